//! Invalid expressions and laws: where the message points, and what it suggests.

use crate::common::{graph, lines};
use formula::limits::{DEEPEST, FARTHEST, LONGEST_TEXT, MOST_OPERATIONS};
use formula::{Definition, Error, Expression, Given, Location, law};

const START: Location = Location { line: 3, column: 17 };

#[track_caller]
fn assert_error(error: &Error, line: u32, column: u32, found: &str, valid: &str) {
    assert_eq!((error.place.line, error.place.column), (line, column), "{error}");
    assert!(error.found.contains(found), "{found:?} is not in: {error}");
    assert!(error.valid.contains(valid) && !error.valid.is_empty(), "{valid:?} is not in: {error}");
    let text = error.to_string();
    assert!(text.starts_with(&format!("{}:{line}:{column}: ", error.file)), "{text}");
}

/// Text, offset of the place from the beginning of the text, what is found, what would be valid.
const SYNTAX: [(&str, u32, &str, &str); 62] = [
    ("", 0, "the end", "a number"),
    ("  ", 2, "the end", "a number"),
    ("1 +", 3, "the end", "a number"),
    ("1 + * 2", 4, "*", "a number"),
    ("+1", 0, "+", "a number"),
    ("1 + )", 4, ")", "a number"),
    ("()", 1, ")", "a number"),
    ("2 3", 2, "`3` behind `2`", "2*3"),
    ("2a", 1, "`a` behind `2`", "2*a"),
    ("2e", 1, "`e` behind `2`", "2*e"),
    ("2(a + 1)", 1, "`(` behind `2`", "2*(...)"),
    ("a b", 2, "`b` behind `a`", "a*b"),
    ("a (b)", 2, "`(` behind `a`", "a*("),
    ("(a)(b)", 3, "`(` behind `)`", ")*("),
    ("(a)2", 3, "`2` behind `)`", ")*2"),
    ("1_000", 1, "`_`", "letter first"),
    ("0x10", 1, "`x10` behind `0`", "0*x10"),
    ("(a + b", 6, "is not closed", ")"),
    ("((a)", 4, "3:17", ")"),
    ("exp(a", 5, "exp(", ")"),
    ("a + b)", 5, "`)`, which closes nothing", "end"),
    ("a]", 1, "`]`, which closes nothing", "end"),
    ("(a]", 2, "is not closed", ")"),
    ("a[1]", 1, "`[` behind `a`", "s[j]"),
    ("a \u{2212} b", 2, "minus or dash `\u{2212}` (U+2212)", "ASCII minus -"),
    ("a \u{2013} b", 2, "minus or dash", "-"),
    ("a \u{d7} b", 2, "multiplication", "*"),
    ("a\u{b7}b", 1, "multiplication", "*"),
    ("a \u{f7} b", 2, "division", "/"),
    ("a:b", 1, "division", "/"),
    ("a\u{b2}", 1, "superscript", "^2"),
    ("a\u{2074}", 1, "superscript", "^"),
    ("\u{221a}a", 0, "root", "sqrt"),
    ("2*\u{3c0}", 2, "Greek", "pi"),
    ("\u{3ba}*a", 0, "`\u{3ba}` (U+03BA)", "ASCII letters"),
    ("a\u{a0}+ b", 1, "blank", "ordinary space"),
    ("a**2", 1, "**", "^"),
    ("{a}", 0, "brace", "( )"),
    ("|a|", 0, "bar", "abs"),
    ("a = b", 2, "comparison", "min(a, b)"),
    ("max(a; b)", 5, "semicolon", "comma"),
    ("a % b", 2, "%", "+ - * / ^"),
    ("3,5*a", 1, "decimal comma", "3.5"),
    ("2*(3,5 + a)", 4, "decimal comma", "3.5"),
    ("a, b", 1, "comma outside", "operator"),
    ("(a, b)", 2, "comma outside", "operator"),
    ("exp(1,5)", 5, "comma behind the arguments of `exp`", "1.5"),
    ("exp(a, b)", 5, "`exp`", "1 argument"),
    ("exp()", 4, ")", "a number"),
    ("exp a", 0, "`exp` without arguments", "exp(EXPRESSION)"),
    ("ramp(a)", 0, "`ramp` with 1 argument", "2 arguments"),
    ("ramp(a, b, 1)", 9, "`ramp`", "2 arguments"),
    ("min(a)", 0, "`min` with 1 argument", "2 arguments or more"),
    ("max(a, )", 7, ")", "a number"),
    ("sin(a)", 0, "`sin(`", "functions exp"),
    ("log(a)", 0, "`log(`", "ln(...)?"),
    ("sqr(a)", 0, "`sqr(`", "sqrt(...)?"),
    ("1e999", 0, "too large", "1.797"),
    ("1.2.3", 0, "two points", "0.5"),
    (".", 0, "`.`", "0.5"),
    ("a\n + b\n  c", 0, "`c` behind `b`", "b*c"),
    ("a ! b", 2, "!", "+ - * / ^"),
];

#[test]
fn messages_of_syntax_point_and_offer() {
    for (text, offset, found, valid) in SYNTAX {
        let error = Expression::parse("claims.toml", START, text).expect_err(text);
        let (line, column) = if text.contains('\n') { (5, 3) } else { (3, 17 + offset) };
        assert_error(&error, line, column, found, valid);
        assert_eq!(error.file, "claims.toml");
    }
}

/// The same within a law; places count from column 9 of line 2.
const NEIGHBOURS: [(&str, u32, &str, &str); 31] = [
    ("x", 0, "`x` alone", "x[1]"),
    ("s[]", 2, "`]`", "s[1]"),
    ("s[1.5]", 2, "`1.5`", "s[1]"),
    ("s[a]", 2, "`a`", "s[1]"),
    ("s[j]", 2, "`j`", "within a sum"),
    ("v[2", 3, "is not closed", "]"),
    ("v[2)", 3, "is not closed", "]"),
    ("v[1001]", 2, "1001", "1000"),
    ("v[99999999999]", 2, "99999999999", "1000"),
    ("v[600 + 600]", 8, "1200", "1000"),
    ("v(1)", 0, "`v(`", "v[1]"),
    ("s(2 - v)", 0, "`s(`", "s*("),
    ("2*j", 2, "`j` outside of a sum", "sum(j"),
    ("sum", 3, "the end", "sum(j, FROM, TO, EXPRESSION)"),
    ("sum(s, 1, 2, s)", 4, "`s`", "sum(j"),
    ("sum(k, 1, 2, s)", 4, "`k`", "sum(j"),
    ("sum(j 1, 2, s)", 6, "`1`", "sum(j"),
    ("sum(j, a, 2, s)", 7, "`a`", "whole numbers"),
    ("sum(j, 1, 2.5, s)", 10, "`2.5`", "whole numbers"),
    ("sum(j, 3, 1, s)", 10, "from 3 to 1", "FROM <= TO"),
    ("sum(j, 1, 1001, s)", 10, "1001", "1000"),
    ("sum(j, 1, 2)", 11, "`)`", "EXPRESSION"),
    ("sum(j, 1, 2, s[j]", 17, "is not closed", ")"),
    ("sum(j, 1, 2, s, v)", 14, "comma outside", "operator"),
    ("sum(j, 1, 2, sum(j, 1, 2, s))", 13, "within a sum", "one sum"),
    ("sum(j, 1, 2, s[j*2])", 16, "`*`", "]"),
    ("sum(j, 1, 1000, s[2*j])", 16, "1002 places away at j = 501", "1000"),
    ("sum(j, 1, 2, s[2*a])", 17, "`a`", "j"),
    ("ramp(s, 0.1*v)", 0, "width depends on s", "parameters"),
    ("s + acceleration", 4, "`acceleration` within", "sum"),
    ("kind", 0, "`kind` within", "names of [law]"),
];

#[test]
fn messages_about_neighbours_point_and_offer() {
    for (text, offset, found, valid) in NEIGHBOURS {
        let error = graph(&[("acceleration", text)], &[]).expect_err(text);
        assert_error(&error, 2, 9 + offset, found, valid);
    }
}

#[test]
fn unknown_names_come_with_the_nearest() {
    let numbers = [("kappa", 1.0), ("v0", 2.0)];
    // text, offset, found, nearest
    let table = [
        ("kapa*v0", 0, "`kapa`", "kappa?"),
        ("Kappa*v0", 0, "`Kappa`", "kappa?"),
        ("kappa*V0", 6, "`V0`", "v0?"),
        ("kappa*v0 - vv", 11, "`vv`", "names of [law] (body kappa v0)"),
        ("kappa*v0 + summ", 11, "`summ`", "sum?"),
        ("kappa*v0 + Pi", 11, "`Pi`", "pi?"),
        ("kappa*v0 + quite_different", 11, "`quite_different`", "s v s[j]"),
    ];
    for (text, offset, found, valid) in table {
        let error = graph(&[("acceleration", text)], &numbers).expect_err(text);
        assert_error(&error, 2, 9 + offset, found, valid);
    }
    let error = graph(&[("acceleration", "quite_different*s")], &[]).expect_err("an unknown name");
    assert!(!error.valid.contains('?'), "{error}");
}

#[test]
fn circles_are_named_in_their_order() {
    let texts = [("acceleration", "A - v"), ("A", "2*B"), ("B", "s + C"), ("C", "1 + A"), ("D", "A")];
    let error = graph(&texts, &[]).expect_err("a circle");
    assert_error(&error, 5, 13, "A -> B -> C -> A", "without circular references");
    let error = graph(&[("acceleration", "s"), ("A", "A + 1")], &[]).expect_err("a circle");
    assert_error(&error, 3, 9, "A -> A", "without circular references");
    let error = graph(&[("acceleration", "gap"), ("gap", "s - gap")], &[]).expect_err("a circle");
    assert_error(&error, 3, 13, "gap -> gap", "without circular references");
}

#[test]
fn unused_reserved_and_repeated_names_are_refused() {
    let unused = |texts: &[(&str, &str)], numbers: &[(&str, f64)]| graph(texts, numbers).expect_err("an unused name");
    assert_error(&unused(&[("acceleration", "s")], &[("v0", 1.0)]), 3, 1, "`v0`", "names that are used");
    assert_error(&unused(&[("acceleration", "s"), ("A", "B"), ("B", "v")], &[]), 3, 1, "`A`", "names that are used");
    assert_error(&unused(&[("acceleration", "s"), ("gapp", "v")], &[]), 3, 1, "`gapp`", "gap?");
    assert!(graph(&[("acceleration", "s"), ("gap", "s - a*v")], &[("a", 1.0), ("scale", 2.0)]).is_ok());
    for name in ["exp", "ln_1p", "ramp", "e", "pi", "s", "v", "x", "j", "sum", "kind", "min"] {
        assert_error(&unused(&[("acceleration", "s")], &[(name, 1.0)]), 3, 1, "reserved", "softplus");
    }
    for name in ["", "2a", "a-b", "_a", "\u{3ba}", "a b"] {
        assert_error(&unused(&[("acceleration", "s")], &[(name, 1.0)]), 3, 1, "the name", "a letter first");
    }
    let error = unused(&[("acceleration", "a*s"), ("a", "v")], &[("a", 1.0)]);
    assert_error(&error, 4, 1, "a second `a`", "once");
}

#[test]
fn keys_have_their_kinds() {
    let section = Location { line: 5, column: 1 };
    let of = |definitions: &[Definition<'_>]| law("scene.toml", section, definitions).expect_err("a bad law");
    assert_error(&of(&lines(&[], &[("body", 0.0)])), 5, 1, "without `acceleration`", "acceleration = ");
    assert_error(&of(&lines(&[("acceleration", "s")], &[])), 5, 1, "without `body`", "body = NUMBER");
    assert_error(&of(&lines(&[], &[("acceleration", 1.0)])), 2, 9, "a number for acceleration", "quotation marks");
    assert_error(&of(&lines(&[("body", "1")], &[])), 2, 9, "an expression for body", "a number");
    assert_error(&of(&lines(&[("scale", "1")], &[])), 2, 9, "an expression for scale", "a number");
    for scale in [0.0, -1.5] {
        assert_error(&of(&lines(&[], &[("scale", scale)])), 2, 9, &format!("scale = {scale}"), "> 0");
    }
    assert_error(&of(&lines(&[], &[("gap", 1.0)])), 2, 9, "a number for gap", "quotation marks");
    assert_error(&of(&lines(&[], &[("a", f64::INFINITY)])), 2, 9, "inf", "finite");
    assert_error(&of(&lines(&[], &[("a", f64::NAN)])), 2, 9, "NaN", "finite");
}

#[test]
fn values_without_a_meaning_are_found_on_binding() {
    let numbers = [("a", -1.0)];
    let table = [
        ("s + 2*exp(ln(a))", 19, "ln(-1.0)", "> 0"),
        ("s/(a + 1)", 11, "", ""),
        ("s*(2 - 1/(a + 1))", 17, "(1.0) / (0.0)", "divisor"),
        ("ramp(s, a)", 9, "width -1", "0 (sharp)"),
        ("ramp(s, -a*1e-310)", 9, "width", "1e-300"),
        ("v + a^0.5", 14, "(-1.0) ^ (0.5)", "base > 0"),
        ("v + (a + 1)^-2", 20, "(0.0)^(-2)", "divisor"),
    ];
    for (text, column, found, valid) in table {
        let graph = graph(&[("acceleration", text)], &numbers).unwrap_or_else(|error| panic!("{error}"));
        match graph.bind(&graph.values()) {
            Err(error) => assert_error(&error, 2, column, found, valid),
            // division of a variable by 0 is found when it is carried out
            Ok(bound) => {
                let error = bound.eval(bound.acceleration(), |_| 1.0).expect_err(text);
                assert_error(&error, 2, column - 1, "(1.0) / (0.0)", "divisor");
            }
        }
    }
    let graph = graph(&[("acceleration", "s + 0*ln(a)")], &numbers).expect("a law");
    assert!(graph.bind(&graph.values()).is_ok(), "a term with a factor 0 is not computed");
}

#[test]
fn texts_are_limited_in_depth_and_size() {
    let parse = |text: &str| Expression::parse("claims.toml", START, text);
    let deep = |open: &str, close: &str, count: usize| format!("{}a{}", open.repeat(count), close.repeat(count));
    for (open, close) in [("(", ")"), ("-", ""), ("2^", ""), ("exp(", ")"), ("min(a, ", ")")] {
        assert!(parse(&deep(open, close, DEEPEST - 1)).is_ok(), "{open}");
        // the first operand that is too deep
        let column = 17
            + deep(open, close, DEEPEST)
                .match_indices('a')
                .nth(if open == "min(a, " { DEEPEST - 1 } else { 0 })
                .map_or(0, |(at, _)| at as u32);
        assert_error(&parse(&deep(open, close, DEEPEST)).expect_err(open), 3, column, "deep", "less nesting");
        assert_error(&parse(&deep(open, close, 2000)).expect_err(open), 3, column, "deep", "less nesting");
    }
    let long = format!("a{}", " + a".repeat(LONGEST_TEXT / 4 - 1));
    assert!(parse(&long).is_ok());
    assert_error(&parse(&format!("{long} + a + a")).expect_err("a long text"), 3, 17, "bytes", "named expressions");
    let neighbours = format!("sum(j, -{FARTHEST}, {FARTHEST}, s[j])");
    assert!(graph(&[("acceleration", &neighbours)], &[]).is_ok());
    // named expressions are shared: 2^60 paths, 60 operations
    let names: Vec<String> = (0..60).map(|i| format!("n{i}")).collect();
    let texts: Vec<String> = (1..60).map(|i| format!("n{i}*n{i}")).collect();
    let mut lines = vec![("acceleration", "n0")];
    lines.extend(names.iter().map(String::as_str).zip(texts.iter().map(String::as_str).chain(["s"])));
    assert!(graph(&lines, &[]).expect("a law").size() < 70);
    // sums are written out, and limited, also where everything is shared
    for body in ["s[j]*v[j]", "v*v"] {
        let terms = format!(" + {body}").repeat(120);
        let text = format!("sum(j, 1, 1000, 1{terms})");
        let error = graph(&[("acceleration", &text)], &[]).expect_err("a large law");
        assert_eq!(error.place.line, 2);
        assert!(error.found.contains(&MOST_OPERATIONS.to_string()) && error.valid.contains("shorter sums"), "{error}");
    }
}

#[test]
fn a_long_chain_of_names_does_not_recurse() {
    let count = 20_000;
    let names: Vec<String> = (0..count).map(|i| format!("n{i}")).collect();
    let texts: Vec<String> = (1..=count).map(|i| if i < count { format!("n{i}") } else { "s".to_owned() }).collect();
    let place = Location { line: 1, column: 1 };
    let chain = names.iter().zip(&texts).map(|(name, text)| (name.as_str(), Given::Text(text)));
    let rest = [("acceleration", Given::Text("n0")), ("body", Given::Number(0.0))];
    let definitions: Vec<Definition<'_>> = rest
        .into_iter()
        .chain(chain)
        .map(|(name, given)| Definition { name, key: place, value: place, given })
        .collect();
    assert!(law("scene.toml", place, &definitions).is_ok());
}
