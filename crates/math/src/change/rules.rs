//! Rules for differences: how much the result of an operation changes when its operands change, and what each rule
//! stores of the reference.
//!
//! With a = a0 + da: the product changes by `da b + a0 db`, the quotient q by `(da - q0 db) / b`, the exponential by
//! `e^a0 (e^da - 1)`, the logarithm by `ln(1 + da / a0)`. No rule subtracts two nearly equal numbers.

use crate::lane::{self, SoftplusBase};
use crate::lanes::Lanes;
use crate::number::{Number, repeated};

/// What an operation keeps of the reference.
#[derive(Clone, Copy, Debug)]
pub struct Kept {
    a: f64,
    b: f64,
    softplus: SoftplusBase,
}

impl Default for Kept {
    fn default() -> Kept {
        Kept { a: 0.0, b: 0.0, softplus: SoftplusBase::ZERO }
    }
}

impl Kept {
    fn pair(a: f64, b: f64) -> Kept {
        Kept { a, b, softplus: SoftplusBase::ZERO }
    }

    /// Of a product: both factors.
    pub fn of_product(a: f64, b: f64) -> Kept {
        Kept::pair(a, b)
    }

    /// Of a quotient: divisor and quotient.
    pub fn of_quotient(a: f64, b: f64) -> Kept {
        Kept::pair(b, a / b)
    }

    /// Of a reciprocal: the number and its reciprocal.
    pub fn of_recip(a: f64) -> Kept {
        Kept::pair(a, 1.0 / a)
    }

    /// Of a whole power: the number and, of a negative power, its reciprocal.
    pub fn of_whole_power(a: f64, n: i32) -> Kept {
        Kept::pair(a, if n < 0 { 1.0 / a } else { 0.0 })
    }

    /// Of any power: the reciprocal of the number, and the power.
    pub fn of_power(a: f64, q: f64) -> Kept {
        Kept::pair(1.0 / a, lane::pow(a, q))
    }

    /// Of an exponential: it and the exponent.
    pub fn of_exp(a: f64) -> Kept {
        Kept::pair(lane::exp(a), a)
    }

    /// Of a logarithm: the reciprocal of the number.
    pub fn of_ln(a: f64) -> Kept {
        Kept::pair(1.0 / a, 0.0)
    }

    /// Of ln(1 + a): 1 / (1 + a).
    pub fn of_ln_1p(a: f64) -> Kept {
        Kept::pair(1.0 / (1.0 + a), 0.0)
    }

    /// Of a square root: the number and its root.
    pub fn of_sqrt(a: f64) -> Kept {
        Kept::pair(a, a.sqrt())
    }

    /// Of a hyperbolic tangent, which is 2 sigma(2 a) - 1: the argument 2 a of the logistic function and its values
    /// there and on the other side.
    pub fn of_tanh(a: f64) -> Kept {
        let y = 2.0 * a;
        let softplus = SoftplusBase::new(y);
        Kept { a: lane::sigmoid(y), b: lane::sigmoid(-y), softplus }
    }

    /// Of the softplus function: its point.
    pub fn of_softplus(a: f64) -> Kept {
        Kept { softplus: SoftplusBase::new(a), ..Kept::default() }
    }

    /// Of an absolute value: the number.
    pub fn of_abs(a: f64) -> Kept {
        Kept::pair(a, 0.0)
    }

    /// Of the smaller or larger of two: both.
    pub fn of_pair(a: f64, b: f64) -> Kept {
        Kept::pair(a, b)
    }
}

/// Of a b.
#[inline(always)]
pub fn product(kept: &Kept, da: f64, db: f64) -> f64 {
    da * (kept.b + db) + kept.a * db
}

/// Of a / b.
#[inline(always)]
pub fn quotient(kept: &Kept, da: f64, db: f64) -> f64 {
    (da - kept.b * db) / (kept.a + db)
}

/// Of 1 / a.
#[inline(always)]
pub fn recip(kept: &Kept, da: f64) -> f64 {
    -(da * ((1.0 / (kept.a + da)) * kept.b))
}

/// Of a^n: `da (a^(n-1) + a^(n-2) a0 + ... + a0^(n-1))`, for a negative n of the reciprocals.
#[inline(always)]
pub fn whole_power(kept: &Kept, da: f64, n: i32) -> f64 {
    let after = kept.a + da;
    if n >= 0 {
        return telescope(da, after, kept.a, n.unsigned_abs());
    }
    let inverse = 1.0 / after;
    telescope(-(da * (inverse * kept.b)), inverse, kept.b, n.unsigned_abs())
}

/// `after^n - before^n` where `change` is their difference.
#[inline(always)]
fn telescope(change: f64, after: f64, before: f64, n: u32) -> f64 {
    match n {
        0 => 0.0,
        1 => change,
        2 => change * (after + before),
        3 => change * (after * after + before * (after + before)),
        _ => change * (1..n).fold(1.0, |sum, i| sum * after + repeated(before, i)),
    }
}

/// Of a^q.
#[inline(always)]
pub fn power(kept: &Kept, da: f64, q: f64) -> f64 {
    kept.b * lane::pow_m1(da * kept.a, q)
}

/// Of e^a, and of e^a - 1.
#[inline(always)]
pub fn exp(kept: &Kept, da: f64) -> f64 {
    kept.a * lane::exp_m1(da)
}

/// What [`exp`] does to e^da - 1, and [`ln`] to da before the logarithm.
#[inline(always)]
pub fn scale(kept: &Kept, x: f64) -> f64 {
    kept.a * x
}

/// The point of a softplus function.
pub fn softplus_base(kept: &Kept) -> &SoftplusBase {
    &kept.softplus
}

/// Whether e^a0 is next to nothing: then e^da may overflow where their product does not.
#[inline(always)]
pub fn is_faint(kept: &Kept) -> bool {
    kept.b < -600.0
}

/// [`exp`] where it is.
#[inline(always)]
pub fn faint_exp(kept: &Kept, da: f64) -> f64 {
    let near = kept.a * lane::exp_m1(if da < 1.0 { da } else { 1.0 });
    let far = lane::exp(kept.b + da) - kept.a;
    if da < 1.0 { near } else { far }
}

/// [`exp`], or [`faint_exp`] where that is needed.
pub(super) fn exp_of_any(kept: &Kept, da: f64) -> f64 {
    if is_faint(kept) { faint_exp(kept, da) } else { exp(kept, da) }
}

/// Of ln a, and of ln(1 + a).
#[inline(always)]
pub fn ln(kept: &Kept, da: f64) -> f64 {
    lane::ln_1p(da * kept.a)
}

/// Of the square root.
#[inline(always)]
pub fn sqrt(kept: &Kept, da: f64) -> f64 {
    let sum = (kept.a + da).sqrt() + kept.b;
    // from 0 to 0
    if sum == 0.0 { 0.0 } else { da / sum }
}

/// Of tanh a. With y = 2 a the logistic function changes by `(e^dy - 1) sigma(-y) sigma(y0)`, which for dy > 0 is
/// written with e^-dy: nothing cancels and nothing overflows.
#[inline(always)]
pub fn tanh(kept: &Kept, da: f64) -> f64 {
    let dy = 2.0 * da;
    let y = kept.softplus.point() + dy;
    let rises = dy > 0.0;
    let less = lane::exp_m1(if rises { -dy } else { dy });
    let slope = lane::sigmoid(if rises { y } else { -y }) * if rises { kept.b } else { kept.a };
    let change = 2.0 * (less * slope);
    if rises { -change } else { change }
}

/// Of ln(1 + e^a).
#[inline(always)]
pub fn softplus(kept: &Kept, da: f64) -> f64 {
    lane::softplus_difference(&kept.softplus, da)
}

/// [`power`] of several.
#[inline(always)]
pub(super) fn power_of<const W: usize>(kept: &Kept, da: Lanes<W>, q: f64) -> Lanes<W> {
    ((da * kept.a).ln_1p() * q).exp_m1() * kept.b
}

/// [`exp`] of several.
#[inline(always)]
pub(super) fn exp_of<const W: usize>(kept: &Kept, da: Lanes<W>) -> Lanes<W> {
    da.exp_m1() * kept.a
}

/// [`ln`] of several.
#[inline(always)]
pub(super) fn ln_of<const W: usize>(kept: &Kept, da: Lanes<W>) -> Lanes<W> {
    (da * kept.a).ln_1p()
}

/// [`softplus`] of several.
#[inline(always)]
pub(super) fn softplus_of<const W: usize>(kept: &Kept, da: Lanes<W>) -> Lanes<W> {
    da.softplus_difference(&kept.softplus)
}

/// Of |a|.
#[inline(always)]
pub fn abs(kept: &Kept, da: f64) -> f64 {
    let before = kept.a;
    let after = before + da;
    let along = if before < 0.0 { -da } else { da };
    let across = after.abs() - before.abs();
    if (before < 0.0) == (after < 0.0) { along } else { across }
}

/// Of the smaller of a and b.
#[inline(always)]
pub fn min(kept: &Kept, da: f64, db: f64) -> f64 {
    -max(&Kept::pair(-kept.a, -kept.b), -da, -db)
}

/// Of the larger of a and b.
#[inline(always)]
pub fn max(kept: &Kept, da: f64, db: f64) -> f64 {
    let apart = kept.b - kept.a;
    let takes_b = apart + (db - da) > 0.0;
    let took_b = apart > 0.0;
    let taken = if takes_b { db } else { da };
    // the other one now: its change, and how far apart they were
    let offset = if takes_b { apart } else { -apart };
    if takes_b == took_b { taken } else { taken + offset }
}
