//! Kinds of numbers with which a formula can be evaluated.
//!
//! A formula is written once, as a function of any [`Number`]. What comes out depends on the numbers that go in:
//!
//! | number | gives |
//! |---|---|
//! | `f64` | the value |
//! | [`Lanes`](crate::lanes::Lanes) | the values of several pedestrians at once |
//! | [`Change`](crate::change::Change) | the difference from a reference, without cancellation |
//! | [`Changed`](crate::change::Changed) | a value and the differences from it |
//! | [`Jet`](crate::series::Jet) | the next coefficient of a power series |
//! | [`Dual`](crate::dual::Dual) | the value with a derivative |
//! | [`DoubleDouble`] | the value to twice the precision |
//! | [`Affine`](crate::affine::Affine) | whether the formula is linear in some variables, and with which slopes |
//!
//! Every operation of a double is one IEEE operation or a function of [`lane`], in the order in which it is written, so
//! all numbers that hold doubles give the same bits.

use crate::double_double::{DoubleDouble, full};
use crate::lane;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// What a formula is made of. Operations have the range of the real function, and no value beyond it: NaN in doubles,
/// which every further operation keeps but `powi` with the exponent 0. Arguments of `exp`, `ln`, `tanh` and their kin
/// are dimensionless.
///
/// Constants enter as the right-hand side of an operation, so a number may belong to
/// something (a tape, a series) that a constant alone does not know.
pub trait Number:
    Copy
    + Neg<Output = Self>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Add<f64, Output = Self>
    + Sub<f64, Output = Self>
    + Mul<f64, Output = Self>
    + Div<f64, Output = Self>
{
    /// 1 / x; infinite at 0.
    fn recip(self) -> Self;

    /// x^n by repeated multiplication, `((x x) x) ...`; of a negative n the reciprocal of that. For any x; 1 where n =
    /// 0.
    fn powi(self, n: i32) -> Self;

    /// x^q = e^(q ln x) for x > 0; else NaN, for q = 0 too.
    fn powf(self, q: f64) -> Self;

    /// e^x; 0 or infinite where it underflows or overflows.
    fn exp(self) -> Self;

    /// e^x - 1.
    fn exp_m1(self) -> Self;

    /// ln x for x > 0; else NaN, at 0 too.
    fn ln(self) -> Self;

    /// ln(1 + x) for x > -1; else NaN, at -1 too.
    fn ln_1p(self) -> Self;

    /// The square root for x >= 0; else NaN. Its slope at 0 is infinite.
    fn sqrt(self) -> Self;

    /// The hyperbolic tangent.
    fn tanh(self) -> Self;

    /// ln(1 + e^x).
    fn softplus(self) -> Self;

    /// |x|. A kink at 0.
    fn abs(self) -> Self;

    /// The smaller of two; the first of equal ones; NaN if either is.
    fn min(self, other: Self) -> Self;

    /// The larger of two; the first of equal ones; NaN if either is.
    fn max(self, other: Self) -> Self;

    /// x^q, by repeated multiplication where q is whole and at most 16 in size: then x may be negative too.
    #[inline(always)]
    fn power(self, q: f64) -> Self {
        match whole(q) {
            Some(n) => self.powi(n),
            None => self.powf(q),
        }
    }

    /// `eps ln(1 + exp(-x / eps))`, the smooth ramp of eq:aTheta, for eps > 0.
    #[inline(always)]
    fn ramp(self, epsilon: f64) -> Self {
        (self * (-1.0 / epsilon)).softplus() * epsilon
    }
}

/// The exponents that are repeated multiplications: whole and at most 16 in size.
#[inline(always)]
pub fn whole(q: f64) -> Option<i32> {
    const LARGEST: f64 = 16.0;
    // of the size, so that a compiler which knows the answer for q knows it for -q
    let size = q.abs();
    let n = size as u8;
    (size <= LARGEST && f64::from(n) == size).then_some(if q < 0.0 { -i32::from(n) } else { i32::from(n) })
}

/// `((x x) x) ...`, n >= 0 times.
#[inline(always)]
pub(crate) fn repeated(x: f64, n: u32) -> f64 {
    match n {
        0 => 1.0,
        1 => x,
        2 => x * x,
        3 => x * x * x,
        _ => (1..n).fold(x, |product, _| product * x),
    }
}

impl Number for f64 {
    #[inline(always)]
    fn recip(self) -> f64 {
        1.0 / self
    }

    #[inline(always)]
    fn powi(self, n: i32) -> f64 {
        let product = repeated(self, n.unsigned_abs());
        if n < 0 { 1.0 / product } else { product }
    }

    #[inline(always)]
    fn powf(self, q: f64) -> f64 {
        lane::pow(self, q)
    }

    #[inline(always)]
    fn exp(self) -> f64 {
        lane::exp(self)
    }

    #[inline(always)]
    fn exp_m1(self) -> f64 {
        lane::exp_m1(self)
    }

    #[inline(always)]
    fn ln(self) -> f64 {
        lane::ln(self)
    }

    #[inline(always)]
    fn ln_1p(self) -> f64 {
        lane::ln_1p(self)
    }

    #[inline(always)]
    fn sqrt(self) -> f64 {
        f64::sqrt(self)
    }

    #[inline(always)]
    fn tanh(self) -> f64 {
        lane::tanh(self)
    }

    #[inline(always)]
    fn softplus(self) -> f64 {
        lane::softplus(self)
    }

    #[inline(always)]
    fn abs(self) -> f64 {
        f64::abs(self)
    }

    #[inline(always)]
    fn min(self, other: f64) -> f64 {
        if other < self || other.is_nan() { other } else { self }
    }

    #[inline(always)]
    fn max(self, other: f64) -> f64 {
        if other > self || other.is_nan() { other } else { self }
    }
}

impl Number for DoubleDouble {
    fn recip(self) -> DoubleDouble {
        DoubleDouble::ONE / self
    }

    fn powi(self, n: i32) -> DoubleDouble {
        let product = (0..n.unsigned_abs()).fold(DoubleDouble::ONE, |product, _| product * self);
        if n < 0 { product.recip() } else { product }
    }

    fn powf(self, q: f64) -> DoubleDouble {
        full::exp(full::ln(self) * q)
    }

    fn exp(self) -> DoubleDouble {
        full::exp(self)
    }

    fn exp_m1(self) -> DoubleDouble {
        full::exp_m1(self)
    }

    fn ln(self) -> DoubleDouble {
        full::ln(self)
    }

    fn ln_1p(self) -> DoubleDouble {
        full::ln_1p(self)
    }

    fn sqrt(self) -> DoubleDouble {
        DoubleDouble::sqrt(self)
    }

    fn tanh(self) -> DoubleDouble {
        full::tanh(self)
    }

    fn softplus(self) -> DoubleDouble {
        full::softplus(self)
    }

    fn abs(self) -> DoubleDouble {
        DoubleDouble::abs(self)
    }

    fn min(self, other: DoubleDouble) -> DoubleDouble {
        if (other - self).hi < 0.0 || other.hi.is_nan() { other } else { self }
    }

    fn max(self, other: DoubleDouble) -> DoubleDouble {
        if (other - self).hi > 0.0 || other.hi.is_nan() { other } else { self }
    }
}
