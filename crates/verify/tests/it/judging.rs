//! Lists of sums, samples, and distances.

use checkout::sums::{State, Sums};
use files::table::MixedTable;
use verify::golden;
use verify::numbers::{self, Tolerance, relative, ulps};

const ONE: &str = "1111111111111111111111111111111111111111111111111111111111111111";
const TWO: &str = "2222222222222222222222222222222222222222222222222222222222222222";

fn exact(_: &str) -> Tolerance {
    Tolerance::default()
}

#[test]
fn a_list_comes_back_as_it_was() {
    let text = format!("{ONE}  data/a.csv\n{TWO}  data/b.csv\n");
    let sums = Sums::parse("list", &text).expect("a list");
    assert_eq!(sums.to_text(), text);
}

#[test]
fn malformed_lines_are_named() {
    for (text, problem) in [
        ("abc  data/a.csv\n".to_owned(), "list:1: not 64"),
        (format!("{ONE}  a\n{TWO} b\n"), "list:2: not `hash  name`"),
        (format!("{}  a\n", ONE.replace('1', "A")), "list:1: not 64"),
        (format!("{ONE}  ../a\n"), "list:1: not a name relative"),
        (format!("{ONE}  a\r"), "list:1: a control character in the name"),
        (format!("{ONE}  /a\n"), "list:1: not a name relative"),
        (format!("{ONE}  a\n{TWO}  a\n"), "list:2: this name appears twice"),
    ] {
        let failure = Sums::parse("list", &text).expect_err(problem);
        assert_eq!(failure.code(), 2);
        assert!(failure.text().starts_with(problem), "{} for {text}", failure.text());
    }
}

#[test]
fn each_state_is_told_apart() {
    let sums = Sums::parse("list", &format!("{ONE}  gone\n{ONE}  other\n{ONE}  same\n")).expect("a list");
    let made =
        [("other", TWO), ("same", ONE), ("unlisted", TWO)].map(|(name, hash)| (name.to_owned(), hash.to_owned()));
    let states: Vec<(String, State)> = sums.judge(&made.into()).into_iter().collect();
    let expected =
        [("gone", State::Missing), ("other", State::Differs), ("same", State::Same), ("unlisted", State::New)];
    assert_eq!(states, expected.map(|(name, state)| (name.to_owned(), state)));
}

#[test]
fn samples_keep_at_most_two_thousand_rows() {
    let csv = |rows: usize| format!("t\n{}", (0..rows).map(|row| format!("{row}\n")).collect::<String>());
    for (rows, step) in [(0, 1), (1, 1), (2000, 1), (2001, 2), (4000, 2), (4001, 3), (40_000, 20), (399_133, 200)] {
        let sample = golden::sample(&csv(rows));
        let lines: Vec<&str> = sample.lines().collect();
        assert_eq!(golden::step(rows), step, "{rows} rows");
        assert_eq!(lines.len(), 1 + rows.div_ceil(step), "{rows} rows");
        let last = if rows == 0 { "t".to_owned() } else { ((rows - 1) / step * step).to_string() };
        assert_eq!(lines.last(), Some(&last.as_str()));
    }
}

#[test]
fn distances_in_units_of_the_last_place() {
    assert_eq!(ulps(1.0, 1.0_f64.next_up()), 1);
    assert_eq!(ulps(-1.0, (-1.0_f64).next_down()), 1);
    assert_eq!(ulps(0.0, -0.0), 1);
    assert_eq!(ulps(f64::from_bits(3), -f64::from_bits(2)), 6);
    assert_eq!(ulps(1.0, 2.0), 1 << 52);
    assert_eq!(relative(0.0, 0.0).to_bits(), 0.0_f64.to_bits());
    assert!((relative(1.0, -1.0) - 2.0).abs() < 1e-15);
}

#[test]
fn the_place_of_the_largest_distance_is_named() {
    let golden = MixedTable::parse(b"t,std\n0,1\n3,1e-8\n6,5\n").expect("a table");
    let fresh = MixedTable::parse(b"t,std\n0,1\n3,2e-8\n6,5.5\n").expect("a table");
    let distance = numbers::compare(&golden, &fresh, 3, &exact).expect("one shape");
    assert_eq!(distance.cells, 2);
    assert_eq!((distance.absolute.row, distance.absolute.column.as_str()), (6, "std"));
    assert_eq!((distance.relative.row, distance.ulp.row), (3, 3));
    assert!((distance.absolute.value - 0.5).abs() < 1e-15 && (distance.relative.value - 0.5).abs() < 1e-15);
}

#[test]
fn tables_of_another_shape_are_not_compared() {
    let table = |text: &str| MixedTable::parse(text.as_bytes()).expect("a table");
    let columns = numbers::compare(&table("t,std\n0,1\n"), &table("t,x\n0,1\n"), 1, &exact).expect_err("columns");
    assert_eq!(columns, "expected the columns t,std, found t,x");
    let rows = numbers::compare(&table("t\n0\n1\n"), &table("t\n0\n"), 1, &exact).expect("the rows of both");
    assert_eq!((rows.cells, rows.unmatched), (0, 1));
}

#[test]
fn differences_along_t_grow_shrink_or_stay() {
    let table = |error: &dyn Fn(i32) -> f64| {
        let rows: String = (0..40).map(|t| format!("{t},{:?}\n", 1.0 + error(t))).collect();
        MixedTable::parse(format!("t,std\n{rows}").as_bytes()).expect("a table")
    };
    let small = |t: i32| f64::from(t) * 1e-6;
    for (error, course, since) in [
        (&small as &dyn Fn(i32) -> f64, "growing", 1.0),
        (&|t| small(40 - t) * f64::from(40 - t), "shrinking", 0.0),
        (&|_| 1e-6, "constant", 0.0),
        (&|t| if t < 35 { 0.0 } else { 1e-6 }, "growing", 35.0),
        (&|t| if t == 7 { 1e-6 } else { 0.0 }, "in one row", 7.0),
    ] {
        let tolerance = |_: &str| Tolerance { absolute: 20.5e-6, ..Tolerance::default() };
        let distance = numbers::compare(&table(&|_| 0.0), &table(error), 1, &tolerance).expect("one shape");
        let found = distance.course.expect("a course");
        assert_eq!((found.course, found.since), (course, since), "{:?}", found.quarters);
        let beyond = (0..40).filter(|&t| error(t) > 20.5e-6).count();
        assert_eq!(distance.beyond, beyond);
        assert_eq!(distance.furthest.is_some(), beyond > 0);
    }
}

#[test]
fn tolerances_add_up() {
    let table = |value: f64| MixedTable::parse(format!("n,v\n0,{value:?}\n1,-8\n").as_bytes()).expect("a table");
    let tolerance = |_: &str| Tolerance { absolute: 0.25, relative: 0.5, of_scale: 0.125 };
    // 0.25 + 0.125 * 8 + 0.5 * the larger of the two
    for (value, beyond) in [(3.25, 0), (4.5, 0), (4.75, 1)] {
        let distance = numbers::compare(&table(1.0), &table(value), 1, &tolerance).expect("one shape");
        assert_eq!(distance.beyond, beyond, "{value}");
    }
}
