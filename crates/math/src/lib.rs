//! Elementary functions whose bits are the same on every machine.
//!
//! The standard library leaves the last bits of `exp`, `ln`, `powf` and their
//! kin to the platform. Here every function is a fixed sequence of IEEE 754
//! additions, multiplications, divisions and square roots (and of integer
//! operations), each of which has one right answer; so a result depends on its
//! arguments alone: not on the processor, the operating system, the compiler's
//! flags or how many values share a vector register. No fused multiply-add is
//! used, which WebAssembly and older processors lack.
//!
//! | module | for | error |
//! |---|---|---|
//! | [`scalar`] (re-exported) | one value at a time, full domain | correctly rounded but for rare cases |
//! | [`lane`] | the body of a loop that the compiler vectorises | at most 3 units in the last place, powers more |
//! | [`row`] | a row of values in place, as short loops | as its lane: the same bits |
//! | [`simd`] | runs a loop with the widest registers the processor has | none: the same bits |
//! | [`double_double`] | 106 bits as pairs of doubles; functions in [`double_double::full`] | about 2^-104; 2^-100 |
//!
//! [`number`] lists the kinds of numbers in which a formula can be evaluated, [`random`] draws some.
//!
//! # Units, ranges, NaN
//!
//! Arguments of transcendental functions, and their results, are dimensionless; angles are in radians. Sums, products
//! and roots carry whatever unit the caller gives them: the crate knows none. A derivative has the unit of the value
//! over that of the variable, a difference the unit of the value.
//!
//! Each function states its range. Outside of it the result is NaN, or infinite where this is said; nothing panics and
//! nothing returns an error because of the value of a number. NaN goes in and NaN comes out, except for [`pow`] (`x^0 =
//! 1`, `1^y = 1`, as in C) and [`number::Number::powi`] with the exponent 0. Which NaN, and its sign, has no meaning.
//!
//! Slices have any length unless one is stated.

pub mod affine;
pub mod change;
pub mod complex;
pub mod double_double;
pub mod dual;
pub mod lane;
pub mod lanes;
pub mod number;
pub mod random;
pub mod row;
pub mod scalar;
pub mod series;
pub mod simd;

pub use complex::complex_sqrt;
pub use scalar::{cos, exp, exp_m1, ln, ln_1p, log10, pow, sin};

/// The larger of two numbers, the first in a tie; NaN if either is: `f64::max` would lose it, and may differ in the
/// sign of a zero.
#[inline]
pub fn larger(a: f64, b: f64) -> f64 {
    if a >= b || a.is_nan() { a } else { b }
}

/// The smaller of two numbers, the first in a tie; NaN if either is.
#[inline]
pub fn smaller(a: f64, b: f64) -> f64 {
    if a <= b || a.is_nan() { a } else { b }
}

#[cfg(test)]
mod tests {
    use super::{larger, smaller};

    #[test]
    #[expect(clippy::disallowed_methods, reason = "what they are compared with")]
    fn neither_of_two_numbers_hides_that_the_other_is_none() {
        for (a, b) in [(f64::NAN, 1.0), (1.0, f64::NAN), (f64::NAN, f64::NAN)] {
            assert!(larger(a, b).is_nan() && smaller(a, b).is_nan());
        }
        for (a, b) in [(1.0, 2.0), (2.0, 1.0), (-3.0, 2.0), (f64::INFINITY, 0.0), (1.0, 1.0)] {
            assert_eq!((larger(a, b), smaller(a, b)), (f64::max(a, b), f64::min(a, b)));
        }
    }
}
