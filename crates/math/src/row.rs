//! Functions applied in place to a row of numbers, each as several short loops.
//!
//! A processor looks some hundred instructions ahead for work. The operations of one logarithm wait for each other over
//! more than a hundred cycles, so a loop over whole logarithms shows it two or three of them at a time, and its units
//! stand idle. Loops over a third or half of a function show it many more; what passes from one to the next stays in
//! the first-level cache. Every function gives the bits of the [`lane`](crate::lane) of its name.
//!
//! For the body of a [`Kernel`](crate::simd::Kernel), as lanes are. Best for rows whose length is a multiple of
//! [`LANES`], so that nothing remains for single numbers; any length will do.

use crate::lane::SoftplusBase;
use crate::lane::exponential::{Reduced, exp_m1_of, exp_of};
use crate::lane::logarithm::{Parts, Ratio, ln_1p_of};
use crate::lane::softplus::{Change, reduced_decay, softplus_difference_of, softplus_of};
use crate::lane::tanh::{tanh_of, twice_size};

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
    fn rows(&mut self, n: usize) -> [&mut [f64]; 4] {
        [&mut self.a[..n], &mut self.b[..n], &mut self.c[..n], &mut self.d[..n]]
    }
}

/// x\[i\] = e^x\[i\].
#[inline(always)]
pub fn exp(x: &mut [f64], room: &mut Scratch) {
    for x in x.chunks_mut(LENGTH) {
        let [r, missing, shifted, _] = room.rows(x.len());
        reduce(Reduced::new, x, r, missing, shifted);
        expand(exp_of, x, r, missing, shifted);
    }
}

/// x\[i\] = e^x\[i\] - 1.
#[inline(always)]
pub fn exp_m1(x: &mut [f64], room: &mut Scratch) {
    for x in x.chunks_mut(LENGTH) {
        let [r, missing, shifted, _] = room.rows(x.len());
        reduce(Reduced::new, x, r, missing, shifted);
        expand(exp_m1_of, x, r, missing, shifted);
    }
}

/// x\[i\] = tanh x\[i\].
#[inline(always)]
pub fn tanh(x: &mut [f64], room: &mut Scratch) {
    for x in x.chunks_mut(LENGTH) {
        let [r, missing, shifted, t] = room.rows(x.len());
        for i in 0..x.len() {
            t[i] = twice_size(x[i]);
        }
        reduce(Reduced::new, t, r, missing, shifted);
        expand(exp_m1_of, t, r, missing, shifted);
        for i in 0..x.len() {
            x[i] = tanh_of(x[i], t[i]);
        }
    }
}

/// x\[i\] = ln(1 + x\[i\]).
#[inline(always)]
pub fn ln_1p(x: &mut [f64], room: &mut Scratch) {
    for x in x.chunks_mut(LENGTH) {
        let [e, f, dropped, s] = room.rows(x.len());
        take_apart(x, e, f, dropped, s);
        for i in 0..x.len() {
            x[i] = ln_1p_of(x[i], Parts { e: e[i], f: f[i], dropped: dropped[i], s: s[i] });
        }
    }
}

/// x\[i\] = ln(1 + e^x\[i\]).
#[inline(always)]
pub fn softplus(x: &mut [f64], room: &mut Scratch) {
    for x in x.chunks_mut(LENGTH) {
        let [r, missing, shifted, decay] = room.rows(x.len());
        reduce(reduced_decay, x, r, missing, shifted);
        expand(|_, reduced| reduced.exp(), decay, r, missing, shifted);
        let [f, s] = [r, missing];
        divide(Ratio::of_unit, decay, f, s);
        for i in 0..x.len() {
            x[i] = softplus_of(x[i], decay[i], Ratio { f: f[i], s: s[i] });
        }
    }
}

/// x\[i\] = softplus(y0 + x\[i\]) - softplus(y0).
#[inline(always)]
pub fn softplus_difference(base: &SoftplusBase, x: &mut [f64], room: &mut Scratch) {
    for x in x.chunks_mut(LENGTH) {
        let [r, missing, shifted, change] = room.rows(x.len());
        reduce_change(base, x, r, missing, shifted, change);
        expand(|less, reduced| Change { reduced, less }.value(base), change, r, missing, shifted);
        let [f, s] = [r, missing];
        divide(Ratio::of_short, change, f, s);
        for i in 0..x.len() {
            x[i] = softplus_difference_of(base, x[i], change[i], Ratio { f: f[i], s: s[i] });
        }
    }
}

// The short loops. Slices that are arguments of their own are known not to overlap, which the compiler must know to
// make vector code; all have the length of the first.

/// The first half of an exponential.
#[inline(always)]
fn reduce(reduced: impl Fn(f64) -> Reduced, x: &[f64], r: &mut [f64], missing: &mut [f64], shifted: &mut [f64]) {
    let n = x.len();
    let (r, missing, shifted) = (&mut r[..n], &mut missing[..n], &mut shifted[..n]);
    for i in 0..n {
        Reduced { r: r[i], missing: missing[i], shifted: shifted[i] } = reduced(x[i]);
    }
}

/// The second half of an exponential, from x and the result of the first half.
#[inline(always)]
fn expand(second: impl Fn(f64, Reduced) -> f64, x: &mut [f64], r: &[f64], missing: &[f64], shifted: &[f64]) {
    let n = x.len();
    let (r, missing, shifted) = (&r[..n], &missing[..n], &shifted[..n]);
    for i in 0..n {
        x[i] = second(x[i], Reduced { r: r[i], missing: missing[i], shifted: shifted[i] });
    }
}

/// The first half of the difference of two exponentials.
#[inline(always)]
fn reduce_change(
    base: &SoftplusBase,
    x: &[f64],
    r: &mut [f64],
    missing: &mut [f64],
    shifted: &mut [f64],
    less: &mut [f64],
) {
    let n = x.len();
    let (r, missing, shifted, less) = (&mut r[..n], &mut missing[..n], &mut shifted[..n], &mut less[..n]);
    for i in 0..n {
        let change = Change::new(base, x[i]);
        Reduced { r: r[i], missing: missing[i], shifted: shifted[i] } = change.reduced;
        less[i] = change.less;
    }
}

/// The first half of a logarithm, of a number of any size.
#[inline(always)]
fn take_apart(x: &[f64], e: &mut [f64], f: &mut [f64], dropped: &mut [f64], s: &mut [f64]) {
    let n = x.len();
    let (e, f, dropped, s) = (&mut e[..n], &mut f[..n], &mut dropped[..n], &mut s[..n]);
    for i in 0..n {
        Parts { e: e[i], f: f[i], dropped: dropped[i], s: s[i] } = Parts::new(x[i]);
    }
}

/// The first half of a logarithm, of a number of little range.
#[inline(always)]
fn divide(ratio: impl Fn(f64) -> Ratio, x: &[f64], f: &mut [f64], s: &mut [f64]) {
    let n = x.len();
    let (f, s) = (&mut f[..n], &mut s[..n]);
    for i in 0..n {
        Ratio { f: f[i], s: s[i] } = ratio(x[i]);
    }
}
