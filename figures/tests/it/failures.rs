//! Bad input and failing disks: one message, the right exit code, nothing half-written.

use crate::{root, run};
use files::table::Table;
use std::path::Path;
use std::process::Output;

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
fn a_wrong_option_is_not_blamed_on_a_line_of_the_scene() {
    for (options, words) in
        [(["--t-end", "0"], "run.t_end = 0: "), (["--method", "heun"], "heun has no error estimate")]
    {
        let output = run("simulate", &[&["scenes/ring.toml"], &options[..]].concat());
        let message = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{message}");
        assert!(message.contains("scenes/ring.toml with these options: ") && message.contains(words), "{message}");
    }
}

#[test]
fn a_folder_that_cannot_be_made_is_named() {
    let scratch = tempfile::tempdir().expect("a scratch folder");
    let file = scratch.path().join("file");
    std::fs::write(&file, "in the way").expect("a file is written");
    let out = file.join("out");
    let output = run("simulate", &["scenes/ring.toml", "--t-end", "2", "--out", out.to_str().expect("UTF-8")]);
    assert_eq!(output.status.code(), Some(2));
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(message.contains(&format!("{}: is no folder", file.display())), "{message}");
    assert_eq!(std::fs::read_to_string(&file).expect("still there"), "in the way");
}

/// A run that would last for hours: what would keep its results from being written is said before it.
#[test]
fn results_that_cannot_be_written_are_told_before_the_run() {
    let scratch = tempfile::tempdir().expect("a scratch folder");
    let place = |name: &str| scratch.path().join(name).to_str().expect("UTF-8").to_owned();
    let text = std::fs::read_to_string(root().join("scenes/ring.toml")).expect("the example scene");
    std::fs::create_dir_all(place("taken/std.csv")).expect("a folder");
    std::fs::create_dir_all(place("scene")).expect("a folder");
    std::fs::write(place("scene/std.csv"), &text).expect("a scene");
    std::fs::write(place("long.toml"), &text).expect("a scene");
    let cases = [
        ("long.toml", "taken", "new.csv", "taken/std.csv: is a folder"),
        ("long.toml", "out", "taken", "taken: is a folder"),
        ("long.toml", "out", "nowhere/new.csv", "new.csv: its folder is missing"),
        ("long.toml", "scene", "scene/events.csv", "two files of this name"),
        ("scene/std.csv", "scene", "new.csv", "is the scene"),
    ];
    for (scene, out, state, words) in cases {
        let long = ["--t-end", "1e9", "--sample", "1e6"];
        let (scene, out, state) = (place(scene), place(out), place(state));
        let output = run("simulate", &[&[scene.as_str(), "--out", &out, "--state", &state][..], &long].concat());
        let told = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{told}");
        assert!(told.contains(words) && told.lines().count() == 1, "{words}: {told}");
    }
    assert!(!scratch.path().join("out").exists() && files_in(&scratch.path().join("scene")) == 1);
    let kept = ["--checkpoint", &place("nowhere/run.checkpoint"), "--t-end", "1e9", "--sample", "1e6"];
    let output = run("simulate", &[&["scenes/ring.toml"], &kept[..]].concat());
    let told = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.code() == Some(2) && told.contains("run.checkpoint: its folder is missing"), "{told}");
    // the table of a map has the name of its panel
    std::fs::write(place("scene/main.csv"), std::fs::read(root().join("scenes/map.toml")).expect("a map"))
        .expect("a map");
    let output = run("map", &[&place("scene/main.csv"), "--out", &place("scene")]);
    let told = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.code() == Some(2) && told.contains("is the scene"), "{told}");
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
fn a_figure_has_no_blank_cells() {
    // in the lowest cells the margin is above all numbers
    let map = "[panel.left]\nlaw = { kind = \"algebraic\", mu = 0.5, q = 1.0, v0 = 3.0 }\nmap.value = \"margin\"\n\
               map.x = { parameter = \"a_v\", from = 0.0, to = 0.1, cells = 2 }\n\
               map.y = { parameter = \"d_gap\", from = 0.0, to = 1e-153, cells = 100 }\n";
    let folder = tempfile::tempdir().expect("a scratch folder");
    let path = |name: &str| folder.path().join(name).to_str().expect("UTF-8").to_owned();
    std::fs::write(path("scene.toml"), map).expect("a scene is written");
    let [scene, tables] = [path("scene.toml"), path("tables")];
    let words = ["--scene", &scene, "--tables", &tables, "--pictures", &path("pictures")];
    let output = run("fig03-algebraic-criterion", &words);
    let message = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(4), "{message}");
    assert!(message.contains("left: 5.0 % blank: 10 cells without a value"), "{message}");
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

/// `simulate` on a copy of the example scene in a folder, with these options; exit code and message.
fn in_folder(folder: &Path, options: &[&str]) -> (Option<i32>, String) {
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_simulate"));
    let output = command.current_dir(folder).args(["my.toml", "--t-end", "2", "--no-check"]).args(options).output();
    let output = output.expect("it starts");
    (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
}

#[test]
fn no_file_of_the_user_is_overwritten_or_removed() {
    let scratch = tempfile::tempdir().expect("a scratch folder");
    let folder = scratch.path();
    let scene = std::fs::read(root().join("scenes/ring.toml")).expect("the example scene");
    std::fs::write(folder.join("my.toml"), &scene).expect("a scene");
    std::fs::write(folder.join("precious.csv"), "1,2\n").expect("a table");
    for (options, words) in [
        (&["--state", "./my.toml"][..], "my.toml: is the scene"),
        (&["--checkpoint", "my.toml"], "my.toml: is the scene"),
        (&["--checkpoint", "precious.csv"], "precious.csv: is no checkpoint"),
        (&["--checkpoint", "."], "directory"),
        (&["--state", "end.csv", "--checkpoint", "./end.csv"], "the checkpoint is removed at the end"),
        (&["--out", ".", "--checkpoint", "std.csv"], "the checkpoint is removed at the end"),
    ] {
        let (code, told) = in_folder(folder, options);
        assert_eq!(code, Some(2), "{options:?}: {told}");
        assert!(told.contains(words), "{options:?}: {told}");
        let mut names: Vec<_> =
            std::fs::read_dir(folder).expect("a folder").map(|e| e.expect("a file").file_name()).collect();
        names.sort();
        assert_eq!(names, ["my.toml", "precious.csv"], "{options:?}");
        assert_eq!(std::fs::read(folder.join("my.toml")).expect("the scene"), scene);
        assert_eq!(std::fs::read(folder.join("precious.csv")).expect("the table"), b"1,2\n");
    }
}

/// One folder, still to be made, by several names.
#[test]
fn a_state_may_be_written_to_the_folder_that_is_made() {
    let scratch = tempfile::tempdir().expect("a scratch folder");
    let folder = scratch.path();
    std::fs::copy(root().join("scenes/ring.toml"), folder.join("my.toml")).expect("a scene");
    let whole = folder.join("o3");
    let whole = whole.to_str().expect("UTF-8");
    for (out, state) in
        [("./o1", "o1/f.csv"), ("o2", "./o2/f.csv"), (whole, "o3/f.csv"), ("o4/run", "o4/f.csv"), ("o5/", "o5/f.csv")]
    {
        let (code, told) = in_folder(folder, &["--tables-only", "--out", out, "--state", state]);
        assert_eq!(code, Some(0), "{out} {state}: {told}");
        assert!(folder.join(state).exists() && folder.join(out).join("std.csv").exists(), "{out} {state}");
    }
    for (out, state, words) in [
        ("./o6", "o6/std.csv", "two files of this name"),
        ("o7", "o8/f.csv", "its folder is missing"),
        ("o7", "o7/run/f.csv", "its folder is missing"),
    ] {
        let (code, told) = in_folder(folder, &["--out", out, "--state", state]);
        assert!(code == Some(2) && told.contains(words), "{out} {state}: {told}");
        assert!(!folder.join(out).exists(), "{out}");
    }
}

#[test]
fn what_an_earlier_run_left_in_the_folder_is_named() {
    let scratch = tempfile::tempdir().expect("a scratch folder");
    let folder = scratch.path();
    let scene = std::fs::read_to_string(root().join("scenes/ring.toml")).expect("the example scene");
    std::fs::write(folder.join("my.toml"), &scene).expect("a scene");
    assert_eq!(in_folder(folder, &["--out", "run"]), (Some(0), String::new()));
    std::fs::write(folder.join("my.toml"), scene.replace("\"trajectories\"", "\"std\"")).expect("a scene");
    let (code, told) = in_folder(folder, &["--out", "run"]);
    assert_eq!(code, Some(0), "{told}");
    for name in ["trajectories.csv", "trajectories.svg", "trajectories.png"] {
        assert!(told.contains(&format!("{name}: not of this run")), "{told}");
    }
    assert_eq!(told.lines().count(), 3, "{told}");
}

/// Runs a binary on a scene of its own that is made of these lines; the folder of its tables is `out`.
fn on_scene(binary: &str, text: &str, out: &Path, arguments: &[&str]) -> Output {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let scene = folder.path().join("my scene.toml");
    std::fs::write(&scene, text).expect("a scene is written");
    let [scene, out] = [&scene, out].map(|path| path.to_str().expect("UTF-8"));
    run(binary, &[&[scene, "--out", out], arguments].concat())
}

/// A scene of thirty pedestrians.
fn thirty(law: &str, run: &str) -> String {
    format!("[law]\n{law}\n[ring]\npedestrians = 30\nlength = 60.0\n[start]\nshift = 0.1\n[run]\nsample = 1.0\n{run}\n")
}

const LOGARITHMIC: &str = "kind = \"logarithmic\"\nv0 = 1.0\nepsilon = 0.01";

fn summary(folder: &Path) -> serde_json::Value {
    let bytes = std::fs::read(folder.join("summary.json")).expect("a summary");
    serde_json::from_slice(&bytes).expect("JSON")
}

/// By Heun's steps the flow stays uniform, since spacings lose the shift; the right one blows up at t = 0.156.
#[test]
fn rows_that_the_check_does_not_confirm_are_not_written() {
    let text = "[law]\nkind = \"algebraic\"\nmu = 0.0884\nq = 3.0\nv0 = 0.702\n[ring]\npedestrians = 15\nlength = 30.19042\n\
                [start]\nshift = -1.49e-33\n[run]\nmethod = \"heun\"\nt_end = 0.526\nsample = 0.02\ndt = 1.77e-5\nstate = \"gaps\"\n";
    let out = tempfile::tempdir().expect("a scratch folder");
    let output = on_scene("simulate", text, out.path(), &["--tables-only"]);
    let told = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(4), "{told}");
    assert!(told.lines().count() == 1 && told.contains("state = \"deviations\""), "{told}");
    let summary = summary(out.path());
    assert_eq!(summary["stop"], "not_confirmed", "{summary}");
    let time = summary["t"].as_f64().expect("a number");
    let std = std::fs::read_to_string(out.path().join("std.csv")).expect("a table");
    let last = std.lines().last().and_then(|line| line.split(',').next()).and_then(|t| t.parse().ok());
    assert!(time < 0.156 && last == Some(time), "{time} {last:?}");
}

#[test]
fn a_run_that_cannot_go_on_keeps_its_tables_and_says_why() {
    let out = tempfile::tempdir().expect("a scratch folder");
    let text = thirty(LOGARITHMIC, "t_end = 1000.0\ntolerance = 1e-12\nmethod = \"dop853\"\nmost_steps = 60");
    let output = on_scene("simulate", &text, out.path(), &["--tables-only"]);
    let told = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(4), "{told}");
    assert_eq!(told.lines().count(), 1, "{told}");
    assert!(told.contains("60") && told.contains("most_steps"), "{told}");
    let summary = summary(out.path());
    assert_eq!((&summary["stop"], &summary["steps"]), (&"too_many_steps".into(), &60.into()), "{summary}");
    assert!(told.contains(summary["reason"].as_str().expect("a reason")), "{told}");
    let reached = summary["t"].as_f64().expect("a time");
    let table = |name: &str| Table::read(&out.path().join(name)).expect("a table");
    let times = table("std.csv").column("t").expect("times");
    let samples = reached.floor() as usize;
    // until then a row for every sample, and no row behind
    assert!(samples > 1 && reached < 1000.0, "{reached}");
    assert_eq!(times.last(), Some(&(samples as f64)), "{reached}");
    assert_eq!(table("trajectories.csv").len(), 30 * times.len());
    assert!(out.path().join("events.csv").exists());
}

#[test]
fn the_check_of_a_run_can_be_left_out() {
    let text = thirty(LOGARITHMIC, "t_end = 20.0\ntolerance = 1e-10\nmethod = \"dop853\"");
    let [checked, plain] = [&[][..], &["--no-check"]].map(|more| {
        let out = tempfile::tempdir().expect("a scratch folder");
        let output = on_scene("simulate", &text, out.path(), &[&["--tables-only"], more].concat());
        assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
        let read = |name: &str| std::fs::read_to_string(out.path().join(name)).expect("a table");
        let words = String::from_utf8_lossy(&output.stdout).into_owned();
        (read("std.csv"), read("trajectories.csv"), read("events.csv"), summary(out.path()), words)
    });
    assert!(checked.0 == plain.0 && checked.1 == plain.1, "the tables are those of the run");
    for key in ["steps", "rejected", "right_hand_sides", "t", "stop"] {
        assert_eq!(checked.3[key], plain.3[key], "{key}");
    }
    let estimate = checked.3["error"]["std"].as_f64().expect("an estimate");
    assert!(estimate > 0.0 && estimate < 1e-8, "{estimate}");
    assert!(plain.3["error"].is_null(), "{}", plain.3);
    assert_eq!([&checked, &plain].map(|run| run.2.lines().next() == Some("event,t,n,error")), [true, false]);
    assert_eq!([&checked, &plain].map(|run| run.4.contains("estimated errors")), [true, false]);
}

#[test]
fn a_formula_that_loses_its_value_is_an_event() {
    let out = tempfile::tempdir().expect("a scratch folder");
    // speeds grow until 3 - v, of which the logarithm is taken, is not positive
    let law = "kind = \"formula\"\nacceleration = \"1 + 0.001*ln(3 - v)\"\nbody = 0.0";
    let text = thirty(law, "t_end = 40.0\ntolerance = 1e-11\nmethod = \"dop853\"");
    let output = on_scene("simulate", &text, out.path(), &["--tables-only"]);
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    let summary = summary(out.path());
    assert_eq!(summary["stop"], "undefined", "{summary}");
    let events = std::fs::read_to_string(out.path().join("events.csv")).expect("a table");
    let event = events.lines().find(|line| line.starts_with("undefined,")).expect("the event");
    let fields: Vec<&str> = event.split(',').collect();
    let time: f64 = fields[1].parse().expect("a time");
    assert!((time - 3.0).abs() < 0.1 && fields[2].parse::<usize>().is_ok_and(|n| n < 30), "{event}");
    let times = Table::read(&out.path().join("std.csv")).expect("a table").column("t").expect("times");
    assert!(times.last().is_some_and(|&last| last <= time && last >= time.floor() - 1e-9), "{times:?}");
}

#[test]
fn the_map_of_a_run_is_the_stability_of_its_uniform_flow() {
    let out = tempfile::tempdir().expect("a scratch folder");
    let out = out.path().join("out");
    // the response of the flow is v0 times a number of the headway, and the flow is stable below a half
    for (v0, is_stable) in [(0.1, true), (1.2, false)] {
        let text = thirty(LOGARITHMIC, "t_end = 1e5\ntolerance = 1e-10\nmethod = \"dop853\"")
            .replace("v0 = 1.0", &format!("v0 = {v0:?}"))
            // of tables that are not written nobody asks how long they are
            .replace("sample = 1.0", "sample = 1e-6")
            .replace("length = 60.0", "length = 45.0");
        let output = on_scene("map", &text, &out, &["--json"]);
        assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
        let printed: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
        let flow = &printed["points"][0]["uniform_flow"];
        assert_eq!(flow["stable"], is_stable, "{printed}");
        assert_eq!(flow["margin"].as_f64().expect("a margin") <= 0.0, is_stable, "{printed}");
        let words = String::from_utf8_lossy(&on_scene("map", &text, &out, &[]).stdout).into_owned();
        assert!(words.contains(if is_stable { ": stable" } else { ": unstable" }), "{words}");
        assert!(!out.exists(), "a map of one point writes nothing");
    }
}

#[test]
fn numbers_of_hundreds_of_digits_are_told_by_their_power_of_ten() {
    let scratch = tempfile::tempdir().expect("a scratch folder");
    let law = "kind = \"formula\"\nacceleration = \"1e300*tanh(s) - v\"\nbody = 0.0";
    let text = thirty(law, "t_end = 1.0\ntolerance = 1e-8\nmethod = \"dop853\"");
    let text = text.replace("length = 60.0", "length = 1e305");
    let output = on_scene("simulate", &text, &scratch.path().join("out"), &["--tables-only", "--no-check"]);
    let told = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(told.contains("on 1e305: ") && told.lines().all(|line| line.len() < 300), "{told}");
}
