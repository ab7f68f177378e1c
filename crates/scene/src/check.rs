//! How far the numbers of a run are off: from a second run of the same scene, by another method or by other steps.
//!
//! The same method at another tolerance would often take the same steps, those of a short run above all: two runs that are
//! one differ by nothing. Another method shares neither steps nor coefficients; it is of order 8 and at a smaller tolerance,
//! so that its own error is the smaller one. Of fixed steps the order tells how the difference and the error compare. Where
//! it can be, the second run is one in deviations from the uniform flow, in which the start has no rounding.

use crate::propagated::Propagated;
use crate::run::{Scene, has_deviations};
use crate::simulation::{Outcome, RunObserver, run_from};
use jam::events::{Event, EventKind};
use jam::laws::Model;
use jam::states::StateVariables;
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
    /// What they cost: the right-hand sides of the check over those of the run.
    pub cost: f64,
}

/// The tolerance of the second run over that of the run: so much smaller that errors of both that are alike, by chance, are
/// rare; by a method of order 8 that costs little.
const TIGHTER: f64 = 0.1;

/// The same where the run's own method is of such an order.
const TIGHTER_IF_HIGH: f64 = 0.02;
const HIGH: usize = 8;

/// No second run has a smaller tolerance: rounding may keep it from ever being met.
const TIGHTEST: f64 = 3e-15;

/// Ends of both runs that are this near, relative to the time, are one.
const SAME_TIME: f64 = 1e-9;

/// No number is known better than to so many roundings of the largest of its kind.
pub(crate) const ROUNDINGS: f64 = 4.0 * f64::EPSILON;

/// The errors that the steps of the run have told, if they have; else those by a second run, at which somebody may look on.
pub fn errors_of(
    scene: &Scene,
    outcome: &Outcome,
    propagated: Option<&Propagated>,
    onlooker: &mut dyn RunObserver,
) -> Errors {
    let told = propagated.and_then(|propagated| propagated.errors(scene, outcome));
    told.unwrap_or_else(|| errors_seen(scene, outcome, onlooker))
}

/// Runs the scene once more and compares.
pub fn errors(scene: &Scene, outcome: &Outcome) -> Errors {
    errors_seen(scene, outcome, &mut ())
}

/// The same, with somebody who looks on while the scene runs once more.
fn errors_seen(scene: &Scene, outcome: &Outcome, onlooker: &mut dyn RunObserver) -> Errors {
    let Second { scene: second, factor } = second(scene, outcome);
    let other = run_from(&second, None, onlooker).unwrap_or_else(|broken| *broken.outcome);
    let difference = |numbers: &[f64], others: &[f64]| factor * difference(numbers, others);
    let gathered = gathered(scene, outcome);
    let ends_alike = outcome.stop().map(|stop| stop.kind) == other.stop().map(|stop| stop.kind);
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
    // the drive and the force may cancel
    let desired = ROUNDINGS * scene.model.desired_speed().abs();
    Errors {
        cost: other.statistics.evaluations as f64 / outcome.statistics.evaluations as f64,
        std: (ends_alike && has_samples)
            .then(|| std_error(&std(outcome), &std(&other)) + rounding(scene, outcome, &second) + f64::MIN_POSITIVE),
        positions: state(|outcome| &outcome.positions).map(|error| error + ROUNDINGS * largest(&outcome.positions)),
        speeds: state(|outcome| &outcome.speeds).map(|error| error + desired),
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
    let is_blow_up = outcome.events.iter().any(|happening| happening.kind == EventKind::BlowUp);
    let t_end = if is_blow_up { scene.t_end } else { outcome.statistics.time };
    let is_fixed_series = scene.method.needs_series() && matches!(scene.control, Control::Fixed { .. });
    let can_deviate = has_deviations(&scene.model, scene.ring, scene.steady_speed) && !is_fixed_series;
    // the same form would not show what becomes of the rounding of the start
    let form = if can_deviate { StateVariables::Deviations } else { scene.form };
    match scene.control {
        Control::Adaptive { tolerance } => {
            let method = if scene.method == Method::Dop853 { Method::Verner87 } else { Method::Dop853 };
            let tighter = tolerance * if scene.method.order() < HIGH { TIGHTER } else { TIGHTER_IF_HIGH };
            let control = Control::Adaptive { tolerance: if tighter > TIGHTEST { tighter } else { TIGHTEST } };
            Second {
                scene: Scene { method, control, t_end, form, most_steps: most_steps(outcome), ..scene.clone() },
                factor: AGREEMENT,
            }
        }
        Control::Fixed { step } => {
            let made = if step < scene.t_end { step } else { scene.t_end };
            let seen = if has_kinks(&scene.model) { ACROSS_KINKS } else { HIGHEST_SEEN };
            let order = scene.method.order().min(seen) as i32;
            let ratio = match order {
                // a longer step would be cut to the same one
                _ if made > 0.5 * t_end => 0.5,
                1 | 2 => 2.0,
                _ => 1.25,
            };
            let growth = (0..order).fold(1.0, |power: f64, _| power * ratio);
            let control = Control::Fixed { step: ratio * made };
            Second { scene: Scene { control, t_end, form, ..scene.clone() }, factor: CAUTION / (growth - 1.0).abs() }
        }
    }
}

/// The second run may take a few times the work of the run, and somewhat more where that is little.
fn most_steps(outcome: &Outcome) -> u64 {
    const STAGES: u64 = 12;
    const FEW_TIMES: u64 = 4;
    FEW_TIMES * outcome.statistics.evaluations / STAGES + 1000
}

/// Errors of two methods may have one sign and agree in part.
const AGREEMENT: f64 = 1.5;

/// Errors of higher orders than this do not show as such: kinks and rounding are larger.
const HIGHEST_SEEN: usize = 8;

/// The order of steps across a kink.
const ACROSS_KINKS: usize = 2;

/// Whether the law has bends of no width.
pub(crate) fn has_kinks(model: &Model) -> bool {
    matches!(model, Model::Formula(formula) if formula.has_kinks())
}

/// Fixed steps may be too long for their error to be that of their order.
const CAUTION: f64 = 2.0;

/// The rounding of the standard deviation: that of speeds where they are not kept as deviations; none where all motion is one
/// to the last bit, and the second run is not.
fn rounding(scene: &Scene, outcome: &Outcome, second: &Scene) -> f64 {
    let shows_all = second.form == StateVariables::Deviations;
    match scene.form {
        StateVariables::Deviations => of_headway(scene) * largest_std(outcome),
        _ if shows_all && largest_std(outcome) == 0.0 => 0.0,
        _ => ROUNDINGS * largest(&outcome.speeds),
    }
}

/// How much the headway, `L/N` to the nearest double, changes deviations that grow or fade by how the force answers to a
/// spacing: much where that falls by a factor of `e` over a small part of the headway.
pub(crate) fn of_headway(scene: &Scene) -> f64 {
    const PART: f64 = 1e-9;
    let Some(speed) = scene.steady_speed else { return 0.0 };
    let headway = scene.ring.headway();
    let [here, there] = [headway, headway * (1.0 + PART)].map(|headway| scene.model.linearise(headway, speed).phi);
    let condition = ((there - here) / (PART * here)).abs();
    if condition.is_finite() { 0.5 * f64::EPSILON * condition } else { 0.0 }
}

/// The standard deviation of speeds where all of them are equal to the last bit, since what the force makes of the shift is
/// lost beside the drive: nobody's speed is off by more than the force on the least spacing answers to the shift, within a
/// relaxation time. `None` where speeds differ, or the law does not tell.
pub(crate) fn unseen(scene: &Scene, outcome: &Outcome) -> Option<f64> {
    let (headway, shift) = (scene.ring.headway(), scene.start.shift.abs());
    let is_told = largest_std(outcome) == 0.0 && !matches!(scene.model, Model::Formula(_));
    // from rest speeds only grow until the drive is balanced, and the force with them
    let speed = largest(&outcome.speeds);
    let phi = is_told.then(|| scene.model.linearise(headway - shift, speed).phi).filter(|phi| phi.is_finite())?;
    // what the rounding of spacings leaves of the shift may be half as much again
    Some(CAUTION * phi.abs() * shift * math::smaller(outcome.statistics.time, 1.0))
}

/// Whether spacings lose the shift of the start to the last digit.
pub(crate) fn loses_shift(scene: &Scene) -> bool {
    let (clearance, shift) = (scene.ring.headway() - scene.model.contact(), scene.start.shift);
    scene.form == StateVariables::Spacings
        && shift != 0.0
        && clearance - shift == clearance
        && clearance + shift == clearance
}

/// The largest standard deviation in the table.
pub(crate) fn largest_std(outcome: &Outcome) -> f64 {
    outcome.std.rows().fold(0.0, |most, row| math::larger(most, row[1]))
}

/// What fixed steps, whose sums are not compensated, may gather of roundings: once motion is steady all have one sign.
fn gathered(scene: &Scene, outcome: &Outcome) -> f64 {
    match scene.control {
        Control::Fixed { .. } => 0.5 * f64::EPSILON * outcome.statistics.steps as f64,
        Control::Adaptive { .. } => 0.0,
    }
}

/// The largest in size.
pub(crate) fn largest(numbers: &[f64]) -> f64 {
    numbers.iter().fold(0.0, |size, number| if number.abs() <= size { size } else { number.abs() })
}

/// The largest difference, and what rounding leaves open.
fn difference(numbers: &[f64], others: &[f64]) -> f64 {
    let larger = |a: f64, b: f64| if a >= b || a.is_nan() { a } else { b };
    let differences = numbers.iter().zip(others).map(|(number, other)| (number - other).abs());
    differences.fold(ROUNDINGS * largest(numbers), larger)
}

/// The difference of the time of an event from that of the same kind, of the same pedestrian if it has it.
fn time_error(event: &Event, others: &[Event]) -> Option<f64> {
    let same_kind = || others.iter().filter(|other| other.kind == event.kind);
    let same = same_kind().find(|other| other.pedestrian == event.pedestrian).or_else(|| same_kind().next());
    same.map(|other| difference(&[event.time], &[other.time]))
}
