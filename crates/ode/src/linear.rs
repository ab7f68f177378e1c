//! Propagates a small difference from a solution by the linearised equations, for systems that provide them
//! ([`crate::System::tangent`]).

use crate::dense::Step;
use crate::system::{System, Tangent, TangentEnds};
use crate::taylor::forced;
use math::simd::{Kernel, dispatch};
use std::cell::RefCell;
use std::ops::Range;

/// The linearised equations over the step looked at last.
#[derive(Clone, Debug)]
pub(crate) struct Linear {
    /// Their coefficients at the start of the step and at its end; or in the step before and in this one.
    start: Vec<f64>,
    end: Vec<f64>,
    /// How fast differences move at most: at the end of the step, and in the whole of it.
    fastest_at_end: f64,
    fastest: f64,
    /// Whether `end` is known from the step before, whether it is a mean over the step rather than what holds at its
    /// end, and for how many more steps it may stand for theirs.
    is_known: bool,
    is_mean: bool,
    is_steady: bool,
    steady_for: u32,
    /// Whether they change so much over the step that a shift in time is carried apart.
    is_thrown: bool,
    /// How late the solution is: this part of the difference, a shift along the solution, is carried exactly. Of a
    /// motion that is thrown back by a wall all but a small rest is of this kind.
    late: f64,
    /// The components concerned.
    forced: Vec<Range<usize>>,
    scratch: RefCell<Scratch>,
}

#[derive(Clone, Debug, Default)]
struct Scratch {
    state: Vec<f64>,
    rates: Vec<f64>,
    /// The coefficients at a place within the step.
    there: Vec<f64>,
    room: Vec<f32>,
}

/// Differences that move by more than this within a step would cost more than the step.
const MOST_TURNS: f64 = 1000.0;

/// Coefficients that change by at most this fraction over a step are reused for a few more steps.
const STEADY: f64 = 0.01;
const STEADY_FOR: u32 = 3;

/// Where coefficients change by more than this fraction over a step, they do not do so linearly.
const THROWN: f64 = 0.1;

impl Linear {
    /// For a system; `None` if it does not provide its linearised equations.
    pub(crate) fn new(system: &dyn System) -> Option<Linear> {
        let (size, zeros) = (system.tangent_size(), vec![0.0; system.dimension()]);
        (size > 0).then(|| Linear {
            start: vec![0.0; size],
            end: vec![0.0; size],
            fastest_at_end: 0.0,
            fastest: 0.0,
            is_known: false,
            is_mean: false,
            is_steady: false,
            steady_for: 0,
            is_thrown: false,
            late: 0.0,
            forced: forced(system),
            scratch: RefCell::new(Scratch { state: zeros.clone(), rates: zeros, ..Scratch::default() }),
        })
    }

    /// Carries a difference, known at the start of a step, over the step; false where it moves too fast.
    pub(crate) fn carry(&mut self, step: &Step<'_>, error: &[f64], after: &mut [f64]) -> bool {
        self.look(step);
        let is_slow = self.fastest * step.length() <= MOST_TURNS;
        if is_slow {
            let rates = step.rates_before();
            self.late = if self.is_thrown { lateness(&self.forced, rates, error) } else { 0.0 };
            self.over(step, 1.0, error, after);
        }
        is_slow
    }

    /// Finds the coefficients over the step: those at both ends or, better, their mean.
    fn look(&mut self, step: &Step<'_>) {
        if !self.is_known {
            self.fastest_at_end = step.system.tangent(step.before(), &mut self.end);
            self.is_known = true;
        }
        let fastest = self.fastest_at_end;
        self.fastest = fastest;
        self.is_steady = self.steady_for > 0;
        if self.is_steady {
            // `end` is that of an earlier step, near enough
            (self.steady_for, self.is_thrown) = (self.steady_for - 1, false);
            return;
        }
        std::mem::swap(&mut self.start, &mut self.end);
        let (was_mean, ends) = (
            self.is_mean,
            TangentEnds { states: [step.before(), step.after()], rates: [step.rates_before(), step.rates_after()] },
        );
        let mean = step.system.mean_tangent(ends, &self.start, &mut self.end);
        let mean = mean.filter(|mean| mean.change <= THROWN);
        self.is_mean = mean.is_some();
        let change = if let Some(mean) = mean {
            (self.fastest, self.fastest_at_end) = (mean.fastest, mean.fastest);
            mean.change
        } else {
            // along a sharp bend a mean says too little
            if was_mean {
                self.fastest = step.system.tangent(step.before(), &mut self.start);
            }
            self.fastest_at_end = step.system.tangent(step.after(), &mut self.end);
            self.fastest = if self.fastest_at_end <= self.fastest { self.fastest } else { self.fastest_at_end };
            self.compare()
        };
        self.steady_for = if change <= STEADY { STEADY_FOR } else { 0 };
        self.is_thrown = change > THROWN;
    }

    /// By which part the coefficients change.
    fn compare(&self) -> f64 {
        let [change, size] = dispatch(Largest { one: &self.end, other: &self.start });
        if change == 0.0 { 0.0 } else { change / size }
    }

    /// Writes the difference at the fraction `theta` of the step, less what the solution is late, of what was there at
    /// its start.
    fn over(&self, step: &Step<'_>, theta: f64, error: &[f64], result: &mut [f64]) {
        if self.late == 0.0 {
            result.copy_from_slice(error);
        } else {
            dispatch(Unshifted { error, rates: step.rates_before(), late: self.late, result });
        }
        let Scratch { there, room, .. } = &mut *self.scratch.borrow_mut();
        let (start, end) = match (self.is_steady || self.is_mean, theta == 1.0) {
            (true, _) => (&self.end[..], &[][..]),
            (false, true) => (&self.start[..], &self.end[..]),
            (false, false) => {
                there.clear();
                there.extend(self.start.iter().zip(&self.end).map(|(start, end)| start + theta * (end - start)));
                (&self.start[..], &there[..])
            }
        };
        let length = theta * step.length();
        step.system.carry(Tangent { start, end, length, fastest: self.fastest, room }, result);
    }

    /// Adds to the difference that was carried over the step what the solution is late, and what the step has added:
    /// its own error, and this part of its change with the sign of the error at its start.
    pub(crate) fn end(&self, step: &Step<'_>, own: &[f64], rounding: f64, error: &[f64], after: &mut [f64]) {
        let (states, rates) = ([step.before(), step.after()], step.rates_after());
        if self.late == 0.0 {
            dispatch(Arrived::<false> { late: 0.0, rates, own, rounding, states, error, after });
        } else {
            dispatch(Arrived::<true> { late: self.late, rates, own, rounding, states, error, after });
        }
        // what does not belong there grows by roundings
        if !self.is_steady {
            step.system.constrain(after);
        }
    }

    /// Writes the difference at the fraction `theta` of the step, of what was there at its start.
    pub(crate) fn at(&self, step: &mut Step<'_>, theta: f64, error: &[f64], result: &mut [f64]) {
        self.over(step, theta, error, result);
        let Scratch { state, rates, .. } = &mut *self.scratch.borrow_mut();
        step.at_fraction(theta, state);
        step.rates_of(state, rates);
        result.iter_mut().zip(rates).for_each(|(result, rate)| *result += self.late * *rate);
    }
}

/// What a shift in time carries is at most so many times the difference: what remains would be the difference of two
/// far larger numbers, of which the series has two digits.
const MOST_LATE: f64 = 10.0;

/// The shift in time that makes most of a difference.
fn lateness(components: &[Range<usize>], rates: &[f64], error: &[f64]) -> f64 {
    let sizes = |range: Range<usize>| {
        let sizes = Sizes { one: &rates[range.clone()], other: &error[range.clone()] };
        // of a few, a call would take longer than the work
        if range.len() < LANES { sizes.run() } else { dispatch(sizes) }
    };
    let scale = components.iter().fold(0.0, |scale, range| {
        let own = sizes(range.clone())[0];
        if own <= scale { scale } else { own }
    });
    let share = 1.0 / scale;
    let (mut along, mut squares) = (0.0, 0.0);
    for range in components {
        let products = Products { rates: &rates[range.clone()], error: &error[range.clone()], share };
        let sums = if range.len() < LANES { products.run() } else { dispatch(products) };
        (along, squares) = (along + sums[0], squares + sums[1]);
    }
    let late = along / squares * share;
    // of a slow motion it may be far more than the error of what moves on
    let [fastest, largest] = sizes(0..rates.len());
    let is_part = late.abs() * fastest <= MOST_LATE * largest;
    if is_part { late } else { 0.0 }
}

/// Numbers per iteration.
const LANES: usize = 8;

/// The largest absolute values of two rows; NaN counts for nothing.
struct Sizes<'a> {
    one: &'a [f64],
    other: &'a [f64],
}

impl Kernel for Sizes<'_> {
    type Output = [f64; 2];

    #[inline(always)]
    fn run(self) -> [f64; 2] {
        in_lanes(self.one, self.other, |one, other| [one, other])
    }
}

/// The largest absolute values of the difference of two rows and of the first; NaN counts for nothing.
struct Largest<'a> {
    one: &'a [f64],
    other: &'a [f64],
}

impl Kernel for Largest<'_> {
    type Output = [f64; 2];

    #[inline(always)]
    fn run(self) -> [f64; 2] {
        in_lanes(self.one, self.other, |one, other| [one - other, one])
    }
}

/// The largest absolute values of two functions of two rows.
#[inline(always)]
fn in_lanes(one: &[f64], other: &[f64], of: impl Fn(f64, f64) -> [f64; 2]) -> [f64; 2] {
    let mut most = [[0.0; LANES]; 2];
    let mut take = |lane: usize, one: f64, other: f64| {
        for (most, value) in most.iter_mut().zip(of(one, other)) {
            let size = value.abs();
            most[lane] = if size > most[lane] { size } else { most[lane] };
        }
    };
    let (ones, rest) = one.as_chunks::<LANES>();
    let (others, other_rest) = other.as_chunks::<LANES>();
    for (one, other) in ones.iter().zip(others) {
        for lane in 0..LANES {
            take(lane, one[lane], other[lane]);
        }
    }
    for (one, other) in rest.iter().zip(other_rest) {
        take(0, *one, *other);
    }
    // half against half: one after the other each comparison would wait for the last
    let mut half = LANES / 2;
    while half > 0 {
        for most in &mut most {
            for lane in 0..half {
                most[lane] = if most[lane + half] > most[lane] { most[lane + half] } else { most[lane] };
            }
        }
        half /= 2;
    }
    [most[0][0], most[1][0]]
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
        let (mut along, mut squares) = ([0.0; LANES], [0.0; LANES]);
        let mut take = |lane: usize, rate: f64, error: f64| {
            let rate = rate * self.share;
            along[lane] += rate * error;
            squares[lane] += rate * rate;
        };
        let (rates, rest) = self.rates.as_chunks::<LANES>();
        let (errors, other_rest) = self.error.as_chunks::<LANES>();
        for (rate, error) in rates.iter().zip(errors) {
            for lane in 0..LANES {
                take(lane, rate[lane], error[lane]);
            }
        }
        for (rate, error) in rest.iter().zip(other_rest) {
            take(0, *rate, *error);
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

/// Adds `late * rates` if `LATE`, the own error and the rounding of a step to a difference.
struct Arrived<'a, const LATE: bool> {
    late: f64,
    rates: &'a [f64],
    own: &'a [f64],
    rounding: f64,
    states: [&'a [f64]; 2],
    error: &'a [f64],
    after: &'a mut [f64],
}

impl<const LATE: bool> Kernel for Arrived<'_, LATE> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Arrived { late, rates, own, rounding, states: [before, now], error, after } = self;
        let states = before.iter().zip(now).zip(error);
        let added = rates.iter().zip(own).zip(states);
        for (after, ((rate, own), ((before, now), error))) in after.iter_mut().zip(added) {
            let carried = if LATE { *after + late * rate } else { *after };
            *after = carried + (own + (rounding * (now - before).abs()).copysign(*error));
        }
    }
}
