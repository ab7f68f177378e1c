//! Sums over stages, vectorised over components. The order of the additions is fixed: blocks of four stages.

use crate::tableau::Row;
use math::simd::{Kernel, dispatch};

/// Writes `sum = factor * (w_a k_a + w_b k_b + ...)` where stage `j` is `stages[j * n .. (j + 1) * n]`, `n = sum.len()`.
pub(crate) fn weighted_sum(factor: f64, weights: Row, stages: &[f64], sum: &mut [f64]) {
    dispatch(WeightedSum { factor, weights, stages, sum });
}

/// Writes `sum = r_0 + theta (r_1 + (1 - theta) (r_2 + theta (r_3 + ...)))` where `r_j` is `rows[j * n .. (j + 1) * n]`,
/// `n = sum.len()`.
pub(crate) fn nested_sum(theta: f64, rows: &[f64], sum: &mut [f64]) {
    dispatch(NestedSum { theta, rows, sum });
}

/// Writes `result = start + change`.
pub(crate) fn add(start: &[f64], change: &[f64], result: &mut [f64]) {
    for ((result, start), change) in result.iter_mut().zip(start).zip(change) {
        *result = start + change;
    }
}

/// Adds `change` to `state`; `carry` keeps what rounding drops (Kahan's sum) and brings it in the next time.
pub(crate) fn add_compensated(state: &[f64], change: &[f64], carry: &mut [f64], result: &mut [f64]) {
    for (((result, state), change), carry) in result.iter_mut().zip(state).zip(change).zip(carry) {
        let change = change + *carry;
        let sum = state + change;
        *carry = change - (sum - state);
        *result = sum;
    }
}

/// The largest absolute value; NaN if there is one.
pub(crate) fn largest(values: &[f64]) -> f64 {
    let mut largest = 0.0;
    let mut sum = 0.0;
    for value in values {
        let size = value.abs();
        largest = if size > largest { size } else { largest };
        sum += size;
    }
    if sum.is_nan() { f64::NAN } else { largest }
}

/// The smallest absolute value.
pub(crate) fn smallest(values: &[f64]) -> f64 {
    values.iter().fold(f64::INFINITY, |least, value| if value.abs() < least { value.abs() } else { least })
}

struct WeightedSum<'a> {
    factor: f64,
    weights: Row,
    stages: &'a [f64],
    sum: &'a mut [f64],
}

impl Kernel for WeightedSum<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let n = self.sum.len();
        let stage = |j: usize| &self.stages[j * n..(j + 1) * n];
        self.sum.fill(0.0);
        let blocks = self.weights.chunks_exact(4);
        let rest = blocks.remainder();
        for block in blocks {
            let [(a, wa), (b, wb), (c, wc), (d, wd)] = [block[0], block[1], block[2], block[3]];
            let (ka, kb, kc, kd) = (stage(a), stage(b), stage(c), stage(d));
            for ((((sum, ka), kb), kc), kd) in self.sum.iter_mut().zip(ka).zip(kb).zip(kc).zip(kd) {
                *sum += (wa * ka + wb * kb) + (wc * kc + wd * kd);
            }
        }
        for &(j, weight) in rest {
            for (sum, k) in self.sum.iter_mut().zip(stage(j)) {
                *sum += weight * k;
            }
        }
        for sum in self.sum.iter_mut() {
            *sum *= self.factor;
        }
    }
}

struct NestedSum<'a> {
    theta: f64,
    rows: &'a [f64],
    sum: &'a mut [f64],
}

impl Kernel for NestedSum<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        self.sum.fill(0.0);
        for (r, row) in self.rows.chunks_exact(self.sum.len()).enumerate().rev() {
            let factor = if r % 2 == 0 { self.theta } else { 1.0 - self.theta };
            for (sum, row) in self.sum.iter_mut().zip(row) {
                *sum = row + factor * *sum;
            }
        }
    }
}
