//! Entries: verdicts, placeholders, and every kind of bad input.

use crate::desk::{Desk, claim, numbers, open_claim};
use claims::entry::Verdict;
use claims::source::LedgerFiles;
use claims::uncertain::Uncertain;
use claims::{report, words};

#[test]
fn verdicts_follow_from_tests() {
    let desk = Desk::new("verdicts", &[("one", "x\n1\n")]);
    for (tests, under, verdict) in [
        (&["> 0"][..], &[][..], Verdict::Holds),
        (&["> 0", "< 2"], &[], Verdict::Holds),
        (&["> 0", "> 2"], &[], Verdict::Fails),
        (&["> 2"], &["> 0"], Verdict::Conditional),
        (&["> 2"], &["> 0", "> 3"], Verdict::Fails),
        // a condition is not needed for what holds as it is written
        (&["> 0"], &["> 3"], Verdict::Holds),
    ] {
        let found = desk.ledger(&claim("holds", tests, under)).expect("a ledger").claims[0].found();
        assert_eq!(found, verdict, "{tests:?} {under:?}");
    }
    // errors reach over: nothing is decided
    let open = |name: &str, tests: &[&str], under: &[&str]| {
        let desk = Desk::new(name, &[("one", "x\n1\n")]);
        desk.error("one", "x", "taylor", 0.5);
        desk.ledger(&claim("holds", tests, under)).expect("a ledger").claims[0].found()
    };
    assert_eq!(open("open-1", &["> 0.8"], &[]), Verdict::Open);
    assert_eq!(open("open-2", &["> 0", "> 0.8"], &[]), Verdict::Open);
    assert_eq!(open("open-3", &["> 0.8", "> 2"], &[]), Verdict::Fails);
    assert_eq!(open("open-4", &["> 2"], &["> 0.8"]), Verdict::Open);
    assert_eq!(report::verdict(&[]), Verdict::Open);
}

#[test]
fn bad_tests_are_named() {
    let desk = numbers();
    let count = "take = \"count\"\ntable = \"fig90/one\"";
    let last = "take = \"last\"\nof = \"v\"\ntable = \"fig90/one\"";
    desk.problem(
        "take = \"count\"\ntable = \"fig90/two\"",
        &["table: no table fig90/two", "cargo xtask figures fig90"],
    );
    desk.problem("take = \"count\"\ntable = \"accuracy/two\"", &["table", "data/accuracy/two.csv is not there"]);
    desk.problem("take = \"count\"\ntable = \"../one\"", &["table", "valid are names"]);
    desk.problem(&format!("{count}\nwhere = [\"x > 0\"]"), &["where: no column x; there are t, v, w"]);
    desk.problem(&format!("{count}\nwhere = [\"v > x\"]"), &["where: x is not a column", "t, v, w"]);
    desk.problem(&format!("{count}\nwhere = [\"v >\"]"), &["where", "op one of < <= > >= = !="]);
    desk.problem(&format!("{count}\nwhere = [\"v ~ 1\"]"), &["where", "no comparison"]);
    desk.problem(&format!("{count}\nwhere = [\"v > 1 ^ * 2\"]"), &["where", "column 5", "`*`"]);
    desk.problem(&format!("{last}\nwhere = [\"v > 9\"]"), &["where: no row is left (fig90/one)"]);
    desk.problem("take = \"only\"\nof = \"v\"\ntable = \"fig90/one\"", &["4 rows are left where `only` needs one"]);
    desk.problem("take = \"share\"\ntable = \"fig90/one\"\namong = [\"v > 9\"]", &["among", "no row"]);
    desk.problem("take = \"last\"\ntable = \"fig90/one\"", &["of: is missing: `last` needs a column"]);
    desk.problem("take = \"last\"\nof = \"x\"\ntable = \"fig90/one\"", &["of: no column x"]);
    desk.problem(&format!("{count}\nof = \"v\""), &["of: `count` counts rows"]);
    desk.problem(&format!("{count}\non = [\"t\"]"), &["on: is only for"]);
    desk.problem(&format!("{count}\nnext = \"t\"\nbeside = \"fig90/one\""), &["next: stands beside"]);
    desk.problem(&format!("{last}\nis = \"big\""), &["is: \"big\"; valid"]);
    desk.problem(&format!("{last}\ntimes = 2\nless = 2"), &["less: stands beside times"]);
    desk.problem(&format!("{last}\ntimes = \"2\""), &["times", "must be a number or a measure"]);
    desk.problem(
        &format!("{last}\ntimes = {{ take = \"last\", off = \"v\", table = \"fig90/one\" }}"),
        &["times", "unknown field `off`"],
    );
    desk.problem(
        &format!("{last}\ntimes = {{ take = \"last\", of = \"z\", table = \"fig90/one\" }}"),
        &["times, of: no column z"],
    );
}

#[test]
fn malformed_files_are_named_with_their_line() {
    let failure = |claims: &str| {
        let failure = LedgerFiles::parse([claims, "", ""]).expect_err(claims);
        assert_eq!(failure.code(), 2);
        failure.text().to_owned()
    };
    let good = claim("holds", &["> 0"], &[]);
    LedgerFiles::parse([&good, "", ""]).expect("a claim");
    for (from, to, wanted) in [
        ("take = \"only\"", "take = \"some\"", "paper/claims.toml:8 (at or after one): unknown variant `some`"),
        ("of = \"x\"", "off = \"x\"", "unknown field `off`"),
        ("verdict = \"holds\"", "verdict = \"good\"", "unknown variant `good`, expected one of `holds`"),
        ("label = \"l\"", "", "missing field `label`"),
        ("label = \"l\"", "label = 1", "paper/claims.toml:3"),
        ("id = \"one\"", "id = \"One\"", "id: must be small letters"),
        ("finding", "condition = \"if\"\nfinding", "condition: stands together with"),
        ("verdict = \"holds\"", "verdict = \"cannot be decided\"", "why: is missing"),
        ("finding", "why = \"so\"\nfinding", "why: is only for"),
        ("is = \"> 0\"", "", "test: no test has an `is`"),
        ("finding", "verdict_found = \"holds\"\nfinding", "one, verdict_found: is found by the tests"),
    ] {
        let text = good.replacen(from, to, 1);
        let found = failure(&text);
        assert!(found.contains(wanted), "{to}: {found}");
    }
    assert!(failure(&format!("{good}{good}")).contains("id: appears twice"));
    assert_eq!(LedgerFiles::parse(["", "", ""]).expect("no files"), LedgerFiles::default());
}

#[test]
fn placeholders_are_filled_with_what_the_error_carries() {
    let desk = Desk::new("fill", &[("one", "x,error\n0.123456789,0.00004\n")]);
    let text = |finding: &str| {
        let test = "name = \"x\"\ntake = \"only\"\nof = \"x\"\ntable = \"one\"\nerror_of = \"error\"\nis = \"> 0\"";
        let claim = open_claim(test).replace("finding = \"\"", &format!("finding = \"{finding}\""));
        desk.ledger(&claim).map(|ledger| ledger.claims[0].finding.clone()).map_err(|failure| failure.text().to_owned())
    };
    assert_eq!(text("is {x} now").as_deref(), Ok("is 0.123 now"));
    // four digits lie above the error
    assert_eq!(text("{x:9}, {x:2}, {x:percent}").as_deref(), Ok("0.1235, 0.12, 12.3 %"));
    assert!(text("{y}").is_err_and(|text| text.contains("no test has the name y; there are: x")));
    assert!(text("{x").is_err_and(|text| text.contains("not closed")));
    assert!(text("{x:many}").is_err_and(|text| text.contains("valid: {name}, {name:5}")));
    assert!(text("is 0.1235").is_err_and(|text| text.contains("0.1235 is typed")));
    for (value, digits, expected) in [
        (0.98507, 3, "0.985"),
        (4.991e-8, 2, "5.0e-8"),
        (960.8728, 5, "960.87"),
        (123_456.7, 3, "123457"),
        (-0.000_12, 2, "-0.00012"),
        (1.0, 3, "1.00"),
        (9.999, 2, "10"),
    ] {
        assert_eq!(words::significant(value, digits), expected);
    }
    assert_eq!(words::number(Uncertain::exact(39_800.0), None), "39800");
}

#[test]
fn names_stand_once() {
    let desk = numbers();
    let test = "name = \"a\"\ntake = \"count\"\ntable = \"fig90/one\"";
    let failure = desk.ledger(&format!("{}[[claim.test]]\n{test}\n", open_claim(test))).expect_err("twice");
    assert!(failure.text().contains("name: a appears twice"), "{}", failure.text());
}
