//! The softplus function ln(1 + e^x), its differences, and its slope.

use super::exponential::{LOWEST, Reduced};
use super::logarithm::{Ratio, ln_1p_short, ln_1p_unit};

/// ln(1 + e^x) for every finite x, with full relative precision for x << 0 as well
/// (at x = -708 it stops decreasing). Error below 2 units in the last place.
#[inline(always)]
pub fn softplus(x: f64) -> f64 {
    let decay = reduced_decay(x).exp();
    softplus_of(x, decay, Ratio::of_unit(decay))
}

/// [`softplus`], and e^-|x| as [`exp`](super::exp) gives it, at the cost of one exponential.
#[inline(always)]
pub fn softplus_and_decay(x: f64) -> [f64; 2] {
    let least = reduced_decay(x).exp();
    let decay = if x.abs() > -LOWEST { 0.0 } else { least };
    [softplus_of(x, least, Ratio::of_unit(least)), decay]
}

/// 1 / (1 + e^-x), the slope of the softplus function. Error below 2.5 units in the
/// last place; at x = -708 it stops decreasing.
#[inline(always)]
pub fn sigmoid(x: f64) -> f64 {
    let decay = reduced_decay(x).exp();
    let numerator = if x < 0.0 { decay } else { 1.0 };
    numerator / (1.0 + decay)
}

/// The argument -|x|, but not below -708: that of the decay e^-|x|, from which [`softplus_of`] continues.
#[inline(always)]
pub(crate) fn reduced_decay(x: f64) -> Reduced {
    let size = x.abs();
    Reduced::new(if size > -LOWEST { LOWEST } else { -size })
}

/// ln(1 + e^x) from the decay e^-|x| and its ratio.
#[inline(always)]
pub(crate) fn softplus_of(x: f64, decay: f64, ratio: Ratio) -> f64 {
    let positive_part = if x > 0.0 { x } else { 0.0 };
    positive_part + ln_1p_unit(decay, ratio)
}

/// A point from which differences of the softplus function are taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SoftplusBase {
    /// The point y0.
    point: f64,
    /// 1 for y0 >= 0, else -1.
    sign: f64,
    /// 1 for y0 >= 0, else 0: the slope of max(y, 0).
    above: f64,
    /// 1 - above.
    below: f64,
    /// Up to this |y0| - |y| a change on one side of 0 is computed from the share.
    reach: f64,
    /// a = e^-|y0|, but not below e^-708.
    decay: f64,
    /// 1 / (1 + a).
    inverse: f64,
    /// a / (1 + a), or 0 where |y0| is beyond 708.
    share: f64,
}

impl SoftplusBase {
    /// The base at 0.
    pub const ZERO: SoftplusBase = SoftplusBase {
        point: 0.0,
        sign: 1.0,
        above: 1.0,
        below: 0.0,
        reach: -LOWEST,
        decay: 1.0,
        inverse: 0.5,
        share: 0.5,
    };

    /// The point.
    #[inline(always)]
    pub fn point(&self) -> f64 {
        self.point
    }

    /// The base at a finite point.
    pub fn new(point: f64) -> SoftplusBase {
        let (sign, above, below) = if point >= 0.0 { (1.0, 1.0, 0.0) } else { (-1.0, 0.0, 1.0) };
        let size = point.abs();
        // tiny differences are as precise as the share, so that is rounded once only
        let decay = reduced_decay(point).exp_with_tail();
        let share = (decay / (decay + 1.0)).hi;
        let (reach, share) = if size > -LOWEST { (0.0, 0.0) } else { (-LOWEST, share) };
        SoftplusBase { point, sign, above, below, reach, decay: decay.hi, inverse: 1.0 - share, share }
    }
}

/// softplus(y0 + d) - softplus(y0), with an error relative to this difference, however
/// small d: below 3 units in the last place while |y0| <= 708. Beyond, the rounding of
/// y = y0 + d adds up to |y| units.
///
/// The softplus function is max(y, 0) + h(|y|), h(p) = ln(1 + e^-p). The difference of
/// the first terms is d, 0 or one of the points, by the signs. That of the second is
/// ln(1 + u), with u from `Change`.
#[inline(always)]
pub fn softplus_difference(base: &SoftplusBase, d: f64) -> f64 {
    let change = Change::new(base, d).value(base);
    softplus_difference_of(base, d, change, Ratio::of_short(change))
}

/// The first half of u = (e^-|y| - a) / (1 + a) for y = y0 + d and a = e^-|y0|, which lies between -1/2 and 1.
///
/// On one side of 0, where |y0| - |y| is d or -d without rounding, it is computed as
/// a / (1 + a) (e^(|y0| - |y|) - 1), and so it is where |y| is not much smaller than |y0|.
#[derive(Clone, Copy)]
pub(crate) struct Change {
    /// The argument of the exponential.
    pub(crate) reduced: Reduced,
    /// 1 where the exponential is that of |y0| - |y|, from which 1 is taken off; else 0.
    pub(crate) less: f64,
}

impl Change {
    #[inline(always)]
    pub(crate) fn new(base: &SoftplusBase, d: f64) -> Change {
        let SoftplusBase { point, sign, reach, .. } = *base;
        let y = point + d;
        let oriented = y * sign;
        let same_side = oriented >= 0.0;
        let approach = if same_side { -d * sign } else { point * sign + oriented };
        let near = approach <= if same_side { reach } else { 1.0 };
        let argument = if near { approach } else { -y.abs() };
        let argument = if argument < LOWEST { LOWEST } else { argument };
        Change { reduced: Reduced::new(argument), less: if near { 1.0 } else { 0.0 } }
    }

    /// u.
    #[inline(always)]
    pub(crate) fn value(self, base: &SoftplusBase) -> f64 {
        let exponential = self.reduced.exp_less(self.less);
        let close = base.share * exponential;
        let far = (exponential - base.decay) * base.inverse;
        if self.less > 0.0 { close } else { far }
    }
}

/// softplus(y0 + d) - softplus(y0) from u and its ratio.
#[inline(always)]
pub(crate) fn softplus_difference_of(base: &SoftplusBase, d: f64, change: f64, ratio: Ratio) -> f64 {
    let SoftplusBase { point, sign, above, below, .. } = *base;
    let y = point + d;
    let crossed = below * y - above * point;
    let linear = if y * sign >= 0.0 { above * d } else { crossed };
    linear + ln_1p_short(change, ratio)
}
