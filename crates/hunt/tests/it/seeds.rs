//! Random scenes by their seeds.

use hunt::report::{Hunted, hunt, table};

/// Runs that the second integration may leave undecided: chaotic ones, and steep ones that take too much work.
const UNDECIDED: f64 = 0.02;

fn judged(from: u64, count: u64) {
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let all = hunt(from, count, threads);
    println!("{}", table(&all));
    let verdicts: Vec<_> = all.iter().flat_map(|Hunted { verdicts, .. }| verdicts).collect();
    assert!(verdicts.iter().all(|verdict| verdict.findings.is_empty()), "{}", table(&all));
    let undecided = verdicts.iter().filter(|verdict| !verdict.undecided.is_empty()).count() as f64;
    assert!(undecided <= UNDECIDED * verdicts.len() as f64, "{}", table(&all));
    // the generator reaches all that it should
    for ending in ["ran to t_end", "negative_speed", "overlap", "exchange", "refused: no uniform flow"] {
        assert!(verdicts.iter().any(|verdict| verdict.ending.contains(ending)), "no run: {ending}\n{}", table(&all));
    }
}

#[test]
fn three_hundred_random_scenes_are_right_or_say_why_not() {
    judged(0, 300);
}

#[test]
#[ignore = "ten minutes"]
fn ten_thousand_random_scenes_are_right_or_say_why_not() {
    judged(0, 10_000);
}
