//! Conversion of double-double numbers to and from decimal text.

use super::DoubleDouble;
use std::cmp::Ordering;

/// The number with `digits` >= 1 significant decimal digits, rounded from its exact value (half to even), `d.ddde-x`;
/// zero is `0`. For finite numbers.
pub fn format(value: DoubleDouble, digits: usize) -> String {
    // the double of larger size decides the sign
    let (hi, lo) = (value.hi, value.lo);
    if hi == 0.0 && lo == 0.0 {
        return "0".to_owned();
    }
    let negative = if hi == 0.0 { lo < 0.0 } else { hi < 0.0 };
    let places = places(hi).max(places(lo));
    let mut exact = expanded(hi, places);
    combine(&mut exact, &expanded(lo, places), (hi < 0.0) == (lo < 0.0));
    let leading = exact.iter().position(|&digit| digit != 0).unwrap_or(0);
    let mut exponent = (exact.len() - 1 - leading) as i64 - places as i64;
    let mut kept = exact.split_off(leading);
    kept.resize(kept.len().max(digits), 0);
    let rest = kept.split_off(digits);
    if rounds_up(&kept, &rest) && carry(&mut kept) {
        exponent += 1;
    }
    let text: String = kept.iter().map(|&digit| char::from(b'0' + digit)).collect();
    let (first, others) = text.split_at(1);
    let point = if others.is_empty() { "" } else { "." };
    let power = if exponent == 0 { String::new() } else { format!("e{exponent}") };
    format!("{}{first}{point}{others}{power}", if negative { "-" } else { "" })
}

/// The number that a decimal text means, with a relative error below 2^-98 (digits from the 39th on are not read);
/// `None` if the text is no finite decimal number. For sizes between about 1e-250 and 1e250.
pub fn parse(text: &str) -> Option<DoubleDouble> {
    let (mantissa, exponent) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let (sign, whole) = match whole.strip_prefix('-') {
        Some(rest) => (-1.0, rest),
        None => (1.0, whole),
    };
    let digits = format!("{whole}{fraction}");
    if digits.is_empty() || !digits.bytes().all(|byte| byte.is_ascii_digit()) {
        return None;
    }
    let digits = digits.trim_start_matches('0');
    let read = digits.len().min(38);
    let number: i128 = if read == 0 { 0 } else { digits[..read].parse().ok()? };
    let shift = i32::try_from(digits.len() - read).ok()? - i32::try_from(fraction.len()).ok()?;
    let exponent = exponent.parse::<i32>().ok()?.checked_add(shift)?;
    // the cast rounds to nearest; what it leaves out is below 2^74 and rounded once more
    let hi = number as f64;
    let rest = number - hi as i128;
    let value = DoubleDouble::ordered_sum(hi, rest as f64);
    let power = power_of_ten(exponent.unsigned_abs());
    let scaled = if exponent < 0 { value / power } else { value * power };
    Some(scaled.times(sign))
}

/// 10^n, by squaring.
fn power_of_ten(n: u32) -> DoubleDouble {
    let (mut power, mut square, mut left) = (DoubleDouble::ONE, DoubleDouble::from(10.0), n);
    while left > 0 {
        if left & 1 == 1 {
            power = power * square;
        }
        left >>= 1;
        if left > 0 {
            square = square * square;
        }
    }
    power
}

/// How many binary, and so how many decimal, places after the point the double has.
fn places(value: f64) -> usize {
    let bits = value.to_bits();
    let biased = ((bits >> 52) & 0x7ff).max(1) as i64;
    let fraction = (bits & ((1 << 52) - 1)) | (1 << 52);
    if value == 0.0 { 0 } else { (1075 - biased - i64::from(fraction.trailing_zeros())).max(0) as usize }
}

/// The decimal digits of the size of a double, `places` of them after the point; 0 in front. Exact where the double has
/// no more places.
fn expanded(value: f64, places: usize) -> Vec<u8> {
    let text = format!("{:0>width$}", format!("{:.places$}", value.abs()), width = 320 + places);
    text.bytes().filter(u8::is_ascii_digit).map(|byte| byte - b'0').collect()
}

/// Adds `other` to `digits`, or takes the smaller of the two from the larger.
fn combine(digits: &mut Vec<u8>, other: &[u8], is_sum: bool) {
    // one double has a point where the other may have none: align the ends
    let length = digits.len().max(other.len());
    let widened = |digits: &[u8]| [vec![0; length - digits.len()], digits.to_vec()].concat();
    let (mut large, mut small) = (widened(digits), widened(other));
    if large < small {
        std::mem::swap(&mut large, &mut small);
    }
    let mut carried = 0;
    for (a, b) in large.iter_mut().zip(&small).rev() {
        let value = if is_sum { *a as i8 + *b as i8 + carried } else { *a as i8 - *b as i8 + carried };
        carried = value.div_euclid(10);
        *a = value.rem_euclid(10) as u8;
    }
    *digits = large;
}

/// Whether the digits cut off, `rest`, count as one of the last digit kept.
fn rounds_up(kept: &[u8], rest: &[u8]) -> bool {
    let Some((first, others)) = rest.split_first() else { return false };
    let is_odd = kept.last().is_some_and(|digit| digit % 2 == 1);
    match first.cmp(&5) {
        Ordering::Less => false,
        Ordering::Greater => true,
        Ordering::Equal => is_odd || others.iter().any(|&digit| digit != 0),
    }
}

/// Adds one to the last digit; whether all were nines, so that there is a new leading 1 (and one digit less).
fn carry(digits: &mut [u8]) -> bool {
    for digit in digits.iter_mut().rev() {
        if *digit < 9 {
            *digit += 1;
            return false;
        }
        *digit = 0;
    }
    digits[0] = 1;
    true
}
