//! Sharp bends of the right-hand side, and steps that would cross one unnoticed.
//!
//! A stage, a coefficient or an error estimate knows of a bend only what the step samples of it. A step from one side
//! of a narrow bend to the other, or into it and back, may sample nothing: every estimate is then that of another
//! equation. The system therefore reports its distance from its bends, in units of their width ([`System::bends`]), and
//! a step that touches one may not be long on that scale.

use crate::system::System;
use math::simd::{Kernel, dispatch};

/// The arguments of all bends at both ends of a step, with their rates.
pub(crate) struct Bends {
    before: Arguments,
    after: Arguments,
}

#[derive(Clone)]
struct Arguments {
    values: Vec<f64>,
    rates: Vec<f64>,
}

/// A bend is not felt beyond this argument: the smooth ramp's tail, `exp(-EDGE)`, is below the rounding of a double.
const EDGE: f64 = 37.0;

/// By so much an argument may change in a step that touches the bend. The bend itself is a few units wide, which the
/// stages of a step of this length, or its coefficients, see.
const LIMIT: f64 = 8.0;

/// Number of parts in which the path between the ends is examined.
const PARTS: u32 = 32;

impl Bends {
    /// The bends of a system at its start; `None` if it has none.
    pub(crate) fn new(system: &dyn System, state: &[f64], rates: &[f64]) -> Option<Bends> {
        let count = system.bends();
        let arguments = Arguments { values: vec![0.0; count], rates: vec![0.0; count] };
        let mut bends = Bends { before: arguments.clone(), after: arguments };
        bends.before.read(system, state, rates);
        (count > 0).then_some(bends)
    }

    /// The part of a step of length `h` after which it has to end, less than 1, if it is too long for a bend; its end
    /// is at this state with these rates.
    pub(crate) fn shortened(&mut self, system: &dyn System, state: &[f64], rates: &[f64], h: f64) -> Option<f64> {
        self.after.read(system, state, rates);
        let (before, after) = (&self.before, &self.after);
        if !dispatch(MayPass { before, after, h }) {
            return None;
        }
        let paths = (0..before.values.len()).filter_map(|i| {
            Path::new([before.values[i], h * before.rates[i], after.values[i], h * after.rates[i]]).end()
        });
        let first = paths.fold(1.0, |first, end| if end < first { end } else { first });
        (first < 1.0).then_some(first)
    }

    /// Continues from the end of the last step examined.
    pub(crate) fn advance(&mut self) {
        std::mem::swap(&mut self.before, &mut self.after);
    }
}

impl Arguments {
    fn read(&mut self, system: &dyn System, state: &[f64], rates: &[f64]) {
        system.bend_arguments(state, rates, &mut self.values, &mut self.rates);
    }
}

/// Whether a step may pass a bend: by the control points of the cubics through both ends, which bound them.
struct MayPass<'a> {
    before: &'a Arguments,
    after: &'a Arguments,
    h: f64,
}

impl Kernel for MayPass<'_> {
    type Output = bool;

    #[inline(always)]
    fn run(self) -> bool {
        let third = self.h / 3.0;
        let starts = self.before.values.iter().zip(&self.before.rates);
        let ends = self.after.values.iter().zip(&self.after.rates);
        let mut count = 0;
        for ((start, leaving), (end, arriving)) in starts.zip(ends) {
            let points = [*start, start + third * leaving, end - third * arriving, *end];
            let low = lower(lower(points[0], points[1]), lower(points[2], points[3]));
            let high = -lower(lower(-points[0], -points[1]), lower(-points[2], -points[3]));
            let is_long = u64::from(high - start > LIMIT) | u64::from(start - low > LIMIT);
            count += is_long & u64::from(low < EDGE) & u64::from(high > -EDGE);
        }
        count > 0
    }
}

/// The lower of two numbers, as a selection that vectorises.
#[inline(always)]
fn lower(a: f64, b: f64) -> f64 {
    if b < a { b } else { a }
}

/// The cubic through both ends of a step.
struct Path {
    start: f64,
    change: f64,
    bend_before: f64,
    bend_after: f64,
}

impl Path {
    /// From values and slopes (per step) at both ends.
    fn new([start, leaving, end, arriving]: [f64; 4]) -> Path {
        let change = end - start;
        Path { start, change, bend_before: leaving - change, bend_after: change - arriving }
    }

    fn at(&self, theta: f64) -> f64 {
        let there = theta * (1.0 - theta);
        self.start + (theta * self.change + there * ((1.0 - theta) * self.bend_before + theta * self.bend_after))
    }

    /// The fraction at which a step has touched the bend and gone as far as it may; `None` if it does neither.
    fn end(&self) -> Option<f64> {
        let place = |part: u32| f64::from(part) / f64::from(PARTS);
        let feels = |x: f64| x.abs() < EDGE || (x < 0.0) != (self.start < 0.0);
        let mut has_felt = feels(self.start);
        for part in 1..=PARTS {
            let is_past = |theta: f64| {
                let x = self.at(theta);
                (has_felt || feels(x)) && (x - self.start).abs() > LIMIT
            };
            if is_past(place(part)) {
                return Some(last_before(place(part - 1), place(part), &is_past));
            }
            has_felt |= feels(self.at(place(part)));
        }
        None
    }
}

/// The last number before `is_past` holds, which it does at `past` and not at `before`.
fn last_before(mut before: f64, mut past: f64, is_past: &dyn Fn(f64) -> bool) -> f64 {
    loop {
        let middle = 0.5 * (before + past);
        if middle <= before || middle >= past {
            return before;
        }
        if is_past(middle) { past = middle } else { before = middle }
    }
}

#[cfg(test)]
mod tests {
    use super::{EDGE, LIMIT, Path};

    /// The end of the straight path between two arguments.
    fn straight(from: f64, to: f64) -> Option<f64> {
        Path::new([from, to - from, to, to - from]).end()
    }

    #[test]
    fn a_long_path_ends_where_it_comes_to_the_bend() {
        for (from, to) in [(1000.0, -1000.0), (-1000.0, 1000.0), (1000.0, 0.0), (1e6, -1e7)] {
            let end = straight(from, to).expect("it is too long");
            assert!((from + end * (to - from)).abs() - EDGE < 1e-8 * (from - to).abs(), "{from} to {to}: {end}");
        }
        // from within the bend, or next to it, it goes as far as it may
        for (from, to) in [(0.0, 1000.0), (5.0, -400.0), (EDGE + 1.0, -500.0)] {
            let end = straight(from, to).expect("it is too long");
            assert!((end * (to - from).abs() - LIMIT).abs() < 1e-9, "{from} to {to}: {end}");
        }
    }

    #[test]
    fn paths_beside_the_bend_and_short_ones_are_free() {
        for (from, to) in [(1000.0, 50.0), (-50.0, -1e9), (3.0, -3.0), (EDGE, EDGE - LIMIT)] {
            assert_eq!(straight(from, to), None, "{from} to {to}");
        }
    }

    #[test]
    fn a_dip_into_the_bend_between_two_ends_is_seen() {
        // from 100 down to 100 - 400 / 4 = 0 and back; and not so deep
        assert!(Path::new([100.0, -400.0, 100.0, 400.0]).end().is_some());
        assert_eq!(Path::new([100.0, -200.0, 100.0, 200.0]).end(), None);
    }
}
