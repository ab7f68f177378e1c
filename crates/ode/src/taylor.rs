//! Taylor's method: the series of the solution about the start of a step, to an order that suits the tolerance.
//!
//! The system gives the coefficients by recurrence ([`crate::System::series`]). The last two of them determine the step
//! in advance, so that none is rejected, and the series itself is the solution inside the step (A. Jorba, M. Zou, *A
//! software package for the numerical integration of ODEs by means of high-order Taylor methods*, Experimental
//! Mathematics 14 (2005) 99).

use crate::control::{Control, Norm};
use crate::dense::{Ends, Part, Stepper, Trial};
use crate::kinks::Kinks;
use crate::system::System;
use math::lane;
use math::simd::{Kernel, dispatch};
use std::ops::Range;

pub(crate) struct Taylor {
    order: usize,
    dimension: usize,
    /// Unit of time of the coefficients, a power of 2 near the length of the steps: in units far from it the coefficients
    /// of high orders would overflow near a blow-up.
    unit: f64,
    /// That of the next expansion.
    next_unit: f64,
    /// The step that was proposed last.
    proposed: f64,
    /// The kinks on which steps end, if the system has any.
    kinks: Option<Kinks>,
    /// Rows of coefficients, that of order 0 first, from `begin` on.
    coefficients: Vec<f64>,
    /// So that the components with a force, of which samples and defects are computed, begin with a line of the cache.
    begin: usize,
    /// Length of a row.
    row: usize,
    /// The size of the row of the last order, in units of the tolerance.
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

/// The order at a fixed step: higher ones gain nothing in double precision.
pub(crate) const HIGHEST: usize = 24;

/// The order for a tolerance. The step grows as tolerance^(1 / order), the work for it with the order and its square: half
/// the natural logarithm of the tolerance, and a few more for what a step costs besides. Constants from the times of the
/// scenes of figures 4 and 11; the minimum is flat: two orders more or less cost 2 %.
fn order(control: Control) -> usize {
    match control {
        Control::Fixed { .. } => HIGHEST,
        Control::Adaptive { tolerance } => {
            let best = OFFSET - PER_E_FOLD * math::ln(tolerance);
            (best.round() as usize).clamp(4, HIGHEST)
        }
    }
}

/// Orders gained for a tolerance smaller by a factor of e.
const PER_E_FOLD: f64 = 0.45;
/// The order for a tolerance of 1.
const OFFSET: f64 = 6.0;

impl Taylor {
    pub(crate) fn new(system: &dyn System, control: Control) -> Taylor {
        let (order, dimension, row) = (order(control), system.dimension(), system.row_length());
        let zeros = |count: usize| vec![0.0; count];
        let forced = forced(system);
        let mut coefficients = zeros((order + 1) * row + LINE - 1);
        let begin = aligned(&coefficients, forced.first().map_or(0, |range| range.start));
        coefficients.truncate(begin + (order + 1) * row);
        let (defect, missing) = (zeros(dimension), zeros(dimension));
        Taylor {
            order,
            dimension,
            unit: 1.0,
            next_unit: 1.0,
            proposed: 1.0,
            kinks: Kinks::new(system, order),
            coefficients,
            begin,
            row,
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
        let rows = &mut self.coefficients[self.begin..];
        let (states, others) = rows.split_at_mut(self.row);
        dispatch(Begin { state, rates, unit: self.unit, first: [&mut states[..n], &mut others[..n]] });
        system.series(self.order, self.unit, rows);
    }

    fn rows(&self) -> &[f64] {
        &self.coefficients[self.begin..]
    }

    fn row(&self, k: usize) -> &[f64] {
        &self.rows()[k * self.row..][..self.dimension]
    }
}

impl Stepper for Taylor {
    fn try_step(&mut self, system: &dyn System, from: Trial<'_>, change: &mut [f64], norm: Option<&Norm>) -> f64 {
        // an adaptive step has its series from the proposal of its length, a shorter try after a rejection too
        if norm.is_none() {
            self.expand(system, from.state, from.rates);
        }
        // a step may end far earlier than its series allows, which of a polynomial is never: in that unit the coefficients of
        // the next expansion would overflow
        if from.h < self.proposed {
            self.next_unit = power_of_two(from.h);
        }
        let h = from.h / self.unit;
        dispatch(Change::<false> { rows: self.rows(), n: self.row, from: 0, h, result: change });
        norm.map_or(0.0, |_| (0..self.order).fold(self.last_size, |error, _| error * h))
    }

    fn propose(&mut self, system: &dyn System, state: &[f64], rates: &[f64], norm: &Norm) -> Option<f64> {
        self.expand(system, state, rates);
        self.last_size = norm.of(self.row(self.order));
        let last = growth(self.last_size, self.order)?;
        let before = growth(norm.of(self.row(self.order - 1)), self.order - 1)?;
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

    fn evaluations(&self) -> u64 {
        self.order as u64 - 1
    }

    fn defect(&mut self, ends: &Ends<'_>, norm: &Norm) -> f64 {
        let h = ends.h / self.unit;
        let rows = &self.coefficients[self.begin + self.row..];
        let (Some(first), Some(last)) = (self.forced.first(), self.forced.last()) else { return 0.0 };
        let range = first.start..last.end;
        let (n, length, rates) = (self.row, ends.h, ends.rates_after);
        dispatch(Defect { rows, n, range, h, length, rates, defect: &mut self.defect });
        for pair in self.forced.windows(2) {
            self.defect[pair[0].end..pair[1].start].fill(0.0);
        }
        self.has_defect = true;
        norm.of(&self.defect)
    }

    /// What follows the last order. For components with a force it follows from the defect, which was computed when the
    /// step was accepted. For position-like ones two orders are known: the first follows from the last order of speeds,
    /// the second from what the speeds lack. The first alone may vanish by chance, or by symmetry.
    fn own_error(&mut self, system: &dyn System, ends: &Ends<'_>, error: &mut [f64]) -> bool {
        if !self.has_defect {
            return false;
        }
        let (Some(first), Some(last)) = (self.forced.first(), self.forced.last()) else { return false };
        let range = first.start..last.end;
        let next = (self.order + 1) as f64;
        let of_last = -ends.h / next * power(ends.h / self.unit, self.order);
        let of_defect = ends.h / ((next + 1.0) * next);
        let last = &self.coefficients[self.begin + self.order * self.row..][range.clone()];
        let (defect, missing) = (&self.defect[range.clone()], &mut self.missing[range.clone()]);
        // position-like components among them are written anew
        let factors = [1.0 / next, of_last, of_defect];
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
        for (row, own) in rows.chunks_exact_mut(n).zip(self.rows().chunks_exact(self.row)).skip(1) {
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
        dispatch(Change::<true> { rows: self.rows(), n: self.row, from, h, result });
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
        dispatch(Both { rows: self.rows(), n: self.row, from, h, results });
        Some(0)
    }
}

/// A whole power.
fn power(mut base: f64, mut exponent: usize) -> f64 {
    let mut power = 1.0;
    while exponent > 0 {
        if exponent % 2 == 1 {
            power *= base;
        }
        base *= base;
        exponent /= 2;
    }
    power
}

/// The largest power of 2 that is not above a normal number.
fn power_of_two(number: f64) -> f64 {
    const EXPONENT: u64 = 0x7ff0_0000_0000_0000;
    f64::from_bits(number.to_bits() & EXPONENT)
}

/// The logarithm of the step over which a term of order `k` with this coefficient, in units of the tolerance, grows to 1, with
/// the other sign. `None` for a coefficient that is not finite; for one that vanishes, of a step beyond every run.
fn growth(coefficient: f64, k: usize) -> Option<f64> {
    let clamped = math::smaller(math::larger(coefficient, LEAST), MOST);
    coefficient.is_finite().then(|| lane::ln(clamped) / k as f64)
}

/// Smaller coefficients are taken for this one.
const LEAST: f64 = 1e-300;
/// Larger ones for this one: the step is rejected then.
const MOST: f64 = 1e300;

/// A kink is passed by so much of the tolerance, and at least by so many roundings.
const SLACK: f64 = 0.1;
const ROUNDINGS: f64 = 4.0;

/// A step that a kink ends is the measure for the next one if it is no shorter than this, in units of the last one.
const TELLING: f64 = 1e-4;

/// The step is so much shorter than that at which the last term meets the tolerance.
const SAFETY: f64 = 0.95;

/// Writes the first two rows of coefficients.
struct Begin<'a> {
    state: &'a [f64],
    rates: &'a [f64],
    unit: f64,
    first: [&'a mut [f64]; 2],
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

/// Writes `c_0 + c_1 h + c_2 h^2 + ...`, as [`Change`] does, for two lengths: a coefficient is loaded once for both, and
/// while one sum waits for itself the other goes on.
struct Both<'a> {
    rows: &'a [f64],
    /// Length of a row.
    n: usize,
    from: usize,
    h: [f64; 2],
    results: [&'a mut [f64]; 2],
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

/// Writes `c_1 h + 2 c_2 h^2 + 3 c_3 h^3 + ...`, the length of the step times the slope of the series, minus `length` times
/// the rates.
struct Defect<'a> {
    /// That of order 1 first.
    rows: &'a [f64],
    /// Length of a row.
    n: usize,
    range: Range<usize>,
    h: f64,
    length: f64,
    rates: &'a [f64],
    defect: &'a mut [f64],
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

/// The components that are not position-like.
pub(crate) fn forced(system: &dyn System) -> Vec<Range<usize>> {
    let mut positions = system.positions();
    positions.sort_by_key(|range| range.start);
    let starts = std::iter::once(0).chain(positions.iter().map(|range| range.end));
    let ends = positions.iter().map(|range| range.start).chain([system.dimension()]);
    starts.zip(ends).map(|(start, end)| start..end).filter(|range| !range.is_empty()).collect()
}

/// The least number of numbers to leave out of these, fewer than [`LINE`], so that the one of this index behind them begins a
/// line of the cache.
fn aligned(numbers: &[f64], index: usize) -> usize {
    let offset = numbers[index % LINE..].as_ptr().align_offset(LINE * size_of::<f64>());
    // where that is not known, anywhere will do
    if offset < LINE { offset } else { 0 }
}

/// Doubles of a line of the cache: what lies across two of them is read and written in two goes.
const LINE: usize = 8;
/// Components per iteration.
const LANES: usize = 16;
/// Components per iteration of a sum over all orders.
const WIDE: usize = 40;
/// Components per iteration of two such sums.
const FEWER: usize = 24;
