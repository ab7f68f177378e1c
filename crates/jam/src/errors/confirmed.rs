//! Samples that a second run does not confirm: it ends before them, or, by steps of another fixed length, differs from them by
//! as much as they are large. They are left out, and the run ends by name where the others end.

use super::second::{SAME_TIME, Second};
use super::{Errors, ROUNDINGS, errors_of, largest, loses_shift, run_propagated};
use crate::run::{Broken, Outcome, Run, RunObserver, advice, untried};
use math::larger;
use ode::{Control, Failure};

/// The run up to the last sample that its check confirms, with the errors of that; `None` if all are confirmed. What was seen
/// of the run is seen once more, up to there.
pub fn refused(
    run: &Run,
    outcome: &Outcome,
    errors: &Errors,
    observer: &mut dyn RunObserver,
) -> Option<(Broken, Errors)> {
    let time = errors.confirmed_until?;
    let (made, errors) = if time > 0.0 {
        let shorter = Run { t_end: time, ..run.clone() };
        let (made, propagated) = run_propagated(&shorter, observer);
        let made = made.unwrap_or_else(|broken| *broken.outcome);
        let errors = errors_of(&shorter, &made, Some(&propagated), &mut ());
        (made, Errors { confirmed_until: None, ..errors })
    } else {
        let made = untried(run, observer);
        let errors = of_start(&made);
        (made, errors)
    };
    // the last sample is not the end of a step in the run itself
    let outcome = Box::new(Outcome { samples: outcome.samples.clone().until(time), ..made });
    let failure = Failure::NotConfirmed { time };
    Some((Broken { advice: advice(&failure, run), failure, narrowest: None, outcome }, errors))
}

/// The start is exact but for its rounding.
fn of_start(outcome: &Outcome) -> Errors {
    Errors {
        std: Some(f64::MIN_POSITIVE),
        positions: Some(ROUNDINGS * largest(&outcome.positions)),
        speeds: Some(f64::MIN_POSITIVE),
        events: vec![Some(0.0); outcome.events.len()],
        cost: 0.0,
        confirmed_until: None,
    }
}

/// Whether the other run has all the samples. A stop of both may lie on either side of one.
pub(super) fn reaches(outcome: &Outcome, other: &Outcome) -> bool {
    let missing = outcome.samples.len().saturating_sub(other.samples.len());
    let is_by_chance = outcome.stop().zip(other.stop()).is_some_and(|(stop, other)| {
        let late = (stop.time - other.time).abs();
        stop.kind == other.kind && late <= NEAR * stop.time
    });
    missing == 0 || missing == 1 && is_by_chance
}

/// Stops of both runs that are this near, relative to their time, are one.
const NEAR: f64 = 1e-6;

/// The time of the last sample that the second run confirms; `None`: that of all.
pub(super) fn until(run: &Run, outcome: &Outcome, second: &Second) -> Option<f64> {
    let other = &second.outcome;
    let is_before_end = |time: &f64| *time < (1.0 - SAME_TIME) * outcome.statistics.time;
    let end = match (outcome.stop(), other.stop()) {
        (None, Some(stop)) => Some(stop.time),
        // of a shift that the run has lost the other one alone tells anything
        (None, None) if loses_shift(run) => Some(other.statistics.time),
        _ => None,
    };
    let end = end.filter(is_before_end);
    let difference = match run.control {
        Control::Fixed { .. } => first_unlike(outcome, second),
        Control::Adaptive { .. } => None,
    };
    let first = [end, difference].into_iter().flatten().reduce(math::smaller)?;
    Some(last_before(outcome, first))
}

/// The time of the last sample before this one.
pub(super) fn last_before(outcome: &Outcome, time: f64) -> f64 {
    outcome.samples.times.iter().copied().take_while(|&t| t < time).last().unwrap_or(0.0)
}

/// The time of the first sample that is off by as much as all before it are large, and by a visible part of the speeds; or that
/// the other run does not reach, having broken down.
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

/// Smaller standard deviations than this part of the speeds are a flow all but uniform, whatever their error.
const VISIBLE: f64 = 1e-3;
