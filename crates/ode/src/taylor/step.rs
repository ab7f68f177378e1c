//! The order for a tolerance, and the step that the last coefficients allow.

use crate::control::Control;
use math::lane;

/// The order at a fixed step: higher ones gain nothing in double precision.
pub(crate) const HIGHEST: usize = 24;

/// The order for a tolerance. The step grows as tolerance^(1 / order), the work for it with the order and its square:
/// half the natural logarithm of the tolerance, and a few more for what a step costs besides. Constants from the times
/// of the scenes of figures 4 and 11; the minimum is flat: two orders more or less cost 2 %.
pub(super) fn order(control: Control) -> usize {
    match control {
        Control::Fixed { .. } => HIGHEST,
        Control::Adaptive { tolerance } => {
            let best = OFFSET - PER_E_FOLD * math::ln(tolerance);
            (best.round() as usize).clamp(4, HIGHEST)
        }
    }
}

/// Orders gained for a tolerance smaller by a factor of e.
const PER_E_FOLD: f64 = 0.45;
/// The order for a tolerance of 1.
const OFFSET: f64 = 6.0;

/// A whole power.
pub(super) fn power(mut base: f64, mut exponent: usize) -> f64 {
    let mut power = 1.0;
    while exponent > 0 {
        if exponent % 2 == 1 {
            power *= base;
        }
        base *= base;
        exponent /= 2;
    }
    power
}

/// The largest power of 2 that is not above a normal number.
pub(super) fn power_of_two(number: f64) -> f64 {
    const EXPONENT: u64 = 0x7ff0_0000_0000_0000;
    f64::from_bits(number.to_bits() & EXPONENT)
}

/// The logarithm of the step over which a term of order `k` with this coefficient, in units of the tolerance, grows to
/// 1, with the other sign. `None` for a coefficient that is not finite; for one that vanishes, of a step beyond every
/// run.
pub(super) fn growth(coefficient: f64, k: usize) -> Option<f64> {
    let clamped = math::smaller(math::larger(coefficient, LEAST), MOST);
    coefficient.is_finite().then(|| lane::ln(clamped) / k as f64)
}

/// Smaller coefficients are taken for this one.
const LEAST: f64 = 1e-300;
/// Larger ones for this one: the step is rejected then.
const MOST: f64 = 1e300;

/// A kink is passed by so much of the tolerance, and at least by so many roundings.
pub(super) const SLACK: f64 = 0.1;
pub(super) const ROUNDINGS: f64 = 4.0;

/// A step that a kink ends is the measure for the next one if it is no shorter than this, in units of the last one.
pub(super) const TELLING: f64 = 1e-4;

/// The step is so much shorter than that at which the last term meets the tolerance.
pub(super) const SAFETY: f64 = 0.95;
