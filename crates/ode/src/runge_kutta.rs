//! One step of an explicit Runge-Kutta method, and its interpolant.

use crate::control::Norm;
use crate::dense::{Ends, Part, Stepper, Trial, cubic};
use crate::system::System;
use crate::tableau::{Interpolant, Row, Tableau};
use crate::vector::{add, add_nested, add_weighted_sum, weighted_sum};

pub(crate) struct RungeKutta {
    tableau: &'static Tableau,
    n: usize,
    /// All stages one after another: those of the step, the rate at its end, those of the interpolant.
    stages: Vec<f64>,
    state: Vec<f64>,
    sum: Vec<f64>,
    /// `r_0, r_1, ...` of a nested interpolant, once they are wanted.
    nested: Vec<f64>,
    nested_is_ready: bool,
    /// Whether the error of the last step took the rate at its end, which then need not be evaluated again.
    end_is_known: bool,
}

impl RungeKutta {
    pub(crate) fn new(tableau: &'static Tableau, n: usize) -> RungeKutta {
        let (further, rows) = match tableau.interpolant {
            Interpolant::Cubic => (0, 0),
            Interpolant::Nested { stages, rows } => (stages.len(), rows.len()),
        };
        RungeKutta {
            tableau,
            n,
            stages: vec![0.0; (tableau.stages() + 1 + further) * n],
            state: vec![0.0; n],
            sum: vec![0.0; n],
            nested: vec![0.0; rows * n],
            nested_is_ready: false,
            end_is_known: false,
        }
    }

    /// Evaluates stage `i` at `start + h * (row of earlier stages)`, a state that is left in `self.state`.
    fn stage(&mut self, system: &dyn System, start: &[f64], h: f64, row: Row, i: usize) {
        let (earlier, later) = self.stages.split_at_mut(i * self.n);
        add_weighted_sum(start, h, row, earlier, &mut self.state);
        system.rates(&self.state, &mut later[..self.n]);
    }

    /// Evaluates the rate at the end of the step, if the estimate counts it as a stage; false outside the domain.
    fn end(&mut self, system: &dyn System, start: &[f64], change: &[f64]) -> bool {
        if self.tableau.estimates_with_end() {
            add(start, change, &mut self.state);
            if !system.in_domain(&self.state) {
                return false;
            }
            let end = self.tableau.stages() * self.n;
            system.rates(&self.state, &mut self.stages[end..end + self.n]);
            self.end_is_known = true;
        }
        true
    }

    /// The error of the step in units of the tolerance. Of two estimates `e_5`, `e_3` the combination of DOP853 is
    /// taken, `e_5^2 / sqrt(e_5^2 + e_3^2 / 100)`, which behaves as an estimate of order 7.
    fn error(&mut self, h: f64, norm: &Norm) -> f64 {
        let mut estimates = [0.0; 2];
        for (estimate, weights) in estimates.iter_mut().zip(self.tableau.errors) {
            weighted_sum(h, weights, &self.stages, &mut self.sum);
            *estimate = norm.of(&self.sum);
        }
        match (self.tableau.errors.len(), estimates) {
            (2, [fine, coarse]) if fine > 0.0 => fine * (fine / (fine * fine + 0.01 * coarse * coarse).sqrt()),
            (_, [estimate, _]) => estimate,
        }
    }

    fn prepare_nested(&mut self, system: &dyn System, ends: &Ends<'_>) {
        let Interpolant::Nested { stages, rows } = self.tableau.interpolant else { return };
        let h = ends.h;
        let end = self.tableau.stages();
        self.stages[end * self.n..(end + 1) * self.n].copy_from_slice(ends.rates_after);
        for (i, row) in stages.iter().enumerate() {
            // inside an accepted step: the solution is in the domain at both ends
            self.stage(system, ends.before, h, row, end + 1 + i);
        }
        for (row, nested) in rows.iter().zip(self.nested.chunks_exact_mut(self.n)) {
            weighted_sum(h, row, &self.stages, nested);
        }
        self.nested_is_ready = true;
    }
}

impl Stepper for RungeKutta {
    fn try_step(&mut self, system: &dyn System, from: Trial<'_>, change: &mut [f64], norm: Option<&Norm>) -> f64 {
        (self.nested_is_ready, self.end_is_known) = (false, false);
        self.stages[..self.n].copy_from_slice(from.rates);
        let mut is_beyond = false;
        for (i, row) in self.tableau.rows.iter().enumerate() {
            self.stage(system, from.state, from.h, row, i + 1);
            is_beyond |= !system.in_domain(&self.state);
            if is_beyond && norm.is_some() {
                return f64::INFINITY;
            }
        }
        weighted_sum(from.h, self.tableau.weights, &self.stages, change);
        let Some(norm) = norm else { return if is_beyond { f64::INFINITY } else { 0.0 } };
        if self.end(system, from.state, change) { self.error(from.h, norm) } else { f64::INFINITY }
    }

    fn evaluations(&self) -> u64 {
        self.tableau.rows.len() as u64 + u64::from(self.end_is_known)
    }

    fn rates_at_end(&self) -> Option<&[f64]> {
        let end = self.tableau.stages() * self.n;
        self.end_is_known.then(|| &self.stages[end..end + self.n])
    }

    /// An embedded solution of order `q` errs by `step^(q + 1)` in one step. All pairs here have `q + 1 = order`, and the
    /// two estimates of DOP853 together behave like one of order 7.
    fn error_power(&self) -> usize {
        self.tableau.order
    }

    fn interpolate(&mut self, system: &dyn System, ends: &Ends<'_>, theta: f64, part: Part<'_>) -> u64 {
        let (from, values) = (part.from, part.values);
        cubic(ends, theta, Part { from, values: &mut *values });
        let Interpolant::Nested { stages, .. } = self.tableau.interpolant else { return 0 };
        let evaluations = if self.nested_is_ready { 0 } else { stages.len() as u64 };
        if !self.nested_is_ready {
            self.prepare_nested(system, ends);
        }
        add_nested(theta, &self.nested, self.n, from, values);
        evaluations
    }
}
