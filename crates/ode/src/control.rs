//! Step size control.

use crate::system::{Group, Measure, System};
use crate::vector::{largest, smallest};
use math::lane;

/// The rule for the length of the steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Control {
    /// Every step has this length, except a shorter last one where the end is no multiple of it. The error is not
    /// looked at.
    Fixed {
        /// Length of a step, above 0 and finite, in the unit of time.
        step: f64,
    },
    /// Steps as long as the estimated local error allows.
    Adaptive {
        /// Largest error of one step, relative to the size of a group of components (see [`Group`]): above 0,
        /// dimensionless. Below about 1e-15 it asks for more than doubles have, and steps become ever shorter.
        tolerance: f64,
    },
}

/// Error vectors in units of the tolerance.
pub(crate) struct Norm {
    groups: Vec<Group>,
    scales: Vec<f64>,
    tolerance: f64,
}

impl Norm {
    pub(crate) fn new(system: &dyn System, tolerance: f64) -> Norm {
        let groups = system.groups();
        Norm { scales: vec![0.0; groups.len()], groups, tolerance }
    }

    /// Fixes the scales for a step that starts at `state`.
    pub(crate) fn start(&mut self, state: &[f64]) {
        for (scale, group) in self.scales.iter_mut().zip(&self.groups) {
            let components = &state[group.range.clone()];
            let size = match group.measure {
                Measure::Largest => largest(components),
                Measure::Smallest => smallest(components),
            };
            *scale = self.tolerance * if size > group.floor { size } else { group.floor };
        }
    }

    /// This part of the error that a component is allowed, but no less than so many roundings of its group.
    pub(crate) fn scale(&self, component: usize, part: f64, roundings: f64) -> f64 {
        let group = self.groups.iter().position(|group| group.range.contains(&component)).unwrap_or(0);
        self.scales[group] * (part + roundings * f64::EPSILON / self.tolerance)
    }

    /// The largest error over the groups; 1 is just allowed. NaN when an error is.
    pub(crate) fn of(&self, errors: &[f64]) -> f64 {
        let mut worst = 0.0;
        for (scale, group) in self.scales.iter().zip(&self.groups) {
            let size = largest(&errors[group.range.clone()]);
            let ratio = if size > 0.0 { size / scale } else { size };
            worst = if ratio > worst || ratio.is_nan() { ratio } else { worst };
        }
        worst
    }
}

/// Proportional-integral control of the step (K. Gustafsson 1991; Hairer & Wanner, *Solving ODEs II*, section IV.2).
pub(crate) struct Controller {
    exponent: f64,
    /// The error of the last step that was accepted.
    pub(crate) previous: f64,
}

/// The step shrinks or grows at most by these factors.
const SMALLEST: f64 = 0.2;
const LARGEST: f64 = 6.0;
const SAFETY: f64 = 0.9;
/// An error of this size leads to the smallest factor for every method.
const HUGE: f64 = 1e300;
/// Share of the proportional part, which answers to the change of the error; the rest is integral.
const PROPORTIONAL: f64 = 0.2;

impl Controller {
    /// For a method whose local error falls as step^`power`.
    pub(crate) fn new(power: usize) -> Controller {
        Controller { exponent: 1.0 / power as f64, previous: 1.0 }
    }

    /// The factor for the next step after an accepted one with this error.
    pub(crate) fn accept(&mut self, error: f64) -> f64 {
        // a vanishing error would ask for an infinite step
        let error = if error > 1e-10 { error } else { 1e-10 };
        // error^-(1 - P) (previous / error)^P
        let logarithm = PROPORTIONAL * lane::ln(self.previous) - lane::ln(error);
        self.previous = error;
        (SAFETY * lane::exp(self.exponent * logarithm)).clamp(SMALLEST, LARGEST)
    }

    /// The factor for another try after a rejected step; NaN asks for the smallest.
    pub(crate) fn reject(&self, error: f64) -> f64 {
        let is_huge = error.is_nan() || error > HUGE;
        if is_huge { SMALLEST } else { (SAFETY * lane::exp(-self.exponent * lane::ln(error))).clamp(SMALLEST, 0.9) }
    }
}
