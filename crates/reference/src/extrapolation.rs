//! Extrapolated midpoint rule in double-double numbers (W. B. Gragg 1965; Hairer, Norsett & Wanner, *Solving ODEs I*,
//! II.9).
//!
//! The error of the midpoint rule with `m` substeps is a series in `1 / m^2`. So the sum of the results for `m` = 2, 4,
//! .., 2K with weights `w_i = prod_{j != i} m_i^2 / (m_i^2 - m_j^2)` has order 2K. The weights are rational; the
//! largest is 256 for K = 12 and 1447 for K = 15, so hardly a digit is lost to them.

use crate::ring::Ring;
use math::double_double::DoubleDouble;
use math::simd::{Kernel, dispatch};

/// The method with its weights and its memory.
#[derive(Clone, Debug)]
pub struct Extrapolation {
    /// For each row: its weight in the result, and in the difference from the result with one row less.
    weights: Vec<(DoubleDouble, DoubleDouble)>,
    earlier: Vec<DoubleDouble>,
    change: Vec<DoubleDouble>,
    state: Vec<DoubleDouble>,
    rates: Vec<DoubleDouble>,
    /// After a step: what the state changes by.
    pub result: Vec<DoubleDouble>,
    /// After a step: the result less that with one row less, an estimate (from above) of its error.
    pub difference: Vec<DoubleDouble>,
}

impl Extrapolation {
    /// The method of order `2 rows`, `rows >= 2`, for states of `dimension` numbers.
    pub fn new(rows: usize, dimension: usize) -> Extrapolation {
        let zeros = || vec![DoubleDouble::ZERO; dimension];
        let (weights, lower) = (weights(rows), weights(rows - 1));
        let less = lower.into_iter().chain([DoubleDouble::ZERO]);
        Extrapolation {
            weights: weights.iter().zip(less).map(|(&weight, less)| (weight, weight - less)).collect(),
            earlier: zeros(),
            change: zeros(),
            state: zeros(),
            rates: zeros(),
            result: zeros(),
            difference: zeros(),
        }
    }

    /// The order of the result.
    pub fn order(&self) -> usize {
        2 * self.weights.len()
    }

    /// Evaluations of the rates for one step beside that at its start.
    pub fn evaluations(&self) -> u64 {
        (self.weights.len() * self.weights.len()) as u64
    }

    /// A step of length `h` from a state with its rates, into `self.result` and `self.difference`.
    pub fn step(&mut self, ring: &Ring, state: &[DoubleDouble], rates: &[DoubleDouble], h: DoubleDouble) {
        self.result.fill(DoubleDouble::ZERO);
        self.difference.fill(DoubleDouble::ZERO);
        for row in 0..self.weights.len() {
            self.midpoint(ring, state, rates, h, 2 * (row + 1));
            let (weight, difference) = self.weights[row];
            dispatch(AddScaled { factor: weight, terms: &self.change, sums: &mut self.result });
            dispatch(AddScaled { factor: difference, terms: &self.change, sums: &mut self.difference });
        }
    }

    /// The midpoint rule with `substeps`: leaves what the state changes by in `self.change`.
    fn midpoint(
        &mut self,
        ring: &Ring,
        state: &[DoubleDouble],
        rates: &[DoubleDouble],
        h: DoubleDouble,
        substeps: usize,
    ) {
        let h = h / substeps as f64;
        self.earlier.fill(DoubleDouble::ZERO);
        self.change.fill(DoubleDouble::ZERO);
        dispatch(AddScaled { factor: h, terms: rates, sums: &mut self.change });
        for _ in 1..substeps {
            dispatch(Sum { a: state, b: &self.change, out: &mut self.state });
            ring.rates(&self.state, &mut self.rates);
            dispatch(AddScaled { factor: h.times(2.0), terms: &self.rates, sums: &mut self.earlier });
            std::mem::swap(&mut self.earlier, &mut self.change);
        }
    }
}

/// `w_i` for 2, 4, .., 2 rows substeps.
fn weights(rows: usize) -> Vec<DoubleDouble> {
    let square = |row: usize| ((row + 1) * (row + 1)) as f64;
    let factor = |i: usize, j: usize| DoubleDouble::from(square(i)) / (square(i) - square(j));
    let weight = |i: usize| (0..rows).filter(|&j| j != i).fold(DoubleDouble::ONE, |product, j| product * factor(i, j));
    (0..rows).map(weight).collect()
}

/// sums\[i\] += factor terms\[i\].
struct AddScaled<'a> {
    factor: DoubleDouble,
    terms: &'a [DoubleDouble],
    sums: &'a mut [DoubleDouble],
}

impl Kernel for AddScaled<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        for (sum, term) in self.sums.iter_mut().zip(self.terms) {
            *sum = *sum + self.factor * *term;
        }
    }
}

/// out\[i\] = a\[i\] + b\[i\].
struct Sum<'a> {
    a: &'a [DoubleDouble],
    b: &'a [DoubleDouble],
    out: &'a mut [DoubleDouble],
}

impl Kernel for Sum<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        for (out, (a, b)) in self.out.iter_mut().zip(self.a.iter().zip(self.b)) {
            *out = *a + *b;
        }
    }
}
