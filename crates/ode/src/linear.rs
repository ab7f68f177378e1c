//! Propagates a small difference from a solution by the linearised equations, for systems that provide them
//! ([`crate::System::tangent`]). A step may be too long for a difference when the solution itself has become slow. The
//! difference is then computed with more orders than the step, or in several pieces.

use crate::dense::Step;
use crate::system::{System, Tangent};
use crate::taylor::{Change, forced};
use crate::vector::largest;
use math::lane;
use math::simd::{Kernel, dispatch};
use std::cell::RefCell;
use std::ops::Range;

/// The series of a difference over the step looked at last.
#[derive(Clone, Debug)]
pub(crate) struct Linear {
    /// The coefficients of the equations at the start of the step or of its last piece, at its end, and their growth over a
    /// piece.
    start: Vec<f64>,
    end: Vec<f64>,
    growth: Vec<f64>,
    /// How fast differences move at most, at the end of the step.
    fastest: f64,
    /// Whether `end` is known from the step before, and for how many more steps it may stand for theirs.
    is_known: bool,
    is_steady: bool,
    steady_for: u32,
    /// The rows of all pieces, which are equally long; what follows them is unused.
    rows: Vec<f64>,
    /// How late the solution is: this part of the difference, a shift along the solution, is carried exactly. Of a motion
    /// that is thrown back by a wall all but a small rest is of this kind.
    late: f64,
    /// The components concerned.
    forced: Vec<Range<usize>>,
    /// Scratch for states and rates.
    state: RefCell<[Vec<f64>; 2]>,
    /// What fading leaves over a piece, and its logarithm.
    left: f64,
    fading: f64,
    /// How many numbers the rows of a piece are.
    length: usize,
    pieces: usize,
}

/// Terms of a series from the first that is smaller than this part are left out: an error is asked to a factor of 3.
const REST: f64 = 2e-2;

/// A piece is at most so long, in units of the time in which differences move: terms of longer ones would cancel.
const LONGEST: f64 = 10.0;

/// More pieces than this would cost more than the step.
const MOST_PIECES: f64 = 100.0;

/// Coefficients that change by at most this fraction over a step are reused for a few more steps.
const STEADY: f64 = 0.01;
const STEADY_FOR: u32 = 3;

impl Linear {
    /// For a system; `None` if it does not provide its linearised equations.
    pub(crate) fn new(system: &dyn System) -> Option<Linear> {
        let size = system.tangent_size();
        let zeros = || vec![0.0; size];
        (size > 0).then(|| Linear {
            start: zeros(),
            end: zeros(),
            growth: zeros(),
            fastest: 0.0,
            is_known: false,
            is_steady: false,
            steady_for: 0,
            rows: Vec::new(),
            late: 0.0,
            forced: forced(system),
            state: RefCell::new([vec![0.0; system.dimension()], vec![0.0; system.dimension()]]),
            left: 1.0,
            fading: 0.0,
            length: 0,
            pieces: 0,
        })
    }

    /// Carries a difference, known at the start of a step, over the step; false where it moves too fast.
    pub(crate) fn expand(&mut self, step: &Step<'_>, error: &[f64]) -> bool {
        let fastest = self.look(step);
        let turns = fastest * step.length();
        let pieces = (turns / LONGEST).ceil();
        if pieces.is_nan() || pieces > MOST_PIECES {
            return false;
        }
        self.pieces = if pieces > 1.0 { pieces as usize } else { 1 };
        let share = 1.0 / self.pieces as f64;
        let (unit, dimension) = (step.length() * share, error.len());
        self.fading = step.system.fading() * unit;
        self.left = lane::exp(self.fading);
        let order = order(turns * share, REST / self.left);
        self.length = (order + 1) * dimension;
        if self.rows.len() < self.pieces * self.length {
            self.rows.resize(self.pieces * self.length, 0.0);
        }
        let rates = step.rates_before();
        // a motion that is all but uniform is thrown back by nothing
        self.late = if self.is_steady { 0.0 } else { lateness(&self.forced, rates, error) };
        dispatch(Unshifted { error, rates, late: self.late, result: &mut self.rows[..dimension] });
        if self.pieces > 1 {
            self.growth.iter_mut().for_each(|growth| *growth *= share);
        }
        for piece in 0..self.pieces {
            let (done, rest) = self.rows.split_at_mut(piece * self.length);
            let rows = &mut rest[..self.length];
            if piece > 0 {
                whole(&done[done.len() - self.length..], dimension, 1.0, &mut rows[..dimension]);
                rows[..dimension].iter_mut().for_each(|difference| *difference *= self.left);
                if !self.is_steady {
                    self.start.iter_mut().zip(&self.growth).for_each(|(start, growth)| *start += growth);
                }
            }
            let growth = if self.is_steady { &[][..] } else { &self.growth[..] };
            step.system.difference(Tangent { start: &self.start, growth }, order, unit, rows);
        }
        true
    }

    /// Finds the coefficients at the start of the step and their growth; returns how fast differences move at most.
    fn look(&mut self, step: &Step<'_>) -> f64 {
        let before = if self.is_known { self.fastest } else { step.system.tangent(step.before(), &mut self.end) };
        self.start.copy_from_slice(&self.end);
        self.is_steady = self.steady_for > 0;
        if self.is_steady {
            self.steady_for -= 1;
            return before;
        }
        // after steady steps `end` is that of an earlier one, near enough
        self.fastest = step.system.tangent(step.after(), &mut self.end);
        self.is_known = true;
        for (growth, (start, end)) in self.growth.iter_mut().zip(self.start.iter().zip(&self.end)) {
            *growth = end - start;
        }
        self.steady_for = if largest(&self.growth) <= STEADY * largest(&self.end) { STEADY_FOR } else { 0 };
        if self.fastest > before { self.fastest } else { before }
    }

    /// Writes the difference at the end of the step, of what was there at its start, and what the step has added.
    pub(crate) fn end(&self, step: &Step<'_>, added: &[f64], result: &mut [f64]) {
        let left = self.rest(1.0, result);
        dispatch(Shifted { left, late: self.late, rates: step.rates_after(), added, result });
    }

    /// The same at the fraction `theta` of the step.
    pub(crate) fn at(&self, step: &mut Step<'_>, theta: f64, result: &mut [f64]) {
        let [state, rates] = &mut *self.state.borrow_mut();
        step.at_fraction(theta, state);
        step.rates_of(state, rates);
        let left = self.rest(theta, result);
        result.iter_mut().zip(rates).for_each(|(result, rate)| *result = *result * left + self.late * *rate);
    }

    /// Writes the series there; returns what fading leaves of it.
    fn rest(&self, theta: f64, result: &mut [f64]) -> f64 {
        let place = theta * self.pieces as f64;
        let piece = (place as usize).min(self.pieces - 1);
        let within = place - piece as f64;
        whole(&self.rows[piece * self.length..][..self.length], result.len(), within, result);
        if within == 1.0 { self.left } else { lane::exp(self.fading * within) }
    }
}

/// What a shift in time carries is at most so many times the difference: what remains would be the difference of two far
/// larger numbers, of which the series has two digits.
const MOST_LATE: f64 = 10.0;

/// The shift in time that makes most of a difference.
fn lateness(components: &[Range<usize>], rates: &[f64], error: &[f64]) -> f64 {
    let scale = components.iter().fold(0.0, |scale, range| {
        let own = largest(&rates[range.clone()]);
        if own <= scale { scale } else { own }
    });
    let share = 1.0 / scale;
    let (mut along, mut squares) = (0.0, 0.0);
    for range in components {
        let sums = dispatch(Products { rates: &rates[range.clone()], error: &error[range.clone()], share });
        (along, squares) = (along + sums[0], squares + sums[1]);
    }
    let late = along / squares * share;
    // of a slow motion it may be far more than the error of what moves on
    let is_part = late.abs() * largest(rates) <= MOST_LATE * largest(error);
    if is_part { late } else { 0.0 }
}

/// The sums of rates times errors and of squares of rates, these in units in which the largest is 1.
struct Products<'a> {
    rates: &'a [f64],
    error: &'a [f64],
    share: f64,
}

impl Kernel for Products<'_> {
    type Output = [f64; 2];

    #[inline(always)]
    fn run(self) -> [f64; 2] {
        const LANES: usize = 8;
        let (mut along, mut squares) = ([0.0; LANES], [0.0; LANES]);
        for (rates, error) in self.rates.chunks(LANES).zip(self.error.chunks(LANES)) {
            for i in 0..rates.len().min(error.len()) {
                let share = rates[i] * self.share;
                along[i] += share * error[i];
                squares[i] += share * share;
            }
        }
        [along, squares].map(|sums| sums.iter().sum())
    }
}

/// Writes `error - late * rates`.
struct Unshifted<'a> {
    error: &'a [f64],
    rates: &'a [f64],
    late: f64,
    result: &'a mut [f64],
}

impl Kernel for Unshifted<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        for (result, (error, rate)) in self.result.iter_mut().zip(self.error.iter().zip(self.rates)) {
            *result = error - self.late * rate;
        }
    }
}

/// Takes what is left of a difference and adds `late * rates + added`.
struct Shifted<'a> {
    left: f64,
    late: f64,
    rates: &'a [f64],
    added: &'a [f64],
    result: &'a mut [f64],
}

impl Kernel for Shifted<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        for (result, (rate, added)) in self.result.iter_mut().zip(self.rates.iter().zip(self.added)) {
            *result = (self.left * *result + self.late * rate) + added;
        }
    }
}

/// The sum of a series.
fn whole(rows: &[f64], n: usize, h: f64, result: &mut [f64]) {
    dispatch(Change::<true> { rows, n, from: 0, h, result });
}

/// The last order whose term is above `rest`, where each is `turns / k` times the one before; terms grow at first.
fn order(turns: f64, rest: f64) -> usize {
    let (mut order, mut term) = (1, turns);
    while term > rest || (order as f64) < turns {
        order += 1;
        term *= turns / order as f64;
    }
    order
}
