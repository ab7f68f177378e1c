//! What a number must be able to do for formulas to be evaluated with it.

use crate::limits::LARGEST_POWER;
use math::lane;
use math::twofold::{Twofold, full};

/// A number: a double, a double-double, a value with its derivatives, an interval.
///
/// Constants enter through operations with a double, beside a number that is there already, so a type whose values need a
/// context (an order, a count of derivatives) takes it from there.
pub trait Number: Clone {
    /// The constant `value` in the context of this number.
    fn constant(&self, value: f64) -> Self;
    /// The nearest double, to tell whether there is a value and for messages; NaN or infinite where there is none.
    fn nearest(&self) -> f64;

    /// `-x`
    fn neg(&self) -> Self;
    /// `x + y`
    fn add(&self, other: &Self) -> Self;
    /// `x - y`
    fn sub(&self, other: &Self) -> Self;
    /// `x * y`
    fn mul(&self, other: &Self) -> Self;
    /// `x / y`
    fn div(&self, other: &Self) -> Self;
    /// `x^y` for x > 0.
    fn pow(&self, exponent: &Self) -> Self;
    /// The smaller one, the first in a tie; NaN if either is.
    fn min(&self, other: &Self) -> Self;
    /// The larger one, the first in a tie; NaN if either is.
    fn max(&self, other: &Self) -> Self;

    /// `e^x`
    fn exp(&self) -> Self;
    /// `e^x - 1`
    fn exp_m1(&self) -> Self;
    /// The natural logarithm.
    fn ln(&self) -> Self;
    /// `ln(1 + x)`
    fn ln_1p(&self) -> Self;
    /// The square root.
    fn sqrt(&self) -> Self;
    /// The hyperbolic tangent.
    fn tanh(&self) -> Self;
    /// `ln(1 + e^x)`
    fn softplus(&self) -> Self;
    /// `-x` for x < 0, else `x`.
    fn abs(&self) -> Self;

    /// `x + c`, which is also `c + x`.
    fn add_constant(&self, c: f64) -> Self {
        self.add(&self.constant(c))
    }
    /// `x - c`
    fn sub_constant(&self, c: f64) -> Self {
        self.sub(&self.constant(c))
    }
    /// `c - x`
    fn constant_sub(&self, c: f64) -> Self {
        self.constant(c).sub(self)
    }
    /// `x * c`, which is also `c * x`.
    fn mul_constant(&self, c: f64) -> Self {
        self.mul(&self.constant(c))
    }
    /// `x / c`
    fn div_constant(&self, c: f64) -> Self {
        self.div(&self.constant(c))
    }
    /// `c / x`
    fn constant_div(&self, c: f64) -> Self {
        self.constant(c).div(self)
    }
    /// `x^c` for x > 0.
    fn pow_constant(&self, c: f64) -> Self {
        self.pow(&self.constant(c))
    }
    /// `c^x` for c > 0.
    fn constant_pow(&self, c: f64) -> Self {
        self.constant(c).pow(self)
    }

    /// `x^n` for 1 <= |n| <= 16: `((x x) x) ...` from the left, and 1 divided by that for n < 0.
    fn power(&self, n: i32) -> Self {
        debug_assert!(n != 0 && n.abs() <= LARGEST_POWER);
        let product = (1..n.abs()).fold(self.clone(), |product, _| product.mul(self));
        if n < 0 { product.constant_div(1.0) } else { product }
    }
}

/// Functions are those of [`math::lane`], so that rows of numbers have the same bits.
impl Number for f64 {
    fn constant(&self, value: f64) -> f64 {
        value
    }
    fn nearest(&self) -> f64 {
        *self
    }
    fn neg(&self) -> f64 {
        -self
    }
    fn add(&self, other: &f64) -> f64 {
        self + other
    }
    fn sub(&self, other: &f64) -> f64 {
        self - other
    }
    fn mul(&self, other: &f64) -> f64 {
        self * other
    }
    fn div(&self, other: &f64) -> f64 {
        self / other
    }
    fn pow(&self, exponent: &f64) -> f64 {
        lane::pow(*self, *exponent)
    }
    fn min(&self, other: &f64) -> f64 {
        if other < self || other.is_nan() { *other } else { *self }
    }
    fn max(&self, other: &f64) -> f64 {
        if other > self || other.is_nan() { *other } else { *self }
    }
    fn exp(&self) -> f64 {
        lane::exp(*self)
    }
    fn exp_m1(&self) -> f64 {
        lane::exp_m1(*self)
    }
    fn ln(&self) -> f64 {
        lane::ln(*self)
    }
    fn ln_1p(&self) -> f64 {
        lane::ln_1p(*self)
    }
    fn sqrt(&self) -> f64 {
        f64::sqrt(*self)
    }
    fn tanh(&self) -> f64 {
        lane::tanh(*self)
    }
    fn softplus(&self) -> f64 {
        lane::softplus(*self)
    }
    fn abs(&self) -> f64 {
        f64::abs(*self)
    }
}

/// About 100 bits, for exponents between -700 and 700 and values between 1e-290 and 1e300.
impl Number for Twofold {
    fn constant(&self, value: f64) -> Twofold {
        Twofold::from(value)
    }
    fn nearest(&self) -> f64 {
        self.hi
    }
    fn neg(&self) -> Twofold {
        -*self
    }
    fn add(&self, other: &Twofold) -> Twofold {
        *self + *other
    }
    fn sub(&self, other: &Twofold) -> Twofold {
        *self - *other
    }
    fn mul(&self, other: &Twofold) -> Twofold {
        *self * *other
    }
    fn div(&self, other: &Twofold) -> Twofold {
        *self / *other
    }
    fn pow(&self, exponent: &Twofold) -> Twofold {
        Number::exp(&(*exponent * full::ln(*self)))
    }
    fn min(&self, other: &Twofold) -> Twofold {
        if (*other - *self).hi < 0.0 || other.hi.is_nan() { *other } else { *self }
    }
    fn max(&self, other: &Twofold) -> Twofold {
        if (*other - *self).hi > 0.0 || other.hi.is_nan() { *other } else { *self }
    }
    fn exp(&self) -> Twofold {
        if self.hi > 700.0 { Twofold::from(f64::INFINITY) } else { full::exp(*self) }
    }
    fn exp_m1(&self) -> Twofold {
        if self.hi > 700.0 { Twofold::from(f64::INFINITY) } else { full::exp_m1(*self) }
    }
    fn ln(&self) -> Twofold {
        full::ln(*self)
    }
    fn ln_1p(&self) -> Twofold {
        full::ln_1p(*self)
    }
    fn sqrt(&self) -> Twofold {
        Twofold::sqrt(*self)
    }
    fn tanh(&self) -> Twofold {
        full::tanh(*self)
    }
    fn softplus(&self) -> Twofold {
        full::softplus(*self)
    }
    fn abs(&self) -> Twofold {
        Twofold::abs(*self)
    }
    fn add_constant(&self, c: f64) -> Twofold {
        *self + c
    }
    fn sub_constant(&self, c: f64) -> Twofold {
        *self - c
    }
    fn mul_constant(&self, c: f64) -> Twofold {
        *self * c
    }
}
