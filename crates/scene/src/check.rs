//! How far the numbers of a run are off: from a second, coarser run of the same scene.
//!
//! Its error is several times that of the run, so their difference is an estimate on the safe side. Its steps lie
//! elsewhere: what one of the two steps over, the other does not. It costs less than the run.

use crate::run::Scene;
use crate::simulation::{Outcome, run};
use jam::events::{Event, Happening};
use jam::states::FormKind;
use ode::Control;

/// Estimated errors; `None` where the second run says nothing, having ended elsewhere.
#[derive(Clone, Debug, PartialEq)]
pub struct Errors {
    /// The largest of the standard deviation over all samples.
    pub std: Option<f64>,
    /// The largest of the positions at the end.
    pub positions: Option<f64>,
    /// The largest of the speeds at the end.
    pub speeds: Option<f64>,
    /// Of the times of the events, in their order.
    pub events: Vec<Option<f64>>,
}

/// The tolerance of the second run over that of the run.
const LOOSER: f64 = 10.0;

/// Ends of both runs that are this near, relative to the time, are one.
const SAME_TIME: f64 = 1e-9;

/// No number is known better than to so many roundings of the largest of its kind.
const ROUNDINGS: f64 = 4.0 * f64::EPSILON;

/// Runs the scene once more and compares.
pub fn errors(scene: &Scene, outcome: &Outcome) -> Errors {
    let other = run(&coarser(scene, outcome)).unwrap_or_else(|broken| *broken.outcome);
    let ends_alike = outcome.stop().map(|stop| stop.event) == other.stop().map(|stop| stop.event);
    let times = [outcome, &other].map(|outcome| outcome.statistics.time);
    let is_same_time = (times[0] - times[1]).abs() <= SAME_TIME * times[0];
    let std = |outcome: &Outcome| outcome.std.rows().map(|row| row[1]).collect::<Vec<f64>>();
    // a stop may lie on either side of a sample
    let has_samples = other.std.len() + usize::from(outcome.stop().is_some()) >= outcome.std.len();
    let state = |numbers: fn(&Outcome) -> &[f64]| {
        (ends_alike && is_same_time).then(|| difference(numbers(outcome), numbers(&other)))
    };
    Errors {
        std: (ends_alike && has_samples).then(|| {
            let (found, least) = (difference(&std(outcome), &std(&other)), rounding(scene, outcome));
            if found < least { least } else { found }
        }),
        positions: state(|outcome| &outcome.positions),
        speeds: state(|outcome| &outcome.speeds),
        events: outcome.events.iter().map(|event| time_error(event, &other.events)).collect(),
    }
}

/// The same scene with a larger error, and other steps.
fn coarser(scene: &Scene, outcome: &Outcome) -> Scene {
    let control = match scene.control {
        Control::Adaptive { tolerance } => Control::Adaptive { tolerance: LOOSER * tolerance },
        // an error of order p grows by 2^p - 1 of itself, or by 1.25^p - 1: about once or more
        Control::Fixed { step } => Control::Fixed { step: step * if scene.method.order() < 3 { 2.0 } else { 1.25 } },
    };
    // a run ends with the step in which it finds its last event; a blow-up is no time to end at
    let is_blow_up = outcome.events.iter().any(|happening| happening.event == Event::BlowUp);
    let t_end = if is_blow_up { scene.t_end } else { outcome.statistics.time };
    Scene { control, t_end, ..scene.clone() }
}

/// The rounding of the speeds, which the standard deviation inherits where they are not kept as deviations.
fn rounding(scene: &Scene, outcome: &Outcome) -> f64 {
    if scene.form == FormKind::Deviations { 0.0 } else { difference(&outcome.speeds, &outcome.speeds) }
}

/// The largest difference, and what rounding leaves open.
fn difference(numbers: &[f64], others: &[f64]) -> f64 {
    let larger = |a: f64, b: f64| if a >= b || a.is_nan() { a } else { b };
    let differences = numbers.iter().zip(others).map(|(number, other)| (number - other).abs());
    let size = numbers.iter().fold(0.0, |size: f64, number| larger(size, number.abs()));
    differences.fold(ROUNDINGS * size, larger)
}

/// The difference of the time of an event from that of the same kind, of the same pedestrian if it has it.
fn time_error(event: &Happening, others: &[Happening]) -> Option<f64> {
    let same_kind = || others.iter().filter(|other| other.event == event.event);
    let same = same_kind().find(|other| other.pedestrian == event.pedestrian).or_else(|| same_kind().next());
    same.map(|other| difference(&[event.time], &[other.time]))
}
