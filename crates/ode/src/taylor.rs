//! Taylor's method: the series of the solution about the start of a step, to an order that suits the tolerance.
//!
//! The system gives the coefficients by recurrence ([`crate::System::series`]). The last two of them determine the step
//! in advance, so that none is rejected, and the series itself is the solution inside the step (A. Jorba, M. Zou, *A
//! software package for the numerical integration of ODEs by means of high-order Taylor methods*, Experimental
//! Mathematics 14 (2005) 99).

mod step;
mod sums;

use crate::control::{Control, Norm};
use crate::dense::{Ends, Part, Stepper, Trial};
use crate::kinks::Kinks;
use crate::rows::Rows;
use crate::system::System;
use math::lane;
use math::simd::{Kernel, dispatch};
use std::ops::Range;
use step::{ROUNDINGS, SAFETY, SLACK, TELLING, growth, order, power, power_of_two};
use sums::{Begin, Both, Defect};

pub(crate) use step::HIGHEST;
pub(crate) use sums::Change;

pub(crate) struct Taylor {
    order: usize,
    dimension: usize,
    /// Unit of time of the coefficients, a power of 2 near the length of the steps: in units far from it the
    /// coefficients of high orders would overflow near a blow-up.
    unit: f64,
    /// That of the next expansion.
    next_unit: f64,
    /// The step that was proposed last.
    proposed: f64,
    /// The kinks on which steps end, if the system has any.
    kinks: Option<Kinks>,
    /// Rows of coefficients, that of order 0 first. The components with a force, of which samples and defects are
    /// computed, begin with a line of the cache.
    coefficients: Rows,
    /// The sizes of the rows of the last two orders, in units of the tolerance.
    before_size: f64,
    last_size: f64,
    /// The components that are not position-like: the others' rates bend nowhere.
    forced: Vec<Range<usize>>,
    /// Scratch for the defect at the end of a step; 0 for position-like components.
    defect: Vec<f64>,
    /// Whether it is that of the last step.
    has_defect: bool,
    /// Scratch for what position-like components lack.
    missing: Vec<f64>,
}

impl Taylor {
    pub(crate) fn new(system: &dyn System, control: Control) -> Taylor {
        let (order, dimension, forced) = (order(control), system.dimension(), forced(system));
        let first = forced.first().map_or(0, |range| range.start);
        let (defect, missing) = (vec![0.0; dimension], vec![0.0; dimension]);
        Taylor {
            order,
            dimension,
            unit: 1.0,
            next_unit: 1.0,
            proposed: 1.0,
            kinks: Kinks::new(system, order),
            coefficients: Rows::apart(order + 1, dimension, system.row_length(), first),
            before_size: 0.0,
            last_size: 0.0,
            forced,
            defect,
            has_defect: false,
            missing,
        }
    }

    fn expand(&mut self, system: &dyn System, state: &[f64], rates: &[f64]) {
        let n = self.dimension;
        self.unit = self.next_unit;
        let stride = self.coefficients.stride();
        let rows = self.coefficients.all_mut();
        let (states, others) = rows.split_at_mut(stride);
        dispatch(Begin { state, rates, unit: self.unit, first: [&mut states[..n], &mut others[..n]] });
        system.series(self.order, self.unit, rows);
    }

    /// Whether a step leads to where the rates have no value, though its end may not. Beside such an edge all terms of
    /// the series are below the tolerance at a step beyond its radius of convergence, where they grow with the order:
    /// the sum may turn back before the edge, at every step. The path that counts is the tangent. The rates are spoilt.
    fn is_beyond(&mut self, system: &dyn System, from: &Trial<'_>, rates: &mut [f64]) -> bool {
        let is_growing = self.last_size * from.h > self.before_size * self.unit;
        if !is_growing {
            return false;
        }
        for ((end, state), rate) in self.missing.iter_mut().zip(from.state).zip(from.rates) {
            *end = state + from.h * rate;
        }
        // a wall is passed by no step, and needs no such look
        if !system.in_domain(&self.missing) {
            return false;
        }
        system.rates(&self.missing, rates);
        !rates.iter().all(|rate| rate.is_finite())
    }
}

impl Stepper for Taylor {
    fn try_step(&mut self, system: &dyn System, from: Trial<'_>, change: &mut [f64], norm: Option<&Norm>) -> f64 {
        // an adaptive step has its series from the proposal of its length, a shorter try after a rejection too
        if norm.is_none() {
            self.expand(system, from.state, from.rates);
        }
        // a step may end far earlier than its series allows, which of a polynomial is never: in that unit the
        // coefficients of the next expansion would overflow
        if from.h < self.proposed {
            self.next_unit = power_of_two(from.h);
        }
        let h = from.h / self.unit;
        if norm.is_some() && self.is_beyond(system, &from, change) {
            return f64::INFINITY;
        }
        dispatch(Change::<false> {
            rows: self.coefficients.all(),
            n: self.coefficients.stride(),
            from: 0,
            h,
            result: change,
        });
        norm.map_or(0.0, |_| (0..self.order).fold(self.last_size, |error, _| error * h))
    }

    fn propose(&mut self, system: &dyn System, state: &[f64], rates: &[f64], norm: &Norm) -> Option<f64> {
        self.expand(system, state, rates);
        self.last_size = norm.of(self.coefficients.row(self.order));
        let last = growth(self.last_size, self.order)?;
        self.before_size = norm.of(self.coefficients.row(self.order - 1));
        let before = growth(self.before_size, self.order - 1)?;
        let step = SAFETY * self.unit * lane::exp(-if last > before { last } else { before });
        self.proposed = self.kinks.as_mut().map_or(step, |kinks| {
            let slack = norm.scale(self.forced.first().map_or(0, |range| range.start), SLACK, ROUNDINGS);
            kinks.end(system, step, self.unit, slack)
        });
        // a short step to a kink tells nothing of the steps behind it
        let is_telling = self.proposed == step || self.proposed > TELLING * self.unit;
        self.next_unit = if is_telling { power_of_two(self.proposed) } else { self.unit };
        Some(self.proposed)
    }

    fn unit(&self) -> f64 {
        self.unit
    }

    fn resume(&mut self, unit: f64) {
        self.next_unit = unit;
    }

    /// The few looks along a tangent are not counted: a step is made of its series.
    fn evaluations(&self) -> u64 {
        self.order as u64 - 1
    }

    fn defect(&mut self, ends: &Ends<'_>, norm: &Norm) -> f64 {
        let h = ends.h / self.unit;
        let n = self.coefficients.stride();
        let rows = &self.coefficients.all()[n..];
        let (Some(first), Some(last)) = (self.forced.first(), self.forced.last()) else { return 0.0 };
        let range = first.start..last.end;
        let (length, rates) = (ends.h, ends.rates_after);
        dispatch(Defect { rows, n, range, h, length, rates, defect: &mut self.defect });
        for pair in self.forced.windows(2) {
            self.defect[pair[0].end..pair[1].start].fill(0.0);
        }
        self.has_defect = true;
        norm.of(&self.defect)
    }

    /// What follows the last order. For components with a force it follows from the defect, which was computed when the
    /// step was accepted. For position-like ones two orders are known: the first follows from the last order of speeds,
    /// the second from what the speeds lack. The first alone may vanish by chance, or by symmetry. What a defect leaves
    /// of itself at the end of the step fades as speeds do: else positions would keep what speeds lack by then.
    fn own_error(&mut self, system: &dyn System, ends: &Ends<'_>, error: &mut [f64]) -> bool {
        if !self.has_defect {
            return false;
        }
        let (Some(first), Some(last)) = (self.forced.first(), self.forced.last()) else { return false };
        let range = first.start..last.end;
        let next = (self.order + 1) as f64;
        let of_last = -ends.h / next * power(ends.h / self.unit, self.order);
        // what grows instead does not fade
        let rate = math::larger(system.relaxation_rate(), 0.0);
        let faded = 1.0 / (1.0 + rate * ends.h / (next + 1.0));
        let of_defect = faded * ends.h / ((next + 1.0) * next);
        let last = &self.coefficients.row(self.order)[range.clone()];
        let (defect, missing) = (&self.defect[range.clone()], &mut self.missing[range.clone()]);
        // position-like components among them are written anew
        let factors = [faded / next, of_last, of_defect];
        dispatch(OwnError { defect, last, factors, error: &mut error[range], missing });
        system.kinematics(&self.missing, error);
        true
    }

    fn difference(&mut self, system: &dyn System, near: &[f64], order: usize, rows: &mut Vec<f64>) -> f64 {
        let n = self.dimension;
        let order = if order < self.order { order } else { self.order };
        // all of them are written anew
        rows.resize((order + 1) * n, 0.0);
        rows[..n].copy_from_slice(near);
        let (states, rates) = rows.split_at_mut(n);
        system.rates(states, &mut rates[..n]);
        rates[..n].iter_mut().for_each(|rate| *rate *= self.unit);
        system.series(order, self.unit, rows);
        for (row, own) in rows.chunks_exact_mut(n).zip(self.coefficients.iter()).skip(1) {
            for (coefficient, own) in row.iter_mut().zip(own) {
                *coefficient -= own;
            }
        }
        self.unit
    }

    /// A coefficient that is not shows at the end of the step.
    fn is_finite_between(&self) -> bool {
        true
    }

    fn error_power(&self) -> usize {
        self.order
    }

    fn interpolate(&mut self, _system: &dyn System, ends: &Ends<'_>, theta: f64, part: Part<'_>) -> u64 {
        let h = theta * (ends.h / self.unit);
        // row 0 is the state at the start of the step
        let Part { from, values: result } = part;
        dispatch(Change::<true> { rows: self.coefficients.all(), n: self.coefficients.stride(), from, h, result });
        0
    }

    fn interpolate_both(
        &mut self,
        _system: &dyn System,
        ends: &Ends<'_>,
        thetas: [f64; 2],
        from: usize,
        results: [&mut [f64]; 2],
    ) -> Option<u64> {
        let h = thetas.map(|theta| theta * (ends.h / self.unit));
        dispatch(Both { rows: self.coefficients.all(), n: self.coefficients.stride(), from, h, results });
        Some(0)
    }
}

/// Writes what components with a force are off by, and what position-like ones lack because of it.
struct OwnError<'a> {
    defect: &'a [f64],
    last: &'a [f64],
    /// Of the defect in the error; of the last order and of the defect in what is missing.
    factors: [f64; 3],
    error: &'a mut [f64],
    missing: &'a mut [f64],
}

impl Kernel for OwnError<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let [own, first, second] = self.factors;
        let known = self.defect.iter().zip(self.last);
        for ((defect, last), (error, missing)) in known.zip(self.error.iter_mut().zip(self.missing)) {
            *error = own * defect;
            *missing = first * last + second * defect;
        }
    }
}

/// The components that are not position-like.
pub(crate) fn forced(system: &dyn System) -> Vec<Range<usize>> {
    let mut positions = system.positions();
    positions.sort_by_key(|range| range.start);
    let starts = std::iter::once(0).chain(positions.iter().map(|range| range.end));
    let ends = positions.iter().map(|range| range.start).chain([system.dimension()]);
    starts.zip(ends).map(|(start, end)| start..end).filter(|range| !range.is_empty()).collect()
}
