//! The kinds of numbers in which a formula can be evaluated: doubles, double-double numbers, a number with a difference
//! from it ([`Difference`]), and an unevaluated sum of two parts ([`Parted`]).
//!
//! A law is written once ([`crate::formula`]). In [`Difference`]s it gives what it gives in a uniform flow and by how
//! much a perturbed pedestrian differs from that, with all digits of the difference, be it 1e-200.

// the platform's functions, not those of `math`: a fault there must not appear on both sides of a comparison
#![allow(clippy::disallowed_methods)]

use math::double_double::{DoubleDouble, full};
use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// What a formula is made of.
pub trait Number:
    Copy
    + Debug
    + From<f64>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// The number, rounded to a double.
    fn value(self) -> f64;

    /// `e^x`.
    fn exp(self) -> Self;

    /// `ln(1 + e^x)`.
    fn softplus(self) -> Self;

    /// `ln(1 + x)` for `x > -1`.
    fn ln_1p(self) -> Self;

    /// `x^q` for `x > 0`.
    fn power(self, q: f64) -> Self;

    /// `e^x - 1`.
    fn exp_m1(self) -> Self;

    /// `ln x` for `x > 0`.
    fn ln(self) -> Self;

    /// The square root, for `x >= 0`.
    fn root(self) -> Self;

    /// The hyperbolic tangent.
    fn tanh(self) -> Self;

    /// `|x|`.
    fn size(self) -> Self;

    /// The smaller of two; the first of equal ones.
    fn smaller(self, other: Self) -> Self;

    /// `x^n` for any `x`, by multiplication.
    fn whole_power(self, n: i32) -> Self {
        let product = (0..n.unsigned_abs()).fold(Self::from(1.0), |product, _| product * self);
        if n < 0 { Self::from(1.0) / product } else { product }
    }

    /// The larger of two; the first of equal ones.
    fn larger(self, other: Self) -> Self {
        -(-self).smaller(-other)
    }
}

/// A number that can be the part of a [`Difference`], and the component of a state.
pub trait Real: Number {
    /// The size of one rounding, relative.
    const ROUNDING: f64;
}

impl Number for f64 {
    fn value(self) -> f64 {
        self
    }

    fn exp(self) -> f64 {
        f64::exp(self)
    }

    fn softplus(self) -> f64 {
        let rest = f64::ln_1p(f64::exp(-self.abs()));
        if self > 0.0 { self + rest } else { rest }
    }

    fn ln_1p(self) -> f64 {
        f64::ln_1p(self)
    }

    fn power(self, q: f64) -> f64 {
        f64::powf(self, q)
    }

    fn exp_m1(self) -> f64 {
        f64::exp_m1(self)
    }

    fn ln(self) -> f64 {
        f64::ln(self)
    }

    fn root(self) -> f64 {
        self.sqrt()
    }

    fn tanh(self) -> f64 {
        f64::tanh(self)
    }

    fn size(self) -> f64 {
        self.abs()
    }

    fn smaller(self, other: f64) -> f64 {
        if other < self || other.is_nan() { other } else { self }
    }
}

impl Real for f64 {
    const ROUNDING: f64 = 1.1e-16;
}

impl Number for DoubleDouble {
    fn value(self) -> f64 {
        self.into()
    }

    fn exp(self) -> DoubleDouble {
        full::exp(self)
    }

    fn softplus(self) -> DoubleDouble {
        full::softplus(self)
    }

    fn ln_1p(self) -> DoubleDouble {
        full::ln_1p(self)
    }

    fn power(self, q: f64) -> DoubleDouble {
        full::exp(full::ln(self) * q)
    }

    fn exp_m1(self) -> DoubleDouble {
        full::exp_m1(self)
    }

    fn ln(self) -> DoubleDouble {
        full::ln(self)
    }

    fn root(self) -> DoubleDouble {
        self.sqrt()
    }

    fn tanh(self) -> DoubleDouble {
        full::tanh(self)
    }

    fn size(self) -> DoubleDouble {
        if self.hi < 0.0 { -self } else { self }
    }

    fn smaller(self, other: DoubleDouble) -> DoubleDouble {
        if (other - self).hi < 0.0 || other.hi.is_nan() { other } else { self }
    }
}

impl Real for DoubleDouble {
    const ROUNDING: f64 = 1e-31;
}

/// The number `base + change`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Difference<T> {
    /// What it is compared with.
    pub base: T,
    /// How much it differs.
    pub change: T,
}

impl<T: Real> Difference<T> {
    /// The number itself, without its base.
    pub fn whole(self) -> T {
        self.base + self.change
    }

    /// A function of which the difference over a small change is known in closed form. Where the change is large
    /// nothing is lost by subtracting.
    fn map(self, is_small: bool, f: impl Fn(T) -> T, small: impl Fn(T, T) -> T) -> Difference<T> {
        let base = f(self.base);
        let change = if is_small { small(base, self.change) } else { f(self.whole()) - base };
        Difference { base, change }
    }

    /// Whether the change is small for a function that varies over 1.
    fn is_below_1(self) -> bool {
        self.change.value().abs() < 1.0
    }
}

impl<T: Real> From<f64> for Difference<T> {
    fn from(value: f64) -> Difference<T> {
        Difference { base: T::from(value), change: T::from(0.0) }
    }
}

impl<T: Real> Add for Difference<T> {
    type Output = Difference<T>;
    fn add(self, other: Difference<T>) -> Difference<T> {
        Difference { base: self.base + other.base, change: self.change + other.change }
    }
}

impl<T: Real> Sub for Difference<T> {
    type Output = Difference<T>;
    fn sub(self, other: Difference<T>) -> Difference<T> {
        Difference { base: self.base - other.base, change: self.change - other.change }
    }
}

impl<T: Real> Neg for Difference<T> {
    type Output = Difference<T>;
    fn neg(self) -> Difference<T> {
        Difference { base: -self.base, change: -self.change }
    }
}

impl<T: Real> Mul for Difference<T> {
    type Output = Difference<T>;
    fn mul(self, other: Difference<T>) -> Difference<T> {
        let change = self.change * other.whole() + self.base * other.change;
        Difference { base: self.base * other.base, change }
    }
}

impl<T: Real> Div for Difference<T> {
    type Output = Difference<T>;
    fn div(self, other: Difference<T>) -> Difference<T> {
        let base = self.base / other.base;
        Difference { base, change: (self.change - base * other.change) / other.whole() }
    }
}

impl<T: Real> Number for Difference<T> {
    fn value(self) -> f64 {
        self.whole().value()
    }

    fn exp(self) -> Difference<T> {
        self.map(self.is_below_1(), T::exp, |base, change| base * change.exp_m1())
    }

    /// Over a small change `c` it grows by `ln(1 + s (e^c - 1))`, where `s = 1 / (1 + e^-x)`; beyond 0 by `c` and what
    /// is left of `ln(1 + e^-x)`.
    fn softplus(self) -> Difference<T> {
        let (base, whole) = (self.base, self.whole());
        let tail = |x: T| (-x).exp().ln_1p();
        let change = if self.is_below_1() {
            let decay = if base.value() > 0.0 { (-base).exp() } else { base.exp() };
            let share = if base.value() > 0.0 { T::from(1.0) } else { decay } / (decay + T::from(1.0));
            (share * self.change.exp_m1()).ln_1p()
        } else if base.value() > 0.0 && whole.value() > 0.0 {
            self.change + (tail(whole) - tail(base))
        } else {
            whole.softplus() - base.softplus()
        };
        Difference { base: base.softplus(), change }
    }

    fn ln_1p(self) -> Difference<T> {
        let ratio = self.change / (self.base + T::from(1.0));
        self.map(true, T::ln_1p, |_, _| ratio.ln_1p())
    }

    fn power(self, q: f64) -> Difference<T> {
        let ratio = self.change / self.base;
        let is_small = ratio.value().abs() < 0.5;
        self.map(is_small, |x| x.power(q), |base, _| base * (ratio.ln_1p() * T::from(q)).exp_m1())
    }

    fn exp_m1(self) -> Difference<T> {
        let base = self.base;
        self.map(self.is_below_1(), T::exp_m1, |_, change| base.exp() * change.exp_m1())
    }

    fn ln(self) -> Difference<T> {
        let ratio = self.change / self.base;
        self.map(ratio.value().abs() < 0.5, T::ln, |_, _| ratio.ln_1p())
    }

    fn root(self) -> Difference<T> {
        let whole = self.whole().root();
        Difference { base: self.base.root(), change: self.change / (whole + self.base.root()) }
    }

    /// By the theorem of addition: `t (1 - tanh^2 x) / (1 + t tanh x)`, where `t` is the tangent of the change; `1 -
    /// tanh^2` from `e^-2|x|`.
    fn tanh(self) -> Difference<T> {
        let (one, size) = (T::from(1.0), self.base.size());
        let decay = (size * T::from(-2.0)).exp();
        let rest = T::from(4.0) * decay / ((one + decay) * (one + decay));
        self.map(self.is_below_1(), T::tanh, |base, change| {
            let tangent = change.tanh();
            tangent * rest / (one + tangent * base)
        })
    }

    fn size(self) -> Difference<T> {
        let (base, whole) = (self.base.value() < 0.0, self.whole().value() < 0.0);
        match (base, whole) {
            (false, false) => self,
            (true, true) => -self,
            _ => Difference { base: self.base.size(), change: self.whole().size() - self.base.size() },
        }
    }

    /// The two numbers may change places: then what remains is the difference of the one from the other's base.
    fn smaller(self, other: Difference<T>) -> Difference<T> {
        let between = other - self;
        let is_other = |part: T| part.value() < 0.0 || part.value().is_nan();
        let (at_base, at_whole) = (is_other(between.base), is_other(between.whole()));
        let base = if at_base { other.base } else { self.base };
        match (at_base, at_whole) {
            (false, false) => self,
            (true, true) => other,
            (false, true) => Difference { base, change: between.base + other.change },
            (true, false) => Difference { base, change: self.change - between.base },
        }
    }
}

/// The sum `base + rest`, added and subtracted part by part: `(2 + rest) - 2` is `rest`, however small. Everything else
/// is done to the sum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parted<T> {
    /// The constant part.
    pub base: T,
    /// The other part.
    pub rest: T,
}

impl<T: Real> Parted<T> {
    /// The sum.
    pub fn whole(self) -> T {
        self.base + self.rest
    }

    fn of(rest: T) -> Parted<T> {
        Parted { base: T::from(0.0), rest }
    }
}

impl<T: Real> From<f64> for Parted<T> {
    fn from(value: f64) -> Parted<T> {
        Parted { base: T::from(value), rest: T::from(0.0) }
    }
}

impl<T: Real> Add for Parted<T> {
    type Output = Parted<T>;
    fn add(self, other: Parted<T>) -> Parted<T> {
        Parted { base: self.base + other.base, rest: self.rest + other.rest }
    }
}

impl<T: Real> Sub for Parted<T> {
    type Output = Parted<T>;
    fn sub(self, other: Parted<T>) -> Parted<T> {
        Parted { base: self.base - other.base, rest: self.rest - other.rest }
    }
}

impl<T: Real> Neg for Parted<T> {
    type Output = Parted<T>;
    fn neg(self) -> Parted<T> {
        Parted { base: -self.base, rest: -self.rest }
    }
}

impl<T: Real> Mul for Parted<T> {
    type Output = Parted<T>;
    fn mul(self, other: Parted<T>) -> Parted<T> {
        Parted::of(self.whole() * other.whole())
    }
}

impl<T: Real> Div for Parted<T> {
    type Output = Parted<T>;
    fn div(self, other: Parted<T>) -> Parted<T> {
        Parted::of(self.whole() / other.whole())
    }
}

impl<T: Real> Number for Parted<T> {
    fn value(self) -> f64 {
        self.whole().value()
    }

    fn exp(self) -> Parted<T> {
        Parted::of(self.whole().exp())
    }

    fn softplus(self) -> Parted<T> {
        Parted::of(self.whole().softplus())
    }

    fn ln_1p(self) -> Parted<T> {
        Parted::of(self.whole().ln_1p())
    }

    fn power(self, q: f64) -> Parted<T> {
        Parted::of(self.whole().power(q))
    }

    fn exp_m1(self) -> Parted<T> {
        Parted::of(self.whole().exp_m1())
    }

    fn ln(self) -> Parted<T> {
        Parted::of(self.whole().ln())
    }

    fn root(self) -> Parted<T> {
        Parted::of(self.whole().root())
    }

    fn tanh(self) -> Parted<T> {
        Parted::of(self.whole().tanh())
    }

    fn size(self) -> Parted<T> {
        if self.whole().value() < 0.0 { -self } else { self }
    }

    fn smaller(self, other: Parted<T>) -> Parted<T> {
        let between = (other - self).whole().value();
        if between < 0.0 || between.is_nan() { other } else { self }
    }
}
