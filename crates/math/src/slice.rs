//! Functions of whole slices, run with the widest registers of the processor.
//!
//! Each computes as many values as the shorter of its slices has.

use crate::lane::{self, SoftplusBase};
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
        for (out, &x) in self.out.iter_mut().zip(self.x) {
            *out = lane::decay(x);
        }
        for (out, &x) in self.out.iter_mut().zip(self.x) {
            *out = lane::softplus_of_decay(x, *out);
        }
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
        for (out, &d) in self.out.iter_mut().zip(self.d) {
            *out = lane::softplus_change(&self.base, d);
        }
        for (out, &d) in self.out.iter_mut().zip(self.d) {
            *out = lane::softplus_difference_of_change(&self.base, d, *out);
        }
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
        for (out, &r) in self.out.iter_mut().zip(self.r) {
            *out = lane::ln_1p(self.c * r);
        }
    }
}
