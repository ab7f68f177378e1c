//! The text file, and the table from which it is made.

use crate::{TABLE, header};
use checkout::failure::Failure;
use files::write::{Draft, publish};
use interchange::frames::{Frames, Row};
use interchange::text;
use std::fs;

fn rows(table: &str) -> Result<Vec<Row>, Failure> {
    Frames::read("run.csv", table.as_bytes(), 2, 0.25)?.collect()
}

#[test]
fn a_line_for_each_pedestrian_in_each_frame() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("trajectories.txt");
    let draft = Draft::new(&file).expect("a draft");
    let frames = Frames::read("run.csv", TABLE.as_bytes(), 2, 0.25).expect("a table");
    assert_eq!(text::write(&draft, &header(Some(0.6)), frames), Ok(4));
    assert!(!file.exists());
    publish(vec![draft]).expect("a file");
    let text = fs::read_to_string(&file).expect("text");
    // PedPy takes the first number of the first line with this word
    assert!(text.starts_with("# framerate: 8\n# title: two # x/cm framerate: 99\n"), "{text}");
    // 0.6 * 0.3 is not 0.18 in binary: the text rounds
    let body =
        "# ID FR x/m y/m z/m\n0 0 -0.075000000 0 0\n1 0 3.000000000 0 0\n0 1 0.180000000 0 0\n1 1 3.060000000 0 0\n";
    assert!(text.ends_with(body), "{text}");
    for fact in ["# a_0: 0.6 m\n# a_0_from: given\n", "# tau: 0.5 s\n", "# ring_length: 6.0 m\n"] {
        assert!(text.contains(fact), "{text}");
    }
    assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 1);
}

#[test]
fn without_a_length_the_desired_speed_is_the_typical_one() {
    // 1.2 m/s * 0.5 s / 3
    let header = header(None);
    assert_eq!((header.units.length, header.units.is_derived), (0.2, true));
    let facts = header.facts();
    assert!(facts.contains(&("a_0_from", "desired speed of 1.2 m/s".to_owned())), "{facts:?}");
    let speed = facts.iter().find(|(name, _)| *name == "desired_speed").map(|(_, value)| value.as_str());
    assert_eq!(speed, Some("1.200000 m/s"));
}

#[test]
fn frames_are_whole_and_in_order() {
    let frames: Vec<(u32, u32, f64)> = rows(TABLE).expect("rows").iter().map(|row| (row.frame, row.n, row.x)).collect();
    assert_eq!(frames, [(0, 0, -0.125), (0, 1, 5.0), (1, 0, 0.3), (1, 1, 5.1)]);
    for (from, to, problem) in [
        ("t,n,x,v", "t,n,v,x", "run.csv:1: expected the columns t,n,x,v, found t,n,v,x"),
        ("0.25,0,", "0.26,0,", "run.csv:4: expected pedestrian 0 at t = 0.25, found 0.0 at 0.26"),
        ("0,1,5,0\n", "", "run.csv:3: expected pedestrian 1 at t = 0.0, found 0.0 at 0.25"),
        ("0.25,1,5.1,0.2\n", "", "the last frame has 1 of 2 pedestrians"),
        ("0.3", "NaN", "run.csv:4: \"NaN\" is not a finite number"),
        ("0.3,0.1", "0.3", "run.csv:4: "),
    ] {
        assert!(TABLE.contains(from), "{from}");
        match rows(&TABLE.replace(from, to)) {
            Err(Failure::Usage(text)) => assert!(text.contains(problem), "{text}"),
            other => panic!("{from}: {other:?}"),
        }
    }
}

#[test]
fn a_draft_that_is_dropped_leaves_the_old_file() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("trajectories.txt");
    fs::write(&file, "old").expect("a file");
    let draft = Draft::new(&file).expect("a draft");
    let broken = Frames::read("run.csv", &TABLE.as_bytes()[..TABLE.len() - 20], 2, 0.25).expect("a table");
    assert!(text::write(&draft, &header(None), broken).is_err());
    drop(draft);
    assert_eq!(fs::read_to_string(&file).ok().as_deref(), Some("old"));
    assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 1);
}

#[test]
fn positions_keep_their_digits_whatever_a_metre_is() {
    for (a_0, expected) in [(0.6, "0 1 0.180000000 0 0"), (1e-12, "0 1 0.0000000000003000000 0 0")] {
        let folder = tempfile::tempdir().expect("a folder");
        let draft = Draft::new(&folder.path().join("trajectories.txt")).expect("a draft");
        let frames = Frames::read("run.csv", TABLE.as_bytes(), 2, 0.25).expect("a table");
        text::write(&draft, &header(Some(a_0)), frames).expect("text");
        let text = fs::read_to_string(draft.path()).expect("text");
        assert!(text.lines().any(|line| line == expected), "{text}");
    }
}
