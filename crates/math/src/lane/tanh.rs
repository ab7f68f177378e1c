//! The hyperbolic tangent.

use super::exp_m1;

/// From here on the hyperbolic tangent is 1 to the last bit.
pub(crate) const SATURATED: f64 = 20.0;

/// tanh x. For every x; 1 and -1 at infinity. Error below 3 units in the last place; NaN for NaN.
#[inline(always)]
pub fn tanh(x: f64) -> f64 {
    tanh_of(x, exp_m1(twice_size(x)))
}

/// 2 |x|, but at most 40: the argument of the exponential from which [`tanh_of`] continues.
#[inline(always)]
pub(crate) fn twice_size(x: f64) -> f64 {
    let size = x.abs();
    2.0 * if size > SATURATED { SATURATED } else { size }
}

/// tanh x from t = e^(2|x|) - 1: t / (t + 2), with the sign of x.
#[inline(always)]
pub(crate) fn tanh_of(x: f64, t: f64) -> f64 {
    (t / (t + 2.0)).copysign(x)
}
