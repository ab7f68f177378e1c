//! Powers with a real exponent.

use super::exponential::rounded_exp;
use crate::double_double::DoubleDouble;

/// x^y, with the special cases of the C standard: x^0 = 1 and 1^y = 1 for every
/// argument, NaN for a negative x unless y is a whole number.
pub fn pow(x: f64, y: f64) -> f64 {
    if y == 0.0 || x == 1.0 {
        return 1.0;
    }
    if x.is_nan() || y.is_nan() {
        return f64::NAN;
    }
    if x.is_sign_positive() {
        return of_size(x, y);
    }
    let whole = y.trunc() == y;
    if !whole && x != 0.0 && x.is_finite() {
        return f64::NAN;
    }
    let odd = (y % 2.0).abs() == 1.0;
    if odd { -of_size(-x, y) } else { of_size(-x, y) }
}

/// x^y for x >= 0.
fn of_size(x: f64, y: f64) -> f64 {
    if y.is_infinite() && x == 1.0 {
        return 1.0; // (-1)^infinity
    }
    if x == 0.0 || x.is_infinite() || y.is_infinite() {
        let grows = (x > 1.0) == (y > 0.0);
        return if grows { f64::INFINITY } else { 0.0 };
    }
    // beyond this no power of a double but 1 is finite and not zero
    const LARGEST: f64 = 1e20;
    rounded_exp(DoubleDouble::from(x).ln() * y.clamp(-LARGEST, LARGEST))
}
