//! A small difference from a solution, carried over steps by the linearised equations, for systems that tell them
//! ([`crate::System::tangent`]). A step whose solution has become slow may be long for a difference, which then takes more
//! orders than the step, or is carried over it in several pieces.

use crate::dense::Step;
use crate::system::{System, Tangent};
use crate::taylor::Change;
use crate::vector::largest;
use math::simd::dispatch;

/// The series of a difference over the step looked at last.
#[derive(Clone, Debug)]
pub(crate) struct Linear {
    /// The coefficients of the equations at the start and at the end of the step, and their growth over a piece of it.
    start: Vec<f64>,
    end: Vec<f64>,
    growth: Vec<f64>,
    /// At the start of the piece.
    piece_start: Vec<f64>,
    /// How fast differences move at most, at the end of the step.
    fastest: f64,
    /// Whether `end` is known from the step before, and for how many more steps it may stand for theirs.
    is_known: bool,
    steady_for: u32,
    /// The rows of all pieces, which are equally long.
    rows: Vec<f64>,
    pieces: usize,
}

/// Terms of a series from the first that is smaller than this part are left out.
const REST: f64 = 1e-3;

/// A piece is at most so long, in units of the time in which differences move: terms of longer ones would cancel.
const LONGEST: f64 = 10.0;

/// More pieces than this would cost more than the step.
const MOST_PIECES: f64 = 100.0;

/// Coefficients that change by no more than this part over a step stand for those of a few more steps.
const STEADY: f64 = 0.01;
const STEADY_FOR: u32 = 3;

impl Linear {
    /// For a system; `None` if it does not tell its linearised equations.
    pub(crate) fn new(system: &dyn System) -> Option<Linear> {
        let size = system.tangent_size();
        let zeros = || vec![0.0; size];
        (size > 0).then(|| Linear {
            start: zeros(),
            end: zeros(),
            growth: zeros(),
            piece_start: zeros(),
            fastest: 0.0,
            is_known: false,
            steady_for: 0,
            rows: Vec::new(),
            pieces: 0,
        })
    }

    /// Carries a difference, known at the start of a step, over the step; false where it moves too fast.
    pub(crate) fn expand(&mut self, step: &Step<'_>, error: &[f64]) -> bool {
        let fastest = self.look(step);
        let turns = fastest * step.length();
        let pieces = (turns / LONGEST).ceil();
        if !(pieces <= MOST_PIECES) {
            return false;
        }
        self.pieces = if pieces > 1.0 { pieces as usize } else { 1 };
        let share = 1.0 / self.pieces as f64;
        let (order, unit, dimension) = (order(turns * share), step.length() * share, error.len());
        self.growth.iter_mut().zip(self.start.iter().zip(&self.end)).for_each(|(growth, (start, end))| {
            *growth = (end - start) * share;
        });
        self.piece_start.copy_from_slice(&self.start);
        self.rows.resize(self.pieces * (order + 1) * dimension, 0.0);
        let length = (order + 1) * dimension;
        self.rows[..dimension].copy_from_slice(error);
        for piece in 0..self.pieces {
            let (done, rest) = self.rows.split_at_mut(piece * length);
            let rows = &mut rest[..length];
            if piece > 0 {
                whole(&done[done.len() - length..], dimension, 1.0, &mut rows[..dimension]);
                self.piece_start.iter_mut().zip(&self.growth).for_each(|(start, growth)| *start += growth);
            }
            let tangent = Tangent { start: &self.piece_start, growth: &self.growth };
            step.system.difference(tangent, order, unit, rows);
        }
        true
    }

    /// Finds the coefficients at both ends; returns how fast differences move at most.
    fn look(&mut self, step: &Step<'_>) -> f64 {
        let before = if self.is_known {
            self.start.copy_from_slice(&self.end);
            self.fastest
        } else {
            step.system.tangent(step.before(), &mut self.start)
        };
        if self.is_known && self.steady_for > 0 {
            self.steady_for -= 1;
            return before;
        }
        // `end` may be that of an earlier step, which stood for those since
        self.fastest = step.system.tangent(step.after(), &mut self.end);
        self.is_known = true;
        let apart = self.start.iter().zip(&self.end).map(|(start, end)| (start - end).abs());
        let change = apart.fold(0.0, |most: f64, apart| if apart <= most { most } else { apart });
        self.steady_for = if change <= STEADY * largest(&self.end) { STEADY_FOR } else { 0 };
        if self.fastest > before { self.fastest } else { before }
    }

    /// Writes the difference at the fraction `theta` of the step, of what was there at its start.
    pub(crate) fn at(&self, theta: f64, result: &mut [f64]) {
        let length = self.rows.len() / self.pieces;
        let place = theta * self.pieces as f64;
        let piece = (place as usize).min(self.pieces - 1);
        whole(&self.rows[piece * length..][..length], result.len(), place - piece as f64, result);
    }
}

/// The sum of a series.
fn whole(rows: &[f64], n: usize, h: f64, result: &mut [f64]) {
    dispatch(Change::<true> { rows, n, from: 0, h, result });
}

/// The last order whose term counts, where each is `turns / k` times the one before.
fn order(turns: f64) -> usize {
    let (mut order, mut term) = (1, turns);
    while term > REST {
        order += 1;
        term *= turns / order as f64;
    }
    order
}
