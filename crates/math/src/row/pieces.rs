//! The functions of [rows](super) on a piece of a row, or on the lanes of a block.

use crate::lane::SoftplusBase;
use crate::lane::exponential::{Reduced, exp_m1_of, exp_of};
use crate::lane::logarithm::{Parts, Ratio, ln_1p_of};
use crate::lane::softplus::{Change, reduced_decay, softplus_difference_of, softplus_of};
use crate::lane::tanh::{tanh_of, twice_size};

/// Scratch for what passes from one loop to the next: each part as long as the piece.
pub(crate) type Room<'a> = [&'a mut [f64]; 4];

/// x\[i\] = e^x\[i\].
#[inline(always)]
pub(crate) fn exp(x: &mut [f64], [r, missing, shifted, _]: Room<'_>) {
    reduce(Reduced::new, x, r, missing, shifted);
    expand(exp_of, x, r, missing, shifted);
}

/// x\[i\] = e^x\[i\] - 1.
#[inline(always)]
pub(crate) fn exp_m1(x: &mut [f64], [r, missing, shifted, _]: Room<'_>) {
    reduce(Reduced::new, x, r, missing, shifted);
    expand(exp_m1_of, x, r, missing, shifted);
}

/// x\[i\] = tanh x\[i\].
#[inline(always)]
pub(crate) fn tanh(x: &mut [f64], [r, missing, shifted, t]: Room<'_>) {
    for i in 0..x.len() {
        t[i] = twice_size(x[i]);
    }
    reduce(Reduced::new, t, r, missing, shifted);
    expand(exp_m1_of, t, r, missing, shifted);
    for i in 0..x.len() {
        x[i] = tanh_of(x[i], t[i]);
    }
}

/// x\[i\] = ln(1 + x\[i\]).
#[inline(always)]
pub(crate) fn ln_1p(x: &mut [f64], [e, f, dropped, s]: Room<'_>) {
    take_apart(x, e, f, dropped, s);
    for i in 0..x.len() {
        x[i] = ln_1p_of(x[i], Parts { e: e[i], f: f[i], dropped: dropped[i], s: s[i] });
    }
}

/// x\[i\] = ln(1 + e^x\[i\]).
#[inline(always)]
pub(crate) fn softplus(x: &mut [f64], [decay, f, s, _]: Room<'_>) {
    let (r, missing, shifted) = (&mut *decay, &mut *f, &mut *s);
    reduce(reduced_decay, x, r, missing, shifted);
    for i in 0..x.len() {
        decay[i] = Reduced { r: decay[i], missing: f[i], shifted: s[i] }.exp();
    }
    divide(Ratio::of_unit, decay, f, s);
    for i in 0..x.len() {
        x[i] = softplus_of(x[i], decay[i], Ratio { f: f[i], s: s[i] });
    }
}

/// x\[i\] = softplus(y0 + x\[i\]) - softplus(y0).
#[inline(always)]
pub(crate) fn softplus_difference(base: &SoftplusBase, x: &mut [f64], [r, missing, shifted, change]: Room<'_>) {
    reduce_change(base, x, r, missing, shifted, change);
    expand(|less, reduced| Change { reduced, less }.value(base), change, r, missing, shifted);
    let [f, s] = [r, missing];
    divide(Ratio::of_short, change, f, s);
    for i in 0..x.len() {
        x[i] = softplus_difference_of(base, x[i], change[i], Ratio { f: f[i], s: s[i] });
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
