//! Functions of whole slices, run with the widest registers of the processor.
//!
//! Each computes as many values as the shorter of its slices has.

use crate::lane::SoftplusBase;
use crate::row::{self, Room};
use crate::simd::{Kernel, dispatch};

/// out\[i\] = ln(1 + e^x\[i\]), see [`lane::softplus`].
pub fn softplus(x: &[f64], out: &mut [f64]) {
    dispatch(Softplus { x, out });
}

/// out\[i\] = softplus(y0 + d\[i\]) - softplus(y0), see [`lane::softplus_difference`].
pub fn softplus_difference(base: SoftplusBase, d: &[f64], out: &mut [f64]) {
    dispatch(SoftplusDifference { base, d, out });
}

/// out\[i\] = ln(1 + c r\[i\]) for c r\[i\] > -1, see [`lane::ln_1p`].
pub fn ln_1p_scaled(c: f64, r: &[f64], out: &mut [f64]) {
    dispatch(Ln1pScaled { c, r, out });
}

struct Softplus<'a> {
    x: &'a [f64],
    out: &'a mut [f64],
}

impl Kernel for Softplus<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        row::softplus(copied(self.x, self.out), &mut Room::default());
    }
}

struct SoftplusDifference<'a> {
    base: SoftplusBase,
    d: &'a [f64],
    out: &'a mut [f64],
}

impl Kernel for SoftplusDifference<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        row::softplus_difference(&self.base, copied(self.d, self.out), &mut Room::default());
    }
}

struct Ln1pScaled<'a> {
    c: f64,
    r: &'a [f64],
    out: &'a mut [f64],
}

impl Kernel for Ln1pScaled<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let row = copied(self.r, self.out);
        row.iter_mut().for_each(|r| *r *= self.c);
        row::ln_1p(row, &mut Room::default());
    }
}

/// What both have room for, copied from the first to the second.
#[inline(always)]
fn copied<'a>(from: &[f64], to: &'a mut [f64]) -> &'a mut [f64] {
    let n = from.len().min(to.len());
    to[..n].copy_from_slice(&from[..n]);
    &mut to[..n]
}
