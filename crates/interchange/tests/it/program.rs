//! The program: exit codes, what it leaves.

use crate::{TABLE, scene};
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

/// Runs it on a scene and a table in `folder`.
fn export(folder: &Path, scene: &str, table: &str, more: &[&str]) -> Output {
    fs::write(folder.join("scene.toml"), scene).expect("a file");
    fs::write(folder.join("run.csv"), table).expect("a file");
    let mut program = Command::new(env!("CARGO_BIN_EXE_export"));
    program.args(["--scene", "scene.toml", "--table", "run.csv", "--out", "out", "--tau", "0.5"]);
    if !more.contains(&"--fps") {
        program.args(["--fps", "8"]);
    }
    program.args(more).current_dir(folder).output().expect("the program starts")
}

fn left(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> = fs::read_dir(folder.join("out"))
        .into_iter()
        .flatten()
        .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}

#[test]
fn both_files_or_one() {
    for (more, expected) in [
        (&[][..], &["trajectories.sqlite", "trajectories.txt"][..]),
        (&["--format", "pedpy"], &["trajectories.txt"]),
        (&["--format", "jupedsim"], &["trajectories.sqlite"]),
    ] {
        let folder = tempfile::tempdir().expect("a folder");
        let output = export(folder.path(), &scene(), TABLE, more);
        assert!(output.status.success(), "{output:?}");
        assert_eq!(left(folder.path()), expected);
        let words = String::from_utf8_lossy(&output.stdout);
        assert!(words.contains("a_0: 0.2 m"), "{words}");
    }
}

#[test]
fn bad_input_is_told_and_leaves_nothing() {
    let with = |from: &str, to: &str| scene().replace(from, to);
    let map = with("[run]", "[map]");
    for (scene, table, more, words) in [
        (scene(), "t,n,x\n", &[][..], "run.csv:1: columns t,n,x"),
        (scene(), &TABLE[..TABLE.len() - 4], &[], "run.csv:5: "),
        (with("v0 = 3.0", "v0 = -3.0"), TABLE, &[], "law.v0 = -3"),
        (with("pedestrians = 2", "pedestrians = 1"), TABLE, &[], "ring.pedestrians = 1"),
        (map, TABLE, &[], "has no [run]"),
        (scene(), TABLE, &["--panel", "other"], "no panel other"),
        (scene(), TABLE, &["--a0", "0"], "must be a number above 0"),
        (scene(), TABLE, &["--a0", "1e-16"], "a_0 = 1e-16 m: must be from 1e-15"),
        (scene(), TABLE, &["--fps", "0.5"], "0.5: must be a number from 1 to 1000"),
        (scene(), TABLE, &["--fps", "1001"], "1001: must be a number from 1 to 1000"),
        (scene(), TABLE, &["--format", "csv"], "possible values: pedpy, jupedsim"),
    ] {
        let folder = tempfile::tempdir().expect("a folder");
        let output = export(folder.path(), &scene, table, more);
        let told = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{words}: {told}");
        assert!(told.contains(words), "{told}");
        assert!(left(folder.path()).is_empty(), "{:?}", left(folder.path()));
    }
}

#[test]
fn a_folder_that_cannot_be_made_is_a_failure() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("out"), "in the way").expect("a file");
    let output = export(folder.path(), &scene(), TABLE, &[]);
    assert_eq!(output.status.code(), Some(4));
    assert!(String::from_utf8_lossy(&output.stderr).contains("out"));
}

#[test]
fn frame_rates_of_cameras_are_taken_as_they_are() {
    for rate in ["29.97", "2.5", "25.0", "5", "1000"] {
        let folder = tempfile::tempdir().expect("a folder");
        let interval = 1.0 / (rate.parse::<f64>().expect("a number") * 0.5);
        let table = format!("t,n,x,v\n0,0,0,0\n0,1,5,0\n{interval:?},0,0.3,0.1\n{interval:?},1,5.1,0.2\n");
        let output = export(folder.path(), &scene(), &table, &["--fps", rate]);
        assert!(output.status.success(), "{output:?}");
        let text = fs::read_to_string(folder.path().join("out/trajectories.txt")).expect("text");
        assert!(text.starts_with(&format!("# framerate: {}\n", rate.trim_end_matches(".0"))), "{text}");
    }
}
