//! Sine and cosine.

use super::power_of_two;
use super::series::{every_second, sum};
use crate::double_double::DoubleDouble;

/// The sine of an angle in radians, of any size; NaN for an infinite angle.
pub fn sin(x: f64) -> f64 {
    if x.abs() < 1.0 / (1u64 << 27) as f64 {
        return x; // the next term, x^3/6, is below half a unit
    }
    let (quadrant, angle) = reduced(x);
    rotated(quadrant, angle)
}

/// The cosine of an angle in radians, of any size; NaN for an infinite angle.
pub fn cos(x: f64) -> f64 {
    let (quadrant, angle) = reduced(x);
    rotated(quadrant + 1, angle)
}

/// sin(angle + quadrant pi/2).
fn rotated(quadrant: u64, angle: DoubleDouble) -> f64 {
    let value: f64 = if quadrant.is_multiple_of(2) { sine(angle) } else { cosine(angle) }.into();
    if quadrant & 2 == 0 { value } else { -value }
}

/// The sine for |r| <= pi/4, by its Taylor series to r^25 / 25!.
fn sine(r: DoubleDouble) -> DoubleDouble {
    const COEFFICIENTS: [DoubleDouble; 13] = every_second(1);
    sum(&COEFFICIENTS, 6, r * r) * r
}

/// The cosine for |r| <= pi/4, by its Taylor series to r^24 / 24!.
fn cosine(r: DoubleDouble) -> DoubleDouble {
    const COEFFICIENTS: [DoubleDouble; 13] = every_second(0);
    sum(&COEFFICIENTS, 6, r * r)
}

/// A number of quarter turns (modulo 4) and the rest of the angle, at most pi/4 in size.
fn reduced(x: f64) -> (u64, DoubleDouble) {
    if x.abs() <= std::f64::consts::FRAC_PI_4 {
        return (0, DoubleDouble::from(x));
    }
    if !x.is_finite() {
        return (0, DoubleDouble::from(f64::NAN));
    }
    let [first, second, third, fourth] = quarter_turns(x.abs());
    let quadrant = first >> 62;
    let high = wide(first, second) << 2 | wide(third, fourth) >> 126;
    let low = wide(third, fourth) << 2;
    let (quadrant, turn) =
        if high >> 127 == 0 { (quadrant, fraction(high, low)) } else { (quadrant + 1, -fraction(!high, !low)) };
    let angle = turn * DoubleDouble::HALF_PI;
    if x < 0.0 { (8 - quadrant, -angle) } else { (quadrant, angle) }
}

/// |x| 2/pi modulo 4 in units of 2^-254, for |x| > pi/4, after Payne and Hanek: of
/// the bits of 2/pi only those take part that decide the last two whole bits and
/// the fraction.
fn quarter_turns(size: f64) -> [u64; 4] {
    let bits = size.to_bits();
    let mantissa = (bits & ((1 << 52) - 1)) | (1 << 52);
    // size = mantissa 2^e; bits of 2/pi of weight 2^(1-e) and more give multiples of 4
    let start = (bits >> 52) as usize + 62 - 1075;
    let (word, shift) = (start / 64, start % 64);
    let mut product = [0; 4];
    let mut carry = 0;
    for i in (0..4).rev() {
        let window = wide(TWO_OVER_PI[word + i], TWO_OVER_PI[word + i + 1]) << shift;
        let sum = u128::from(mantissa) * (window >> 64) + carry;
        product[i] = sum as u64;
        carry = sum >> 64;
    }
    product
}

/// (high 2^128 + low) 2^-256 to 106 bits.
fn fraction(high: u128, low: u128) -> DoubleDouble {
    let zeros = high.leading_zeros().min(127);
    let leading = high << zeros | (low >> 1) >> (127 - zeros);
    let head = (leading >> 75) as f64;
    let tail = ((leading >> 22) & ((1 << 53) - 1)) as f64 * power_of_two(-53);
    let unit = power_of_two(-53 - zeros as i32);
    DoubleDouble::ordered_sum(head * unit, tail * unit)
}

fn wide(high: u64, low: u64) -> u128 {
    u128::from(high) << 64 | u128::from(low)
}

/// The bits of 2/pi after its binary point, behind 64 zeros (printed by `coefficients.py`).
#[rustfmt::skip]
const TWO_OVER_PI: [u64; 21] = [
    0x0000_0000_0000_0000,
    0xa2f9_836e_4e44_1529,
    0xfc27_57d1_f534_ddc0,
    0xdb62_9599_3c43_9041,
    0xfe51_63ab_debb_c561,
    0xb724_6e3a_424d_d2e0,
    0x0649_2eea_09d1_921c,
    0xfe1d_eb1c_b129_a73e,
    0xe882_35f5_2ebb_4484,
    0xe99c_7026_b45f_7e41,
    0x3991_d639_8353_39f4,
    0x9c84_5f8b_bdf9_283b,
    0x1ff8_97ff_de05_980f,
    0xef2f_118b_5a0a_6d1f,
    0x6d36_7ecf_27cb_09b7,
    0x4f46_3f66_9e5f_ea2d,
    0x7527_bac7_ebe5_f17b,
    0x3d07_39f7_8a52_92ea,
    0x6bfb_5fb1_1f8d_5d08,
    0x5603_3046_fc7b_6bab,
    0xf0cf_bc20_9af4_361d,
];
