//! Extrapolated midpoint rule (W. B. Gragg 1965; Hairer, Norsett & Wanner, *Solving ODEs I*, section II.9).
//!
//! The midpoint rule with 2, 4, 6, ... substeps has an error that is a series in the square of the substep; Aitken and
//! Neville's scheme removes its first terms. No coefficients are shared with the Runge-Kutta methods, so the two check
//! each other.

use crate::control::Norm;
use crate::dense::{Ends, Part, Stepper, Trial};
use crate::system::System;
use crate::vector::add;

/// Rows of the scheme: 2, 4, ..., 2 ROWS substeps.
const ROWS: usize = 8;

/// The order of the result.
pub(crate) const ORDER: usize = 2 * ROWS;

pub(crate) struct Extrapolation {
    /// `scheme[j]`: the change of the state over the step, extrapolated from rows `i - j ..= i` after row `i`.
    scheme: Vec<Vec<f64>>,
    earlier: Vec<f64>,
    change: Vec<f64>,
    state: Vec<f64>,
    rates: Vec<f64>,
}

impl Extrapolation {
    pub(crate) fn new(n: usize) -> Extrapolation {
        let zeros = || vec![0.0; n];
        Extrapolation { scheme: vec![zeros(); ROWS], earlier: zeros(), change: zeros(), state: zeros(), rates: zeros() }
    }

    /// The midpoint rule with `substeps`: leaves the change of the state in `self.change`; false if it leaves the
    /// domain, in which case it continues unless `guarded`.
    fn midpoint(&mut self, system: &dyn System, from: &Trial<'_>, substeps: usize, guarded: bool) -> bool {
        let h = from.h / substeps as f64;
        self.earlier.fill(0.0);
        for (change, rate) in self.change.iter_mut().zip(from.rates) {
            *change = h * rate;
        }
        let mut is_inside = true;
        for _ in 1..substeps {
            add(from.state, &self.change, &mut self.state);
            is_inside &= system.in_domain(&self.state);
            if guarded && !is_inside {
                return false;
            }
            system.rates(&self.state, &mut self.rates);
            for ((earlier, change), rate) in self.earlier.iter_mut().zip(&mut self.change).zip(&self.rates) {
                let next = *earlier + 2.0 * h * rate;
                *earlier = *change;
                *change = next;
            }
        }
        is_inside
    }

    /// Takes `self.change` as row `i` into the scheme; `scheme[i]` becomes the best value so far.
    fn extrapolate(&mut self, i: usize) {
        let substeps = |row: usize| (2 * (row + 1)) as f64;
        for component in 0..self.change.len() {
            let mut value = self.change[component];
            for j in 0..i {
                let ratio = substeps(i) / substeps(i - 1 - j);
                let above = self.scheme[j][component];
                self.scheme[j][component] = value;
                value += (value - above) / (ratio * ratio - 1.0);
            }
            self.scheme[i][component] = value;
        }
    }
}

impl Stepper for Extrapolation {
    fn try_step(&mut self, system: &dyn System, from: Trial<'_>, change: &mut [f64], norm: Option<&Norm>) -> f64 {
        let mut is_beyond = false;
        for i in 0..ROWS {
            is_beyond |= !self.midpoint(system, &from, 2 * (i + 1), norm.is_some());
            if is_beyond && norm.is_some() {
                return f64::INFINITY;
            }
            self.extrapolate(i);
        }
        change.copy_from_slice(&self.scheme[ROWS - 1]);
        for (difference, (best, next)) in
            self.change.iter_mut().zip(self.scheme[ROWS - 1].iter().zip(&self.scheme[ROWS - 2]))
        {
            *difference = best - next;
        }
        norm.map_or(if is_beyond { f64::INFINITY } else { 0.0 }, |norm| norm.of(&self.change))
    }

    fn evaluations(&self) -> u64 {
        (ROWS * ROWS) as u64
    }

    fn error_power(&self) -> usize {
        ORDER - 1
    }

    /// A shorter step from the same start: as accurate as the step itself.
    fn interpolate(&mut self, system: &dyn System, ends: &Ends<'_>, theta: f64, part: Part<'_>) -> u64 {
        let from = Trial { state: ends.before, rates: ends.rates_before, h: theta * ends.h };
        let mut change = vec![0.0; ends.before.len()];
        self.try_step(system, from, &mut change, None);
        add(&ends.before[part.range()], &change[part.range()], part.values);
        self.evaluations()
    }
}
