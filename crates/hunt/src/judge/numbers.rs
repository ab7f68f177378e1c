//! The numbers of the tables and of the end against the second integration.

use super::{Ratio, Verdict, is_blown_up};
use crate::answer::Answer;
use crate::bound::Bound;
use crate::stated::largest;
use jam::run::Outcome;
use math::larger;
use scene::run::Scene;

/// The comparison of one number.
#[derive(Clone, Copy, Debug)]
pub struct Compared {
    /// Of which number.
    pub what: &'static str,
    /// When.
    pub time: f64,
    /// That of the run.
    pub found: f64,
    /// That of the second integration.
    pub right: f64,
    /// The error of the latter, by its own account.
    pub uncertainty: f64,
    /// The error allowed; infinite where the run states none.
    pub allowed: f64,
    /// The largest size of such a number.
    pub range: f64,
}

impl Compared {
    /// Adds it to a verdict.
    pub fn note(self, verdict: &mut Verdict) {
        let Compared { what, time, found, right, uncertainty, allowed, range } = self;
        let error = (found - right).abs();
        if !found.is_finite() {
            verdict.findings.push(format!("{what} at t = {time:?} is {found:?}"));
            return;
        }
        if allowed.is_infinite() {
            return;
        }
        if error <= allowed {
            if uncertainty > 0.5 * allowed {
                verdict
                    .undecided
                    .push(format!("{what} at {time:?}: allowed {allowed:e}, uncertain by {uncertainty:e}"));
            }
            verdict.ratios.push(Ratio { what, error, allowed, uncertainty, range });
        } else if error > 3.0 * uncertainty {
            verdict.findings.push(format!(
                "{what} at t = {time:?} is {found:?}, right is {right:?} (sure to {uncertainty:.1e}): off by {error:.2e}, allowed {allowed:.2e}"
            ));
            verdict.ratios.push(Ratio { what, error, allowed, uncertainty, range });
        } else {
            verdict.undecided.push(format!("{what} at {time:?}: off by {error:e}, uncertain by {uncertainty:e}"));
        }
    }
}

/// Compares every row, and the end.
pub(super) fn compare(verdict: &mut Verdict, scene: &Scene, outcome: &Outcome, answer: &Answer, bound: &Bound) {
    let pedestrians = scene.ring.pedestrians;
    let (std, trajectories) = (scene::tables::std(&outcome.samples), scene::tables::trajectories(&outcome.samples));
    let stds: Vec<&[f64]> = std.rows().collect();
    let trajectories: Vec<&[f64]> = trajectories.rows().collect();
    let range = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0_f64, |most, value| larger(most, value.abs()));
    let std_range = range(&mut stds.iter().map(|row| row[1]));
    let solution = &answer.solution;
    start(verdict, scene, stds.first().map(|row| row[1]), trajectories.get(..pedestrians).unwrap_or_default());
    for (row, std) in stds.iter().enumerate().skip(1) {
        let time = std[0];
        let Some((right, twin)) = answer.at(time) else {
            if solution.time < time {
                verdict.findings.push(format!(
                    "a row at t = {time:?}, but the solution ends at {:?} ({:?})",
                    solution.time, solution.end
                ));
            }
            break;
        };
        Compared {
            what: "std",
            time,
            found: std[1],
            right: right.std,
            uncertainty: (right.std - twin.std).abs(),
            allowed: bound.std,
            range: std_range,
        }
        .note(verdict);
        if let Some(rows) = trajectories.get(row * pedestrians..(row + 1) * pedestrians) {
            let (x, v): (Vec<f64>, Vec<f64>) = rows.iter().map(|row| (row[2], row[3])).unzip();
            state(verdict, time, (&x, &v), right, twin, bound.table);
        }
    }
    // at a blow-up a rounding of the time is a large part of the speeds
    if let Some((right, twin)) = answer.at(outcome.statistics.time).filter(|_| !is_blown_up(outcome)) {
        state(verdict, right.time, (&outcome.positions, &outcome.speeds), right, twin, bound.end);
    }
}

/// The first row: everybody at rest at equal spacings, but for the shift of pedestrian 0 or the displacements.
fn start(verdict: &mut Verdict, scene: &Scene, std: Option<f64>, rows: &[&[f64]]) {
    if std != Some(0.0) {
        verdict.findings.push(format!("std at the start is {std:?}"));
    }
    let headway = scene.ring.length / scene.ring.pedestrians as f64;
    for (n, row) in rows.iter().enumerate() {
        let by = if n == 0 { scene.start.shift } else { 0.0 };
        let right = n as f64 * headway + scene.displacements.get(n).copied().unwrap_or(by);
        let is_right = row[1] == n as f64
            && (row[2] - right).abs() <= n as f64 * f64::EPSILON * scene.ring.length
            && row[3] == 0.0;
        if !is_right {
            verdict.findings.push(format!("pedestrian {n} starts as {row:?}; right: at {right:?}, at rest"));
        }
    }
}

/// Half a unit in the last place of a time, relative.
const ULP: f64 = 1.2e-16;

/// Positions and speeds: the worst pedestrian.
fn state(
    verdict: &mut Verdict,
    time: f64,
    (x, v): (&[f64], &[f64]),
    right: &reference::solution::Sample,
    twin: &reference::solution::Sample,
    allowed: [f64; 2],
) {
    let largest = |a: &[f64], b: &[f64]| largest(a.iter().zip(b).map(|(a, b)| a - b));
    let numbers = [
        ("position", x, &right.positions, &twin.positions, allowed[0]),
        ("speed", v, &right.speeds, &twin.speeds, allowed[1] + right.acceleration * ULP * time),
    ];
    for (what, found, right, twin, allowed) in numbers {
        let range = right.iter().fold(0.0_f64, |most, value| larger(most, value.abs()));
        let error = largest(found, right);
        Compared { what, time, found: error, right: 0.0, uncertainty: largest(right, twin), allowed, range }
            .note(verdict);
    }
}
