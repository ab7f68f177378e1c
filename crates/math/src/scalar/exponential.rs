//! The exponential function.

use super::power_of_two;
use super::series::{INVERSE_FACTORIALS, sum};
use crate::double_double::DoubleDouble;

/// ln(2^1024) rounded up: from here on the exponential overflows.
const OVERFLOW: f64 = 709.782_712_893_384;
/// ln(2^-1075) rounded down: below it the exponential rounds to zero.
const UNDERFLOW: f64 = -745.133_219_101_941_2;

/// e^x for every x; infinite above 709.78, zero below -745.13.
pub fn exp(x: f64) -> f64 {
    rounded_exp(DoubleDouble::from(x))
}

/// e^x - 1 for every x, with full relative precision near 0; infinite above 709.78.
pub fn exp_m1(x: f64) -> f64 {
    if x.is_nan() || x.abs() < 1.0 / (1u64 << 54) as f64 {
        return x; // the next term, x^2/2, is below half a unit
    }
    if x > OVERFLOW {
        return f64::INFINITY;
    }
    if x < -40.0 {
        return -1.0;
    }
    DoubleDouble::from(x).exp_m1().into()
}

impl DoubleDouble {
    /// e^x with a relative error of about 2^-80, less below -690 where its tail
    /// underflows; zero below -708, infinite above 709.78.
    pub fn exp(self) -> DoubleDouble {
        if self.hi < -708.0 {
            return DoubleDouble::ZERO;
        }
        if self.hi > OVERFLOW {
            return DoubleDouble::from(f64::INFINITY);
        }
        let (k, p) = reduced(self);
        (p + 1.0).times(power_of_two(k / 2)).times(power_of_two(k - k / 2))
    }

    /// e^x - 1 with a relative error of about 2^-80, for -708 < x < 709.78; beyond, the result has no meaning.
    pub fn exp_m1(self) -> DoubleDouble {
        let (k, p) = reduced(self);
        if k == 0 {
            return p;
        }
        // one halving keeps 2^1024 out of the way
        ((p + 1.0).times(power_of_two(k - 1)) - 0.5).times(2.0)
    }
}

/// e^x rounded to a double.
pub(super) fn rounded_exp(x: DoubleDouble) -> f64 {
    if x.hi.is_nan() {
        return x.hi;
    }
    if x.hi > OVERFLOW {
        return f64::INFINITY;
    }
    if x.hi < UNDERFLOW {
        return 0.0;
    }
    let (k, p) = reduced(x);
    scaled(p + 1.0, k)
}

/// The whole number k and p = e^(x - k ln 2) - 1 with |x - k ln 2| <= ln(2)/2;
/// p has a relative error of about 2^-80.
fn reduced(x: DoubleDouble) -> (i32, DoubleDouble) {
    let k = (x.hi * std::f64::consts::LOG2_E).round_ties_even();
    let r = x - DoubleDouble::LN_2 * k;
    (k as i32, series(r))
}

/// e^r - 1 by its Taylor series to r^19 / 19!, for |r| <= 0.35.
fn series(r: DoubleDouble) -> DoubleDouble {
    sum(&INVERSE_FACTORIALS[1..20], 8, r) * r
}

/// `value` 2^k for a value between 1/2 and 3/2, rounded once, also where the result
/// is subnormal.
fn scaled(value: DoubleDouble, k: i32) -> f64 {
    if k > -1022 || (k == -1022 && value.hi >= 1.0) {
        // in two factors, as 2^1024 is no double
        return (value.hi + value.lo) * power_of_two(k / 2) * power_of_two(k - k / 2);
    }
    // the sum with a number whose last bit is worth 2^-1074-k is rounded there
    let large = power_of_two(52 - 1074 - k);
    let sum = DoubleDouble::sum(large, value.hi);
    let rounded = (sum.hi + (sum.lo + value.lo)) - large;
    rounded * power_of_two(k + 100) * power_of_two(-100)
}
