//! Functions for the body of a loop, which the compiler turns into vector code.
//!
//! They have no branches, tables or calls: choices are selections between two
//! computed values, rounding is the addition of a large number, exponents are moved
//! by additions and logical shifts of bits. Any plain loop over slices that calls
//! them is vectorised; run it through [`simd::dispatch`](crate::simd::dispatch) for
//! the widest registers. Several short loops are faster than one long loop, whose
//! operations wait for each other: [`row`](crate::row) has these functions so.
//!
//! Errors are stated in units in the last place of the result; tests hold them to it.
//! The domains are smaller than those of the [`scalar`](crate::scalar) functions, and
//! results below the least normal number (2.2e-308) may be rounded to zero. NaN gives NaN. Infinite arguments have
//! the limit of the function, except for logarithms and powers, where they give NaN.
//!
//! Multiplications and additions are kept apart. Fused, the softplus loop took 0.83 of
//! the time where the processor can fuse (AVX2), and many times as long where not.

pub(crate) mod exponential;
pub(crate) mod logarithm;
mod power;
pub(crate) mod softplus;
pub(crate) mod tanh;

pub use exponential::{exp, exp_m1};
pub use logarithm::{ln, ln_1p};
pub use power::{pow, pow_m1};
pub use softplus::{SoftplusBase, sigmoid, softplus, softplus_and_decay, softplus_difference};
pub use tanh::tanh;
