//! The program `export`: exit codes, and the files it leaves.

use crate::{TABLE, scene};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// Runs it on a scene and a table in `folder`.
fn export(folder: &Path, scene: &str, table: &str, more: &[&str]) -> Output {
    fs::write(folder.join("scene.toml"), scene).expect("a file");
    fs::write(folder.join("run.csv"), table).expect("a file");
    let mut program = Command::new(env!("CARGO_BIN_EXE_export"));
    program.args(["scene.toml", "--table", "run.csv", "--out", "out", "--tau", "0.5"]);
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
        (scene(), "t,n,x\n", &[][..], "run.csv:1: expected the columns t,n,x,v, found t,n,x"),
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

/// The scene with a law as formulas, and these lines among them.
fn formula(lines: &str) -> String {
    let built_in = "kind = 'logarithmic'\nv0 = 3.0\nepsilon = 0.01";
    assert!(scene().contains(built_in));
    scene().replace(built_in, &format!("kind = 'formula'\nacceleration = 'V - v'\nbody = 1.0\n{lines}"))
}

#[test]
fn the_metre_of_a_formula_follows_from_v0_or_scale() {
    for (lines, more, words) in [
        ("V = 'v0*s'\nv0 = 3.0\nscale = 1.0", &[][..], "a_0: 0.2 m; a_0_from: desired speed of 1.2 m/s"),
        ("V = 's'\nscale = 3.0", &[], "a_0: 0.2 m; a_0_from: desired speed of 1.2 m/s"),
        ("V = 'v0*s'\nv0 = '3'\nscale = 3.0", &[], "desired_speed: 1.200000 m/s"),
        ("V = 's'", &["--a0", "0.3"], "a_0: 0.3 m; a_0_from: given; tau: 0.5 s; ring_length: 3.0 m\n"),
    ] {
        let folder = tempfile::tempdir().expect("a folder");
        let output = export(folder.path(), &formula(lines), TABLE, more);
        let told = String::from_utf8_lossy(&output.stdout);
        assert!(output.status.success() && told.contains(words), "{lines}: {output:?}");
        assert_eq!(left(folder.path()).len(), 2);
    }
    for (lines, words) in [
        ("V = 's'", ["neither", "v0", "scale", "--a0"]),
        ("V = 's'\nscale = 0.0", ["law.scale = 0", "must be", "> 0", "scene.toml:"]),
    ] {
        let folder = tempfile::tempdir().expect("a folder");
        let output = export(folder.path(), &formula(lines), TABLE, &[]);
        let told = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{told}");
        assert!(words.iter().all(|word| told.contains(word)), "{told}");
        assert!(left(folder.path()).is_empty());
    }
}

#[test]
fn a_file_in_the_place_of_the_folder_is_bad_input() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("out"), "in the way").expect("a file");
    let output = export(folder.path(), &scene(), TABLE, &[]);
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("out: is no folder"));
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

/// A program in place of `simulate`: notes its arguments and its scene, and leaves the table of the test.
#[cfg(unix)]
fn stand_in(folder: &Path) -> PathBuf {
    use std::os::unix::fs::PermissionsExt as _;
    let program = folder.join("simulate");
    let script = "#!/bin/sh\necho \"$@\" > words.txt\ncp \"$1\" scene-run.txt\nwhile [ $# -gt 0 ]; do\n\
                  [ \"$1\" = --out ] && cp run.csv \"$2/trajectories.csv\"\n shift\ndone\n";
    fs::write(&program, script).expect("a file");
    fs::set_permissions(&program, fs::Permissions::from_mode(0o755)).expect("an executable");
    program
}

#[cfg(unix)]
fn run(folder: &Path, scene: &str, arguments: &[&str]) -> Output {
    fs::write(folder.join("scene.toml"), scene).expect("a file");
    fs::write(folder.join("run.csv"), TABLE).expect("a file");
    let mut program = Command::new(env!("CARGO_BIN_EXE_export"));
    program.arg("--simulate").arg(stand_in(folder)).args(["--out", "out"]).args(arguments);
    program.current_dir(folder).output().expect("the program starts")
}

#[cfg(unix)]
#[test]
fn a_scene_is_run_with_a_sample_for_each_frame() {
    let folder = tempfile::tempdir().expect("a folder");
    let output = run(folder.path(), &scene(), &["scene.toml", "--t-end", "0.5"]);
    assert!(output.status.success(), "{output:?}");
    let words = fs::read_to_string(folder.path().join("words.txt")).expect("words");
    assert!(words.contains("--sample 0.25 --t-end 0.5") && words.contains("--tables-only"), "{words}");
    assert_eq!(left(folder.path()), ["trajectories.sqlite", "trajectories.txt"]);
}

#[cfg(unix)]
#[test]
fn a_scene_that_keeps_only_deviations_is_run_with_trajectories() {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = scene().replace("t_end = 0.5", "t_end = 0.5\nrecord = \"std\"");
    let output = run(folder.path(), &scene, &["scene.toml"]);
    assert!(output.status.success(), "{output:?}");
    let made = fs::read_to_string(folder.path().join("scene-run.txt")).expect("a scene");
    assert!(made.contains("run.record = \"trajectories\"") && made.contains("law.v0 = 3.0"), "{made}");
}

#[cfg(unix)]
#[test]
fn too_many_frames_are_told_in_the_words_of_the_command() {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = scene().replace("pedestrians = 2", "pedestrians = 133").replace("t_end = 0.5", "t_end = 3000");
    let output = run(folder.path(), &scene, &["scene.toml", "--fps", "120"]);
    let told = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{told}");
    for word in ["--fps 120", "133", "2e7", "100.25", "--t-end"] {
        assert!(told.contains(word), "{word}: {told}");
    }
    assert!(!told.contains("sample") && left(folder.path()).is_empty(), "{told}");
}

#[test]
fn figures_are_known_by_their_names() {
    let folder = tempfile::tempdir().expect("a folder");
    let figure = folder.path().join("figures/fig11-trajectories");
    fs::create_dir_all(&figure).expect("a folder");
    fs::write(folder.path().join("Cargo.toml"), "").expect("a file");
    fs::write(figure.join("scene.toml"), scene()).expect("a scene");
    fs::write(folder.path().join("run.csv"), TABLE).expect("a file");
    for (wanted, code, words) in [("fig:jams", 0, "a_0: 0.2 m"), ("11", 0, "a_0"), ("fig77", 2, "no figure fig77")] {
        let mut program = Command::new(env!("CARGO_BIN_EXE_export"));
        program.args([wanted, "--root", ".", "--table", "run.csv", "--out", "out"]).current_dir(folder.path());
        let output = program.output().expect("the program starts");
        let told = [&output.stdout[..], &output.stderr].concat();
        let told = String::from_utf8_lossy(&told);
        assert_eq!(output.status.code(), Some(code), "{told}");
        assert!(told.contains(words), "{told}");
    }
}
