//! The reference solution of figure 4's stable run, and its states in every form.

use super::{Run, State};
use figures::failure::Failure;
use files::write::with_path;
use jam::states::StateVariables;
use math::double_double::{DoubleDouble, decimal};
use reference::ring::Ring as ExactRing;
use reference::scenes::{Parameters, Scene, scene};
use reference::table::spread;
use std::path::Path;

/// The scene whose solution is known to 20 digits.
const NAME: &str = "algebraic_stable";

/// Distances from the solution: the largest of the gaps, the largest of the speeds, that of the standard deviation.
pub type Distances = [f64; 3];

/// The scene as the reference has it.
///
/// # Errors
/// No scene has this name.
pub fn exact_scene() -> Result<Scene, Failure> {
    scene(NAME, Parameters::Doubles).ok_or_else(|| Failure::work(format!("no scene {NAME}")))
}

/// The state at a whole time from the folder of solutions: clearances, speeds, and a position that is not compared.
///
/// # Errors
/// The table cannot be read, or has no such time.
pub fn state_at(folder: &Path, ring: &ExactRing, time: f64) -> Result<Vec<DoubleDouble>, Failure> {
    let (n, contact) = (ring.pedestrians, ring.law.contact());
    let mut state = vec![DoubleDouble::ZERO; ring.dimension()];
    let mut found = 0;
    for cells in rows(&folder.join(format!("{NAME}.csv")))? {
        let [t, pedestrian, gap, speed] = cells[..] else { continue };
        if t.hi == time {
            let index = pedestrian.hi as usize % n;
            (state[index], state[n + index]) = (gap - contact, speed);
            found += 1;
        }
    }
    if found == n { Ok(state) } else { Err(Failure::work(format!("{NAME}.csv: {found} rows at t = {time}"))) }
}

/// The standard deviations at every unit of time, from 0.
///
/// # Errors
/// The table cannot be read.
pub fn spreads(folder: &Path) -> Result<Vec<f64>, Failure> {
    Ok(rows(&folder.join(format!("{NAME}_std.csv")))?.iter().map(|cells| cells[1].into()).collect())
}

/// The rows of a table of numbers, with all their digits.
fn rows(file: &Path) -> Result<Vec<Vec<DoubleDouble>>, Failure> {
    let text = std::fs::read_to_string(file).map_err(|error| with_path(error, file))?;
    let numbers = |line: &str| line.split(',').map(decimal::parse).collect::<Option<Vec<DoubleDouble>>>();
    let damaged = || Failure::work(format!("{}: a cell is not a number", file.display()));
    text.lines().skip(1).map(|line| numbers(line).ok_or_else(damaged)).collect()
}

/// The state of a run as the reference writes it, with its carries and without rounding: clearances, speeds, 0.
pub fn written(ring: &ExactRing, run: &Run) -> Vec<DoubleDouble> {
    let (n, sum) = (ring.pedestrians, &run.sum);
    let at = |index: usize| DoubleDouble::sum(sum.state[index], sum.carry[index]);
    let length = DoubleDouble::from(run.ring.length);
    let contact = ring.law.contact();
    let clearance = |index: usize| match run.state {
        State::RingSystem(StateVariables::Positions) if index + 1 < n => at(index + 1) - at(index) - contact,
        State::RingSystem(StateVariables::Positions) => at(0) + length - at(index) - contact,
        State::Wrapped => {
            let apart = at((index + 1) % n) - at(index);
            if apart.hi < 0.0 { apart + length - contact } else { apart - contact }
        }
        State::RingSystem(StateVariables::Spacings) => at(index),
        State::RingSystem(StateVariables::Deviations) => length / n as f64 - contact + at(index),
    };
    let speed = |index: usize| match run.state {
        State::RingSystem(StateVariables::Deviations) => at(2 * n + 2) + at(n + index),
        State::RingSystem(_) | State::Wrapped => at(n + index),
    };
    (0..n).map(clearance).chain((0..n).map(speed)).chain([DoubleDouble::ZERO]).collect()
}

/// How far a state is from another.
pub fn distances(ring: &ExactRing, state: &[DoubleDouble], other: &[DoubleDouble]) -> Distances {
    let (gap, speed) = reference::table::distances(ring, state, other);
    [gap, speed, (spread(ring, state) - spread(ring, other)).hi.abs()]
}
