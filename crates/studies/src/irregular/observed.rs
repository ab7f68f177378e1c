//! The quantities observed while the waves run.

use super::Scheme;
use crate::hard::rows::{Rows, row};
use crate::hard::run::{Case, difference};
use figures::failure::Failure;
use jam::observe::speed_std;
use jam::ring::Start;
use jam::states::RingSystem;
use ode::{Observer, Problem, Sampler, Step, integrate};
use std::ops::ControlFlow;

/// Statistics are taken at moments so far apart, in units of `tau`: gaps and speeds change little between them.
const MOMENT: f64 = 0.1;
/// Runs are compared at moments so far apart.
const COMPARED: f64 = 5.0;
/// Paths are kept at moments so far apart.
const KEPT: f64 = 0.5;

/// Statistics of a window.
pub(super) struct Window {
    pub begin: f64,
    /// The mean standard deviation of the speeds.
    pub std: f64,
    /// The least effective gap.
    pub least_gap: f64,
    /// The least speed.
    pub least_speed: f64,
    /// The largest speed.
    pub largest_speed: f64,
}

/// Successive windows of a run from a given state and time, with the given number and length, and its last state.
///
/// # Errors
/// The run failed, or two pedestrians touched.
pub(super) fn windows(
    case: &Case,
    start: &[f64],
    scheme: Scheme,
    begin: f64,
    (count, length): (usize, f64),
) -> Result<(Vec<Window>, Vec<f64>), Failure> {
    let mut state = start.to_vec();
    let found = (0..count)
        .map(|index| {
            let mut window = Window {
                begin: begin + index as f64 * length,
                std: 0.0,
                least_gap: f64::INFINITY,
                least_speed: f64::INFINITY,
                largest_speed: f64::NEG_INFINITY,
            };
            let mut moments = 0.0;
            state = watched(case, &state, scheme, length, MOMENT, &mut |_, gaps, speeds, _| {
                let room = |n: usize| case.model.effective_gap(gaps[n], speeds[n], speeds[(n + 1) % speeds.len()]);
                window.least_gap = (0..gaps.len()).map(room).fold(window.least_gap, math::smaller);
                window.least_speed = speeds.iter().copied().fold(window.least_speed, math::smaller);
                window.largest_speed = speeds.iter().copied().fold(window.largest_speed, math::larger);
                window.std += speed_std(speeds);
                moments += 1.0;
            })?;
            window.std /= moments;
            if window.least_gap > 0.0 { Ok(window) } else { Err(Failure::work("somebody was touched in the waves")) }
        })
        .collect::<Result<Vec<Window>, Failure>>()?;
    Ok((found, state))
}

/// The largest difference of speeds between two runs, at each moment up to a time.
///
/// # Errors
/// A run failed.
pub(super) fn parting(case: &Case, runs: [(Scheme, f64); 2], end: f64) -> Result<Vec<(f64, f64)>, Failure> {
    let [one, other] = runs.map(|(scheme, shift)| {
        let mut all = Vec::new();
        let start = case.form().start(Start { shift });
        watched(case, &start, scheme, end, COMPARED, &mut |t, _, speeds, _| all.push((t, speeds.to_vec())))?;
        Ok::<_, Failure>(all)
    });
    Ok(one?.iter().zip(&other?).map(|((t, one), (_, other))| (*t, difference(one, other))).collect())
}

/// The paths of all from one time to another: `t, n, x, v`.
///
/// # Errors
/// The run failed.
pub(super) fn path(case: &Case, shift: f64, scheme: Scheme, [from, to]: [f64; 2]) -> Result<Rows, Failure> {
    let mut rows = Rows::new(&["t", "n", "x", "v"]);
    let start = case.form().start(Start { shift });
    watched(case, &start, scheme, to, KEPT, &mut |t, _, speeds, positions| {
        if t >= from {
            for (n, (x, v)) in positions.iter().zip(speeds).enumerate() {
                rows.push(row![t, n as f64, *x, *v]);
            }
        }
    })?;
    Ok(rows)
}

/// A look at a moment: time, gaps, speeds, positions.
type Look<'a> = dyn FnMut(f64, &[f64], &[f64], &[f64]) + 'a;

/// Runs from a state for so long, with a look every `interval`; returns the last state.
fn watched(
    case: &Case,
    start: &[f64],
    (method, control): Scheme,
    end: f64,
    interval: f64,
    look: &mut Look<'_>,
) -> Result<Vec<f64>, Failure> {
    let form = case.form();
    let mut watching =
        Watching { form: &*form, sampler: Sampler::new(interval, start.len()), count: case.ring.pedestrians, look };
    let problem = Problem { system: &*form, start, begin: 0.0, end, method, control };
    integrate(&problem, &mut watching).map(|made| made.state).map_err(Failure::work)
}

struct Watching<'a, 'l> {
    form: &'a dyn RingSystem,
    sampler: Sampler,
    count: usize,
    look: &'a mut Look<'l>,
}

impl Observer for Watching<'_, '_> {
    fn after(&mut self, step: &mut Step<'_>) -> ControlFlow<()> {
        let [mut gaps, mut speeds, mut positions] = [(); 3].map(|()| vec![0.0; self.count]);
        let (form, look) = (self.form, &mut self.look);
        self.sampler.within(step, f64::INFINITY, &mut |t, state| {
            form.read(state, &mut gaps, &mut speeds);
            form.write_positions(state, &mut positions);
            look(t, &gaps, &speeds, &positions);
        });
        ControlFlow::Continue(())
    }
}
