//! Observers: samples at regular times, and the first zero crossing of a quantity.

use crate::dense::{Step, nearby};
use crate::integrate::Statistics;
use std::ops::{ControlFlow, Range};

/// Sees every accepted step.
pub trait Observer {
    /// Looks at a step; `Break` ends the integration after it.
    fn after(&mut self, step: &mut Step<'_>) -> ControlFlow<()>;

    /// The time of the next sample, in the unit of time: steps that end before it need not be shown unless something
    /// happens in them. By default every step is shown.
    fn next_sample(&self) -> f64 {
        f64::NEG_INFINITY
    }

    /// As many adaptive steps as may be tried, rejected ones included; one more is
    /// [`Failure::TooManySteps`](crate::Failure::TooManySteps). By default [`MOST_STEPS`].
    fn most_steps(&self) -> u64 {
        MOST_STEPS
    }

    /// Sees how far it came when no step leads on from there, before the failure is returned.
    fn stuck(&mut self, _reached: &Statistics) {}

    /// Looks at a place between two steps, every few thousand of them, from which the run can be resumed.
    fn between(&mut self, _mark: &ResumePoint<'_>) {}
}

/// Default limit on steps: 1000 times the longest adaptive run of this repository. More steps mean that the equations
/// are too stiff for the method, and would look like a hang.
pub const MOST_STEPS: u64 = 1_000_000_000;

/// Where an integration by steps of fixed length is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct StepPosition {
    /// The number of the next step, from 0.
    pub step: u64,
    /// The step up to which steps are made one by one, because something happened in a batch of them.
    pub slow_until: u64,
}

/// The state from which an integration can continue.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ResumePoint<'a> {
    /// Between which steps.
    pub position: StepPosition,
    /// The counts so far, and the end of the last step that was shown. Its own state is of no meaning.
    pub statistics: &'a Statistics,
    /// The state there, one number for each component.
    pub state: &'a [f64],
    /// What steps of adaptive length remember; `None` for those of fixed length, whose rates are those of the state.
    pub pace: Option<Pace<'a>>,
}

/// What steps of adaptive length remember from one to the next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pace<'a> {
    /// The rates at the state, one for each component, to the last bit: some methods know them from a state that lacks
    /// its compensation.
    pub rates: &'a [f64],
    /// What rounding has dropped of the state, one number for each component.
    pub compensation: &'a [f64],
    /// The time, and what rounding has dropped of it.
    pub time: [f64; 2],
    /// The length of the next step.
    pub step: f64,
    /// The error of the last step that was accepted, in units of the tolerance: 0 to 1.
    pub error: f64,
    /// The unit of time of the series at the state, for a method that has one.
    pub unit: f64,
}

impl<F: FnMut(&mut Step<'_>) -> ControlFlow<()>> Observer for F {
    fn after(&mut self, step: &mut Step<'_>) -> ControlFlow<()> {
        self(step)
    }
}

/// Times 0, d, 2d, ... and the state at each, taken from inside the steps.
#[derive(Clone, Debug)]
pub struct Sampler {
    interval: f64,
    next: u64,
    /// Room for two samples.
    states: [Vec<f64>; 2],
}

impl Sampler {
    /// Samples every `interval` (above 0, in the unit of time), the first after time 0, of a system of `dimension`
    /// components.
    pub fn new(interval: f64, dimension: usize) -> Sampler {
        Sampler { interval, next: 1, states: [(); 2].map(|()| vec![0.0; dimension]) }
    }

    /// Goes on where a sampler stood whose next sample is at `next` intervals.
    pub fn resume(&mut self, next: u64) {
        self.next = next;
    }

    /// Goes on with a system of another number of components.
    pub fn change_dimension(&mut self, dimension: usize) {
        self.states.iter_mut().for_each(|state| state.resize(dimension, 0.0));
    }

    /// The time of the next sample.
    pub fn next(&self) -> f64 {
        self.time(self.next)
    }

    fn time(&self, index: u64) -> f64 {
        index as f64 * self.interval
    }

    /// The times of the first and of the last sample that [`Sampler::within`] would take; `None` if there is none.
    pub fn span(&self, step: &Step<'_>, until: f64) -> Option<[f64; 2]> {
        let (first, end) = (self.next(), last_moment(step, until));
        if first > end {
            return None;
        }
        let mut last = (end / self.interval) as u64;
        // the quotient is rounded
        last -= u64::from(last as f64 * self.interval > end);
        last += u64::from((last + 1) as f64 * self.interval <= end);
        Some([first, last as f64 * self.interval])
    }

    /// Calls `take(t, state)` for every sample time within the step that is not after `until`.
    pub fn within(&mut self, step: &mut Step<'_>, until: f64, take: &mut dyn FnMut(f64, &[f64])) {
        let all = 0..self.states[0].len();
        self.components_within(step, until, all, take);
    }

    /// The same where `take` looks at these components alone: the others of the state that it gets have no meaning.
    pub fn components_within(
        &mut self,
        step: &mut Step<'_>,
        until: f64,
        range: Range<usize>,
        take: &mut dyn FnMut(f64, &[f64]),
    ) {
        let end = last_moment(step, until);
        loop {
            let times = [self.next(), self.time(self.next + 1)];
            if times[0] > end {
                return;
            }
            if times[1] > end {
                step.components_at(times[0], range.clone(), &mut self.states[0]);
                take(times[0], &self.states[0]);
                self.next += 1;
                return;
            }
            let [one, other] = &mut self.states;
            step.components_at_both(times, range.clone(), [one, other]);
            for (t, state) in times.into_iter().zip(&self.states) {
                take(t, state);
            }
            self.next += 2;
        }
    }
}

/// Up to when samples belong to a step.
fn last_moment(step: &Step<'_>, until: f64) -> f64 {
    if until < step.end { until } else { step.end + nearby(step.end, step.length()) }
}

/// The fraction of the step, 0 to 1, at which `value` of the state, in any unit, first is negative, to the last bit of
/// the fraction. Looked for in `parts` parts of the step and about every minimum that they show; of two crossings
/// within one part the first may go unseen only where `value` has several minima there. `None` when it does not get
/// there; NaN is not negative.
pub fn first_crossing(step: &mut Step<'_>, parts: u32, value: &mut dyn FnMut(&[f64]) -> f64) -> Option<f64> {
    let mut state = vec![0.0; step.before().len()];
    let mut at = |theta: f64| {
        step.at_fraction(theta, &mut state);
        value(&state)
    };
    let place = |part: u32| f64::from(part) / f64::from(parts);
    let close = 0.0625 / f64::from(parts);
    let (mut earlier, mut last) = (f64::INFINITY, at(0.0));
    for part in 1..=parts {
        let next = at(place(part));
        // at the start where it falls at first; else where a neighbour is more than twice as high, since a parabola's
        // minimum lies below the lowest of three samples by at most an eighth of what a neighbour is above it
        let is_minimum = last <= earlier && last <= next;
        let may_dip = if part == 1 { at(close) < last } else { 2.0 * last < earlier || 2.0 * last < next };
        if is_minimum && may_dip {
            let from = place(part.saturating_sub(2));
            if let Some(past) = negative_about_minimum(from, place(part), &mut at) {
                return Some(bisect(from, past, &mut at));
            }
        }
        if next < 0.0 {
            return Some(bisect(place(part - 1), place(part), &mut at));
        }
        (earlier, last) = (last, next);
    }
    if last > earlier || at(1.0 - close) > last {
        return None;
    }
    let from = place(parts - 1);
    negative_about_minimum(from, 1.0, &mut at).map(|past| bisect(from, past, &mut at))
}

/// The first fraction of the step, between `before`, where `value` is not negative, and `past`, where it is, at which
/// it is negative; one of them if there are several.
pub fn crossing_between(step: &mut Step<'_>, before: f64, past: f64, value: &mut dyn FnMut(&[f64]) -> f64) -> f64 {
    let mut state = vec![0.0; step.before().len()];
    bisect(before, past, &mut |theta| {
        step.at_fraction(theta, &mut state);
        value(&state)
    })
}

/// A fraction between the two at which the value is negative, from a golden-section search for its minimum.
fn negative_about_minimum(from: f64, to: f64, at: &mut dyn FnMut(f64) -> f64) -> Option<f64> {
    /// `(sqrt(5) - 1) / 2`
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    /// Narrows the interval to 1e-5 of itself, a parabola's value to 1e-10 of its change.
    const ROUNDS: u32 = 24;
    let (mut low, mut high) = (from, to);
    for _ in 0..ROUNDS {
        let (left, right) = (high - GOLDEN * (high - low), low + GOLDEN * (high - low));
        let (at_left, at_right) = (at(left), at(right));
        if at_left < 0.0 || at_right < 0.0 {
            return Some(if at_left < 0.0 { left } else { right });
        }
        if at_left < at_right { high = right } else { low = left }
    }
    None
}

/// The first number at which the value is negative, between one before the crossing and one past it.
fn bisect(mut before: f64, mut past: f64, at: &mut dyn FnMut(f64) -> f64) -> f64 {
    loop {
        let middle = 0.5 * (before + past);
        if middle <= before || middle >= past {
            return past;
        }
        if at(middle) < 0.0 { past = middle } else { before = middle }
    }
}
