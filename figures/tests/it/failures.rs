//! Bad input and failing disks: one message, the right exit code, nothing half-written.

use crate::{root, run};
use std::path::Path;

/// Runs `simulate` on the example scene with one text replaced; returns exit code, message, and whether anything was
/// written.
fn with_scene(from: &str, to: &str) -> (Option<i32>, String, bool) {
    let scratch = tempfile::tempdir().expect("a scratch folder");
    let text = std::fs::read_to_string(root().join("scenes/ring.toml")).expect("the example scene");
    assert!(text.contains(from), "{from} stands in the example scene");
    let scene = scratch.path().join("my scene.toml");
    std::fs::write(&scene, text.replacen(from, to, 1)).expect("a scene is written");
    let out = scratch.path().join("out");
    let output = run("simulate", &[scene.to_str().expect("UTF-8"), "--out", out.to_str().expect("UTF-8")]);
    (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned(), out.exists())
}

#[test]
fn bad_scenes_are_refused_before_anything_is_written() {
    let cases = [
        ("length      = 75.0", "length = -5.0", "ring.length = -5: must be a number > 0.0"),
        ("length      = 75.0", "length = nan", "ring.length = NaN: must be a number > 0.0"),
        ("pedestrians = 50", "pedestrians = 0", "ring.pedestrians = 0: must be a whole number from 2 to"),
        ("pedestrians = 50", "pedestrians = 1", "ring.pedestrians = 1: must be a whole number from 2 to"),
        ("shift = 0.1", "shift = 2.0", "start.shift = 2: closes a gap at the start"),
        ("shift = 0.1", "shift = \"far\"", "start.shift = \"far\": must be a finite number"),
        ("shift = 0.1", "shift = 0.1\nshifft = 1", "start.shifft: unknown key; known here: shift"),
        ("method    = \"dop853\"", "method = \"heun\"", "heun has no error estimate and needs dt"),
    ];
    for (from, to, words) in cases {
        let (code, message, is_written) = with_scene(from, to);
        assert_eq!(code, Some(2), "{to}: {message}");
        assert!(message.contains("my scene.toml:") && message.contains(words), "{to}: {message}");
        assert_eq!(message.lines().count(), 1, "{message}");
        assert!(!is_written, "{to}: something was written");
    }
}

#[test]
fn a_folder_that_cannot_be_made_is_named() {
    let scratch = tempfile::tempdir().expect("a scratch folder");
    let file = scratch.path().join("file");
    std::fs::write(&file, "in the way").expect("a file is written");
    let out = file.join("out");
    let output = run("simulate", &["scenes/ring.toml", "--t-end", "2", "--out", out.to_str().expect("UTF-8")]);
    assert_eq!(output.status.code(), Some(4));
    assert!(String::from_utf8_lossy(&output.stderr).contains(out.to_str().expect("UTF-8")));
    assert_eq!(std::fs::read_to_string(&file).expect("still there"), "in the way");
}

#[test]
fn a_figure_says_which_table_is_missing() {
    let scratch = tempfile::tempdir().expect("a scratch folder");
    let folder = scratch.path().to_str().expect("UTF-8");
    let scene = "figures/fig08-logarithmic-force/scene.toml";
    let output =
        run("fig08-logarithmic-force", &["--scene", scene, "--tables", folder, "--pictures", folder, "--draw-only"]);
    assert_eq!(output.status.code(), Some(4));
    assert!(String::from_utf8_lossy(&output.stderr).contains("force.csv"));
    assert_eq!(files_in(scratch.path()), 0);
}

#[test]
fn a_run_that_ends_in_an_event_ends_well() {
    let scene = "figures/fig07-exponential-std/scene.toml";
    let output = run("simulate", &[scene, "--panel", "unstable", "--json"]);
    assert_eq!(output.status.code(), Some(0));
    let summary: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!(summary["schema_version"], 1);
    assert_eq!(summary["stop"], "overlap");
    assert!(output.stderr.is_empty());
}

fn files_in(folder: &Path) -> usize {
    std::fs::read_dir(folder).expect("a folder").count()
}

#[test]
fn a_figure_says_what_is_wrong_with_a_table() {
    let scratch = tempfile::tempdir().expect("a scratch folder");
    let folder = scratch.path().to_str().expect("UTF-8");
    let scene = "figures/fig08-logarithmic-force/scene.toml";
    for (table, line, words) in [
        ("d;f\n1;2\n", 1, "semicolons"),
        ("d,f\n1,2\n3,NaN\n", 3, "\"NaN\""),
        ("\"\",\"d\",\"f\"\n\"1\",1,2\n", 1, "row names of R"),
    ] {
        std::fs::write(scratch.path().join("force.csv"), table).expect("a table");
        let arguments = ["--scene", scene, "--tables", folder, "--pictures", folder, "--draw-only"];
        let output = run("fig08-logarithmic-force", &arguments);
        let told = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{told}");
        assert!(told.contains(&format!("force.csv:{line}: ")) && told.contains(words), "{told}");
        assert!(!scratch.path().join("fig08.svg").exists());
    }
}

#[test]
fn two_runs_into_one_folder_leave_the_files_of_one() {
    let scratch = tempfile::tempdir().expect("a scratch folder");
    let out = scratch.path().to_str().expect("UTF-8");
    let ends = ["2", "3"];
    std::thread::scope(|scope| {
        for end in ends {
            scope.spawn(move || {
                let arguments = ["scenes/ring.toml", "--t-end", end, "--tables-only", "--out", out];
                assert!(run("simulate", &arguments).status.success());
            });
        }
    });
    let read = |name: &str| std::fs::read_to_string(scratch.path().join(name)).expect("a file");
    let last = read("std.csv").lines().last().and_then(|line| line.split(',').next()).map(str::to_owned);
    let last = last.filter(|t| ends.contains(&t.as_str())).expect("one of the ends");
    assert!(read("summary.json").contains(&format!("\"t\": {last}.0")), "{}", read("summary.json"));
}

#[cfg(unix)]
#[test]
fn a_pipe_is_no_place_for_a_state() {
    let scratch = tempfile::tempdir().expect("a scratch folder");
    for (place, words) in [("/dev/null", "is a device"), ("out/std.csv", "two files of this name")] {
        let place = scratch.path().join(place);
        let out = scratch.path().join("out");
        let [place, out] = [&place, &out].map(|path| path.to_str().expect("UTF-8"));
        let output = run("simulate", &["scenes/ring.toml", "--t-end", "2", "--out", out, "--state", place]);
        let told = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{told}");
        assert!(told.contains(words), "{told}");
        assert!(std::fs::read_dir(out).map_or(true, |mut files| files.next().is_none()), "something was written");
    }
}
