//! Functions applied in place to a row of numbers, each as several short loops.
//!
//! A processor looks some hundred instructions ahead for work. The operations of one logarithm wait for each other over
//! more than a hundred cycles, so a loop over whole logarithms shows it two or three of them at a time, and its units
//! stand idle. Loops over a third or half of a function show it many more; what passes from one to the next stays in
//! the first-level cache. Every function gives the bits of the [`lane`](crate::lane) of its name.
//!
//! Range, error and NaN are those of the lane functions, number by number. The scratch is overwritten, and can be used
//! for any other row.
//!
//! For the body of a [`Kernel`](crate::simd::Kernel), as lanes are. Best for rows whose length is a multiple of
//! [`LANES`], so that nothing remains for single numbers; any length will do.

pub(crate) mod pieces;

use crate::lane::SoftplusBase;
use pieces::Room;

/// The doubles of the widest registers.
pub const LANES: usize = 8;

/// The longest row that is done in one go; longer ones are done piece by piece. All rows of a step stay in the
/// first-level cache (2 KiB each).
pub const LENGTH: usize = 256;

/// Scratch for what passes from one loop to the next.
#[derive(Clone, Debug)]
pub struct Scratch {
    a: [f64; LENGTH],
    b: [f64; LENGTH],
    c: [f64; LENGTH],
    d: [f64; LENGTH],
}

impl Default for Scratch {
    fn default() -> Scratch {
        let zeros = [0.0; LENGTH];
        Scratch { a: zeros, b: zeros, c: zeros, d: zeros }
    }
}

impl Scratch {
    /// The first `n` places of each.
    #[inline(always)]
    fn rows(&mut self, n: usize) -> Room<'_> {
        [&mut self.a[..n], &mut self.b[..n], &mut self.c[..n], &mut self.d[..n]]
    }
}

/// x\[i\] = e^x\[i\].
#[inline(always)]
pub fn exp(x: &mut [f64], room: &mut Scratch) {
    for x in x.chunks_mut(LENGTH) {
        pieces::exp(x, room.rows(x.len()));
    }
}

/// x\[i\] = e^x\[i\] - 1.
#[inline(always)]
pub fn exp_m1(x: &mut [f64], room: &mut Scratch) {
    for x in x.chunks_mut(LENGTH) {
        pieces::exp_m1(x, room.rows(x.len()));
    }
}

/// x\[i\] = tanh x\[i\].
#[inline(always)]
pub fn tanh(x: &mut [f64], room: &mut Scratch) {
    for x in x.chunks_mut(LENGTH) {
        pieces::tanh(x, room.rows(x.len()));
    }
}

/// x\[i\] = ln(1 + x\[i\]).
#[inline(always)]
pub fn ln_1p(x: &mut [f64], room: &mut Scratch) {
    for x in x.chunks_mut(LENGTH) {
        pieces::ln_1p(x, room.rows(x.len()));
    }
}

/// x\[i\] = ln(1 + e^x\[i\]).
#[inline(always)]
pub fn softplus(x: &mut [f64], room: &mut Scratch) {
    for x in x.chunks_mut(LENGTH) {
        pieces::softplus(x, room.rows(x.len()));
    }
}

/// x\[i\] = softplus(y0 + x\[i\]) - softplus(y0).
#[inline(always)]
pub fn softplus_difference(base: &SoftplusBase, x: &mut [f64], room: &mut Scratch) {
    for x in x.chunks_mut(LENGTH) {
        pieces::softplus_difference(base, x, room.rows(x.len()));
    }
}
