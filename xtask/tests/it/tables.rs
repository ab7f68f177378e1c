//! Runs against their second runs, and the table of events.

use checkout::events::{self, Event};
use files::table::Table;
use xtask::estimate::differences;

fn table(text: &str) -> Table {
    Table::parse(text.as_bytes()).expect("a table")
}

#[test]
fn rows_are_matched_by_time_and_pedestrian() {
    let run = table("t,n,x,v\n0,0,1,0\n0,1,2,0\n1,0,1.5,0.5\n1,1,2.5,0.25\n2,0,9,9\n");
    let check = table("t,n,x,v\n0,0,1,0\n1,0,1.25,0.5\n1,1,2.5,0.5\n");
    let (columns, unmatched) = differences(&run, &check);
    assert_eq!(unmatched, 2);
    assert_eq!(columns.into_iter().collect::<Vec<_>>(), [("v".to_owned(), 0.25), ("x".to_owned(), 0.25)]);
}

#[test]
fn a_column_that_the_check_lacks_has_no_difference() {
    let (columns, unmatched) = differences(&table("t,std,more\n0,1,2\n"), &table("t,std\n0,1\n"));
    assert!(columns["more"].is_nan() && columns["std"] == 0.0 && unmatched == 0, "{columns:?}");
}

#[test]
fn what_could_not_be_compared_has_no_difference_of_zero() {
    let apart = differences(&table("t,std\n0,1\n"), &table("t,std\n1,1\n"));
    assert!(apart.0["std"].is_nan() && apart.1 == 2);
}

#[test]
fn events_are_compared_with_those_of_the_check() {
    let run = events::parse("run", "event,t,n\nexchange,20.5,3\noverlap,12.5,7\noverlap,13,7\nblow_up,30,1\n")
        .expect("events");
    let check = events::parse(
        "check",
        "event,t,n\noverlap,12.5,7\noverlap,13.25,7\nexchange,20.5,4\nblow_up,30.0000000001,1\n",
    )
    .expect("events");
    let lines = events::lines("fig04-unstable", &run, &check);
    // 2 ulp of 12.5 is 2^-48
    assert_eq!(lines[0], format!("fig04-unstable,overlap,12.5,7,{:?}", 1.0 / (1_u64 << 48) as f64));
    assert_eq!(lines[1], "fig04-unstable,overlap,13,7,0.25");
    assert_eq!(lines[2], "fig04-unstable,exchange,20.5,3,inf");
    let late = (30.0 - 30.000_000_000_1_f64).abs();
    assert_eq!(lines[3], format!("fig04-unstable,blow_up,30,1,{late:?}"));
}

#[test]
fn events_of_figures_not_run_now_stay() {
    let old =
        format!("{}\nfig04-a,overlap,1,0,1e-9\nfig07-a,overlap,2,0,1e-9\nfig09-a,overlap,3,0,1e-9\n", events::HEADER);
    let fresh = ["fig07-a,overlap,2.5,0,1e-9".to_owned()];
    let merged = events::merge(&old, &fresh, &|scene| scene == "fig07-a" || scene == "fig09-a");
    assert_eq!(merged, format!("{}\nfig04-a,overlap,1,0,1e-9\nfig07-a,overlap,2.5,0,1e-9\n", events::HEADER));
}

#[test]
fn the_uncertainty_has_a_floor() {
    let event = Event { event: "overlap".to_owned(), t_text: "1".to_owned(), t: 1.0, n: "0".to_owned() };
    let floor = 2.0 * f64::EPSILON;
    assert_eq!(events::uncertainty(event.t, Some(1.0)).to_bits(), floor.to_bits());
    assert_eq!(events::uncertainty(event.t, Some(1.5)).to_bits(), 0.5_f64.to_bits());
    assert!(events::uncertainty(event.t, None).is_infinite());
}
