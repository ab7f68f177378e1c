//! Prints of steps as `simulate` writes them.

use crate::{root, succeed};
use files::steps::Print;
use std::path::Path;

fn simulate(options: &[&str], folder: &Path) {
    let scene = root().join("figures/fig07-exponential-std/scene.toml");
    let (scene, out) = (scene.to_string_lossy(), folder.to_string_lossy());
    let common = [&*scene, "--panel", "unstable", "--t-end", "20", "--tables-only", "--out", &*out];
    succeed("simulate", &[&common[..], options].concat());
}

#[test]
fn every_step_has_a_print_and_the_tables_are_the_same() {
    let scratch = tempfile::tempdir().expect("a scratch folder");
    let [with, without] = ["with", "without"].map(|name| scratch.path().join(name));
    simulate(&["--steps"], &with);
    simulate(&[], &without);
    assert!(!without.join("steps.csv").exists());
    let read = |folder: &Path, name: &str| std::fs::read_to_string(folder.join(name)).expect("a file");
    for name in ["std.csv", "events.csv"] {
        assert!(read(&with, name) == read(&without, name), "{name}");
    }
    let summary: serde_json::Value = serde_json::from_str(&read(&with, "summary.json")).expect("JSON");
    let steps = read(&with, "steps.csv");
    let lines: Vec<(f64, Option<Print>)> = steps
        .lines()
        .skip(1)
        .filter_map(|line| line.split_once(','))
        .map(|(t, print)| (t.parse().expect("a time"), Print::parse(print)))
        .collect();
    assert_eq!(lines.len() as u64, summary["steps"].as_u64().expect("a number") + 1);
    assert!(lines.iter().all(|(_, print)| print.is_some()) && lines.windows(2).all(|pair| pair[0].0 < pair[1].0));
    assert_eq!((lines[0].0.to_bits(), lines.last().map(|line| line.0)), (0, Some(20.0)));
}

#[test]
fn steps_of_fixed_length_have_no_prints() {
    let scratch = tempfile::tempdir().expect("a scratch folder");
    simulate(&["--steps", "--method", "heun", "--dt", "0.01"], scratch.path());
    assert!(!scratch.path().join("steps.csv").exists());
}
