//! The numbers in the figures against the reference solutions (data/reference/solutions): every sample of every curve,
//! all pedestrians at some times, and the times of the events.

use crate::project::{figure, root, scene};
use files::table::Table;
use jam::run::{Outcome, run};
use scene::Overrides;
use scene::tables;

/// A run of a figure and the name of its reference, with bounds for the error of its curve (in units of the curve's
/// range) and of all gaps and speeds: the errors found, rounded up to the next power of ten. The manifest promises
/// 1e-8.
const RUNS: [(&str, &str, &str, f64, f64); 6] = [
    ("fig04", "stable", "algebraic_stable", 1e-14, 1e-14),
    ("fig04", "unstable", "algebraic_unstable", 1e-10, 1e-10),
    ("fig07", "stable", "exponential_stable", 1e-14, 1e-13),
    ("fig07", "unstable", "exponential_unstable", 1e-13, 1e-12),
    ("fig13", "std", "logarithmic", 1e-12, 1e-10),
    ("fig13", "std_small_shift", "logarithmic_small_shift", 1e-11, 1e-11),
];

fn solution(name: &str) -> Table {
    let path = root(&format!("data/reference/solutions/{name}.csv"));
    Table::read(&path).expect("a reference solution")
}

/// The largest difference of the standard deviations at the samples that both have, in units of the range.
fn error_of_curve(outcome: &Outcome, reference: &Table) -> f64 {
    let std = tables::std(&outcome.samples);
    let rows: Vec<(&[f64], &[f64])> = std.rows().zip(reference.rows()).collect();
    assert!(rows.len() > 400 && rows.iter().all(|(a, b)| a[0] == b[0]), "the same times");
    let range = rows.iter().map(|(a, _)| a[1]).fold(0.0, math::larger);
    rows.iter().map(|(a, b)| (a[1] - b[1]).abs()).fold(0.0, math::larger) / range
}

/// The largest difference of gaps and speeds at the times of the reference. Gaps are differences of positions, which
/// adds their rounding, at most 1e-12.
fn error_of_states(outcome: &Outcome, reference: &Table, length: f64) -> f64 {
    let count = reference.column("n").expect("n").iter().copied().fold(0.0, math::larger) as usize + 1;
    let table = tables::trajectories(&outcome.samples);
    let table: Vec<&[f64]> = table.rows().collect();
    let mut worst = 0.0;
    for row in reference.rows() {
        let (sample, n) = (row[0] as usize, row[1] as usize);
        let Some(own) = table.get(sample * count + n) else { continue };
        let ahead = table[sample * count + (n + 1) % count][2] + if n + 1 == count { length } else { 0.0 };
        worst = math::larger(worst, math::larger((ahead - own[2] - row[2]).abs() - 1e-12, (own[3] - row[3]).abs()));
    }
    worst
}

#[test]
fn printed_curves_are_those_of_the_reference() {
    for (id, panel, name, curve, state) in RUNS {
        let mut scene = scene(&figure(id), panel, &Overrides::default());
        scene.keeps_trajectories = true;
        let outcome = run(&scene).expect("it runs");
        let error = error_of_curve(&outcome, &solution(&format!("{name}_std")));
        let errors = error_of_states(&outcome, &solution(name), scene.ring.length);
        println!("{name}: curve {error:.1e} of its range, gaps and speeds {errors:.1e}");
        assert!(error < curve && errors < state, "{name}: {error:e} of the range, {errors:e}");
    }
}

/// Times of events to 1e-11: eleven digits behind the point, of which the manifest claims eight.
#[test]
fn events_are_those_of_the_reference() {
    let path = root("data/reference/solutions/events.csv");
    let text = std::fs::read_to_string(path).expect("the events of the reference");
    let mut count = 0;
    for (id, panel, name, ..) in RUNS {
        let outcome = run(&scene(&figure(id), panel, &Overrides::default())).expect("it runs");
        for line in text.lines().filter(|line| line.starts_with(&format!("{name},"))) {
            let cells: Vec<&str> = line.split(',').collect();
            let (time, n): (f64, usize) = (cells[2].parse().expect("t"), cells[3].parse().expect("n"));
            let own = outcome.events.iter().find(|own| own.kind.name() == cells[1]).expect("the same event");
            println!("{name} {}: {:?}, off by {:.1e}", cells[1], own.time, own.time - time);
            assert!((own.time - time).abs() < 1e-11 && own.pedestrian == n, "{line}: {own:?}");
            count += 1;
        }
    }
    assert_eq!(count, 5);
}
