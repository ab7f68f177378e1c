//! Sums of the series, over blocks of components.

use crate::rows::LINE;
use math::simd::Kernel;
use std::ops::Range;

/// Writes the first two rows of coefficients.
pub(super) struct Begin<'a> {
    pub(super) state: &'a [f64],
    pub(super) rates: &'a [f64],
    pub(super) unit: f64,
    pub(super) first: [&'a mut [f64]; 2],
}

impl Kernel for Begin<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let [states, rates] = self.first;
        let known = self.state.iter().zip(self.rates);
        for ((state, rate), known) in states.iter_mut().zip(rates).zip(known) {
            (*state, *rate) = (*known.0, self.unit * known.1);
        }
    }
}

/// Writes `c_1 h + c_2 h^2 + ...` (Horner) of the components from `from` on, to which `WHOLE` adds `c_0`.
pub(crate) struct Change<'a, const WHOLE: bool> {
    pub(crate) rows: &'a [f64],
    /// Length of a row.
    pub(crate) n: usize,
    pub(crate) from: usize,
    pub(crate) h: f64,
    pub(crate) result: &'a mut [f64],
}

impl<const WHOLE: bool> Change<'_, WHOLE> {
    /// Where the second wide block begins: as far behind the first as it can where rows begin a line of the cache.
    #[inline(always)]
    fn second(&self) -> usize {
        let to_line = self.rows[self.from..].as_ptr().align_offset(LINE * size_of::<f64>());
        if self.n.is_multiple_of(LINE) && to_line < LINE { WIDE - (WIDE - to_line) % LINE } else { WIDE }
    }

    #[inline(always)]
    fn lanes<const LANES: usize>(&mut self, from: usize) {
        let mut sum = [0.0; LANES];
        let (first, others) = self.rows.split_at(self.n);
        for row in others.rchunks_exact(self.n) {
            for (sum, coefficient) in sum.iter_mut().zip(&row[self.from + from..][..LANES]) {
                *sum = (*sum + coefficient) * self.h;
            }
        }
        if WHOLE {
            for (sum, before) in sum.iter_mut().zip(&first[self.from + from..][..LANES]) {
                *sum += before;
            }
        }
        self.result[from..][..LANES].copy_from_slice(&sum);
    }
}

impl<const WHOLE: bool> Kernel for Change<'_, WHOLE> {
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
        if n >= WIDE {
            // each sum waits for itself: more of them at a time
            self.lanes::<WIDE>(0);
            for from in (self.second()..n).step_by(WIDE) {
                self.lanes::<WIDE>(from.min(n - WIDE));
            }
            return;
        }
        for from in (0..n).step_by(LANES) {
            // the last block begins earlier rather than be cut: what is written twice is the same
            self.lanes::<LANES>(from.min(n - LANES));
        }
    }
}

/// Writes `c_0 + c_1 h + c_2 h^2 + ...`, as [`Change`] does, for two lengths: a coefficient is loaded once for both,
/// and while one sum waits for itself the other goes on.
pub(super) struct Both<'a> {
    pub(super) rows: &'a [f64],
    /// Length of a row.
    pub(super) n: usize,
    pub(super) from: usize,
    pub(super) h: [f64; 2],
    pub(super) results: [&'a mut [f64]; 2],
}

impl Both<'_> {
    #[inline(always)]
    fn lanes<const LANES: usize>(&mut self, from: usize) {
        let mut sums = [[0.0; LANES]; 2];
        let (first, others) = self.rows.split_at(self.n);
        for row in others.rchunks_exact(self.n) {
            let row = &row[self.from + from..][..LANES];
            for (sum, h) in sums.iter_mut().zip(self.h) {
                for (sum, coefficient) in sum.iter_mut().zip(row) {
                    *sum = (*sum + coefficient) * h;
                }
            }
        }
        for (sum, result) in sums.iter_mut().zip(&mut self.results) {
            for (sum, before) in sum.iter_mut().zip(&first[self.from + from..][..LANES]) {
                *sum += before;
            }
            result[from..][..LANES].copy_from_slice(sum);
        }
    }
}

impl Kernel for Both<'_> {
    type Output = ();

    #[inline(always)]
    fn run(mut self) {
        let n = self.results[0].len();
        if n < FEWER {
            for from in 0..n {
                self.lanes::<1>(from);
            }
            return;
        }
        for from in (0..n).step_by(FEWER) {
            self.lanes::<FEWER>(from.min(n - FEWER));
        }
    }
}

/// Writes `c_1 h + 2 c_2 h^2 + 3 c_3 h^3 + ...`, the length of the step times the slope of the series, minus `length`
/// times the rates.
pub(super) struct Defect<'a> {
    /// That of order 1 first.
    pub(super) rows: &'a [f64],
    /// Length of a row.
    pub(super) n: usize,
    pub(super) range: Range<usize>,
    pub(super) h: f64,
    pub(super) length: f64,
    pub(super) rates: &'a [f64],
    pub(super) defect: &'a mut [f64],
}

impl Defect<'_> {
    #[inline(always)]
    fn lanes<const LANES: usize>(&mut self, from: usize) {
        let mut sum = [0.0; LANES];
        let order = self.rows.len() / self.n;
        for (k, row) in (1..=order).rev().zip(self.rows.rchunks_exact(self.n)) {
            let k = k as f64;
            for (sum, coefficient) in sum.iter_mut().zip(&row[from..][..LANES]) {
                *sum = (*sum + k * coefficient) * self.h;
            }
        }
        let defects = self.defect[from..][..LANES].iter_mut().zip(&self.rates[from..][..LANES]);
        for ((defect, rate), sum) in defects.zip(sum) {
            *defect = sum - self.length * rate;
        }
    }
}

impl Kernel for Defect<'_> {
    type Output = ();

    #[inline(always)]
    fn run(mut self) {
        let Range { start, end } = self.range;
        let count = end - start;
        // loops, not iterators: what these call would not be compiled for the registers of the kernel
        if count < LANES {
            for from in start..end {
                self.lanes::<1>(from);
            }
        } else if count < WIDE {
            for from in (start..end).step_by(LANES) {
                self.lanes::<LANES>(from.min(end - LANES));
            }
        } else {
            for from in (start..end).step_by(WIDE) {
                self.lanes::<WIDE>(from.min(end - WIDE));
            }
        }
    }
}

/// Components per iteration.
const LANES: usize = 16;
/// Components per iteration of a sum over all orders.
const WIDE: usize = 40;
/// Components per iteration of two such sums.
const FEWER: usize = 24;
