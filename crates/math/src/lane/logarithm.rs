//! The natural logarithm.

use super::exponential::{LN_2_HEAD, LN_2_TAIL};
use std::f64::consts::{FRAC_1_SQRT_2, SQRT_2};

/// (ln((1+s)/(1-s)) / s - 2) / s^2 as a polynomial in s^2, for ratios (1+s)/(1-s)
/// between sqrt(1/2) and sqrt(2), within 2^-59 of the logarithm (`coefficients.py`).
const SERIES: [f64; 7] = [
    0.666_666_666_666_673_4,
    0.399_999_999_994_148_87,
    0.285_714_287_423_478_93,
    0.222_221_985_767_688_26,
    0.181_835_641_582_680_54,
    0.153_140_544_875_549_73,
    0.147_959_131_721_694_73,
];

/// Above it the exponent does not fit the scaling.
const HIGHEST: f64 = 1e307;

/// ln x for a normal x > 0 up to 1e307; NaN for every other argument. Error below 1.2
/// units in the last place.
#[inline(always)]
pub fn ln(x: f64) -> f64 {
    let (e, inverse_power) = parts(x);
    let f = x * inverse_power - 1.0;
    let value = sum_of_logarithms(e * LN_2_HEAD, e * LN_2_TAIL, f, f / (2.0 + f));
    let normal = (f64::MIN_POSITIVE..=HIGHEST).contains(&x);
    if normal { value } else { f64::NAN }
}

/// ln(1 + x), with full relative precision near 0, for -1 < x <= 1e307; NaN for every
/// other argument. Error below 1.2 units in the last place.
#[inline(always)]
pub fn ln_1p(x: f64) -> f64 {
    ln_1p_of(x, Parts::new(x))
}

/// The second half of [`ln_1p`].
#[inline(always)]
pub(crate) fn ln_1p_of(x: f64, parts: Parts) -> f64 {
    let Parts { e, f, dropped, s } = parts;
    // d ln(1 + f) = df / (1 + f) = df (1 - s) / (1 + s), of which few digits matter
    let correction = dropped * (1.0 - (s + s) * (1.0 - s));
    let value = sum_of_logarithms(e * LN_2_HEAD, e * LN_2_TAIL + correction, f, s);
    let inside = (x > -1.0) & (x <= HIGHEST);
    if inside { value } else { f64::NAN }
}

/// 1 + x = 2^e (1 + f + dropped) and s = f / (2 + f): the first half of a logarithm.
#[derive(Clone, Copy)]
pub(crate) struct Parts {
    pub(crate) e: f64,
    pub(crate) f: f64,
    pub(crate) dropped: f64,
    pub(crate) s: f64,
}

impl Parts {
    #[inline(always)]
    pub(crate) fn new(x: f64) -> Parts {
        let sum = 1.0 + x;
        let x_part = sum - 1.0;
        let missing = (1.0 - (sum - x_part)) + (x - x_part);
        let (e, inverse_power) = parts(sum);
        let near = sum * inverse_power - 1.0;
        let far = missing * inverse_power;
        let f = near + far;
        let dropped = (near - f) + far;
        Parts { e, f, dropped, s: f / (2.0 + f) }
    }
}

/// The exponent e, as a double, and 2^-e for which x 2^-e lies between about
/// sqrt(1/2) and sqrt(2); x normal and below 2^1023 sqrt(2).
#[inline(always)]
fn parts(x: f64) -> (f64, f64) {
    // adding 1 - sqrt(1/2) in bits carries into the exponent where the fraction is above sqrt(2)
    const SHIFT: u64 = 0x3ff0_0000_0000_0000 - FRAC_1_SQRT_2.to_bits();
    const TWO_TO_52: u64 = 0x4330_0000_0000_0000;
    let biased = x.to_bits().wrapping_add(SHIFT) >> 52;
    let exponent = f64::from_bits(biased | TWO_TO_52) - (4_503_599_627_370_496.0 + 1023.0);
    let inverse_power = f64::from_bits(0x7fe0_0000_0000_0000_u64.wrapping_sub(biased << 52));
    (exponent, inverse_power)
}

/// head + tail + ln(1 + x) for x between sqrt(1/2) - 1 and sqrt(2) - 1, with
/// s = x / (2 + x); head is 0 or larger than x in size, tail is small.
#[inline(always)]
fn sum_of_logarithms(head: f64, tail: f64, x: f64, s: f64) -> f64 {
    let z = s * s;
    // grouped so that few operations wait for each other (Estrin)
    let w = z * z;
    let first = (SERIES[0] + SERIES[1] * z) + (SERIES[2] + SERIES[3] * z) * w;
    let second = (SERIES[4] + SERIES[5] * z) + SERIES[6] * w;
    let sum = first + second * (w * w);
    // ln(1 + x) = x - (h - s h) + s z sum with h = x^2/2
    let half_square = 0.5 * x * x;
    let rest = (half_square - s * half_square) - (s * z) * sum;
    let total = head + x;
    let missing = x - (total - head);
    total + (missing + (tail - rest))
}

/// 1 + x = 2^e (1 + f) and s = f / (2 + f), where e follows from x: the first half of a logarithm
/// of a number of little range.
#[derive(Clone, Copy)]
pub(crate) struct Ratio {
    pub(crate) f: f64,
    pub(crate) s: f64,
}

impl Ratio {
    /// For 0 <= x <= 1: e is 1 above sqrt(2) - 1, where f = (x - 1) / 2, else 0.
    #[inline(always)]
    pub(crate) fn of_unit(x: f64) -> Ratio {
        let above = x > SQRT_2 - 1.0;
        let numerator = if above { x - 1.0 } else { x };
        let denominator = x + if above { 3.0 } else { 2.0 };
        Ratio { f: if above { 0.5 * numerator } else { numerator }, s: numerator / denominator }
    }

    /// For -1/2 <= x <= 1: e is -1, 0 or 1.
    #[inline(always)]
    pub(crate) fn of_short(x: f64) -> Ratio {
        let f = if x > SQRT_2 - 1.0 { 0.5 * (x - 1.0) } else { x };
        let f = if x < FRAC_1_SQRT_2 - 1.0 { x + x + 1.0 } else { f };
        Ratio { f, s: f / (2.0 + f) }
    }
}

/// ln(1 + x) for 0 <= x <= 1 with [`Ratio::of_unit`].
#[inline(always)]
pub(crate) fn ln_1p_unit(x: f64, ratio: Ratio) -> f64 {
    let above = x > SQRT_2 - 1.0;
    let head = if above { LN_2_HEAD } else { 0.0 };
    let tail = if above { LN_2_TAIL } else { 0.0 };
    sum_of_logarithms(head, tail, ratio.f, ratio.s)
}

/// ln(1 + x) for -1/2 <= x <= 1 with [`Ratio::of_short`].
#[inline(always)]
pub(crate) fn ln_1p_short(x: f64, ratio: Ratio) -> f64 {
    let e = if x > SQRT_2 - 1.0 { 1.0 } else { 0.0 };
    let e = if x < FRAC_1_SQRT_2 - 1.0 { -1.0 } else { e };
    sum_of_logarithms(e * LN_2_HEAD, e * LN_2_TAIL, ratio.f, ratio.s)
}
