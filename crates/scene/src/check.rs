//! How far the numbers of a run are off: from a second run of the same scene, by another method or by other steps.
//!
//! The same method at another tolerance would often take the same steps, those of a short run above all: two runs that are
//! one differ by nothing. Another method shares neither steps nor coefficients; at a larger tolerance it costs less than
//! the run, and its error is the larger one. Of fixed steps the order tells how the difference and the error compare.

use crate::run::Scene;
use crate::simulation::{Onlooker, Outcome, run_from};
use jam::events::{Event, Happening};
use jam::states::FormKind;
use ode::{Control, Method};

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
const LOOSER: f64 = 2.0;

/// Ends of both runs that are this near, relative to the time, are one.
const SAME_TIME: f64 = 1e-9;

/// No number is known better than to so many roundings of the largest of its kind.
const ROUNDINGS: f64 = 4.0 * f64::EPSILON;

/// Runs the scene once more and compares.
pub fn errors(scene: &Scene, outcome: &Outcome) -> Errors {
    errors_seen(scene, outcome, &mut ())
}

/// The same, with somebody who looks on while the scene runs once more.
pub fn errors_seen(scene: &Scene, outcome: &Outcome, onlooker: &mut dyn Onlooker) -> Errors {
    let Second { scene: second, factor } = second(scene, outcome);
    let other = run_from(&second, None, onlooker).unwrap_or_else(|broken| *broken.outcome);
    let difference = |numbers: &[f64], others: &[f64]| factor * difference(numbers, others);
    let gathered = gathered(scene, outcome);
    let ends_alike = outcome.stop().map(|stop| stop.event) == other.stop().map(|stop| stop.event);
    let times = [outcome, &other].map(|outcome| outcome.statistics.time);
    let is_same_time = (times[0] - times[1]).abs() <= SAME_TIME * times[0];
    let std = |outcome: &Outcome| outcome.std.rows().map(|row| row[1]).collect::<Vec<f64>>();
    // a stop may lie on either side of a sample
    let has_samples = other.std.len() + usize::from(outcome.stop().is_some()) >= outcome.std.len();
    let std_error = |numbers: &[f64], others: &[f64]| difference(numbers, others) + gathered * largest(numbers);
    let state = |numbers: fn(&Outcome) -> &[f64]| {
        (ends_alike && is_same_time)
            .then(|| difference(numbers(outcome), numbers(&other)) + gathered * largest(numbers(outcome)))
    };
    Errors {
        std: (ends_alike && has_samples)
            .then(|| std_error(&std(outcome), &std(&other)) + rounding(scene, outcome) + f64::MIN_POSITIVE),
        positions: state(|outcome| &outcome.positions),
        speeds: state(|outcome| &outcome.speeds),
        events: outcome
            .events
            .iter()
            .map(|event| time_error(event, &other.events).map(|error| factor * error))
            .collect(),
    }
}

/// The second run, and the error of the run over the difference of both.
struct Second {
    scene: Scene,
    factor: f64,
}

fn second(scene: &Scene, outcome: &Outcome) -> Second {
    // a run ends with the step in which it finds its last event; a blow-up is no time to end at
    let is_blow_up = outcome.events.iter().any(|happening| happening.event == Event::BlowUp);
    let t_end = if is_blow_up { scene.t_end } else { outcome.statistics.time };
    match scene.control {
        Control::Adaptive { tolerance } => {
            let method = if scene.method == Method::Dop853 { Method::Verner87 } else { Method::Dop853 };
            let looser = LOOSER * tolerance;
            let control = Control::Adaptive { tolerance: if looser < LOOSEST { looser } else { LOOSEST } };
            Second { scene: Scene { method, control, t_end, ..scene.clone() }, factor: AGREEMENT }
        }
        Control::Fixed { step } => {
            let made = if step < scene.t_end { step } else { scene.t_end };
            let order = scene.method.order().min(HIGHEST_SEEN) as i32;
            let ratio = match order {
                // a longer step would be cut to the same one
                _ if made > 0.5 * t_end => 0.5,
                1 | 2 => 2.0,
                _ => 1.25,
            };
            let growth = (0..order).fold(1.0, |power: f64, _| power * ratio);
            let control = Control::Fixed { step: ratio * made };
            Second { scene: Scene { control, t_end, ..scene.clone() }, factor: CAUTION / (growth - 1.0).abs() }
        }
    }
}

/// Errors of two methods may have one sign and agree in part.
const AGREEMENT: f64 = 1.5;

/// The largest tolerance that a scene may have.
const LOOSEST: f64 = 1e-2;

/// Errors of higher orders than this do not show as such: kinks and rounding are larger.
const HIGHEST_SEEN: usize = 8;

/// Fixed steps may be too long for their error to be that of their order.
const CAUTION: f64 = 2.0;

/// The rounding of the speeds, which the standard deviation inherits where they are not kept as deviations.
fn rounding(scene: &Scene, outcome: &Outcome) -> f64 {
    if scene.form == FormKind::Deviations { 0.0 } else { ROUNDINGS * largest(&outcome.speeds) }
}

/// What fixed steps, whose sums are not compensated, may gather of roundings: once motion is steady all have one sign.
fn gathered(scene: &Scene, outcome: &Outcome) -> f64 {
    match scene.control {
        Control::Fixed { .. } => 0.5 * f64::EPSILON * outcome.statistics.steps as f64,
        Control::Adaptive { .. } => 0.0,
    }
}

/// The largest in size.
fn largest(numbers: &[f64]) -> f64 {
    numbers.iter().fold(0.0, |size, number| if number.abs() <= size { size } else { number.abs() })
}

/// The largest difference, and what rounding leaves open.
fn difference(numbers: &[f64], others: &[f64]) -> f64 {
    let larger = |a: f64, b: f64| if a >= b || a.is_nan() { a } else { b };
    let differences = numbers.iter().zip(others).map(|(number, other)| (number - other).abs());
    differences.fold(ROUNDINGS * largest(numbers), larger)
}

/// The difference of the time of an event from that of the same kind, of the same pedestrian if it has it.
fn time_error(event: &Happening, others: &[Happening]) -> Option<f64> {
    let same_kind = || others.iter().filter(|other| other.event == event.event);
    let same = same_kind().find(|other| other.pedestrian == event.pedestrian).or_else(|| same_kind().next());
    same.map(|other| difference(&[event.time], &[other.time]))
}
