//! Sums over stages, vectorised over components. The order of the additions is fixed, in blocks of four stages.

use crate::rows::Rows;
use crate::tableau::Row;
use math::simd::{Kernel, dispatch};
use std::ops::Range;

/// Rows as numbers one after another, each `stride` behind the one before.
#[derive(Clone, Copy)]
struct Stages<'a> {
    all: &'a [f64],
    stride: usize,
}

impl Stages<'_> {
    fn of(rows: &Rows) -> Stages<'_> {
        Stages { all: rows.all(), stride: rows.stride() }
    }
}

/// Writes the components of `range` of `sum = factor * (w_a k_a + w_b k_b + ...)` where `k_j` are these rows.
pub(crate) fn weighted_sum(factor: f64, weights: Row, rows: &Rows, range: Range<usize>, sum: &mut [f64]) {
    let (stages, first, result) = (Stages::of(rows), range.start, &mut sum[range]);
    dispatch(WeightedSum::<false> { start: &[], factor, weights, stages, first, result });
}

/// Writes `result = start + factor * (w_a k_a + w_b k_b + ...)`, stages as in [`weighted_sum`].
pub(crate) fn add_weighted_sum(start: &[f64], factor: f64, weights: Row, rows: &Rows, result: &mut [f64]) {
    dispatch(WeightedSum::<true> { start, factor, weights, stages: Stages::of(rows), first: 0, result });
}

/// Writes `result = start + change`.
pub(crate) fn add(start: &[f64], change: &[f64], result: &mut [f64]) {
    dispatch(Sum { start, change, result });
}

/// Writes `result = state + change + compensation`, and what rounding drops of it to `dropped` (Kahan's sum): the
/// compensation of the next sum.
pub(crate) fn add_compensated(
    state: &[f64],
    change: &[f64],
    compensation: &[f64],
    result: &mut [f64],
    dropped: &mut [f64],
) {
    dispatch(Compensated { state, change, compensation, result, dropped });
}

/// The largest absolute value; NaN if there is one.
pub fn largest(values: &[f64]) -> f64 {
    // of a few, a call would take longer than the work
    if values.len() < WIDE { Largest(values).run() } else { dispatch(Largest(values)) }
}

/// The smallest absolute value.
pub(crate) fn smallest(values: &[f64]) -> f64 {
    values.iter().fold(f64::INFINITY, |least, value| if value.abs() < least { value.abs() } else { least })
}

struct WeightedSum<'a, const STARTED: bool> {
    start: &'a [f64],
    factor: f64,
    weights: Row,
    stages: Stages<'a>,
    /// The component of the stages that the first of the result is made of.
    first: usize,
    result: &'a mut [f64],
}

impl<const STARTED: bool> WeightedSum<'_, STARTED> {
    /// Writes the sum if it has `K` terms.
    #[inline(always)]
    fn few<const K: usize>(self) {
        let (n, Stages { all, stride }) = (self.result.len(), self.stages);
        let (mut rows, mut weights) = ([&[][..]; K], [0.0; K]);
        for (term, &(j, weight)) in self.weights[..K].iter().enumerate() {
            (rows[term], weights[term]) = (&all[j * stride + self.first..][..n], weight);
        }
        for from in (0..n).step_by(LANES) {
            // the last block begins earlier rather than be cut: what is written twice is the same
            let from = if from < n - LANES { from } else { n - LANES };
            let mut k = [&[0.0; LANES]; K];
            for (k, row) in k.iter_mut().zip(&rows) {
                if let Some(part) = row[from..].first_chunk() {
                    *k = part;
                }
            }
            let mut sum = [0.0; LANES];
            for block in 0..K / 4 {
                let term = 4 * block;
                for lane in 0..LANES {
                    let products = |term: usize| weights[term] * k[term][lane] + weights[term + 1] * k[term + 1][lane];
                    sum[lane] += products(term) + products(term + 2);
                }
            }
            for term in K / 4 * 4..K {
                for lane in 0..LANES {
                    sum[lane] += weights[term] * k[term][lane];
                }
            }
            for sum in &mut sum {
                *sum *= self.factor;
            }
            if STARTED {
                let start = &self.start[from..][..LANES];
                for lane in 0..LANES {
                    sum[lane] += start[lane];
                }
            }
            // at the end: between two stores the compiler would read the start anew, one number at a time
            self.result[from..][..LANES].copy_from_slice(&sum);
        }
    }

    /// The components `from .. from + LANES`. Their sums stay in registers while the stages pass by.
    #[inline(always)]
    fn lanes<const LANES: usize>(&mut self, from: usize) {
        let Stages { all, stride } = self.stages;
        let all = &all[self.first + from..];
        let stage = |j: usize| &all[j * stride..][..LANES];
        let mut sum = [0.0; LANES];
        let blocks = self.weights.chunks_exact(4);
        let rest = blocks.remainder();
        for block in blocks {
            let [(a, wa), (b, wb), (c, wc), (d, wd)] = [block[0], block[1], block[2], block[3]];
            let (ka, kb, kc, kd) = (stage(a), stage(b), stage(c), stage(d));
            for lane in 0..LANES {
                sum[lane] += (wa * ka[lane] + wb * kb[lane]) + (wc * kc[lane] + wd * kd[lane]);
            }
        }
        for &(j, weight) in rest {
            let k = stage(j);
            for lane in 0..LANES {
                sum[lane] += weight * k[lane];
            }
        }
        for sum in &mut sum {
            *sum *= self.factor;
        }
        if STARTED {
            let start = &self.start[from..][..LANES];
            for lane in 0..LANES {
                sum[lane] += start[lane];
            }
        }
        // at the end: between two stores the compiler would read the start anew, one number at a time
        self.result[from..][..LANES].copy_from_slice(&sum);
    }
}

impl<const STARTED: bool> Kernel for WeightedSum<'_, STARTED> {
    type Output = ();

    #[inline(always)]
    fn run(mut self) {
        let n = self.result.len();
        if n < LANES {
            for from in 0..n {
                self.lanes::<1>(from);
            }
            return;
        }
        match self.weights.len() {
            1 => self.few::<1>(),
            2 => self.few::<2>(),
            3 => self.few::<3>(),
            4 => self.few::<4>(),
            5 => self.few::<5>(),
            6 => self.few::<6>(),
            7 => self.few::<7>(),
            8 => self.few::<8>(),
            _ => {
                for from in (0..n).step_by(LANES) {
                    self.lanes::<LANES>(from.min(n - LANES));
                }
            }
        }
    }
}

struct Sum<'a> {
    start: &'a [f64],
    change: &'a [f64],
    result: &'a mut [f64],
}

impl Kernel for Sum<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        for ((result, start), change) in self.result.iter_mut().zip(self.start).zip(self.change) {
            *result = start + change;
        }
    }
}

struct Compensated<'a> {
    state: &'a [f64],
    change: &'a [f64],
    compensation: &'a [f64],
    result: &'a mut [f64],
    dropped: &'a mut [f64],
}

impl Kernel for Compensated<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let inputs = self.state.iter().zip(self.change).zip(self.compensation);
        let outputs = self.result.iter_mut().zip(self.dropped);
        for (((state, change), compensation), (result, dropped)) in inputs.zip(outputs) {
            let change = change + compensation;
            let sum = state + change;
            *dropped = change - (sum - state);
            *result = sum;
        }
    }
}

struct Largest<'a>(&'a [f64]);

impl Kernel for Largest<'_> {
    type Output = f64;

    /// Sizes are compared as whole numbers, which their bits are in the same order, NaN above infinity: no other pass
    /// looks for NaN, and the compiler may compare in any order.
    #[inline(always)]
    fn run(self) -> f64 {
        let mut most = 0;
        for value in self.0 {
            let size = value.abs().to_bits() as i64;
            most = if size > most { size } else { most };
        }
        let largest = f64::from_bits(most as u64);
        if largest.is_nan() { f64::NAN } else { largest }
    }
}

/// Components per iteration where sums stay in registers.
const LANES: usize = 16;

/// Fewer numbers than that are not worth a kernel.
const WIDE: usize = 16;
