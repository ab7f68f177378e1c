//! Samples that a second run does not confirm, because it ends before them or, with fixed steps of another length,
//! differs from them by as much as their size. They are removed, and the run ends with a named reason after the last
//! confirmed sample.

use super::second::{LARGE, SAME_TIME, Second};
use super::{Errors, ROUNDINGS, errors_of, largest, run_propagated};
use crate::run::{Broken, Outcome, Run, RunObserver, advice, untried};
use math::larger;
use ode::{Control, Failure};

/// The run up to the last sample that the second run confirms, with its errors; `None` if all samples are confirmed.
/// Observers see the run again, up to that sample.
pub(super) fn refused(
    run: &Run,
    outcome: &Outcome,
    errors: &Errors,
    observer: &mut dyn RunObserver,
) -> Option<(Broken, Errors)> {
    let time = errors.confirmed_until?;
    let (made, errors) = if time > 0.0 {
        shorter(run, outcome, time, errors.cost, observer)
    } else {
        let made = untried(run, observer);
        let errors = of_start(&made, errors.cost);
        (made, errors)
    };
    let failure = Failure::NotConfirmed { time };
    let outcome = Box::new(made);
    Some((Broken { advice: advice(&failure, run), failure, narrowest: None, outcome }, errors))
}

/// The run made again up to this time, with its errors, which are those of its rows alone: in the last step, which is
/// another one, the rows of the run differ.
fn shorter(run: &Run, outcome: &Outcome, time: f64, spent: f64, observer: &mut dyn RunObserver) -> (Outcome, Errors) {
    let shorter = Run { t_end: time, ..run.clone() };
    let (made, propagated) = run_propagated(&shorter, observer);
    let made = made.unwrap_or_else(|broken| *broken.outcome);
    let errors = errors_of(&shorter, &made, Some(&propagated), &mut ());
    let again = made.statistics.evaluations as f64 / outcome.statistics.evaluations as f64;
    let cost = spent + again * (1.0 + errors.cost);
    (made, Errors { confirmed_until: None, cost, ..errors })
}

/// The start is exact up to rounding.
fn of_start(outcome: &Outcome, cost: f64) -> Errors {
    Errors {
        std: Some(f64::MIN_POSITIVE),
        positions: Some(ROUNDINGS * largest(&outcome.positions)),
        speeds: Some(f64::MIN_POSITIVE),
        events: vec![Some(0.0); outcome.events.len()],
        cost,
        confirmed_until: None,
    }
}

/// Whether the other run has all the samples. The stop of either run may lie on either side of a sample.
pub(super) fn reaches(outcome: &Outcome, other: &Outcome) -> bool {
    let missing = outcome.samples.len().saturating_sub(other.samples.len());
    let is_by_chance = outcome.stop().zip(other.stop()).is_some_and(|(stop, other)| {
        let late = (stop.time - other.time).abs();
        stop.kind == other.kind && late <= NEAR * stop.time
    });
    missing == 0 || missing == 1 && is_by_chance
}

/// Stops of both runs closer than this, relative to their time, count as the same.
const NEAR: f64 = 1e-6;

/// The time of the last sample that the second run confirms; `None` if it confirms all.
pub(super) fn until(run: &Run, outcome: &Outcome, second: &Second) -> Option<f64> {
    let other = &second.outcome;
    let other_end = other.stop().map_or(other.statistics.time, |stop| stop.time);
    let is_before_end = other_end < (1.0 - SAME_TIME) * outcome.statistics.time;
    let refuted = refuted_at(run, outcome, other);
    let end = match (refuted, outcome.stop()) {
        (Some(time), _) => Some(time),
        // another event may be the same one, all but for its time
        (_, Some(_)) if reaches(outcome, other) => None,
        _ => is_before_end.then_some(other_end),
    };
    let difference = match run.control {
        Control::Adaptive { .. } if refuted.is_none() => None,
        _ => first_unlike(outcome, second),
    };
    let first = [end, difference].into_iter().flatten().reduce(math::smaller)?;
    Some(last_before(outcome, first))
}

/// The time of the stop of a run that its own error alone led to: the other run, more exact, goes on well past that
/// time, or to the end, and has no stop. One that breaks off soon behind it may have been about to stop.
pub(super) fn refuted_at(run: &Run, outcome: &Outcome, other: &Outcome) -> Option<f64> {
    let stop = outcome.stop()?;
    let well_past = math::smaller(run.t_end, (1.0 + LARGE) * stop.time);
    let time = other.statistics.time;
    let goes_on = other.stop().is_none() && time > (1.0 + NEAR) * stop.time && time >= well_past;
    goes_on.then_some(stop.time)
}

/// The time of the last sample before this one.
pub(super) fn last_before(outcome: &Outcome, time: f64) -> f64 {
    outcome.samples.times.iter().copied().take_while(|&t| t < time).last().unwrap_or(0.0)
}

/// The time of the first sample whose error exceeds all earlier values and a visible part of the speeds, or which the
/// other run does not reach because it failed.
fn first_unlike(outcome: &Outcome, Second { outcome: other, factor, .. }: &Second) -> Option<f64> {
    let (samples, others) = (&outcome.samples, &other.samples);
    let visible = VISIBLE * largest(&outcome.speeds);
    let mut most = visible;
    for (index, &std) in samples.std.iter().enumerate() {
        let Some(&right) = others.std.get(index) else {
            let is_broken = outcome.stop().is_none();
            return is_broken.then(|| samples.times[index]);
        };
        most = larger(most, larger(std, right));
        if factor * (std - right).abs() > most {
            return Some(samples.times[index]);
        }
    }
    None
}

/// With a standard deviation below this part of the speeds, a flow counts as uniform, whatever the error.
const VISIBLE: f64 = 1e-3;
