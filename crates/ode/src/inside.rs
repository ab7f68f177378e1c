//! The solution within a step of a Runge-Kutta method: the cubic through both ends, and nested terms.

use crate::dense::{Ends, Part, mend};
use crate::rows::Rows;
use math::simd::{Kernel, dispatch};

/// The interpolant at some fractions of a step, `c + theta^2 (1 - theta)^2 (r_0 + theta (r_1 + (1 - theta) (r_2 + theta
/// r_3 ...)))` with the Hermite polynomial `c` through states and rates at both ends.
#[derive(Clone, Copy)]
pub(crate) struct Inside<'a, const COUNT: usize> {
    pub(crate) ends: &'a Ends<'a>,
    pub(crate) thetas: [f64; COUNT],
    /// `r_0, r_1, ...`, one row each.
    pub(crate) nested: &'a Rows,
}

impl<const COUNT: usize> Inside<'_, COUNT> {
    /// Writes the components from `from` on, with the chord in place of what is not finite.
    pub(crate) fn write(self, from: usize, results: [&mut [f64]; COUNT]) {
        let (ends, thetas) = (self.ends, self.thetas);
        let mut values = results;
        if !dispatch(Write { inside: self, from, results: values.each_mut().map(|values| &mut **values) }) {
            for (theta, values) in thetas.into_iter().zip(values) {
                mend(ends, theta, Part { from, values });
            }
        }
    }
}

/// Writes them as they are; false where one is not finite.
struct Write<'a, const COUNT: usize> {
    inside: Inside<'a, COUNT>,
    from: usize,
    results: [&'a mut [f64]; COUNT],
}

impl<const COUNT: usize> Write<'_, COUNT> {
    /// The components `from .. from + LANES` of the results; returns whether they are finite.
    #[inline(always)]
    fn lanes<const LANES: usize>(&mut self, from: usize) -> bool {
        let Inside { ends, thetas, nested } = self.inside;
        let first = self.from + from;
        let (before, after) = (part::<LANES>(ends.before, first), part::<LANES>(ends.after, first));
        let (leaving, arriving) = (part::<LANES>(ends.rates_before, first), part::<LANES>(ends.rates_after, first));
        let (mut change, mut bend_before, mut bend_after) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
        for lane in 0..LANES {
            change[lane] = after[lane] - before[lane];
            bend_before[lane] = ends.h * leaving[lane] - change[lane];
            bend_after[lane] = change[lane] - ends.h * arriving[lane];
        }
        let mut is_finite = true;
        for (theta, result) in thetas.into_iter().zip(&mut self.results) {
            let there = theta * (1.0 - theta);
            let mut values = [0.0; LANES];
            for lane in 0..LANES {
                let bend = (1.0 - theta) * bend_before[lane] + theta * bend_after[lane];
                values[lane] = before[lane] + (theta * change[lane] + there * bend);
            }
            if nested.count() > 0 {
                let sum = self::nested::<LANES>(nested, theta, first);
                let quartic = theta * theta * (1.0 - theta) * (1.0 - theta);
                for lane in 0..LANES {
                    values[lane] += quartic * sum[lane];
                }
            }
            for value in values {
                is_finite &= value.abs() < f64::INFINITY;
            }
            result[from..][..LANES].copy_from_slice(&values);
        }
        is_finite
    }
}

#[inline(always)]
fn part<const LANES: usize>(row: &[f64], first: usize) -> [f64; LANES] {
    let mut part = [0.0; LANES];
    part.copy_from_slice(&row[first..][..LANES]);
    part
}

/// `r_0 + theta (r_1 + (1 - theta) (r_2 + theta r_3 ...))`.
#[inline(always)]
fn nested<const LANES: usize>(rows: &Rows, theta: f64, first: usize) -> [f64; LANES] {
    let (mut sum, odd) = ([0.0; LANES], 1.0 - theta);
    let mut factor = if rows.count() % 2 == 1 { theta } else { odd };
    for row in rows.iter().rev() {
        let row = &row[first..][..LANES];
        for lane in 0..LANES {
            sum[lane] = row[lane] + factor * sum[lane];
        }
        factor = if factor == theta { odd } else { theta };
    }
    sum
}

impl<const COUNT: usize> Kernel for Write<'_, COUNT> {
    type Output = bool;

    #[inline(always)]
    fn run(mut self) -> bool {
        let (n, mut is_finite) = (self.results[0].len(), true);
        if n < LANES {
            for from in 0..n {
                is_finite &= self.lanes::<1>(from);
            }
        } else {
            for from in (0..n).step_by(LANES) {
                // the last block begins earlier rather than be cut: what is written twice is the same
                is_finite &= self.lanes::<LANES>(from.min(n - LANES));
            }
        }
        is_finite
    }
}

/// Components per iteration.
const LANES: usize = 16;
