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
//! | [`twofold`] | numbers of 106 bits as pairs of doubles; functions in [`twofold::full`] | about 2^-104; 2^-100 |

pub mod change;
pub mod complex;
pub mod dual;
pub mod lane;
pub mod lanes;
pub mod number;
pub mod row;
pub mod scalar;
pub mod series;
pub mod simd;
pub mod twofold;

pub use complex::complex_sqrt;
pub use scalar::{cos, exp, exp_m1, ln, ln_1p, log10, pow, sin};
