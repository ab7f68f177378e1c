//! The ballistic scheme: speeds as Euler, positions with the mean of the old and the new speeds.
//!
//! M. Treiber, V. Kanagaraj, *Comparing numerical integration schemes for time-continuous car-following models*,
//! Physica A 419 (2015) 183.

use crate::control::Norm;
use crate::dense::{Ends, Part, Stepper, Trial, cubic};
use crate::system::System;
use crate::vector::add;
use std::ops::Range;

pub(crate) struct Ballistic {
    positions: Vec<Range<usize>>,
    state: Vec<f64>,
    rates: Vec<f64>,
}

impl Ballistic {
    pub(crate) fn new(system: &dyn System) -> Ballistic {
        let n = system.dimension();
        Ballistic { positions: system.positions(), state: vec![0.0; n], rates: vec![0.0; n] }
    }
}

impl Stepper for Ballistic {
    fn try_step(&mut self, system: &dyn System, from: Trial<'_>, change: &mut [f64], _norm: Option<&Norm>) -> f64 {
        for (change, rate) in change.iter_mut().zip(from.rates) {
            *change = from.h * rate;
        }
        add(from.state, change, &mut self.state);
        system.kinematics(&self.state, &mut self.rates);
        for i in self.positions.iter().cloned().flatten() {
            change[i] = from.h * (0.5 * (from.rates[i] + self.rates[i]));
        }
        0.0
    }

    /// The new speeds' share in the positions needs no force: the only evaluation is the one at the start.
    fn evaluations(&self) -> u64 {
        0
    }

    fn error_power(&self) -> usize {
        1
    }

    fn interpolate(&mut self, _system: &dyn System, ends: &Ends<'_>, theta: f64, part: Part<'_>) -> u64 {
        cubic(ends, theta, part);
        0
    }
}
