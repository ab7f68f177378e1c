//! The square root of a complex number.

use crate::scalar::power_of_two;

/// The principal square root of `re + i im`: the one with a real part >= 0, and with
/// an imaginary part of the sign of `im` (so a negative number has two roots, by the
/// sign of its zero). Returns (real part, imaginary part); both have a relative error
/// below 4 units in the last place for finite arguments of any size; NaN in either gives NaN in one or both.
/// The result has the unit of the root of its argument.
///
/// Follows Kahan, "Branch cuts for complex elementary functions" (1987): first the
/// part without cancellation, then the other from the product im = 2 re' im'.
pub fn complex_sqrt(re: f64, im: f64) -> (f64, f64) {
    if re == 0.0 && im == 0.0 {
        return (0.0, im);
    }
    if im.is_infinite() {
        return (f64::INFINITY, im);
    }
    if re.is_infinite() {
        return infinite(re, im);
    }
    let (a, b, back) = scaled(re.abs(), im.abs());
    let large = ((a + (a * a + b * b).sqrt()) / 2.0).sqrt();
    let small = b / (2.0 * large);
    let (large, small) = (large * back, small * back);
    if re >= 0.0 { (large, small.copysign(im)) } else { (small, large.copysign(im)) }
}

/// The root for an infinite real part and a finite imaginary one.
fn infinite(re: f64, im: f64) -> (f64, f64) {
    if im.is_nan() {
        return (f64::INFINITY, f64::NAN);
    }
    if re > 0.0 { (re, 0.0_f64.copysign(im)) } else { (0.0, f64::INFINITY.copysign(im)) }
}

/// Both sizes times one power of 4 that keeps their squares in range, and the factor
/// that undoes it in the root.
fn scaled(a: f64, b: f64) -> (f64, f64, f64) {
    let largest = if a > b { a } else { b };
    let power = if largest > 1e150 {
        -600
    } else if largest < 1e-140 {
        700
    } else {
        0
    };
    let factor = power_of_two(power);
    (a * factor, b * factor, power_of_two(-power / 2))
}
