//! Values with a derivative.

use crate::lane;
use crate::number::Number;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A value and its derivative with respect to one variable.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual {
    /// The value, in any unit.
    pub value: f64,
    /// Its derivative, in the unit of the value over that of the variable: at a kink that of one side, NaN beyond the range
    /// of a function.
    pub slope: f64,
}

impl Dual {
    /// The variable itself: its slope is 1.
    #[inline(always)]
    pub fn variable(value: f64) -> Dual {
        Dual { value, slope: 1.0 }
    }

    /// What does not depend on the variable: its slope is 0.
    #[inline(always)]
    pub fn constant(value: f64) -> Dual {
        Dual { value, slope: 0.0 }
    }

    #[inline(always)]
    fn chain(self, value: f64, slope: f64) -> Dual {
        Dual { value, slope: slope * self.slope }
    }
}

impl Neg for Dual {
    type Output = Dual;
    #[inline(always)]
    fn neg(self) -> Dual {
        Dual { value: -self.value, slope: -self.slope }
    }
}

impl Add for Dual {
    type Output = Dual;
    #[inline(always)]
    fn add(self, other: Dual) -> Dual {
        Dual { value: self.value + other.value, slope: self.slope + other.slope }
    }
}

impl Sub for Dual {
    type Output = Dual;
    #[inline(always)]
    fn sub(self, other: Dual) -> Dual {
        Dual { value: self.value - other.value, slope: self.slope - other.slope }
    }
}

impl Mul for Dual {
    type Output = Dual;
    #[inline(always)]
    fn mul(self, other: Dual) -> Dual {
        Dual { value: self.value * other.value, slope: self.slope * other.value + self.value * other.slope }
    }
}

impl Div for Dual {
    type Output = Dual;
    #[inline(always)]
    fn div(self, other: Dual) -> Dual {
        let value = self.value / other.value;
        Dual { value, slope: (self.slope - value * other.slope) / other.value }
    }
}

impl Add<f64> for Dual {
    type Output = Dual;
    #[inline(always)]
    fn add(self, other: f64) -> Dual {
        Dual { value: self.value + other, ..self }
    }
}

impl Sub<f64> for Dual {
    type Output = Dual;
    #[inline(always)]
    fn sub(self, other: f64) -> Dual {
        Dual { value: self.value - other, ..self }
    }
}

impl Mul<f64> for Dual {
    type Output = Dual;
    #[inline(always)]
    fn mul(self, other: f64) -> Dual {
        Dual { value: self.value * other, slope: self.slope * other }
    }
}

impl Div<f64> for Dual {
    type Output = Dual;
    #[inline(always)]
    fn div(self, other: f64) -> Dual {
        Dual { value: self.value / other, slope: self.slope / other }
    }
}

impl Number for Dual {
    #[inline(always)]
    fn recip(self) -> Dual {
        let inverse = 1.0 / self.value;
        self.chain(inverse, -inverse * inverse)
    }

    #[inline(always)]
    fn powi(self, n: i32) -> Dual {
        let slope = if n == 0 { 0.0 } else { f64::from(n) * Number::powi(self.value, n - 1) };
        self.chain(Number::powi(self.value, n), slope)
    }

    #[inline(always)]
    fn powf(self, q: f64) -> Dual {
        let value = lane::pow(self.value, q);
        self.chain(value, q * value / self.value)
    }

    #[inline(always)]
    fn exp(self) -> Dual {
        let value = lane::exp(self.value);
        self.chain(value, value)
    }

    #[inline(always)]
    fn exp_m1(self) -> Dual {
        self.chain(lane::exp_m1(self.value), lane::exp(self.value))
    }

    #[inline(always)]
    fn ln(self) -> Dual {
        self.chain(lane::ln(self.value), 1.0 / self.value)
    }

    #[inline(always)]
    fn ln_1p(self) -> Dual {
        self.chain(lane::ln_1p(self.value), 1.0 / (1.0 + self.value))
    }

    #[inline(always)]
    fn sqrt(self) -> Dual {
        let root = self.value.sqrt();
        self.chain(root, 0.5 / root)
    }

    /// With 1 - tanh^2 as 4 sigma(2 x) sigma(-2 x), which does not cancel.
    #[inline(always)]
    fn tanh(self) -> Dual {
        let y = 2.0 * self.value;
        self.chain(lane::tanh(self.value), 4.0 * (lane::sigmoid(y) * lane::sigmoid(-y)))
    }

    #[inline(always)]
    fn softplus(self) -> Dual {
        self.chain(lane::softplus(self.value), lane::sigmoid(self.value))
    }

    /// At 0 the derivative is that of the right-hand side.
    #[inline(always)]
    fn abs(self) -> Dual {
        if self.value < 0.0 { -self } else { self }
    }

    #[inline(always)]
    fn min(self, other: Dual) -> Dual {
        if other.value < self.value { other } else { self }
    }

    #[inline(always)]
    fn max(self, other: Dual) -> Dual {
        if other.value > self.value { other } else { self }
    }
}
