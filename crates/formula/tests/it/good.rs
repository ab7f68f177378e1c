//! The meaning of valid expressions.

use formula::{Expression, Location};
use math::double_double::DoubleDouble;
use math::lane;
use math::number::Number;
use std::f64::consts::{E, PI};

const HERE: Location = Location { line: 7, column: 9 };

fn value(text: &str) -> f64 {
    let expression = Expression::parse("claims.toml", HERE, text).unwrap_or_else(|error| panic!("{text}: {error}"));
    let number = |place: usize| match expression.names()[place].0.as_str() {
        "a" => 3.0,
        "b" => -2.0,
        "q" => 0.75,
        name => panic!("{name}"),
    };
    expression.eval(number).unwrap_or_else(|error| panic!("{text}: {error}"))
}

#[test]
fn operators_bind_as_written() {
    let table = [
        ("1 + 2*3", 7.0),
        ("(1 + 2)*3", 9.0),
        ("8 - 3 - 2", 3.0),
        ("8/4/2", 1.0),
        ("8/4*2", 4.0),
        ("8 - 3 + 2", 7.0),
        ("-2^2", -4.0),
        ("(-2)^2", 4.0),
        ("2^-1", 0.5),
        ("2^3^2", 512.0),
        ("2^-1^2", 0.5),
        ("2^-2*3", 0.75),
        ("-2*-3", 6.0),
        ("2 - -3", 5.0),
        ("--2", 2.0),
        ("-a*b", 6.0),
        ("-a^2", -9.0),
        ("b^3", -8.0),
        ("b^-3", -0.125),
        ("b^(-2)", 0.25),
        ("b^0", 1.0),
        ("b^1", -2.0),
        ("b^-1", -0.5),
        ("a^(1 + 1)", 9.0),
        ("1e3 + 1E-3 + 2.5e+1", 1025.001),
        ("2e", f64::NAN),
        (".5 + 2.", 2.5),
        ("\n\t 1\r\n + 1 ", 2.0),
        ("e", E),
        ("2*pi", 2.0 * PI),
        ("min(a, b)", -2.0),
        ("max(1, a, b, 2)", 3.0),
        ("min(3, 2, 1)", 1.0),
        ("abs(b) + abs(a)", 5.0),
        ("sqrt(16)", 4.0),
        ("ramp(b, 0) + ramp(a, 0)", 2.0),
        ("ramp(0.5 - 0.5, 0)", 0.0),
    ];
    for (text, expected) in table.into_iter().filter(|(text, _)| *text != "2e") {
        assert_eq!(value(text), expected, "{text}");
    }
}

#[test]
fn functions_are_those_of_math() {
    let ramp = |x: f64, width: f64| width * lane::softplus(x * (-1.0 / width));
    let table = [
        ("exp(q)", lane::exp(0.75)),
        ("ln(q)", lane::ln(0.75)),
        ("ln_1p(q)", lane::ln_1p(0.75)),
        ("exp_m1(q)", lane::exp_m1(0.75)),
        ("tanh(q)", lane::tanh(0.75)),
        ("softplus(q)", lane::softplus(0.75)),
        ("sqrt(q)", 0.75_f64.sqrt()),
        ("a^q", lane::pow(3.0, 0.75)),
        ("a^17", lane::pow(3.0, 17.0)),
        ("2^a", lane::pow(2.0, 3.0)),
        ("a^16", 43_046_721.0),
        ("q^7", (((((0.75 * 0.75) * 0.75) * 0.75) * 0.75) * 0.75) * 0.75),
        ("a^-3", 1.0 / 27.0),
        ("ramp(q, 0.1)", ramp(0.75, 0.1)),
        ("ramp(b, 0.3)", ramp(-2.0, 0.3)),
    ];
    for (text, expected) in table {
        assert_eq!(value(text).to_bits(), expected.to_bits(), "{text}: {} instead of {expected}", value(text));
    }
}

#[test]
fn names_are_listed_in_the_order_of_the_text_with_their_places() {
    let expression = Expression::parse("claims.toml", HERE, "v - v_beside\n  + s*x/j + v").expect("an expression");
    let place = |line, column| Location { line, column };
    let names: Vec<(&str, Location)> = expression.names().iter().map(|(name, at)| (name.as_str(), *at)).collect();
    let expected =
        [("v", place(7, 9)), ("v_beside", place(7, 13)), ("s", place(8, 5)), ("x", place(8, 7)), ("j", place(8, 9))];
    assert_eq!(names, expected);
    let values = [5.0, 2.0, 3.0, 8.0, 6.0];
    assert_eq!(expression.eval(|name| values[name]).expect("a value"), 12.0);
    let constant = Expression::parse("claims.toml", HERE, "2*pi").expect("an expression");
    assert_eq!(constant.eval(|_| panic!("no variable")), Ok(2.0 * PI));
    let exact = constant.carry_out(DoubleDouble::from, |_| panic!("no variable"));
    assert_eq!(exact, DoubleDouble::from(2.0 * PI));
}

#[test]
fn what_has_no_value_is_named_with_its_place_and_operands() {
    // text, column, found, valid
    let table = [
        ("1 + ln(a)", 13, "ln(-0.5)", "> 0"),
        ("a + 1/(b - b)", 14, "(1.0) / (0.0)", "divisor"),
        ("sqrt(a)*0.5", 9, "sqrt(-0.5)", ">= 0"),
        ("2*ln_1p(2*a)", 11, "ln_1p(-1.0)", "> -1"),
        ("a^b", 10, "(-0.5) ^ (0.5)", "base > 0"),
        ("max(0, ln(a))", 16, "ln(-0.5)", "> 0"),
        ("min(ln(a), 0)", 13, "ln(-0.5)", "> 0"),
        ("exp(1000*b) - 1", 9, "exp(500.0)", ""),
        ("exp(1600*b) - 1", 9, "exp(800.0)", "709"),
        ("(b - b)^-2", 16, "(0.0)^(-2)", "divisor"),
        ("exp(1600*b) - exp(1600*b)", 9, "exp(800.0)", "709"),
    ];
    for (text, column, found, valid) in table {
        let expression = Expression::parse("claims.toml", HERE, text).unwrap_or_else(|error| panic!("{text}: {error}"));
        let first_is_a = expression.names()[0].0 == "a";
        let result = expression.eval(|name| if (name == 0) == first_is_a { -0.5 } else { 0.5 });
        if found == "exp(500.0)" {
            assert!(result.is_ok(), "{result:?}");
            continue;
        }
        let error = result.expect_err(text);
        assert_eq!((error.place.line, error.place.column), (7, column), "{text}: {error}");
        assert!(error.found.contains(found) && error.valid.contains(valid), "{text}: {error}");
    }
    let through_infinity = Expression::parse("claims.toml", HERE, "1/(1 + exp(b))").expect("an expression");
    assert_eq!(through_infinity.eval(|_| 800.0).expect("a value"), 0.0);
}

#[test]
fn the_first_wins_a_tie_and_nan_is_not_swallowed() {
    for f in [<f64 as Number>::min, <f64 as Number>::max] {
        assert_eq!((f(0.0, -0.0).to_bits(), f(-0.0, 0.0).to_bits()), (0.0_f64.to_bits(), (-0.0_f64).to_bits()));
        assert!(f(f64::NAN, 1.0).is_nan() && f(1.0, f64::NAN).is_nan());
    }
    let (a, b) = (DoubleDouble::sum(1.0, 1e-20), DoubleDouble::ONE);
    assert_eq!((Number::min(a, b), Number::max(b, a)), (b, a));
    for f in [<DoubleDouble as Number>::min, <DoubleDouble as Number>::max] {
        assert!(f(DoubleDouble::from(f64::NAN), a).hi.is_nan() && f(a, DoubleDouble::from(f64::NAN)).hi.is_nan());
    }
}
