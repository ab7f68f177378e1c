//! Sums over stages, vectorised over components. The order of the additions is fixed, in blocks of four stages.

use crate::tableau::Row;
use math::simd::{Kernel, dispatch};

/// Writes `sum = factor * (w_a k_a + w_b k_b + ...)` where stage `j` is `stages[j * n .. (j + 1) * n]`, `n = sum.len()`.
pub(crate) fn weighted_sum(factor: f64, weights: Row, stages: &[f64], sum: &mut [f64]) {
    dispatch(WeightedSum::<false> { start: &[], factor, weights, stages, result: sum });
}

/// Writes `result = start + factor * (w_a k_a + w_b k_b + ...)`, stages as in [`weighted_sum`].
pub(crate) fn add_weighted_sum(start: &[f64], factor: f64, weights: Row, stages: &[f64], result: &mut [f64]) {
    dispatch(WeightedSum::<true> { start, factor, weights, stages, result });
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

/// Adds `theta^2 (1 - theta)^2 (r_0 + theta (r_1 + (1 - theta) (r_2 + theta r_3 ...)))` to `result`, where `r_j` is
/// `nested[j * n + first ..]`.
pub(crate) fn add_nested(theta: f64, nested: &[f64], n: usize, first: usize, result: &mut [f64]) {
    dispatch(Nested { theta, nested, n, first, result });
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
    stages: &'a [f64],
    result: &'a mut [f64],
}

impl<const STARTED: bool> WeightedSum<'_, STARTED> {
    /// The components `from .. from + LANES`. Their sums stay in registers while the stages pass by.
    #[inline(always)]
    fn lanes<const LANES: usize>(&mut self, from: usize) {
        let n = self.result.len();
        let stage = |j: usize| &self.stages[j * n + from..][..LANES];
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
        if n < WIDE {
            for from in 0..n {
                self.lanes::<1>(from);
            }
            return;
        }
        for from in (0..n).step_by(WIDE) {
            // the last block begins earlier rather than be cut: what is written twice is the same
            self.lanes::<WIDE>(from.min(n - WIDE));
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

struct Nested<'a> {
    theta: f64,
    nested: &'a [f64],
    n: usize,
    first: usize,
    result: &'a mut [f64],
}

impl Nested<'_> {
    #[inline(always)]
    fn lanes<const LANES: usize>(&mut self, from: usize) {
        let (n, theta) = (self.n, self.theta);
        let mut sum = [0.0; LANES];
        for r in (0..self.nested.len() / n).rev() {
            let factor = if r % 2 == 0 { theta } else { 1.0 - theta };
            let nested = &self.nested[r * n + self.first + from..][..LANES];
            for lane in 0..LANES {
                sum[lane] = nested[lane] + factor * sum[lane];
            }
        }
        let quartic = theta * theta * (1.0 - theta) * (1.0 - theta);
        let result = &mut self.result[from..][..LANES];
        for lane in 0..LANES {
            result[lane] += quartic * sum[lane];
        }
    }
}

impl Kernel for Nested<'_> {
    type Output = ();

    #[inline(always)]
    fn run(mut self) {
        let n = self.result.len();
        let wide = n - n % LANES;
        for from in (0..wide).step_by(LANES) {
            self.lanes::<LANES>(from);
        }
        for from in wide..n {
            self.lanes::<1>(from);
        }
    }
}

struct Largest<'a>(&'a [f64]);

impl Kernel for Largest<'_> {
    type Output = f64;

    /// Sizes are compared as whole numbers, which their bits are in the same order, NaN above infinity: no other pass looks
    /// for NaN, and the compiler may compare in any order.
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
const WIDE: usize = 16;

/// Components per iteration where several numbers are gathered.
const LANES: usize = 8;
