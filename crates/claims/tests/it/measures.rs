//! Measures: how rows are chosen and become one number with its error.

use crate::desk::{Desk, numbers};
use claims::entry::Measure;
use claims::measure;
use claims::source::ClaimLocation;
use claims::tables::Tables;

#[test]
fn every_way_to_take_a_number() {
    let desk = numbers();
    for (take, value) in
        [("least", -1.0), ("largest", 5.0), ("mean", 2.25), ("sum", 9.0), ("span", 6.0), ("first", 3.0), ("last", 2.0)]
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
fn each_row_that_is_left_has_its_value() {
    let desk = numbers();
    let tables = Tables::new(&desk.paths, &desk.paths).expect("tables");
    let each = |test: &str| {
        let measure: Measure = toml::from_str(test).expect("a measure");
        measure::each(&measure, &tables, &ClaimLocation("here".to_owned()))
    };
    let (sheet, rows) =
        each("take = \"only\"\nof = \"2*v\"\ntable = \"fig90/one\"\nwhere = [\"v > 2\"]").expect("rows");
    let found: Vec<(String, f64)> =
        rows.iter().map(|(row, value)| (sheet.cell(0, *row).to_string(), value.value)).collect();
    assert_eq!(found, [("0".to_owned(), 6.0), ("2".to_owned(), 10.0)]);
    let failure = each("take = \"least\"\nof = \"v\"\ntable = \"fig90/one\"").expect_err("not of a row");
    assert!(failure.code() == 2 && failure.text().contains("here, take: must be `only`"), "{failure:?}");
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
    desk.value("take = \"last\"\nof = \"w\"\ntable = \"fig90/one\"\nless = -0.5", 8.5, 0.0);
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
        &["where", "does not occur in column event", "overlap, blow_up"],
    );
    desk.problem(&format!("{count}\nwhere = [\"event < overlap\"]"), &["words have no order"]);
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
