//! Functions of one value, over the whole of their domain.
//!
//! Each works with [`DoubleDouble`](crate::double_double::DoubleDouble) numbers to some 80 bits and rounds once, so the
//! result is the double nearest to the true value unless that lies within about 2^-20 of a unit of the middle between
//! two doubles. A call takes some 50 to 170 ns; in long loops the [`lane`](crate::lane) functions take 1 to 10. Special
//! values follow the C standard (annex F): NaN gives NaN, but for `pow(x, 0)` and `pow(1, y)`, which are 1.

mod exponential;
mod logarithm;
mod power;
mod series;
mod trigonometric;

pub use exponential::{exp, exp_m1};
pub use logarithm::{ln, ln_1p, log10};
pub use power::pow;
pub(crate) use series::INVERSE_FACTORIALS;
pub use trigonometric::{cos, sin};

/// 2^k for -1022 <= k <= 1023.
pub(crate) fn power_of_two(k: i32) -> f64 {
    f64::from_bits(((k + 1023) as u64) << 52)
}
