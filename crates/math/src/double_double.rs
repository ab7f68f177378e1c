//! Numbers of about 106 bits: unevaluated sums of two doubles.
//!
//! Used where a double is too coarse: inside the scalar functions, for reference
//! solutions and error bounds. The algorithms and their error bounds are those of
//! Joldes, Muller and Popescu, "Tight and rigorous error bounds for basic building
//! blocks of double-word arithmetic", ACM Trans. Math. Softw. 44 (2017), with
//! products split after Dekker, so no fused multiply-add is needed.

pub mod decimal;
pub mod full;

use std::ops::{Add, Div, Mul, Neg, Sub};

/// The number `hi + lo`, where `hi` is the double nearest to that sum.
///
/// Results have a relative error of a few 2^-104, with any unit, and are meaningful while all intermediate values stay
/// between about 1e-290 and 1e300 in size (the errors of products must not underflow, their splitting must not
/// overflow).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DoubleDouble {
    /// The double nearest to the number.
    pub hi: f64,
    /// What `hi` leaves out; at most half a unit in the last place of `hi`.
    pub lo: f64,
}

impl DoubleDouble {
    /// Zero.
    pub const ZERO: DoubleDouble = DoubleDouble { hi: 0.0, lo: 0.0 };
    /// One.
    pub const ONE: DoubleDouble = DoubleDouble { hi: 1.0, lo: 0.0 };
    /// The natural logarithm of 2.
    pub const LN_2: DoubleDouble = DoubleDouble { hi: std::f64::consts::LN_2, lo: 2.3190468138462996e-17 };
    /// 1 / ln 10, the factor from natural to decimal logarithms.
    pub const INVERSE_LN_10: DoubleDouble = DoubleDouble { hi: std::f64::consts::LOG10_E, lo: 1.098319650216765e-17 };
    /// pi / 2, a quarter turn.
    pub const HALF_PI: DoubleDouble = DoubleDouble { hi: std::f64::consts::FRAC_PI_2, lo: 6.123233995736766e-17 };

    /// The exact sum of two doubles (Knuth).
    #[inline(always)]
    pub fn sum(a: f64, b: f64) -> DoubleDouble {
        let hi = a + b;
        let b_part = hi - a;
        let a_part = hi - b_part;
        DoubleDouble { hi, lo: (a - a_part) + (b - b_part) }
    }

    /// The exact sum of two doubles where `|a| >= |b|` or `a = 0` (Dekker).
    #[inline(always)]
    pub fn ordered_sum(a: f64, b: f64) -> DoubleDouble {
        let hi = a + b;
        DoubleDouble { hi, lo: b - (hi - a) }
    }

    /// The exact product of two doubles (Dekker, Veltkamp).
    #[inline(always)]
    pub fn product(a: f64, b: f64) -> DoubleDouble {
        let hi = a * b;
        let (a_head, a_tail) = halves(a);
        let (b_head, b_tail) = halves(b);
        let rest = (a_head * b_head - hi) + a_head * b_tail + a_tail * b_head;
        DoubleDouble { hi, lo: rest + a_tail * b_tail }
    }

    /// The square root of a number >= 0, NaN below; relative error below 2^-104.
    #[inline]
    pub fn sqrt(self) -> DoubleDouble {
        let root = self.hi.sqrt();
        if root == 0.0 {
            return DoubleDouble::ZERO;
        }
        let rest = self - DoubleDouble::product(root, root);
        DoubleDouble::ordered_sum(root, rest.hi / (2.0 * root))
    }

    /// The product with a power of 2, which is exact where no part underflows.
    #[inline(always)]
    pub fn times(self, power_of_two: f64) -> DoubleDouble {
        DoubleDouble { hi: self.hi * power_of_two, lo: self.lo * power_of_two }
    }

    /// The absolute value.
    #[inline]
    pub fn abs(self) -> DoubleDouble {
        if self.hi < 0.0 { -self } else { self }
    }
}

/// `a` as the sum of two numbers of 26 bits each, whose products are exact.
#[inline(always)]
fn halves(a: f64) -> (f64, f64) {
    const SPLITTER: f64 = 134_217_729.0; // 2^27 + 1
    let big = SPLITTER * a;
    let head = big - (big - a);
    (head, a - head)
}

impl From<f64> for DoubleDouble {
    #[inline(always)]
    fn from(value: f64) -> DoubleDouble {
        DoubleDouble { hi: value, lo: 0.0 }
    }
}

impl From<DoubleDouble> for f64 {
    #[inline(always)]
    fn from(value: DoubleDouble) -> f64 {
        value.hi + value.lo
    }
}

impl Neg for DoubleDouble {
    type Output = DoubleDouble;
    #[inline(always)]
    fn neg(self) -> DoubleDouble {
        DoubleDouble { hi: -self.hi, lo: -self.lo }
    }
}

impl Add for DoubleDouble {
    type Output = DoubleDouble;
    #[inline(always)]
    fn add(self, other: DoubleDouble) -> DoubleDouble {
        let heads = DoubleDouble::sum(self.hi, other.hi);
        let tails = DoubleDouble::sum(self.lo, other.lo);
        let sum = DoubleDouble::ordered_sum(heads.hi, heads.lo + tails.hi);
        DoubleDouble::ordered_sum(sum.hi, sum.lo + tails.lo)
    }
}

impl Add<f64> for DoubleDouble {
    type Output = DoubleDouble;
    #[inline(always)]
    fn add(self, other: f64) -> DoubleDouble {
        let heads = DoubleDouble::sum(self.hi, other);
        DoubleDouble::ordered_sum(heads.hi, heads.lo + self.lo)
    }
}

impl Sub for DoubleDouble {
    type Output = DoubleDouble;
    #[inline(always)]
    fn sub(self, other: DoubleDouble) -> DoubleDouble {
        self + -other
    }
}

impl Sub<f64> for DoubleDouble {
    type Output = DoubleDouble;
    #[inline(always)]
    fn sub(self, other: f64) -> DoubleDouble {
        self + -other
    }
}

impl Mul for DoubleDouble {
    type Output = DoubleDouble;
    #[inline(always)]
    fn mul(self, other: DoubleDouble) -> DoubleDouble {
        let heads = DoubleDouble::product(self.hi, other.hi);
        let crossed = self.hi * other.lo + self.lo * other.hi + self.lo * other.lo;
        DoubleDouble::ordered_sum(heads.hi, heads.lo + crossed)
    }
}

impl Mul<f64> for DoubleDouble {
    type Output = DoubleDouble;
    #[inline(always)]
    fn mul(self, other: f64) -> DoubleDouble {
        let head = DoubleDouble::product(self.hi, other);
        DoubleDouble::ordered_sum(head.hi, head.lo + self.lo * other)
    }
}

impl Div for DoubleDouble {
    type Output = DoubleDouble;
    #[inline(always)]
    fn div(self, other: DoubleDouble) -> DoubleDouble {
        let head = self.hi / other.hi;
        let rest = self - other * head;
        DoubleDouble::ordered_sum(head, rest.hi / other.hi)
    }
}

impl Div<f64> for DoubleDouble {
    type Output = DoubleDouble;
    #[inline(always)]
    fn div(self, other: f64) -> DoubleDouble {
        self / DoubleDouble::from(other)
    }
}
