//! The errors that a run may have.

use crate::answer::Answer;
use jam::states::FormKind;
use ode::Control;
use reference::solution::Kind;
use scene::run::Scene;
use scene::simulation::{Outcome, run};

/// The errors that a run may have, by what is known of it.
///
/// By adaptive steps: so many local errors as there are steps, each at most the tolerance times the scale of the form in
/// use, times [`GROWTH`]. By fixed steps: [`GROWTH`] times what the same run with steps of half the length differs by.
#[derive(Clone, Debug)]
pub struct Bound {
    perturbation: f64,
    rest: f64,
}

/// How much a local error may grow on the way.
const GROWTH: f64 = 30.0;

impl Bound {
    /// The errors of this run.
    pub fn new(scene: &Scene, outcome: &Outcome, answer: &Answer) -> Bound {
        let samples = &answer.solution.samples;
        let most = |of: &dyn Fn(&reference::solution::Sample) -> f64| {
            samples.iter().map(of).fold(0.0_f64, |most, value| most.max(value))
        };
        let largest = |values: &[f64]| values.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
        let perturbation = most(&|sample| sample.perturbation).max(scene.start.shift.abs());
        let size = most(&|sample| largest(&sample.positions).max(largest(&sample.speeds))).max(scene.ring.length);
        let steps = outcome.statistics.steps as f64;
        match scene.control {
            Control::Adaptive { tolerance } => {
                let local = GROWTH * (steps + 10.0) * (tolerance + 1e-15);
                let scale = match scene.form {
                    FormKind::Deviations => perturbation,
                    FormKind::Gaps => perturbation.max(1.0),
                    FormKind::Positions => size,
                };
                Bound { perturbation: local * scale, rest: local * size }
            }
            Control::Fixed { step } => {
                let mut finer = scene.clone();
                finer.control = Control::Fixed { step: 0.5 * step };
                let Ok(finer) = run(&finer) else {
                    return Bound { perturbation: f64::INFINITY, rest: f64::INFINITY };
                };
                let pairs = |a: &[f64], b: &[f64]| {
                    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0_f64, |most, error| most.max(error))
                };
                let column = |outcome: &Outcome| outcome.std.rows().map(|row| row[1]).collect::<Vec<f64>>();
                let std = pairs(&column(outcome), &column(&finer));
                let cells = |outcome: &Outcome| outcome.trajectories.rows().flatten().copied().collect::<Vec<f64>>();
                let state = pairs(&outcome.positions, &finer.positions)
                    .max(pairs(&outcome.speeds, &finer.speeds))
                    .max(pairs(&cells(outcome), &cells(&finer)));
                let rounding = 1e-15 * (steps + 10.0);
                Bound {
                    perturbation: GROWTH * (std + rounding * perturbation)
                        + if scene.form == FormKind::Deviations { 0.0 } else { rounding * size },
                    rest: GROWTH * (state + std + rounding * size),
                }
            }
        }
    }

    /// Of the standard deviation.
    pub fn std(&self, _time: f64) -> f64 {
        self.perturbation
    }

    /// Of positions.
    pub fn position(&self, _time: f64) -> f64 {
        self.rest
    }

    /// Of speeds.
    pub fn speed(&self, _time: f64) -> f64 {
        self.rest
    }

    /// Of what becomes negative in an event.
    pub fn value(&self, _kind: Kind, _time: f64) -> f64 {
        self.rest
    }

    /// Of the time of an event at which the value falls at this rate.
    pub fn moment(&self, time: f64, rate: f64) -> f64 {
        self.value(Kind::Overlap, time) / rate.abs()
    }
}
