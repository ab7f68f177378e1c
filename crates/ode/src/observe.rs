//! Looking at a solution while it is made: samples at regular times, the first crossing of zero.

use crate::dense::{SAME, Step};
use std::ops::ControlFlow;

/// Sees every accepted step.
pub trait Observer {
    /// Looks at a step; `Break` ends the integration after it.
    fn after(&mut self, step: &mut Step<'_>) -> ControlFlow<()>;

    /// The time of the next sample: steps that end before it need not be shown unless something happens in them. By
    /// default every step is shown.
    fn next_sample(&self) -> f64 {
        0.0
    }
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
    state: Vec<f64>,
}

impl Sampler {
    /// Samples every `interval` (> 0), the first after time 0, of a system of `dimension` components.
    pub fn new(interval: f64, dimension: usize) -> Sampler {
        Sampler { interval, next: 1, state: vec![0.0; dimension] }
    }

    /// Goes on with a system of another number of components.
    pub fn change_dimension(&mut self, dimension: usize) {
        self.state.resize(dimension, 0.0);
    }

    /// The time of the next sample.
    pub fn next(&self) -> f64 {
        self.next as f64 * self.interval
    }

    /// Calls `take(t, state)` for every sample time within the step that is not after `until`.
    pub fn within(&mut self, step: &mut Step<'_>, until: f64, take: &mut dyn FnMut(f64, &[f64])) {
        let end = if until < step.end { until } else { step.end + SAME * step.length() };
        loop {
            let t = self.next();
            if t > end {
                return;
            }
            step.at(t, &mut self.state);
            take(t, &self.state);
            self.next += 1;
        }
    }
}

/// The fraction of the step at which `value` first is negative, to the last bit of the fraction; looked for in `parts` parts of the
/// step, so that two crossings within one part may go unseen. `None` when it does not get there.
pub fn first_crossing(step: &mut Step<'_>, parts: u32, value: &mut dyn FnMut(&[f64]) -> f64) -> Option<f64> {
    let mut state = vec![0.0; step.before().len()];
    let mut is_past = |theta: f64| {
        step.at_fraction(theta, &mut state);
        value(&state) < 0.0
    };
    let part = (1..=parts).find(|&part| is_past(f64::from(part) / f64::from(parts)))?;
    let (mut before, mut past) = (f64::from(part - 1) / f64::from(parts), f64::from(part) / f64::from(parts));
    loop {
        let middle = 0.5 * (before + past);
        if middle <= before || middle >= past {
            return Some(past);
        }
        if is_past(middle) { past = middle } else { before = middle }
    }
}
