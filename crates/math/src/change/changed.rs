//! A number at a reference together with its changes: it carries with it what [`Change`](super::Change) reads from a
//! tape.
//!
//! Sums and products of such numbers are numbers of their kind, so they serve as coefficients of power series: the
//! series of a formula and of its difference from the reference come from the same recurrences, and no two nearly equal
//! numbers are subtracted.

use super::rules::{self, Kept};
use crate::lanes::{Lanes, lane_by_lane};
use crate::number::Number;
use crate::series::{Coefficient, sign_of};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A value at the reference, and the differences of `W` pedestrians from it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Changed<const W: usize> {
    /// At the reference, in any unit.
    pub value: f64,
    /// The differences from it, in the same unit.
    pub change: Lanes<W>,
}

impl<const W: usize> Neg for Changed<W> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Changed { value: -self.value, change: -self.change }
    }
}

/// An operation that is linear in both operands, and the same with a constant.
macro_rules! linear {
    ($trait:ident, $name:ident, $operator:tt) => {
        impl<const W: usize> $trait for Changed<W> {
            type Output = Self;
            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                Changed { value: self.value $operator other.value, change: self.change $operator other.change }
            }
        }

        impl<const W: usize> $trait<f64> for Changed<W> {
            type Output = Self;
            #[inline(always)]
            fn $name(self, other: f64) -> Self {
                Changed { value: self.value $operator other, ..self }
            }
        }
    };
}

linear!(Add, add, +);
linear!(Sub, sub, -);

impl<const W: usize> Mul<f64> for Changed<W> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: f64) -> Self {
        Changed { value: self.value * factor, change: self.change * factor }
    }
}

impl<const W: usize> Div<f64> for Changed<W> {
    type Output = Self;
    #[inline(always)]
    fn div(self, divisor: f64) -> Self {
        Changed { value: self.value / divisor, change: self.change * (1.0 / divisor) }
    }
}

impl<const W: usize> Mul for Changed<W> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        let (a, b) = (self.value, other.value);
        // as the rule of a product has it
        Changed { value: a * b, change: self.change * (other.change + b) + other.change * a }
    }
}

impl<const W: usize> Div for Changed<W> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        let kept = Kept::of_quotient(self.value, other.value);
        let change = lane_by_lane!(a of self.change, b of other.change => rules::quotient(&kept, a, b));
        Changed { value: self.value / other.value, change }
    }
}

/// A function of a number: its value, the values it stores of the reference, and its rule for changes. It is not part
/// of a kernel: functions are needed only at order 0, so they are compiled once.
#[inline(never)]
fn apply(
    number: f64,
    changes: &mut [f64],
    value: impl Fn(f64) -> f64,
    kept: impl Fn(f64) -> Kept,
    rule: impl Fn(&Kept, f64) -> f64,
) -> f64 {
    let kept = kept(number);
    changes.iter_mut().for_each(|change| *change = rule(&kept, *change));
    value(number)
}

/// The functions, each with the values it stores and its rule.
macro_rules! functions {
    ($($name:ident, $kept:ident, $rule:ident;)*) => {
        $(#[inline(always)]
        fn $name(mut self) -> Self {
            self.value = apply(self.value, &mut self.change.0, Number::$name, Kept::$kept, rules::$rule);
            self
        })*
    };
}

impl<const W: usize> Number for Changed<W> {
    functions! {
        recip, of_recip, recip;
        ln, of_ln, ln;
        ln_1p, of_ln_1p, ln;
        sqrt, of_sqrt, sqrt;
        tanh, of_tanh, tanh;
        softplus, of_softplus, softplus;
        abs, of_abs, abs;
        exp, of_exp, exp_of_any;
        exp_m1, of_exp, exp_of_any;
    }

    #[inline(always)]
    fn powi(mut self, n: i32) -> Self {
        let (value, kept) = (|x| Number::powi(x, n), |x| Kept::of_whole_power(x, n));
        self.value = apply(self.value, &mut self.change.0, value, kept, |kept, a| rules::whole_power(kept, a, n));
        self
    }

    #[inline(always)]
    fn powf(mut self, q: f64) -> Self {
        let (value, kept) = (|x| Number::powf(x, q), |x| Kept::of_power(x, q));
        self.value = apply(self.value, &mut self.change.0, value, kept, |kept, a| rules::power(kept, a, q));
        self
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        let kept = Kept::of_pair(self.value, other.value);
        let change = lane_by_lane!(a of self.change, b of other.change => rules::min(&kept, a, b));
        Changed { value: Number::min(self.value, other.value), change }
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        let kept = Kept::of_pair(self.value, other.value);
        let change = lane_by_lane!(a of self.change, b of other.change => rules::max(&kept, a, b));
        Changed { value: Number::max(self.value, other.value), change }
    }
}

impl<const W: usize> Coefficient for Changed<W> {
    #[inline(always)]
    fn choose(sign: Self, first: Self, second: Self) -> Self {
        let took_second = sign.value < 0.0;
        let (taken, other) = if took_second { (second, first) } else { (first, second) };
        let apart = other.value - taken.value;
        let mut change = taken.change;
        for lane in 0..W {
            // where the pedestrian takes the other one, the two are apart by what they were, too
            let is_other = (sign.value + sign.change.0[lane] < 0.0) != took_second;
            change.0[lane] = if is_other { other.change.0[lane] + apart } else { taken.change.0[lane] };
        }
        Changed { value: taken.value, change }
    }

    #[inline(always)]
    fn sign(known: Self, number: Self) -> Self {
        let of = |known: f64, a: f64| if known == 0.0 { sign_of(a) } else { known };
        let value = of(known.value, number.value);
        let mut change = known.change;
        for lane in 0..W {
            let (known, a) = (known.value + known.change.0[lane], number.value + number.change.0[lane]);
            change.0[lane] = of(known, a) - value;
        }
        Changed { value, change }
    }
}
