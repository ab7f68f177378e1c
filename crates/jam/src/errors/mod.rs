//! Error estimates for a run, from a second run with another method or other steps.
//!
//! The same method at another tolerance would often take the same steps, those of a short run above all: two runs that are
//! one differ by nothing. Another method shares neither steps nor coefficients; it is of order 8 and at a smaller tolerance,
//! so that its own error is the smaller one. Of fixed steps the order tells how the difference and the error compare. Where
//! it can be, the second run is one in deviations from the uniform flow, in which the start has no rounding.

mod propagated;

pub use propagated::Propagated;

use crate::events::{Event, EventKind};
use crate::laws::Model;
use crate::run::{Broken, Outcome, Run, RunObserver, has_deviations, run_from};
use crate::states::StateVariables;
use ode::{Control, Method};

/// Estimated errors, in the units of the numbers; `None` where the second run gives no estimate because it ended
/// elsewhere.
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

/// Least error of a number, in roundings of the largest number of its kind.
pub(crate) const ROUNDINGS: f64 = 4.0 * f64::EPSILON;

/// Makes a run and estimates the errors of its results: from its steps if they estimate theirs, otherwise from a second
/// run.
///
/// ```
/// use jam::laws::{Logarithmic, Model};
/// use jam::ring::{Ring, Start};
/// use jam::run::Run;
///
/// let law = Model::Logarithmic(Logarithmic { v0: 1.0, a_v: 0.0, epsilon: 0.01 });
/// let run = Run::new(law, Ring { pedestrians: 20, length: 30.0 }, Start { shift: 0.1 }, 50.0)?;
/// let (outcome, errors) = jam::errors::stated(&run)?;
/// let error = errors.std.expect("both runs came to the end");
/// assert!(error > 0.0 && error < 1e-6, "{:?} +- {error:e}", outcome.samples.std.last());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// As [`run`](crate::run::run).
pub fn stated(run: &Run) -> Result<(Outcome, Errors), Broken> {
    let (made, propagated) = run_propagated(run, &mut ());
    let outcome = made?;
    let errors = errors_of(run, &outcome, propagated.as_ref(), &mut ());
    Ok((outcome, errors))
}

/// Makes a run with error estimates from its steps, if its method provides them.
pub fn run_propagated(run: &Run, observer: &mut dyn RunObserver) -> (Result<Outcome, Broken>, Option<Propagated>) {
    let mut propagated = run.method.needs_series().then(|| Propagated::new(run));
    let made = match &mut propagated {
        Some(propagated) => run_from(run, None, &mut (observer, propagated)),
        None => run_from(run, None, observer),
    };
    (made, propagated)
}

/// The errors estimated by the steps of the run, if available; otherwise those from a second run, which can be
/// observed.
pub fn errors_of(
    run: &Run,
    outcome: &Outcome,
    propagated: Option<&Propagated>,
    onlooker: &mut dyn RunObserver,
) -> Errors {
    let told = propagated.and_then(|propagated| propagated.errors(run, outcome));
    told.unwrap_or_else(|| errors_seen(run, outcome, onlooker))
}

/// Runs the scene once more and compares.
pub fn errors(run: &Run, outcome: &Outcome) -> Errors {
    errors_seen(run, outcome, &mut ())
}

/// The same, with an observer of the second run.
fn errors_seen(run: &Run, outcome: &Outcome, onlooker: &mut dyn RunObserver) -> Errors {
    let Second { run: second, factor } = second(run, outcome);
    let other = run_from(&second, None, onlooker).unwrap_or_else(|broken| *broken.outcome);
    let difference = |numbers: &[f64], others: &[f64]| factor * difference(numbers, others);
    let gathered = gathered(run, outcome);
    let ends_alike = outcome.stop().map(|stop| stop.kind) == other.stop().map(|stop| stop.kind);
    let times = [outcome, &other].map(|outcome| outcome.statistics.time);
    let is_same_time = (times[0] - times[1]).abs() <= SAME_TIME * times[0];
    // a stop may lie on either side of a sample
    let has_samples = other.samples.len() + usize::from(outcome.stop().is_some()) >= outcome.samples.len();
    let std_error = |numbers: &[f64], others: &[f64]| difference(numbers, others) + gathered * largest(numbers);
    let state = |numbers: fn(&Outcome) -> &[f64]| {
        (ends_alike && is_same_time)
            .then(|| difference(numbers(outcome), numbers(&other)) + gathered * largest(numbers(outcome)))
    };
    // the drive and the force may cancel
    let desired = ROUNDINGS * run.model.desired_speed().abs();
    Errors {
        cost: other.statistics.evaluations as f64 / outcome.statistics.evaluations as f64,
        std: (ends_alike && has_samples).then(|| {
            std_error(&outcome.samples.std, &other.samples.std) + rounding(run, outcome, &second) + f64::MIN_POSITIVE
        }),
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
    run: Run,
    factor: f64,
}

fn second(run: &Run, outcome: &Outcome) -> Second {
    // a run ends with the step in which it finds its last event; a blow-up is no time to end at
    let is_blow_up = outcome.events.iter().any(|happening| happening.kind == EventKind::BlowUp);
    let t_end = if is_blow_up { run.t_end } else { outcome.statistics.time };
    let is_fixed_series = run.method.needs_series() && matches!(run.control, Control::Fixed { .. });
    let can_deviate = has_deviations(&run.model, run.ring, run.steady_speed) && !is_fixed_series;
    // the same form would not show what becomes of the rounding of the start
    let form = if can_deviate { StateVariables::Deviations } else { run.form };
    match run.control {
        Control::Adaptive { tolerance } => {
            let method = if run.method == Method::Dop853 { Method::Verner87 } else { Method::Dop853 };
            let tighter = tolerance * if run.method.order() < HIGH { TIGHTER } else { TIGHTER_IF_HIGH };
            let control = Control::Adaptive { tolerance: if tighter > TIGHTEST { tighter } else { TIGHTEST } };
            Second {
                run: Run { method, control, t_end, form, most_steps: most_steps(outcome), ..run.clone() },
                factor: AGREEMENT,
            }
        }
        Control::Fixed { step } => {
            let made = if step < run.t_end { step } else { run.t_end };
            let seen = if has_kinks(&run.model) { ACROSS_KINKS } else { HIGHEST_SEEN };
            let order = run.method.order().min(seen) as i32;
            let ratio = match order {
                // a longer step would be cut to the same one
                _ if made > 0.5 * t_end => 0.5,
                1 | 2 => 2.0,
                _ => 1.25,
            };
            let growth = (0..order).fold(1.0, |power: f64, _| power * ratio);
            let control = Control::Fixed { step: ratio * made };
            Second { run: Run { control, t_end, form, ..run.clone() }, factor: CAUTION / (growth - 1.0).abs() }
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
    model.may_have_kinks()
}

/// Fixed steps may be too long for their error to be that of their order.
const CAUTION: f64 = 2.0;

/// The rounding of the standard deviation: that of speeds where they are not kept as deviations; none where all motion is one
/// to the last bit, and the second run is not.
fn rounding(run: &Run, outcome: &Outcome, second: &Run) -> f64 {
    let shows_all = second.form == StateVariables::Deviations;
    match run.form {
        StateVariables::Deviations => of_headway(run) * largest_std(outcome),
        _ if shows_all && largest_std(outcome) == 0.0 => 0.0,
        _ => ROUNDINGS * largest(&outcome.speeds),
    }
}

/// How much the headway, `L/N` to the nearest double, changes deviations that grow or fade by how the force answers to a
/// spacing: much where that falls by a factor of `e` over a small part of the headway.
pub(crate) fn of_headway(run: &Run) -> f64 {
    const PART: f64 = 1e-9;
    let Some(speed) = run.steady_speed else { return 0.0 };
    let headway = run.ring.headway();
    let [here, there] = [headway, headway * (1.0 + PART)].map(|headway| run.model.linearise(headway, speed).phi);
    let condition = ((there - here) / (PART * here)).abs();
    if condition.is_finite() { 0.5 * f64::EPSILON * condition } else { 0.0 }
}

/// The standard deviation of speeds where all of them are equal to the last bit, since what the force makes of the
/// shift is lost beside the drive: the error of a speed is at most the response of the force at the least spacing to
/// the shift, over a relaxation time. `None` where speeds differ, or the law gives no bound.
pub(crate) fn unseen(run: &Run, outcome: &Outcome) -> Option<f64> {
    let (headway, shift) = (run.ring.headway(), run.start.shift.abs());
    let is_told = largest_std(outcome) == 0.0 && !matches!(run.model, Model::Formula(_));
    // from rest speeds only grow until the drive is balanced, and the force with them
    let speed = largest(&outcome.speeds);
    let phi = is_told.then(|| run.model.linearise(headway - shift, speed).phi).filter(|phi| phi.is_finite())?;
    // what the rounding of spacings leaves of the shift may be half as much again
    Some(CAUTION * phi.abs() * shift * math::smaller(outcome.statistics.time, 1.0))
}

/// Whether spacings lose the shift of the start to the last digit.
pub(crate) fn loses_shift(run: &Run) -> bool {
    let (clearance, shift) = (run.ring.headway() - run.model.contact(), run.start.shift);
    run.form == StateVariables::Spacings
        && shift != 0.0
        && clearance - shift == clearance
        && clearance + shift == clearance
}

/// The largest standard deviation in the table.
pub(crate) fn largest_std(outcome: &Outcome) -> f64 {
    outcome.samples.std.iter().copied().fold(0.0, math::larger)
}

/// What fixed steps, whose sums are not compensated, may gather of roundings: once motion is steady all have one sign.
fn gathered(run: &Run, outcome: &Outcome) -> f64 {
    match run.control {
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
