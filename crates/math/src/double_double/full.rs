//! Elementary functions of double-double numbers to about 100 bits, for loops that vectorise.
//!
//! The methods of the same names ([`DoubleDouble::exp`] and its kin) are faster for one value and stop at 80 bits,
//! enough for rounding once to a double. These are free of branches; what they call is inlined. NaN gives NaN. Between
//! -700 and 700 (of the exponent) their relative error is below 2^-100, that of an argument known exactly;
//! `tests/it/full.rs` measures it.

use super::DoubleDouble;
use crate::lane;
use crate::scalar::INVERSE_FACTORIALS;

/// The first 42 bits of ln 2, so that its product with a whole number below 2^11 is exact (`coefficients.py`).
const LN_2_HEAD: f64 = 0.693_147_180_559_890_3;
/// ln 2 less its first 42 bits (`coefficients.py`).
const LN_2_TAIL: DoubleDouble = DoubleDouble { hi: 5.497_923_018_708_371e-14, lo: 1.947_045_092_380_75e-31 };
/// Adding it to a number below 2^51 rounds that to a whole number, found in the last bits.
const ROUNDER: f64 = 6_755_399_441_055_744.0; // 1.5 2^52
/// The exponential function is computed of arguments up to this size; larger ones count as this.
const LARGEST: f64 = 700.0;

/// e^x for |x| <= 700; e^-700 and e^700 beyond.
#[inline(always)]
pub fn exp(x: DoubleDouble) -> DoubleDouble {
    both(x).0
}

/// e^x - 1 for |x| <= 700, with full relative precision near 0; its values at -700 and 700 beyond.
#[inline(always)]
pub fn exp_m1(x: DoubleDouble) -> DoubleDouble {
    both(x).1
}

/// ln x for x between 1e-300 and 1e300, NaN for x <= 0; relative error also near 1, where it refers to an x known
/// exactly.
#[inline(always)]
pub fn ln(x: DoubleDouble) -> DoubleDouble {
    let first = lane::ln(x.hi);
    let (inverse, less) = both(DoubleDouble::from(-first));
    // x e^-first - 1; near 1 without subtracting from it
    let far = x * inverse - 1.0;
    let near = (x - 1.0) * inverse + less;
    improved(first, if (0.5..2.0).contains(&x.hi) { near } else { far })
}

/// ln(1 + x) for x between -1 and 1e300, NaN for x <= -1; with full relative precision near 0.
#[inline(always)]
pub fn ln_1p(x: DoubleDouble) -> DoubleDouble {
    let first = lane::ln_1p(x.hi);
    let (inverse, less) = both(DoubleDouble::from(-first));
    // (1 + x) e^-first - 1; near 0 without adding to 1
    let far = (x + 1.0) * inverse - 1.0;
    let near = x * inverse + less;
    improved(first, if x.hi < -0.5 { far } else { near })
}

/// ln(1 + e^x), with full relative precision for x << 0 down to -700.
#[inline(always)]
pub fn softplus(x: DoubleDouble) -> DoubleDouble {
    let is_positive = x.hi > 0.0;
    let size = if is_positive { x } else { -x };
    let positive_part = if is_positive { x } else { DoubleDouble::ZERO };
    positive_part + ln_1p(exp(-size))
}

/// tanh x, with full relative precision near 0.
#[inline(always)]
pub fn tanh(x: DoubleDouble) -> DoubleDouble {
    // e^-80 is below 2^-107 of 1
    let is_negative = x.hi < 0.0;
    let size = if is_negative { -x } else { x };
    let size = if size.hi > 40.0 { DoubleDouble::from(40.0) } else { size };
    let t = exp_m1(size.times(2.0));
    let value = t / (t + 2.0);
    if is_negative { -value } else { value }
}

/// The logarithm `first` + ln(1 + w) for a w of the order of a double's rounding: one step of Newton's method.
#[inline(always)]
fn improved(first: f64, w: DoubleDouble) -> DoubleDouble {
    w - 0.5 * w.hi * w.hi + first
}

/// e^x and e^x - 1; what is not used is not computed.
#[inline(always)]
fn both(x: DoubleDouble) -> (DoubleDouble, DoubleDouble) {
    let (p, power) = reduced(x);
    ((p + 1.0).times(power), p.times(power) + DoubleDouble::sum(power, -1.0))
}

/// e^(x - k ln 2) - 1 and 2^k, with the whole k for which |x - k ln 2| <= ln(2)/2.
#[inline(always)]
fn reduced(x: DoubleDouble) -> (DoubleDouble, f64) {
    let x = if x.hi > LARGEST { DoubleDouble::from(LARGEST) } else { x };
    let x = if x.hi < -LARGEST { DoubleDouble::from(-LARGEST) } else { x };
    let shifted = x.hi * std::f64::consts::LOG2_E + ROUNDER;
    let k = shifted - ROUNDER;
    let r = (x - k * LN_2_HEAD) - LN_2_TAIL * k;
    let power = f64::from_bits((shifted.to_bits() << 52).wrapping_add(1.0_f64.to_bits()));
    // e^2s - 1 = p (2 + p) with p = e^s - 1, three times
    let eighth = series(r.times(0.125));
    let quarter = eighth * (eighth + 2.0);
    let half = quarter * (quarter + 2.0);
    (half * (half + 2.0), power)
}

/// e^r - 1 by its Taylor series to r^17 / 17!, for |r| <= ln(2)/16; terms from r^10 on in doubles, in which their
/// errors are below 2^-110 of the sum.
#[inline(always)]
fn series(r: DoubleDouble) -> DoubleDouble {
    const C: [DoubleDouble; 26] = INVERSE_FACTORIALS;
    let z = r.hi;
    let small = C[14].hi + z * (C[15].hi + z * (C[16].hi + z * C[17].hi));
    let tail = C[10].hi + z * (C[11].hi + z * (C[12].hi + z * (C[13].hi + z * small)));
    let sum = C[9] + z * tail;
    let sum = C[7] + r * (C[8] + r * sum);
    let sum = C[5] + r * (C[6] + r * sum);
    let sum = C[3] + r * (C[4] + r * sum);
    // 1 + r / 2 + ..., times r
    (r * (r * sum + 0.5) + 1.0) * r
}
