//! A run that is killed and resumed has the bytes of an uninterrupted one.

use crate::root;
use files::write::sha256_file;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

/// Steps of the paper's scheme up to t = 20: some seconds.
const STEPS: f64 = 2e6;
/// Where that is.
const END: &str = "20";

/// `simulate` by the paper's scheme up to `end`, a checkpoint in its folder every tenth of a second.
fn simulate(folder: &Path, end: &str) -> Command {
    simulate_as(
        folder,
        &["figures/fig13-logarithmic-std/scene.toml", "--panel", "std", "--scheme", "paper", "--t-end", end],
    )
}

/// The same of steps of adaptive length: some seconds, too.
fn simulate_adaptive(folder: &Path) -> Command {
    let scene = "figures/fig11-trajectories/scene.toml";
    simulate_as(folder, &[scene, "--method", "bs32", "--tol", "1e-9", "--t-end", "3000", "--no-check"])
}

fn simulate_as(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_simulate"));
    command.current_dir(root()).args(arguments).args(["--tables-only", "--json", "--progress"]);
    command.arg("--out").arg(folder.join("out")).arg("--checkpoint").arg(file(folder));
    command.args(["--checkpoint-every", "0.1"]).stdin(Stdio::null());
    command
}

fn file(folder: &Path) -> PathBuf {
    folder.join("run.checkpoint")
}

/// Starts a run and kills it (SIGKILL) a given time after it has written a checkpoint.
fn kill_as(folder: &Path, after: Duration, mut command: Command) {
    let before = std::fs::read(file(folder)).ok();
    let mut child = command.stderr(Stdio::null()).stdout(Stdio::null()).spawn().expect("it starts");
    let start = Instant::now();
    while std::fs::read(file(folder)).ok() == before {
        assert!(start.elapsed() < Duration::from_secs(60), "no checkpoint in a minute");
        assert!(child.try_wait().expect("a child").is_none(), "it ended before its first checkpoint");
        std::thread::sleep(Duration::from_millis(5));
    }
    std::thread::sleep(after);
    child.kill().expect("it can be killed");
    child.wait().expect("it ends");
}

fn finish_as(folder: &Path, mut command: Command) -> (serde_json::Value, Output) {
    let output = command.output().expect("it starts");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(!file(folder).exists(), "a checkpoint is removed at the end");
    (serde_json::from_slice(&output.stdout).expect("JSON"), output)
}

fn sums(folder: &Path) -> Vec<String> {
    let names = ["std.csv", "trajectories.csv", "events.csv"];
    names.iter().map(|name| sha256_file(&folder.join("out").join(name)).expect("a table")).collect()
}

#[test]
fn a_run_killed_at_any_moment_goes_on_to_the_same_bytes() {
    let scratch = tempfile::tempdir().expect("a scratch folder");
    let [whole, killed] = ["whole", "killed"].map(|name| scratch.path().join(name));
    for folder in [&whole, &killed] {
        std::fs::create_dir(folder).expect("a folder");
    }
    let (summary, _) = finish_as(&whole, simulate(&whole, END));
    assert_eq!((summary["steps"].as_f64(), summary["resumed_steps"].as_u64()), (Some(STEPS), Some(0)));
    for after in [0, 137, 271] {
        kill_as(&killed, Duration::from_millis(after), simulate(&killed, END));
    }
    assert!(!killed.join("out").join("std.csv").exists(), "it ended before it was killed");
    let (resumed, output) = finish_as(&killed, simulate(&killed, END));
    let steps = resumed["resumed_steps"].as_f64().expect("a number");
    println!("resumed at step {steps:e} of {STEPS:e}");
    assert!(steps > 0.0 && steps < STEPS);
    assert!(String::from_utf8_lossy(&output.stderr).starts_with("resumed 0."));
    assert_eq!(sums(&killed), sums(&whole));
    for key in ["steps", "right_hand_sides", "t", "stop", "events", "jams"] {
        assert_eq!(resumed[key], summary[key], "{key}");
    }
}

#[test]
fn a_run_of_adaptive_steps_killed_goes_on_to_the_same_bytes_and_tells_how_far_it_is() {
    let scratch = tempfile::tempdir().expect("a scratch folder");
    let [whole, killed] = ["whole", "killed"].map(|name| scratch.path().join(name));
    for folder in [&whole, &killed] {
        std::fs::create_dir(folder).expect("a folder");
    }
    let (summary, _) = finish_as(&whole, simulate_adaptive(&whole));
    for after in [0, 137] {
        kill_as(&killed, Duration::from_millis(after), simulate_adaptive(&killed));
    }
    let (resumed, output) = finish_as(&killed, simulate_adaptive(&killed));
    let (steps, all) = (resumed["resumed_steps"].as_u64(), summary["steps"].as_u64());
    println!("resumed at step {steps:?} of {all:?}");
    assert!(steps > Some(0) && steps < all, "{steps:?} of {all:?}");
    assert_eq!(sums(&killed), sums(&whole));
    for key in ["steps", "right_hand_sides", "rejected", "t", "stop", "events", "jams"] {
        assert_eq!(resumed[key], summary[key], "{key}");
    }
    // where it was, and where it is a second later, if it takes that long
    let words = String::from_utf8_lossy(&output.stderr).into_owned();
    let number = |line: &str, word: usize| line.split(' ').nth(word).and_then(|number| number.parse::<f64>().ok());
    let places: Vec<f64> =
        words.lines().map(|line| number(line, 1)).collect::<Option<_>>().expect("a number in each line");
    for line in words.lines().filter(|line| line.starts_with("progress")) {
        assert!(number(line, 3).is_some_and(|left| left >= 0.0), "{line}: the seconds that are left");
    }
    assert!(
        words.starts_with("resumed 0.") && places.is_sorted() && places.iter().all(|&place| place < 1.0),
        "{words}"
    );
}

#[test]
fn a_damaged_or_foreign_checkpoint_is_not_believed() {
    let scratch = tempfile::tempdir().expect("a scratch folder");
    let folder = scratch.path();
    // several runs: shorter ones
    let (end, other_end) = ("5", "4");
    let (_, _) = finish_as(folder, simulate(folder, end));
    let expected = sums(folder);
    kill_as(folder, Duration::ZERO, simulate(folder, end));
    let sound = std::fs::read(file(folder)).expect("a checkpoint");
    let mut flipped = sound.clone();
    let middle = sound.len() / 2;
    flipped[middle] ^= 1;
    let short = sound[..middle].to_vec();
    // that of another scene is left to its owner
    let output = simulate(folder, other_end).output().expect("it starts");
    let told = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.code() == Some(2) && told.contains("is the checkpoint of another scene"), "{told}");
    assert!(std::fs::read(file(folder)).expect("a checkpoint") == sound && sums(folder) == expected);
    for bytes in [&flipped, &short, &Vec::new()] {
        std::fs::write(file(folder), bytes).expect("a file");
        let output = simulate(folder, end).output().expect("it starts");
        let summary: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
        assert_eq!(summary["resumed_steps"], 0);
        assert!(bytes.is_empty() || String::from_utf8_lossy(&output.stderr).contains("the run starts over"));
        assert_eq!(sums(folder), expected);
    }
}
