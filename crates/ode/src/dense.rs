//! An accepted step as an observer sees it: the states at both ends, and the solution anywhere in between.

use crate::control::Norm;
use crate::system::System;
use crate::vector::largest;
use math::simd::{Kernel, dispatch};
use std::ops::Range;

/// Where a step starts and how long it shall be.
pub(crate) struct Trial<'a> {
    pub(crate) state: &'a [f64],
    pub(crate) rates: &'a [f64],
    pub(crate) h: f64,
}

/// Both ends of an accepted step.
pub(crate) struct Ends<'a> {
    pub(crate) before: &'a [f64],
    pub(crate) after: &'a [f64],
    pub(crate) rates_before: &'a [f64],
    pub(crate) rates_after: &'a [f64],
    pub(crate) h: f64,
}

/// A method that makes steps. Kept within the crate: callers choose a [`crate::Method`].
pub(crate) trait Stepper {
    /// Writes the change of the state over the step and returns its error in units of the tolerance: infinite when a
    /// stage lies outside the domain, else 0 without a norm.
    fn try_step(&mut self, system: &dyn System, from: Trial<'_>, change: &mut [f64], norm: Option<&Norm>) -> f64;

    /// The length of the step to try first from a state with these rates, where the method knows one; the norm has been
    /// started there. Else the driver follows the error of the step before.
    fn propose(&mut self, _system: &dyn System, _state: &[f64], _rates: &[f64], _norm: &Norm) -> Option<f64> {
        None
    }

    /// The unit of time of the coefficients that the method keeps from step to step, if it does.
    fn unit(&self) -> f64 {
        1.0
    }

    /// Goes on with coefficients in this unit.
    fn resume(&mut self, _unit: f64) {}

    /// Evaluations of the rates in the step tried last, the one at its start not counted.
    fn evaluations(&self) -> u64;

    /// The rates at the end of the step tried last, if it evaluated them.
    fn rates_at_end(&self) -> Option<&[f64]> {
        None
    }

    /// How much the law's rates at the end of the step differ from the slope of its solution there, times the length of
    /// the step and in units of the tolerance; 0 where the method has no such slope.
    fn defect(&mut self, _ends: &Ends<'_>, _norm: &Norm) -> f64 {
        0.0
    }

    /// Writes by how much the end of the accepted step is off, the state before being exact: computed less exact. False
    /// where the method does not know.
    fn own_error(&mut self, _system: &dyn System, _ends: &Ends<'_>, _error: &mut [f64]) -> bool {
        false
    }

    /// Writes by how much the series about a state near the start of the step differ from those of the step, for the
    /// orders from 1 to `order` or the method's own, after a row of no meaning, and returns their unit of time. Only
    /// for methods with [`Stepper::own_error`].
    fn difference(&mut self, _system: &dyn System, _near: &[f64], _order: usize, _rows: &mut Vec<f64>) -> f64 {
        1.0
    }

    /// Whether the solution within an accepted step is finite where both its ends are.
    fn is_finite_between(&self) -> bool {
        false
    }

    /// The power of the step with which the estimated error falls.
    fn error_power(&self) -> usize;

    /// Writes components of the solution at the fraction `theta` of the accepted step; returns the evaluations this
    /// took.
    fn interpolate(&mut self, system: &dyn System, ends: &Ends<'_>, theta: f64, part: Part<'_>) -> u64;

    /// Does so at two fractions inside the step, for the components from `from` on, and returns the evaluations this
    /// took, if the method has a way that is quicker than one after the other.
    fn interpolate_both(
        &mut self,
        _system: &dyn System,
        _ends: &Ends<'_>,
        _thetas: [f64; 2],
        _from: usize,
        _results: [&mut [f64]; 2],
    ) -> Option<u64> {
        None
    }
}

/// A contiguous part of a state, for writing.
pub(crate) struct Part<'a> {
    /// The first of them.
    pub(crate) from: usize,
    pub(crate) values: &'a mut [f64],
}

impl Part<'_> {
    /// Which they are.
    pub(crate) fn range(&self) -> Range<usize> {
        self.from..self.from + self.values.len()
    }
}

/// An accepted step. States and rates have one number for each component of the system. Inside the step the solution is
/// the method's interpolant, whose error is not looked at by the control of the steps.
pub struct Step<'a> {
    pub(crate) system: &'a dyn System,
    pub(crate) stepper: &'a mut dyn Stepper,
    pub(crate) ends: Ends<'a>,
    pub(crate) evaluations: u64,
    pub(crate) is_beyond: bool,
    /// Time at the start of the step.
    pub start: f64,
    /// Time at its end.
    pub end: f64,
}

/// Closer than this fraction of a step to one of its ends, a place is taken for that end.
const SAME: f64 = 1e-13;

fn is_same(theta: f64, end: f64) -> bool {
    (theta - end).abs() < SAME
}

/// How near to an end of a step of this length a time is taken for that end: a few roundings of it, but a small part of
/// a step that is hardly longer than these.
pub(crate) fn nearby(end: f64, length: f64) -> f64 {
    let (rounding, part) = (4.0 * f64::EPSILON * end.abs(), 1e-9 * length);
    if rounding < part { rounding } else { part }
}

impl Step<'_> {
    /// The state at the start.
    pub fn before(&self) -> &[f64] {
        self.ends.before
    }

    /// The state at the end.
    pub fn after(&self) -> &[f64] {
        self.ends.after
    }

    /// The rates at the start.
    pub fn rates_before(&self) -> &[f64] {
        self.ends.rates_before
    }

    /// The rates at the end.
    pub fn rates_after(&self) -> &[f64] {
        self.ends.rates_after
    }

    /// The length of the step, above 0, in the unit of time; more exact than the difference of its ends.
    pub fn length(&self) -> f64 {
        self.ends.h
    }

    /// Whether a stage of this step, of fixed length, lay outside the domain of the equations: its end means nothing.
    pub fn is_beyond(&self) -> bool {
        self.is_beyond
    }

    /// Writes the state at the time `t` within the step; beyond its ends the interpolant is an extrapolation.
    pub fn at(&mut self, t: f64, state: &mut [f64]) {
        self.part_at(t, Part { from: 0, values: state });
    }

    /// As [`Step::at`], for an observer that does not change the statistics of a run: no evaluation is counted.
    pub fn seen_at(&mut self, t: f64, state: &mut [f64]) {
        let counted = self.evaluations;
        self.at(t, state);
        self.evaluations = counted;
    }

    /// As [`Step::at`] for a contiguous part of the components, at lower cost; the rest of `state` is left alone.
    pub fn components_at(&mut self, t: f64, range: Range<usize>, state: &mut [f64]) {
        self.part_at(t, Part { from: range.start, values: &mut state[range] });
    }

    /// [`Step::components_at`] at two times, which some methods compute together.
    pub(crate) fn components_at_both(&mut self, times: [f64; 2], range: Range<usize>, states: [&mut [f64]; 2]) {
        let thetas = times.map(|t| self.fraction(t));
        let [one, other] = states.map(|state| &mut state[range.clone()]);
        let is_inside = |theta: &f64| !is_same(*theta, 0.0) && !is_same(*theta, 1.0);
        if thetas.iter().all(is_inside) {
            let results = [&mut *one, &mut *other];
            if let Some(count) = self.stepper.interpolate_both(self.system, &self.ends, thetas, range.start, results) {
                self.evaluations += count;
                return;
            }
        }
        for (theta, values) in thetas.into_iter().zip([one, other]) {
            self.part_at_fraction(theta, Part { from: range.start, values });
        }
    }

    fn part_at(&mut self, t: f64, part: Part<'_>) {
        self.part_at_fraction(self.fraction(t), part);
    }

    /// The fraction of the step, 0 at its start and 1 at its end, that corresponds to the time `t`.
    pub fn fraction(&self, t: f64) -> f64 {
        let near = nearby(self.end, self.ends.h);
        if (t - self.start).abs() < near {
            0.0
        } else if (t - self.end).abs() < near {
            1.0
        } else {
            (t - self.start) / self.ends.h
        }
    }

    /// Writes the rates of any state, one for each component. They are not counted, since an observer does not change
    /// the statistics of a run.
    pub fn rates_of(&self, state: &[f64], rates: &mut [f64]) {
        self.system.rates(state, rates);
    }

    /// Writes the state at the fraction `theta` of the step, 0 to 1.
    pub fn at_fraction(&mut self, theta: f64, state: &mut [f64]) {
        self.part_at_fraction(theta, Part { from: 0, values: state });
    }

    fn part_at_fraction(&mut self, theta: f64, part: Part<'_>) {
        if is_same(theta, 0.0) {
            part.values.copy_from_slice(&self.ends.before[part.range()]);
        } else if is_same(theta, 1.0) {
            part.values.copy_from_slice(&self.ends.after[part.range()]);
        } else {
            let (from, values) = (part.from, part.values);
            let part = Part { from, values: &mut *values };
            self.evaluations += self.stepper.interpolate(self.system, &self.ends, theta, part);
            if !self.stepper.is_finite_between() {
                mend(&self.ends, theta, Part { from, values });
            }
        }
    }
}

/// Takes the chord where the interpolant is not finite: a step of fixed length may end where the rates are not.
pub(crate) fn mend(ends: &Ends<'_>, theta: f64, part: Part<'_>) {
    if largest(part.values).is_finite() {
        return;
    }
    let (before, after) = (&ends.before[part.range()], &ends.after[part.range()]);
    for (value, (before, after)) in part.values.iter_mut().zip(before.iter().zip(after)) {
        if !value.is_finite() {
            *value = before + theta * (after - before);
        }
    }
}

/// The cubic Hermite polynomial through both ends, written as corrections to the chord.
pub(crate) fn cubic(ends: &Ends<'_>, theta: f64, part: Part<'_>) {
    dispatch(Cubic { ends, theta, part });
}

struct Cubic<'a> {
    ends: &'a Ends<'a>,
    theta: f64,
    part: Part<'a>,
}

impl Kernel for Cubic<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let (h, theta) = (self.ends.h, self.theta);
        let there = theta * (1.0 - theta);
        let Part { from, values } = self.part;
        let ends = self.ends;
        let states = ends.before[from..].iter().zip(&ends.after[from..]);
        let rates = ends.rates_before[from..].iter().zip(&ends.rates_after[from..]);
        for ((result, (before, after)), (leaving, arriving)) in values.iter_mut().zip(states).zip(rates) {
            let change = after - before;
            let bend_before = h * leaving - change;
            let bend_after = change - h * arriving;
            *result = before + (theta * change + there * ((1.0 - theta) * bend_before + theta * bend_after));
        }
    }
}
