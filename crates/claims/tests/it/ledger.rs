//! The ledger: measures on small tables, verdicts, and every kind of bad input.

use checkout::failure::Failure;
use checkout::paths::{Paths, Scheme};
use claims::again;
use claims::entry::{Claim, Verdict};
use claims::report::{self, Ledger, Tested};
use claims::requirement::Requirement;
use claims::sheet::{Sheet, Stated};
use claims::source::Sources;
use claims::tables::{Tables, figure_of};
use claims::uncertain::{Outcome, Relation, Uncertain};
use claims::words;
use math::number::Number;
use std::fs;
use std::path::Path;

/// A folder with tables and a manifest, in which measures are evaluated.
struct Desk {
    paths: Paths,
}

impl Desk {
    fn new(name: &str, tables: &[(&str, &str)]) -> Desk {
        // tests run beside each other, and several have a desk of the same name
        static DESKS: std::sync::atomic::AtomicUsize = std::sync::atomic::AtomicUsize::new(0);
        let own = DESKS.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
        let root = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("ledger-{name}-{own}"));
        let _ = fs::remove_dir_all(&root);
        for (table, text) in tables {
            let path = root.join(format!("data/{table}.csv"));
            fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
            fs::write(path, text).expect("a table");
        }
        let paths = Paths { base: root.clone(), target: root.join("target"), root, scheme: Scheme::Adaptive };
        Desk { paths }
    }

    /// States an error for a column of a table.
    fn error(&self, table: &str, column: &str, method: &str, error: f64) {
        let entry = serde_json::json!({ "error": { column: error }, "method": method });
        let manifest = serde_json::json!({ "schema_version": 1, "outputs": { format!("data/{table}.csv"): entry } });
        fs::write(self.paths.root.join("data/manifest.json"), manifest.to_string()).expect("a manifest");
    }

    fn ledger(&self, claims: &str) -> Result<Ledger, Failure> {
        let sources = Sources::parse([claims, "", ""])?;
        Ledger::new(&sources, &Tables::new(&self.paths, &self.paths)?)
    }

    /// The one test of a claim that only reports.
    #[track_caller]
    fn measure(&self, test: &str) -> Tested {
        self.ledger(&open_claim(test)).unwrap_or_else(|failure| panic!("{test}: {}", failure.text())).claims[0].tests[0]
            .clone()
    }

    #[track_caller]
    fn value(&self, test: &str, value: f64, error: f64) {
        let tested = self.measure(test);
        let close = |a: f64, b: f64| a == b || (a - b).abs() <= 1e-12 * b.abs();
        assert!(
            close(tested.value, value) && close(tested.error, error),
            "{test}: {} +- {}",
            tested.value,
            tested.error
        );
    }

    /// The message about a test that cannot be evaluated.
    #[track_caller]
    fn problem(&self, test: &str, wanted: &[&str]) {
        let failure = self.ledger(&open_claim(test)).expect_err(test);
        assert_eq!(failure.code(), 2, "{test}");
        for part in [&["paper/claims.toml, one, test 1"], wanted].concat() {
            assert!(failure.text().contains(part), "{test}: {:?} lacks {part:?}", failure.text());
        }
    }
}

fn open_claim(test: &str) -> String {
    let head = "[[claim]]\nid = \"one\"\nlabel = \"eq:one\"\nsays = \"one\"\nverdict = \"cannot be decided\"\nwhy = \"a test\"\n";
    format!("{head}finding = \"\"\n[[claim.test]]\n{test}\n")
}

/// A claim with tests that compare the only cell of table `one` with numbers.
fn claim(verdict: &str, tests: &[&str], under: &[&str]) -> String {
    let block = |key: &str, is: &&str| {
        format!("[[claim.{key}]]\ntake = \"only\"\nof = \"x\"\ntable = \"one\"\nis = \"{is}\"\n")
    };
    let condition = if under.is_empty() { "" } else { "condition = \"if\"\n" };
    let why = if verdict == "cannot be decided" { "why = \"so\"\n" } else { "" };
    let tests: String = tests.iter().map(|is| block("test", is)).collect();
    let under: String = under.iter().map(|is| block("under", is)).collect();
    let head =
        format!("[[claim]]\nid = \"one\"\nlabel = \"l\"\nsays = \"s\"\nverdict = \"{verdict}\"\nfinding = \"\"\n");
    format!("{head}{condition}{why}{tests}{under}")
}

fn numbers() -> Desk {
    Desk::new("numbers", &[("fig90/one", "t,v,w\n0,3,1\n1,-1,2\n2,5,4\n3,2,8\n")])
}

#[test]
fn every_way_to_take_a_number() {
    let desk = numbers();
    for (take, value) in
        [("least", -1.0), ("largest", 5.0), ("mean", 2.25), ("span", 6.0), ("first", 3.0), ("last", 2.0)]
    {
        desk.value(&format!("take = \"{take}\"\nof = \"v\"\ntable = \"fig90/one\""), value, 0.0);
    }
    desk.value("take = \"only\"\nof = \"v\"\ntable = \"fig90/one\"\nwhere = [\"t = 2\"]", 5.0, 0.0);
    desk.value("take = \"count\"\ntable = \"fig90/one\"", 4.0, 0.0);
    desk.value("take = \"count\"\ntable = \"fig90/one\"\nwhere = [\"v > 0\", \"t < 3\"]", 2.0, 0.0);
    desk.value("take = \"share\"\ntable = \"fig90/one\"\nwhere = [\"v > 2\"]", 0.5, 0.0);
    desk.value("take = \"share\"\ntable = \"fig90/one\"\nwhere = [\"v > 2\"]\namong = [\"t >= 1\"]", 1.0 / 3.0, 0.0);
}

#[test]
fn every_comparison_and_expression() {
    let desk = numbers();
    for (condition, count) in [
        ("v < 2", 1.0),
        ("v <= 2", 2.0),
        ("v > 2", 2.0),
        ("v >= 2", 3.0),
        ("v = 2", 1.0),
        ("v != 2", 3.0),
        ("v > w", 2.0),
        ("v > 0.5 * w", 2.0),
        ("v + w >= 9", 2.0),
        ("w / v < 0", 1.0),
        ("w - v > (v + w) / 3", 2.0),
        ("abs(v) = max(v, -v)", 4.0),
    ] {
        desk.value(&format!("take = \"count\"\ntable = \"fig90/one\"\nwhere = [\"{condition}\"]"), count, 0.0);
    }
    desk.value("take = \"largest\"\nof = \"w - v\"\ntable = \"fig90/one\"", 6.0, 0.0);
    desk.value("take = \"last\"\nof = \"w\"\ntable = \"fig90/one\"\ntimes = 2", 16.0, 0.0);
    desk.value("take = \"last\"\nof = \"w\"\ntable = \"fig90/one\"\nover = { take = \"last\", of = \"v\", table = \"fig90/one\" }", 4.0, 0.0);
    desk.value(
        "take = \"last\"\nof = \"w\"\ntable = \"fig90/one\"\nless = { take = \"count\", table = \"fig90/one\" }",
        4.0,
        0.0,
    );
    desk.value("take = \"last\"\nof = \"w\"\ntable = \"fig90/one\"\nplus = 0.5", 8.5, 0.0);
}

#[test]
fn a_table_beside_another_is_joined_on_what_names_its_rows() {
    let desk = Desk::new(
        "beside",
        &[("fig90/left", "a,b,phi\n1,1,-1\n1,2,1\n2,1,3\n"), ("fig90/right", "a,b,phi\n2,1,-3\n1,1,5\n9,9,0\n")],
    );
    desk.error("fig90/left", "phi", "closed form", 0.0);
    let on = "on = [\"a\", \"b\"]";
    desk.value(&format!("take = \"count\"\ntable = \"fig90/left\"\nbeside = \"fig90/right\"\n{on}"), 2.0, 0.0);
    desk.value(&format!("take = \"count\"\ntable = \"fig90/left\"\nbeside = \"fig90/right\"\n{on}\nwhere = [\"phi < 0\", \"phi_beside > 0\"]"), 1.0, 0.0);
    // without `on` the columns without a stated error name the rows
    desk.value(
        "take = \"largest\"\nof = \"phi - phi_beside\"\ntable = \"fig90/left\"\nbeside = \"fig90/right\"",
        6.0,
        0.0,
    );
    desk.problem(
        "take = \"count\"\ntable = \"fig90/left\"\nbeside = \"fig90/right\"\non = [\"phi\"]",
        &["beside", "no row has a partner", "on = [..]"],
    );
    desk.problem(
        "take = \"count\"\ntable = \"fig90/right\"\nbeside = \"fig90/left\"\non = [\"a\"]",
        &["do not tell the rows apart"],
    );
    desk.problem(
        "take = \"count\"\ntable = \"fig90/right\"\nbeside = \"fig90/left\"\non = [\"c\"]",
        &["no column c; there are a, b, phi"],
    );
}

#[test]
fn the_next_row_stays_within_its_group() {
    let text = "a,b,phi\n2,1,3\n1,1,-1\n1,3,4\n1,2,1\n2,2,2\n";
    let desk = Desk::new("next", &[("fig90/map", text)]);
    let next = "take = \"count\"\ntable = \"fig90/map\"\nnext = \"b\"\non = [\"a\"]";
    desk.value(next, 3.0, 0.0);
    desk.value(&format!("{next}\nwhere = [\"phi_next > phi\"]"), 2.0, 0.0);
    desk.value(&format!("{next}\nwhere = [\"phi_next < phi\"]"), 1.0, 0.0);
    desk.problem("take = \"count\"\ntable = \"fig90/map\"\nnext = \"a\"\non = []", &["next", "it orders nothing"]);
    // only the rows looked at are ordered
    desk.value("take = \"count\"\ntable = \"fig90/map\"\nnext = \"a\"\non = []\namong = [\"b = 2\"]\nwhere = [\"phi_next > phi\"]", 1.0, 0.0);
}

#[test]
fn words_and_empty_cells() {
    let desk = Desk::new("words", &[("events", "scene,event,t,n\none,overlap,1,\none,blow_up,,3\ntwo,overlap,4,5\n")]);
    let count = "take = \"count\"\ntable = \"events\"";
    desk.value(&format!("{count}\nwhere = [\"event = overlap\"]"), 2.0, 0.0);
    desk.value(&format!("{count}\nwhere = [\"event != overlap\", \"scene = one\"]"), 1.0, 0.0);
    desk.value(&format!("{count}\nwhere = [\"t = empty\"]"), 1.0, 0.0);
    desk.value(&format!("{count}\nwhere = [\"t != empty\", \"n != empty\"]"), 1.0, 0.0);
    // a comparison with an empty cell does not hold, whichever way it goes
    desk.value(&format!("{count}\nwhere = [\"t >= 0\"]"), 2.0, 0.0);
    desk.value(&format!("{count}\nwhere = [\"t < 0\"]"), 0.0, 0.0);
    desk.value("take = \"last\"\nof = \"t\"\ntable = \"events\"\nwhere = [\"event = overlap\"]", 4.0, 0.0);
    desk.problem("take = \"least\"\nof = \"t\"\ntable = \"events\"", &["of: row 1 (from 0) is empty", "!= empty"]);
    desk.problem("take = \"least\"\nof = \"event\"\ntable = \"events\"", &["is the word \"overlap\""]);
    desk.problem(
        &format!("{count}\nwhere = [\"event = overlp\"]"),
        &["where", "stands nowhere in column event", "overlap, blow_up"],
    );
    desk.problem(&format!("{count}\nwhere = [\"event < overlap\"]"), &["words are not ordered"]);
    desk.problem(&format!("{count}\nwhere = [\"event > 1\"]"), &["where a number is needed"]);
    // a word that is the name of a column stands in quotes
    let desk = Desk::new("quoted", &[("events", "kind,t\nt,1\nn,2\n")]);
    desk.value(&format!("{count}\nwhere = [\"kind = 't'\"]"), 1.0, 0.0);
    desk.problem(&format!("{count}\nwhere = [\"kind = t\"]"), &["is the word \"t\", where a number is needed"]);
    desk.problem(&format!("{count}\nwhere = [\"t > 2 * 'n'\"]"), &["column 5", "'"]);
    desk.problem(&format!("{count}\nwhere = [\"t > 2 * n\"]"), &["no column n"]);
    desk.problem(&format!("{count}\nwhere = [\"(t + 1 > 2\"]"), &["column 7", "not closed"]);
    // functions without brackets are columns
    let desk = Desk::new("functions", &[("fig90/one", "ramp,smooth\n1,1.5\n")]);
    desk.value("take = \"last\"\nof = \"smooth - ramp\"\ntable = \"fig90/one\"", 0.5, 0.0);
}

#[test]
fn errors_come_from_the_manifest_or_a_column() {
    let desk = Desk::new("errors", &[("fig90/one", "t,v,error\n0,10,0.5\n1,20,0.25\n")]);
    let last = "take = \"last\"\nof = \"v\"\ntable = \"fig90/one\"";
    desk.value(last, 20.0, 0.0);
    desk.value(&format!("{last}\nerror_of = \"error\""), 20.0, 0.25);
    desk.error("fig90/one", "v", "taylor", 0.01);
    desk.value(last, 20.0, 0.1);
    desk.value("take = \"mean\"\nof = \"v\"\ntable = \"fig90/one\"", 15.0, 0.1);
    desk.value("take = \"span\"\nof = \"v\"\ntable = \"fig90/one\"", 10.0, 0.2);
    desk.value(&format!("{last}\nless = 5"), 15.0, 0.1);
    desk.value(&format!("{last}\ntimes = 3"), 60.0, 0.3);
    // of tables in closed form the error is a part of numbers above 1
    desk.error("fig90/one", "v", "closed form", 0.01);
    desk.value(last, 20.0, 0.2);
    desk.problem(&format!("{last}\nerror_of = \"none\""), &["error_of", "no column none; there are t, v, error"]);
}

#[test]
fn rows_that_may_or_may_not_belong_are_error() {
    let desk = Desk::new("open", &[("fig90/one", "t,v\n0,1\n1,2\n2,2.05\n3,4\n")]);
    desk.error("fig90/one", "v", "closed form", 0.05);
    let above = |take: &str| format!("take = \"{take}\"\ntable = \"fig90/one\"\nwhere = [\"v > 2\"]");
    // 2 +- 0.1 and 2.05 +- 0.1025 may lie above 2, 4 +- 0.2 does
    desk.value(&above("count"), 1.0, 2.0);
    desk.value(&above("share"), 0.25, 0.5);
    let of = |take: &str| format!("{}\nof = \"v\"", above(take));
    // the largest is 4 whatever they are; the least may be as small as 1.9
    desk.value(&of("largest"), 4.0, 0.2);
    desk.value(&of("least"), 4.0, 2.1);
    assert!(desk.measure(&of("mean")).error.is_infinite());
    assert!(desk.measure(&of("first")).error.is_infinite());
    desk.problem("take = \"count\"\ntable = \"fig90/one\"\namong = [\"v > 2\"]", &["among: row 1", "leaves open"]);
}

#[test]
fn comparisons_are_open_where_the_error_reaches_over() {
    let value = |value: f64, error: f64| Uncertain { value, error };
    for (relation, at, outcome) in [
        (Relation::Above, value(1.0, 0.5), Outcome::True),
        (Relation::Above, value(0.4, 0.5), Outcome::Undecided),
        (Relation::Above, value(-0.4, 0.5), Outcome::Undecided),
        (Relation::Above, value(-1.0, 0.5), Outcome::False),
        (Relation::Above, value(0.0, 0.0), Outcome::False),
        (Relation::AtLeast, value(0.0, 0.0), Outcome::True),
        (Relation::Below, value(-1.0, 0.5), Outcome::True),
        (Relation::AtMost, value(0.5, 0.5), Outcome::Undecided),
        (Relation::Equal, value(0.0, 0.0), Outcome::True),
        (Relation::Equal, value(0.0, 1e-9), Outcome::Undecided),
        (Relation::Equal, value(1.0, 0.5), Outcome::False),
        (Relation::Unequal, value(1.0, 0.5), Outcome::True),
        (Relation::Above, value(f64::NAN, 0.0), Outcome::Undecided),
        (Relation::Above, value(1.0, f64::INFINITY), Outcome::Undecided),
    ] {
        assert_eq!(at.compare(relation, Uncertain::exact(0.0)), outcome, "{at:?} {relation:?} 0");
    }
    let within = Requirement::parse("1 within 0.1").expect("a requirement");
    assert_eq!(within.judge(value(1.05, 0.01)), Outcome::True);
    assert_eq!(within.judge(value(1.05, 0.1)), Outcome::Undecided);
    assert_eq!(within.judge(value(1.5, 0.1)), Outcome::False);
    for text in ["", "> ", "1", "> x", "1 within -1", "~ 1", "> inf"] {
        Requirement::parse(text).expect_err(text);
    }
}

#[test]
fn errors_are_carried_through_arithmetic() {
    let (a, b) = (Uncertain { value: 6.0, error: 0.6 }, Uncertain { value: 2.0, error: 0.5 });
    // every corner of the two intervals lies within the result
    let operations: [fn(Uncertain, Uncertain) -> Uncertain; 8] = [
        |x, y| x + y,
        |x, y| x - y,
        |x, y| x * y,
        |x, y| x / y,
        Number::min,
        Number::max,
        |x, y| y.powi(-3) * x.ln(),
        |x, y| x.powf(-1.5) - y.tanh().exp(),
    ];
    for (place, operation) in operations.into_iter().enumerate() {
        let result = operation(a, b);
        for x in [a.low(), a.high()] {
            for y in [b.low(), b.high()] {
                let corner = operation(Uncertain::exact(x), Uncertain::exact(y)).value;
                assert!((corner - result.value).abs() <= result.error + 1e-12, "{place}: {corner} of {result:?}");
            }
        }
    }
    assert!((a / Uncertain { value: 0.1, error: 0.2 }).error.is_infinite());
    assert!(Uncertain { value: 0.1, error: 0.2 }.ln().error.is_infinite());
}

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
        let found = desk.ledger(&claim("holds", tests, under)).expect("a ledger").claims[0].verdict_found;
        assert_eq!(found, verdict, "{tests:?} {under:?}");
    }
    // errors reach over: nothing is decided
    let open = |name: &str, tests: &[&str], under: &[&str]| {
        let desk = Desk::new(name, &[("one", "x\n1\n")]);
        desk.error("one", "x", "taylor", 0.5);
        desk.ledger(&claim("holds", tests, under)).expect("a ledger").claims[0].verdict_found
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
    desk.problem(&format!("{count}\nwhere = [\"v > x\"]"), &["where: x is no column", "t, v, w"]);
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
    desk.problem(&format!("{last}\ntimes = 2\nplus = 2"), &["plus: stands beside times"]);
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
        let failure = Sources::parse([claims, "", ""]).expect_err(claims);
        assert_eq!(failure.code(), 2);
        failure.text().to_owned()
    };
    let good = claim("holds", &["> 0"], &[]);
    Sources::parse([&good, "", ""]).expect("a claim");
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
    ] {
        let text = good.replacen(from, to, 1);
        let found = failure(&text);
        assert!(found.contains(wanted), "{to}: {found}");
    }
    assert!(failure(&format!("{good}{good}")).contains("id: stands twice"));
    assert_eq!(Sources::parse(["", "", ""]).expect("no files"), Sources::default());
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
    assert!(failure.text().contains("name: a stands twice"), "{}", failure.text());
}

#[test]
fn tables_of_figures_are_told_from_committed_ones() {
    assert_eq!(figure_of("fig11/trajectories"), Some("fig11"));
    assert_eq!(figure_of("s13/eps"), Some("s13"));
    for table in ["events", "accuracy/rounding", "paper-scheme/distance", "solutions/x", "reference/published_std_log"]
    {
        assert_eq!(figure_of(table), None, "{table}");
    }
}

/// The checkout that holds this test.
fn checkout() -> Paths {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    Paths { base: root.clone(), target: root.join("target"), root, scheme: Scheme::Adaptive }
}

#[test]
fn the_committed_ledger_belongs_to_the_files_written_by_hand() {
    let paths = checkout();
    let sources = Sources::read(&paths).expect("the ledger's files");
    let text = fs::read_to_string(paths.ledger()).expect("data/ledger.json");
    let ledger: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let claims = ledger["claims"].as_array().expect("claims");
    assert!(claims.len() >= 40, "{} claims", claims.len());
    assert_eq!(claims.len(), sources.claims.len());
    for (found, claim) in claims.iter().zip(&sources.claims) {
        let words = Some(claim.verdict.words());
        assert_eq!((found["id"].as_str(), found["says"].as_str()), (Some(&*claim.id), Some(&*claim.says)));
        assert_eq!((found["verdict"].as_str(), found["verdict_found"].as_str()), (words, words), "{}", claim.id);
        assert_eq!(found["tests"].as_array().map(Vec::len), Some(claim.tests.len() + claim.under.len()));
        let finding = found["finding"].as_str().unwrap_or("{");
        assert!(!finding.contains(['{', '}']), "{finding}");
    }
    assert_eq!(ledger["errata"].as_array().map(Vec::len), Some(sources.errata.len()));
    assert_eq!(ledger["parameters"].as_array().map(Vec::len), Some(sources.parameters.len()));
}

#[test]
fn claims_over_committed_tables_are_found_as_committed() {
    let paths = checkout();
    let mut sources = Sources::read(&paths).expect("the ledger's files");
    let is_committed = |claim: &Claim| {
        let tests = claim.all_tests();
        let tables = tests.iter().flat_map(|(place, _, measure)| measure.tables(place).expect("tables"));
        tables.into_iter().all(|table| figure_of(&table).is_none())
    };
    sources.claims.retain(is_committed);
    (sources.errata, sources.parameters) = (Vec::new(), Vec::new());
    assert!(sources.claims.len() >= 10, "{} claims", sources.claims.len());
    let ledger = Ledger::new(&sources, &Tables::new(&paths, &paths).expect("tables")).expect("a ledger");
    let text = fs::read_to_string(paths.ledger()).expect("data/ledger.json");
    let committed: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    for claim in &ledger.claims {
        let wanted = committed["claims"].as_array().into_iter().flatten().find(|one| one["id"] == *claim.id);
        assert_eq!(serde_json::to_value(claim).ok().as_ref(), wanted, "{}", claim.id);
    }
}

/// Tables in memory, with the errors that the manifest states.
fn of_memory(paths: &Paths, names: &[&str]) -> Tables<'static> {
    let manifest = checkout::manifest::read(paths).expect("a manifest");
    Tables::of_memory(names.iter().map(|&name| {
        let cells = files::table::Sheet::read(&paths.output(&Paths::table(name))).expect("a table");
        let entry = manifest.get(&Paths::table(name));
        let error = |column: &str| Some(Stated::OfRange(entry?.error.get(column)?.unwrap_or(f64::INFINITY)));
        (name.to_owned(), Sheet::new(cells, &error))
    }))
}

#[test]
fn tables_in_memory_give_the_findings_of_files() {
    let paths = checkout();
    let sources = Sources::read(&paths).expect("the ledger's files");
    let files = Tables::new(&paths, &paths).expect("tables");
    let runs: [(&[&str], usize); 3] = [
        (&["fig04/stable", "fig04/unstable", "events"], 3),
        (&["fig07/stable", "fig07/unstable", "events"], 2),
        (&["fig11/trajectories"], 1),
    ];
    for (names, count) in runs {
        if let Some(missing) = names.iter().find(|name| !files.has(name)) {
            eprintln!("skipped: there is no table {missing}");
            continue;
        }
        let memory = of_memory(&paths, names);
        let claims = again::about(&sources, &|table| memory.has(table)).expect("claims");
        assert!(claims.len() >= count, "{names:?}: {} claims", claims.len());
        for claim in claims {
            let (verdict, tests) = again::judge(claim, &memory).expect("a verdict");
            assert_eq!(verdict, claim.verdict, "{}", claim.id);
            assert_eq!((verdict, tests), again::judge(claim, &files).expect("a verdict"), "{}", claim.id);
        }
    }
}

#[test]
fn a_test_without_a_value_leaves_its_claim_open() {
    let claim = |is: &str| {
        let text = format!(
            "[[claim]]\nid = \"a\"\nlabel = \"l\"\nsays = \"s\"\nverdict = \"holds\"\nfinding = \"f\"\n\
             [[claim.test]]\ntake = \"only\"\nof = \"v\"\ntable = \"fig11/a\"\nwhere = [\"v > 5\"]\nis = \"> 0\"\n\
             [[claim.test]]\ntake = \"count\"\ntable = \"fig11/a\"\nis = \"{is}\"\n"
        );
        Sources::parse([&text, "", ""]).expect("a claim")
    };
    let cells = files::table::Sheet::parse(b"v\n1\n2\n").expect("a table");
    let tables = Tables::of_memory([("fig11/a".to_owned(), Sheet::new(cells, &|_| None))]);
    for (is, expected) in [("= 2", Verdict::Open), ("= 3", Verdict::Fails)] {
        let sources = claim(is);
        let (verdict, tests) = again::judge(&sources.claims[0], &tables).expect("a verdict");
        assert_eq!(verdict, expected, "{tests:?}");
        let problem = tests[0].value.as_ref().expect_err("no row");
        assert!(problem.contains("no row") && problem.contains("fig11/a"), "{problem}");
    }
    assert!(again::about(&claim("= 2"), &|table| table == "fig12/a").expect("claims").is_empty());
}
