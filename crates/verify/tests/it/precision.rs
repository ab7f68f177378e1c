//! Tables of accuracy: rows compared, the cheapest method found.

use verify::precision::{COSTS, Scene};
use verify::rows::{Relation, first_stranger};

#[test]
fn fewer_rows_must_be_among_the_committed_ones_and_more_must_hold_them() {
    let (few, many, other) = ("a,b\n1,2\n5,6\n", "a,b\n1,2\n3,4\n5,6\n", "a,b\n1,2\n3,5\n");
    assert_eq!(first_stranger(few, many, Relation::Fewer), None);
    assert_eq!(first_stranger(many, few, Relation::More), None);
    assert_eq!(first_stranger(many, many, Relation::Same), None);
    assert_eq!(first_stranger(many, few, Relation::Fewer).as_deref(), Some("made line 3: 3,4"));
    assert_eq!(first_stranger(other, many, Relation::Fewer).as_deref(), Some("made line 3: 3,5"));
    assert_eq!(first_stranger(few, many, Relation::Same).as_deref(), Some("committed line 3: 3,4"));
    assert_eq!(first_stranger("a,b\n5,6\n1,2\n", many, Relation::Fewer).as_deref(), Some("made line 3: 1,2"));
    assert_eq!(first_stranger("a\r\n", "a\n", Relation::Same).as_deref(), Some("line ends"));
}

const WORK: &str = "method,order,control,right_hand_sides,steps,rejected,error_gap,error_speed,stop
euler,1,1,10,10,0,,,overlap
euler,1,0.5,20,20,0,0.2,0.4,none
ballistic,1,0.5,20,20,0,0.1,0.1,none
ballistic,1,0.25,40,40,0,0.05,0.005,none
dop853,8,1e-9,30,3,0,1e-7,1e-8,none
dop853,8,1e-12,60,6,0,1e-9,1e-12,none
dop853,8,1e-15,90,9,0,1e-8,1e-12,none
taylor,24,1e-9,50,2,0,1e-7,1e-8,none
";
const TIME: &str = "method,control,seconds\ndop853,1e-9,0.03\ntaylor,1e-9,0.01\n";

#[test]
fn the_cheapest_method_depends_on_what_is_counted() {
    let scene = Scene::parse("ring", WORK, TIME).expect("the columns");
    let [(_, work), (_, seconds)] = COSTS;
    assert_eq!(scene.cheapest(1e-6, work, &[]).expect("a run").method, "dop853");
    assert_eq!(scene.cheapest(1e-6, seconds, &[]).expect("a run").method, "taylor");
    assert_eq!(scene.cheapest(1e-8, work, &[]).expect("a run").control, "1e-12");
    // nobody was timed at that error
    assert_eq!(scene.cheapest(1e-8, seconds, &[]), None);
    // the larger of both errors counts, and a run that stopped has none
    assert_eq!(scene.cheapest(0.3, work, &["euler"]), None);
    assert_eq!(scene.cheapest(0.4, work, &["euler"]).expect("a run").control, "0.5");
}

#[test]
fn floors_and_ratios_leave_out_runs_that_stopped() {
    let scene = Scene::parse("ring", WORK, "").expect("the columns");
    let floors: Vec<(&str, Option<f64>)> = scene.floors().iter().map(|row| (&*row.method, row.error)).collect();
    let expected = [("euler", 0.4), ("ballistic", 0.05), ("dop853", 1e-9), ("taylor", 1e-7)];
    assert_eq!(floors, expected.map(|(method, error)| (method, Some(error))));
    assert_eq!(scene.ratios("ballistic", "euler"), Some((0.5, 0.5)));
    assert_eq!(scene.ratios("taylor", "euler"), None);
    assert!(Scene::parse("ring", "method\n", "").expect_err("no column").contains("no column control"));
}
