//! The exponential function.

use crate::double_double::DoubleDouble;

/// The double next to 1 / ln 2.
const INVERSE_LN_2: f64 = std::f64::consts::LOG2_E;
/// The first 33 bits of ln 2, so that its product with a whole number up to 2^20 is exact.
pub(super) const LN_2_HEAD: f64 = 0.693_147_180_601_954_5;
/// ln 2 less its first 33 bits.
pub(super) const LN_2_TAIL: f64 = -4.200_915_072_681_084_6e-11;
/// Adding it to a number below 2^51 rounds that to a whole number, found in the last bits.
const ROUNDER: f64 = 6_755_399_441_055_744.0; // 1.5 2^52
/// (e^r - 1 - r - r^2/2) / r^3 for |r| <= ln(2)/2, within 2^-64 of e^r (`coefficients.py`).
const TAIL: [f64; 10] = [
    0.166_666_666_666_666_82,
    0.041_666_666_666_666_7,
    0.008_333_333_333_316_874,
    0.001_388_888_888_886_518,
    0.000_198_412_698_967_806_02,
    2.480_158_736_508_934_8e-5,
    2.755_723_447_632_069_3e-6,
    2.755_723_867_959_611e-7,
    2.511_216_589_038_178e-8,
    2.092_568_003_611_307_3e-9,
];

/// e^x. Zero below -708, infinite above 709.78. Error below 0.7 units in the last place.
#[inline(always)]
pub fn exp(x: f64) -> f64 {
    exp_of(x, Reduced::new(x))
}

/// The second half of [`exp`].
#[inline(always)]
pub(crate) fn exp_of(x: f64, reduced: Reduced) -> f64 {
    let value = reduced.exp();
    let value = if x < LOWEST { 0.0 } else { value };
    if x > HIGHEST { f64::INFINITY } else { value }
}

/// e^x - 1, with full relative precision near 0. Infinite above 709. Error below 1.3 units
/// in the last place.
#[inline(always)]
pub fn exp_m1(x: f64) -> f64 {
    exp_m1_of(x, Reduced::new(x))
}

/// The second half of [`exp_m1`].
#[inline(always)]
pub(crate) fn exp_m1_of(x: f64, reduced: Reduced) -> f64 {
    let value = reduced.exp_less(1.0);
    let value = if x < LOWEST { -1.0 } else { value };
    if x > 709.0 { f64::INFINITY } else { value }
}

/// Below it the exponential is not computed but set to 0.
pub(super) const LOWEST: f64 = -708.0;
/// Above it, ln(2^1024), the exponential overflows.
const HIGHEST: f64 = 709.782_712_893_384;

/// An argument x = k ln 2 + r with whole k and |r| <= ln(2)/2: the first half of an exponential.
#[derive(Clone, Copy)]
pub(crate) struct Reduced {
    /// r, rounded.
    pub(crate) r: f64,
    /// What that rounding took off.
    pub(crate) missing: f64,
    /// k, in the last bits.
    pub(crate) shifted: f64,
}

impl Reduced {
    #[inline(always)]
    pub(crate) fn new(x: f64) -> Reduced {
        let shifted = x * INVERSE_LN_2 + ROUNDER;
        let k = shifted - ROUNDER;
        let head = x - k * LN_2_HEAD; // exact
        let tail = k * LN_2_TAIL;
        let r = head - tail;
        let missing = (head - r) - tail;
        Reduced { r, missing, shifted }
    }

    /// e^(x - k ln 2) - 1 - r, which holds the rounding of r.
    #[inline(always)]
    fn rest(self) -> f64 {
        let Reduced { r, missing, .. } = self;
        // grouped so that few operations wait for each other (Estrin)
        let square = r * r;
        let fourth = square * square;
        let first = (TAIL[0] + TAIL[1] * r) + (TAIL[2] + TAIL[3] * r) * square;
        let second = (TAIL[4] + TAIL[5] * r) + (TAIL[6] + TAIL[7] * r) * square;
        let sum = first + (second + (TAIL[8] + TAIL[9] * r) * fourth) * fourth;
        (square * r) * sum + (0.5 * square + missing)
    }

    /// k in the bits of an exponent.
    #[inline(always)]
    fn exponent(self) -> u64 {
        self.shifted.to_bits() << 52
    }

    /// e^x; right from x = -708 up to ln(2^1024).
    #[inline(always)]
    pub(crate) fn exp(self) -> f64 {
        let rest = self.rest();
        let sum = 1.0 + self.r;
        let missing = self.r - (sum - 1.0);
        let value = sum + (missing + rest);
        f64::from_bits(value.to_bits().wrapping_add(self.exponent()))
    }

    /// e^x with another 5 bits or so beyond a double.
    pub(super) fn exp_with_tail(self) -> DoubleDouble {
        let power = f64::from_bits(self.exponent().wrapping_add(1.0_f64.to_bits()));
        let sum = DoubleDouble::ordered_sum(1.0, self.r);
        DoubleDouble::ordered_sum(sum.hi, sum.lo + self.rest()).times(power)
    }

    /// e^x - `less` for `less` = 0 or 1; right from x = -708 up to 709.
    #[inline(always)]
    pub(crate) fn exp_less(self, less: f64) -> f64 {
        let rest = self.rest();
        let power = f64::from_bits(self.exponent().wrapping_add(1.0_f64.to_bits()));
        let head = power * self.r;
        let base = power - less;
        let sum = base + head;
        let missing = head - (sum - base);
        sum + (missing + power * rest)
    }
}
