//! Error estimates for a run, from a second run with another method or other steps.
//!
//! The same method at another tolerance would often take the same steps, above all in a short run, and identical runs
//! show no difference. Another method shares neither steps nor coefficients; it is of order 8 and at a smaller
//! tolerance, so that its own error is the smaller one. A run of a few steps is compared with one by Taylor's method,
//! since other methods take all but the same ones. Fixed steps are compared with such a run, too, which tells their
//! error whatever their order; only where it costs more than they do, with steps of half the length. Where it can be,
//! the second run is one in deviations from the uniform flow, in which the start has no rounding.

mod confirmed;
mod of_std;
mod propagated;
mod recent;
mod second;

pub use propagated::Propagated;

use crate::events::{Event, EventKind};
use crate::laws::Model;
use crate::run::{Broken, Outcome, Run, RunObserver, run_from};
use crate::states::StateVariables;
use ode::Control;
use second::Second;

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
    /// The time of the last sample that the check confirms, if it does not confirm all of them; see [`checked`].
    pub confirmed_until: Option<f64>,
}

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
/// As [`run`](crate::run::run); or the second run does not confirm all samples.
pub fn stated(run: &Run) -> Result<(Outcome, Errors), Broken> {
    let (made, propagated) = run_propagated(run, &mut ());
    let outcome = made?;
    match checked(run, &outcome, Some(&propagated), &mut (), &mut ()) {
        (_, Some(broken)) => Err(broken),
        (errors, None) => Ok((outcome, errors)),
    }
}

/// The errors of a run; or, if the check does not confirm all of its samples, the run up to the last one that it
/// confirms, with the errors of that. `onlooker` sees a second run, if one is made, and `again` the run up to that
/// sample.
pub fn checked(
    run: &Run,
    outcome: &Outcome,
    propagated: Option<&Propagated>,
    onlooker: &mut dyn RunObserver,
    again: &mut dyn RunObserver,
) -> (Errors, Option<Broken>) {
    let errors = errors_of(run, outcome, propagated, onlooker);
    match confirmed::refused(run, outcome, &errors, again) {
        Some((broken, errors)) => (errors, Some(broken)),
        None => (errors, None),
    }
}

/// Makes a run and collects from its steps the data for its error estimates.
pub fn run_propagated(run: &Run, observer: &mut dyn RunObserver) -> (Result<Outcome, Broken>, Propagated) {
    let mut propagated = Propagated::new(run);
    let made = run_from(run, None, &mut (observer, &mut propagated));
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
    let told = told.filter(|_| !second::is_underflown(run, outcome));
    let errors = told.unwrap_or_else(|| {
        let seen = propagated.map(Propagated::recent);
        Second::new(run, outcome, seen, onlooker).errors(run, outcome)
    });
    known(run, outcome, errors)
}

/// Runs the scene once more and compares.
pub fn errors(run: &Run, outcome: &Outcome) -> Errors {
    known(run, outcome, Second::new(run, outcome, None, &mut ()).errors(run, outcome))
}

/// The errors with what the steps do not show: fixed ones tell where a formula loses its value to a step. Without those
/// that nobody knows: that of a state without a value; and at a wall, where a pedestrian is thrown back at a gap below
/// every double, those of the speeds, which turn within a rounding of the time, and of the time of the singularity, but
/// for what [remains](left_at_wall).
fn known(run: &Run, outcome: &Outcome, errors: Errors) -> Errors {
    let number = |error: Option<f64>| error.filter(|error| !error.is_nan());
    let is_at_wall = outcome.events.iter().any(Event::is_at_wall);
    let step = match run.control {
        Control::Fixed { step } => step,
        Control::Adaptive { .. } => 0.0,
    };
    let of_event = |(event, error): (&Event, Option<f64>)| match number(error) {
        Some(error) if event.kind == EventKind::Undefined => Some(error + step),
        Some(error) if event.is_at_wall() => left_at_wall(run, outcome).map(|left| error + left),
        error => error,
    };
    Errors {
        std: number(errors.std),
        positions: number(errors.positions),
        speeds: number(errors.speeds).filter(|_| !is_at_wall),
        events: outcome.events.iter().zip(errors.events).map(of_event).collect(),
        ..errors
    }
}

/// The time that remains from a wall to the singularity: speeds double at every throw, the next of which is at most a
/// headway away, so that all of them together take less than a headway at the speed of the last. `None` before the
/// first throw, since nothing is known yet of what follows.
fn left_at_wall(run: &Run, outcome: &Outcome) -> Option<f64> {
    let fastest = largest(&outcome.speeds);
    (fastest >= THROWN * run.model.desired_speed().abs()).then(|| run.ring.headway() / fastest)
}

/// Who is so much faster than pedestrians want to be has been thrown back.
pub(crate) const THROWN: f64 = 4.0;

/// By how much the spacings at the start differ from those of the uniform flow.
pub(crate) fn of_spacings(run: &Run) -> Vec<f64> {
    let (n, shift, moved) = (run.ring.pedestrians, run.start.shift, &run.displacements);
    if !moved.is_empty() {
        return (0..n).map(|own| moved[(own + 1) % n] - moved[own]).collect();
    }
    let mut all = vec![0.0; n];
    all[0] -= shift;
    all[n - 1] += shift;
    all
}

/// Fixed steps may be too long for their error to be that of their order.
const CAUTION: f64 = 2.0;

/// How much the headway, `L/N` to the nearest double, changes deviations that grow or fade by how the force answers to
/// a spacing: much where that falls by a factor of `e` over a small part of the headway.
pub(crate) fn of_headway(run: &Run) -> f64 {
    const PART: f64 = 1e-9;
    let Some(speed) = run.steady_speed else { return 0.0 };
    let headway = run.ring.headway();
    let [here, there] = [headway, headway * (1.0 + PART)].map(|headway| run.model.linearise(headway, speed).phi);
    let condition = ((there - here) / (PART * here)).abs();
    if condition.is_finite() { 0.5 * f64::EPSILON * condition } else { 0.0 }
}

/// The part by which rounded constants change the force at all times: those a law is prepared with, as the square of a
/// parameter or the inverse of one, by a rounding or two; and the headway by what its rounding changes the response to
/// a spacing by. All methods have these errors in common.
pub(crate) fn of_constants(run: &Run) -> f64 {
    f64::EPSILON + of_headway(run)
}

/// The standard deviation of speeds where all of them are equal to the last bit, since what the force makes of the
/// shift is lost beside the drive: the error of a speed is at most the response of the force at the least spacing to
/// the shift, over a relaxation time. `None` where speeds differ, or the law gives no bound.
pub(crate) fn unseen(run: &Run, outcome: &Outcome) -> Option<f64> {
    let (headway, shift) = (run.ring.headway(), largest(&of_spacings(run)));
    let is_told = largest_std(outcome) == 0.0 && !matches!(run.model, Model::Formula(_));
    // from rest speeds only grow until the drive is balanced, and the force with them
    let speed = largest(&outcome.speeds);
    let phi = is_told.then(|| run.model.linearise(headway - shift, speed).phi).filter(|phi| phi.is_finite())?;
    // what the rounding of spacings leaves of the shift may be half as much again
    Some(CAUTION * phi.abs() * shift * math::smaller(outcome.statistics.time, 1.0))
}

/// Whether spacings lose the shift of the start, or all displacements, to the last digit.
pub fn loses_shift(run: &Run) -> bool {
    if run.form != StateVariables::Spacings {
        return false;
    }
    let (clearance, all) = (run.ring.headway() - run.model.contact(), of_spacings(run));
    all.iter().any(|by| *by != 0.0) && all.iter().all(|by| clearance + by == clearance && clearance - by == clearance)
}

/// The largest standard deviation in the table.
pub(crate) fn largest_std(outcome: &Outcome) -> f64 {
    let all = &outcome.samples.std;
    let largest = ode::largest(all);
    if largest.is_nan() { all.iter().copied().fold(0.0, math::larger) } else { largest }
}

/// The largest speed in the table, in size. Where a run goes on behind its stop, the speeds at its end may be far
/// larger; they stand for those in the table only where that keeps no speeds.
pub(crate) fn largest_speed(outcome: &Outcome) -> f64 {
    let speeds = &outcome.samples.speeds;
    largest(if outcome.stop().is_some() && !speeds.is_empty() { speeds } else { &outcome.speeds })
}

/// The largest in size.
pub(crate) fn largest(numbers: &[f64]) -> f64 {
    numbers.iter().fold(0.0, |size, number| if number.abs() <= size { size } else { number.abs() })
}

/// The longest way to the end from the places that would be those of the start without shifts.
pub(crate) fn walked(run: &Run, outcome: &Outcome) -> f64 {
    let places = outcome.positions.iter().enumerate();
    places.map(|(n, position)| (position - n as f64 * run.ring.headway()).abs()).fold(0.0, math::larger)
}
