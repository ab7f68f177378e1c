//! Logarithms.

use super::power_of_two;
use super::series::{ODD_INVERSES, sum};
use crate::double_double::DoubleDouble;

/// The natural logarithm of every x >= 0, subnormal ones included; -infinity at zero, NaN below.
pub fn ln(x: f64) -> f64 {
    if !(x > 0.0 && x < f64::INFINITY) {
        return beyond(x);
    }
    DoubleDouble::from(x).ln().into()
}

/// ln(1 + x) for every x >= -1, with full relative precision near 0; -infinity at -1, NaN below.
pub fn ln_1p(x: f64) -> f64 {
    if x.abs() < 1.0 / (1u64 << 54) as f64 {
        return x; // the next term, x^2/2, is below half a unit
    }
    if !(x > -1.0 && x < f64::INFINITY) {
        return beyond(1.0 + x);
    }
    DoubleDouble::from(x).ln_1p().into()
}

/// The logarithm to base 10 of every x >= 0; -infinity at zero, NaN below.
pub fn log10(x: f64) -> f64 {
    if !(x > 0.0 && x < f64::INFINITY) {
        return beyond(x);
    }
    (DoubleDouble::from(x).ln() * DoubleDouble::INVERSE_LN_10).into()
}

/// The logarithm of an argument that is zero, negative, infinite or not a number.
fn beyond(x: f64) -> f64 {
    if x == 0.0 {
        f64::NEG_INFINITY
    } else if x < 0.0 {
        f64::NAN
    } else {
        x
    }
}

impl DoubleDouble {
    /// ln x with a relative error of about 2^-80, for a finite x > 0; NaN for others.
    pub fn ln(self) -> DoubleDouble {
        if !(self.hi > 0.0 && self.hi < f64::INFINITY) {
            return DoubleDouble::from(f64::NAN);
        }
        let (e, m) = halved(self);
        DoubleDouble::LN_2 * f64::from(e) + twice_artanh((m - 1.0) / (m + 1.0))
    }

    /// ln(1 + x) with a relative error of about 2^-80, for a finite x > -1; NaN for others.
    pub fn ln_1p(self) -> DoubleDouble {
        if self.hi > -0.25 && self.hi < 0.4 {
            return twice_artanh(self / (self + 2.0));
        }
        (self + 1.0).ln()
    }
}

/// ln((1 + s) / (1 - s)) for |s| <= 0.172, by its Taylor series to s^35 / 35.
fn twice_artanh(s: DoubleDouble) -> DoubleDouble {
    sum(&ODD_INVERSES, 6, s * s) * s
}

/// The whole number e and m = x 2^-e, for a finite x > 0, with m near or between sqrt(1/2) and sqrt(2).
fn halved(x: DoubleDouble) -> (i32, DoubleDouble) {
    if x.hi < f64::MIN_POSITIVE {
        let (e, m) = halved(DoubleDouble::from(x.hi * power_of_two(64)));
        return (e - 64, m);
    }
    const ROOT_HALF: i64 = std::f64::consts::FRAC_1_SQRT_2.to_bits() as i64;
    let e = ((x.hi.to_bits() as i64 - ROOT_HALF) >> 52) as i32;
    // in two factors, as 2^-1024 is no normal number
    let half = power_of_two(-e / 2);
    let rest = power_of_two(-e - -e / 2);
    (e, x.times(half).times(rest))
}
