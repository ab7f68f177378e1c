//! The errors that a run may have: ten times those that it states; where it states none, what its tolerance allows.

use crate::answer::Answer;
use crate::stated::Stated;
use jam::states::FormKind;
use ode::Control;
use reference::solution::{Kind, Sample};
use scene::run::Scene;
use scene::simulation::Outcome;

/// The errors that a run may have.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bound {
    /// Of standard deviations.
    pub std: f64,
    /// Of positions and spacings.
    pub position: f64,
    /// Of speeds.
    pub speed: f64,
}

/// Times the stated error.
const FACTOR: f64 = 10.0;

/// How much a local error may grow on the way.
const GROWTH: f64 = 100.0;

impl Bound {
    /// The errors of this run.
    pub fn new(scene: &Scene, outcome: &Outcome, answer: &Answer, stated: &Stated) -> Bound {
        let usual = Bound::by_tolerance(scene, outcome, answer);
        let or = |stated: f64, usual: f64| if stated.is_finite() { FACTOR * stated } else { usual };
        Bound {
            std: or(stated.std, usual.std),
            position: or(stated.position, usual.position),
            speed: or(stated.speed, usual.speed),
        }
    }

    /// So many local errors as there are steps, each at most the tolerance times the scale of the form in use, times
    /// [`GROWTH`]. Of fixed steps nothing is known.
    fn by_tolerance(scene: &Scene, outcome: &Outcome, answer: &Answer) -> Bound {
        let Control::Adaptive { tolerance } = scene.control else {
            return Bound { std: f64::INFINITY, position: f64::INFINITY, speed: f64::INFINITY };
        };
        let samples = &answer.solution.samples;
        let most = |of: &dyn Fn(&Sample) -> f64| samples.iter().map(of).fold(0.0_f64, f64::max);
        let largest = |values: &[f64]| values.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
        let perturbation = most(&|sample| sample.perturbation).max(scene.start.shift.abs());
        let size = most(&|sample| largest(&sample.positions).max(largest(&sample.speeds))).max(scene.ring.length);
        let local = GROWTH * (outcome.statistics.steps as f64 + 10.0) * (tolerance + 1e-15);
        let scale = match scene.form {
            FormKind::Deviations => perturbation,
            FormKind::Gaps => perturbation.max(1.0),
            FormKind::Positions => size,
        };
        Bound { std: local * scale, position: local * size, speed: local * size }
    }

    /// Of what becomes negative in an event.
    pub fn value(&self, kind: Kind) -> f64 {
        match kind {
            Kind::Overlap => 2.0 * (self.position + self.speed),
            Kind::NegativeSpeed => self.speed,
            Kind::Exchange => 2.0 * self.position,
        }
    }

    /// Of the time of an event at which the value falls at this rate.
    pub fn moment(&self, kind: Kind, rate: f64) -> f64 {
        self.value(kind) / rate.abs()
    }
}
