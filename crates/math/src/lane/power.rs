//! Powers with a real exponent.

use super::{exp, exp_m1, ln, ln_1p};

/// x^q = e^(q ln x) for a normal x > 0 up to 1e307 and a finite q; NaN for every other x, for q = 0 too. The error
/// grows with the size of the result's logarithm: it is below 1 + 2.5 |q ln x| units in the last place.
#[inline(always)]
pub fn pow(x: f64, q: f64) -> f64 {
    exp(q * ln(x))
}

/// (1 + t)^q - 1 for -1 < t <= 1e307 and a finite q, NaN for every other t; with full relative precision near t = 0 and
/// q = 0. The error is below 3 + 2.5 |q ln(1 + t)| units in the last place.
#[inline(always)]
pub fn pow_m1(t: f64, q: f64) -> f64 {
    exp_m1(q * ln_1p(t))
}
