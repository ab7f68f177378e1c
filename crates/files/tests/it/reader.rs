//! Typed values from TOML, with lines.

use files::reader::{FINITE, NOT_NEGATIVE, POSITIVE, Reader, Section, Value};

fn parse(text: &str) -> Section {
    Section::parse("my.toml", text).unwrap_or_else(|error| panic!("{error}"))
}

fn number(text: &str) -> f64 {
    let section = parse(&format!("x = {text}"));
    Reader::new("my.toml", "top", &section).number("x", FINITE).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn numbers_in_every_spelling_of_toml() {
    let cases = [
        ("1", 1.0),
        ("-1", -1.0),
        ("+1", 1.0),
        ("1_000", 1000.0),
        ("0x1F", 31.0),
        ("0o17", 15.0),
        ("0b101", 5.0),
        ("1.5", 1.5),
        ("1_000.25", 1000.25),
        ("1e3", 1000.0),
        ("1E-3", 1e-3),
        ("+2.5e+2", 250.0),
        ("0.1", 0.1),
        ("9007199254740992", 9_007_199_254_740_992.0),
        ("9007199254740994", 9_007_199_254_740_994.0),
    ];
    for (text, expected) in cases {
        assert_eq!(number(text).to_bits(), f64::to_bits(expected), "{text}");
    }
    assert_eq!(number("-0.0").to_bits(), (-0.0_f64).to_bits());
}

#[test]
fn ranges_in_words() {
    let section = parse("x = -5");
    let complaint = |wanted: &str| format!("my.toml:1: top.x = -5: must be {wanted}");
    let reader = || Reader::new("my.toml", "top", &section);
    let text = |error: files::reader::SceneError| error.to_string();
    assert_eq!(text(reader().number("x", POSITIVE).unwrap_err()), complaint("a number > 0.0"));
    assert_eq!(text(reader().number("x", NOT_NEGATIVE).unwrap_err()), complaint("a number >= 0.0"));
    assert_eq!(text(reader().number("x", 1.0..=2.0).unwrap_err()), complaint("a number >= 1.0 and <= 2.0"));
    assert_eq!(text(reader().number("x", 1.0..2.0).unwrap_err()), complaint("a number >= 1.0 and < 2.0"));
    assert_eq!(text(reader().number("x", ..-6.0).unwrap_err()), complaint("a number < -6.0"));
    assert_eq!(reader().number("x", ..=-5.0).unwrap(), -5.0);
    let missing = reader().number("y", FINITE).unwrap_err();
    assert_eq!(text(missing), "my.toml:1: top.y is missing; it must be a finite number; found here: x");
    assert_eq!(reader().optional_number("y", FINITE).unwrap(), None);
}

#[test]
fn what_nothing_asked_for_is_unknown() {
    let section = parse("a = 1\nb = 2\nc = \"x\"\n");
    let mut reader = Reader::new("my.toml", "top", &section);
    assert_eq!(reader.count("a", 0, 3).unwrap(), 1);
    assert_eq!(reader.choice("c", &["x", "y"]).unwrap(), "x");
    assert!(!reader.has("d"));
    let error = reader.finish().unwrap_err();
    assert_eq!(error.to_string(), "my.toml:2: top.b: unknown key; known here: a, c, d");
}

#[test]
fn counts_are_whole_numbers_in_their_range() {
    for (text, valid) in [("2", true), ("2.0", true), ("1", false), ("6", false), ("2.5", false), ("inf", false)] {
        let section = parse(&format!("x = {text}"));
        let count = Reader::new("my.toml", "top", &section).count("x", 2, 5);
        assert_eq!(count.is_ok(), valid, "{text}");
        if let Err(error) = count {
            assert!(error.to_string().ends_with("must be a whole number from 2 to 5"), "{error}");
        }
    }
}

#[test]
fn lines_are_those_of_the_keys() {
    let section = parse("# comment\n\na = 1\n[t]\n\nb = 2\ninner = { c = 3 }\n[t.deep]\nd = 4\n");
    let line = |section: &Section, key: &str| section.entries[key].line;
    let table = section.section("t").expect("t");
    assert_eq!((line(&section, "a"), line(table, "b"), line(table, "inner")), (3, 6, 7));
    assert_eq!(line(table.section("inner").expect("inner"), "c"), 7);
    assert_eq!((table.line, line(table.section("deep").expect("deep"), "d")), (4, 9));
}

#[test]
fn what_is_no_number_keeps_its_type() {
    let section = parse("a = true\nb = [1]\nc = 2020-01-01\nd = \"x\"\n");
    let mut reader = Reader::new("my.toml", "top", &section);
    let cases = [("a", "a value of type boolean"), ("b", "a value of type array"), ("c", "a value of type datetime")];
    for (key, kind) in cases {
        let error = reader.number(key, FINITE).unwrap_err().to_string();
        assert!(error.contains(kind), "{error}");
    }
    assert!(matches!(section.entries["d"].value, Value::Text(_)));
}

#[test]
fn text_that_is_not_toml() {
    let error = Section::parse("my.toml", "a = 1\nb = = 2\n").unwrap_err();
    assert_eq!(error.line, 2, "{error}");
    let error = Section::parse("my.toml", "a = 99999999999999999999\n").unwrap_err();
    assert_eq!(error.to_string(), "my.toml:1: 99999999999999999999 is not a number that fits");
}

#[test]
fn what_lies_on_top_wins_key_by_key() {
    let mut below = parse("a = 1\n[t]\nb = 2\nc = 3\n[t.u]\nd = 4\n");
    below.overlay(&parse("[t]\nb = 20\ne = 50\n[t.u]\nf = 60\n[v]\ng = 70\n"));
    let mut lines = Vec::new();
    below.canonical("", &mut lines);
    assert_eq!(
        lines,
        ["a = 1.0", "t.b = 20.0", "t.c = 3.0", "t.e = 50.0", "t.u.d = 4.0", "t.u.f = 60.0", "v.g = 70.0"]
    );
    // a value replaces a table, and a table a value
    below.overlay(&parse("t = 1\n[a]\nh = 2\n"));
    let mut lines = Vec::new();
    below.canonical("", &mut lines);
    assert_eq!(lines, ["a.h = 2.0", "t = 1.0", "v.g = 70.0"]);
}

#[test]
fn whole_numbers_that_no_double_holds_are_refused() {
    for (text, nearest) in [
        ("9007199254740993", "9007199254740992"),
        ("-9007199254740993", "-9007199254740992"),
        ("9223372036854775807", "9223372036854775808"),
    ] {
        let error = Section::parse("my.toml", &format!("a = 1\nb = {text}\n")).unwrap_err();
        assert_eq!(error.line, 2, "{error}");
        assert!(error.problem.contains(text) && error.problem.contains(nearest), "{error}");
    }
    let section = parse("x = 1e300");
    assert!(Reader::new("my.toml", "top", &section).count("x", 0, usize::MAX - 1).is_err());
}

#[test]
fn decimal_commas_and_typographic_minus_signs_are_named() {
    for (text, words) in [
        ("a = 1\nx = 1,5\n", "decimal comma; write 1.5"),
        ("a = 1\nx = \u{2212}2.5\n", "typographic minus sign; write -2.5"),
        ("a = 1\nx = \u{2013}2\n", "typographic minus sign; write -2"),
    ] {
        let error = Section::parse("my.toml", text).unwrap_err();
        assert_eq!(error.line, 2, "{error}");
        assert!(error.problem.contains(words), "{error}");
    }
}

#[test]
fn complaints_say_apart_what_they_are_about() {
    let section = parse("a = -1.5\nb = 2.0");
    let mut reader = Reader::new("my.toml", "law", &section);
    let about = |error: files::reader::SceneError| *error.about.expect("about a key");
    let wrong = about(reader.number("a", POSITIVE).expect_err("negative"));
    assert_eq!((wrong.key.as_str(), wrong.value), ("law.a", Some(Value::Number(-1.5))));
    assert_eq!(wrong.allowed.as_deref(), Some("a number > 0.0"));
    let missing = about(reader.number("c", POSITIVE).expect_err("missing"));
    assert_eq!((missing.key.as_str(), missing.value), ("law.c", None));
    assert_eq!(missing.allowed.as_deref(), Some("a number > 0.0"));
    let complaint = about(reader.complaint("b", "is too large; must be below 1"));
    assert_eq!(complaint.allowed.as_deref(), Some("below 1"));
    let unknown = about(reader.finish().expect_err("b was not asked for"));
    assert_eq!((unknown.key.as_str(), unknown.allowed.as_deref()), ("law.b", Some("a, c")));
}
