//! Scenes that once failed: `scenes/*.toml`, each with a comment that says how.

use hunt::judge::{self, Verdict};
use std::path::Path;

/// The verdicts on all scenes whose names begin so, with their names.
fn verdicts(beginning: &str) -> Vec<(String, Verdict)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let files = std::fs::read_dir(&folder).expect("a folder").map(|entry| entry.expect("an entry").path());
    let name = |file: &Path| file.file_name().expect("a name").to_string_lossy().into_owned();
    let mut files: Vec<_> = files.filter(|file| name(file).starts_with(beginning)).collect();
    files.sort();
    assert!(!files.is_empty(), "{}: {beginning}", folder.display());
    let judged = |file: &std::path::PathBuf| {
        let text = std::fs::read_to_string(file).expect("text");
        judge::scene(&text).into_iter().map(|verdict| (name(file), verdict)).collect::<Vec<_>>()
    };
    files.iter().flat_map(judged).collect()
}

#[test]
fn scenes_that_went_wrong_are_right_or_say_why_not() {
    let all = verdicts("");
    assert!(all.len() > 30, "{} panels", all.len());
    for (name, verdict) in all {
        assert!(verdict.findings.is_empty() && verdict.undecided.is_empty(), "{name}: {verdict:#?}");
    }
}

/// Errors of Taylor's method that were stated far too large.
#[test]
fn errors_that_were_far_too_large_are_near_the_true_ones() {
    for (name, verdict) in verdicts("cautious") {
        assert!(verdict.stated.len() > 1, "{name}: {verdict:#?}");
        let states = verdict.stated.iter().filter(|ratio| ratio.what != "std");
        for ratio in states.filter(|ratio| ratio.error > 1e-14 * ratio.range) {
            assert!(ratio.value() > LEAST, "{name}: {ratio:?}");
        }
    }
}

/// They are less than a few thousand times too large: errors of stiff motion fade faster than their series tell.
const LEAST: f64 = 3e-4;
