//! One step of an explicit Runge-Kutta method, and its interpolant.

use crate::control::Norm;
use crate::dense::{Ends, Part, Stepper, Trial};
use crate::inside::Inside;
use crate::rows::Rows;
use crate::system::System;
use crate::tableau::{Interpolant, Row, Tableau};
use crate::vector::{add, add_weighted_sum, weighted_sum};
use std::ops::Range;

pub(crate) struct RungeKutta {
    tableau: &'static Tableau,
    /// All stages one after another: those of the step, the rate at its end, those of the interpolant.
    stages: Rows,
    /// The state of a stage, and an error.
    scratch: Rows,
    /// `r_0, r_1, ...` of a nested interpolant, once they are wanted.
    nested: Rows,
    /// The components that they are known for.
    known: Range<usize>,
    /// Whether the stages of the interpolant have been evaluated.
    is_continued: bool,
    /// Whether the error of the last step took the rate at its end, which then need not be evaluated again.
    end_is_known: bool,
}

/// Rows of the scratch.
const STATE: usize = 0;
const ERROR: usize = 1;

impl RungeKutta {
    pub(crate) fn new(tableau: &'static Tableau, n: usize) -> RungeKutta {
        let (further, rows) = match tableau.interpolant {
            Interpolant::Cubic => (0, 0),
            Interpolant::Nested { stages, rows } => (stages.len(), rows.len()),
        };
        RungeKutta {
            tableau,
            stages: Rows::new(tableau.stages() + 1 + further, n),
            scratch: Rows::new(2, n),
            nested: Rows::new(rows, n),
            known: 0..0,
            is_continued: false,
            end_is_known: false,
        }
    }

    /// Evaluates stage `i` at `start + h * (row of earlier stages)`, a state that is left in the scratch.
    fn stage(&mut self, system: &dyn System, start: &[f64], h: f64, row: Row, i: usize) {
        add_weighted_sum(start, h, row, &self.stages, self.scratch.row_mut(STATE));
        system.rates(self.scratch.row(STATE), self.stages.row_mut(i));
    }

    /// Evaluates the rate at the end of the step, if the estimate counts it as a stage; false outside the domain.
    fn end(&mut self, system: &dyn System, start: &[f64], change: &[f64]) -> bool {
        if self.tableau.estimates_with_end() {
            add(start, change, self.scratch.row_mut(STATE));
            if !system.in_domain(self.scratch.row(STATE)) {
                return false;
            }
            system.rates(self.scratch.row(STATE), self.stages.row_mut(self.tableau.stages()));
            self.end_is_known = true;
        }
        true
    }

    /// The error of the step in units of the tolerance. Of two estimates `e_5`, `e_3` the combination of DOP853 is
    /// taken, `e_5^2 / sqrt(e_5^2 + e_3^2 / 100)`, which behaves as an estimate of order 7.
    fn error(&mut self, h: f64, norm: &Norm) -> f64 {
        let mut estimates = [0.0; 2];
        for (estimate, weights) in estimates.iter_mut().zip(self.tableau.errors) {
            let error = self.scratch.row_mut(ERROR);
            weighted_sum(h, weights, &self.stages, 0..error.len(), error);
            *estimate = norm.of(error);
        }
        match (self.tableau.errors.len(), estimates) {
            (2, [fine, coarse]) if fine > 0.0 => fine * (fine / (fine * fine + 0.01 * coarse * coarse).sqrt()),
            (_, [estimate, _]) => estimate,
        }
    }

    /// Makes the nested interpolant ready for these components; returns the evaluations that this took.
    fn prepare_nested(&mut self, system: &dyn System, ends: &Ends<'_>, range: Range<usize>) -> u64 {
        let Interpolant::Nested { stages, rows } = self.tableau.interpolant else { return 0 };
        if self.known.start <= range.start && range.end <= self.known.end {
            return 0;
        }
        let is_first = !self.is_continued;
        if is_first {
            let end = self.tableau.stages();
            if !self.end_is_known {
                self.stages.row_mut(end).copy_from_slice(ends.rates_after);
            }
            for (i, row) in stages.iter().enumerate() {
                // inside an accepted step: the solution is in the domain at both ends
                self.stage(system, ends.before, ends.h, row, end + 1 + i);
            }
            self.is_continued = true;
        }
        // whoever has asked for some of them and now asks for others gets all
        self.known = if is_first { range } else { 0..ends.before.len() };
        for (r, row) in rows.iter().enumerate() {
            weighted_sum(ends.h, row, &self.stages, self.known.clone(), self.nested.row_mut(r));
        }
        if is_first { stages.len() as u64 } else { 0 }
    }

    fn inside<'a, const COUNT: usize>(&'a self, ends: &'a Ends<'a>, thetas: [f64; COUNT]) -> Inside<'a, COUNT> {
        Inside { ends, thetas, nested: &self.nested }
    }
}

impl Stepper for RungeKutta {
    fn try_step(&mut self, system: &dyn System, from: Trial<'_>, change: &mut [f64], norm: Option<&Norm>) -> f64 {
        (self.known, self.is_continued, self.end_is_known) = (0..0, false, false);
        self.stages.row_mut(0).copy_from_slice(from.rates);
        let mut is_beyond = false;
        for (i, row) in self.tableau.rows.iter().enumerate() {
            self.stage(system, from.state, from.h, row, i + 1);
            is_beyond |= !system.in_domain(self.scratch.row(STATE));
            if is_beyond && norm.is_some() {
                return f64::INFINITY;
            }
        }
        weighted_sum(from.h, self.tableau.weights, &self.stages, 0..change.len(), change);
        let Some(norm) = norm else { return if is_beyond { f64::INFINITY } else { 0.0 } };
        if self.end(system, from.state, change) { self.error(from.h, norm) } else { f64::INFINITY }
    }

    fn evaluations(&self) -> u64 {
        self.tableau.rows.len() as u64 + u64::from(self.end_is_known)
    }

    fn rates_at_end(&self) -> Option<&[f64]> {
        self.end_is_known.then(|| self.stages.row(self.tableau.stages()))
    }

    /// An embedded solution of order `q` errs by `step^(q + 1)` in one step. All pairs here have `q + 1 = order`, and
    /// the two estimates of DOP853 together behave like one of order 7.
    fn error_power(&self) -> usize {
        self.tableau.order
    }

    /// [`Inside`] sees to it.
    fn is_finite_between(&self) -> bool {
        true
    }

    fn interpolate(&mut self, system: &dyn System, ends: &Ends<'_>, theta: f64, part: Part<'_>) -> u64 {
        let evaluations = self.prepare_nested(system, ends, part.range());
        self.inside(ends, [theta]).write(part.from, [part.values]);
        evaluations
    }

    fn interpolate_both(
        &mut self,
        system: &dyn System,
        ends: &Ends<'_>,
        thetas: [f64; 2],
        from: usize,
        results: [&mut [f64]; 2],
    ) -> Option<u64> {
        let evaluations = self.prepare_nested(system, ends, from..from + results[0].len());
        self.inside(ends, thetas).write(from, results);
        Some(evaluations)
    }
}
