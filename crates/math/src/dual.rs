//! Values with a derivative, or with several.

use crate::lane;
use crate::number::Number;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A value and its derivative with respect to one variable, or to several as a [`Gradient`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual<S = f64> {
    /// The value, in any unit.
    pub value: f64,
    /// Its derivative, in the unit of the value over that of the variable: at a kink that of one side, NaN beyond the
    /// range of a function.
    pub slope: S,
}

/// What derivatives can be: a number, or one for each of several variables.
pub trait Slope:
    Copy + Neg<Output = Self> + Add<Output = Self> + Sub<Output = Self> + Mul<f64, Output = Self> + Div<f64, Output = Self>
{
}

impl Slope for f64 {}

/// The derivatives with respect to `K` variables.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gradient<const K: usize>(pub [f64; K]);

impl<const K: usize> Slope for Gradient<K> {}

impl<const K: usize> Gradient<K> {
    /// That of one of the variables.
    #[inline(always)]
    pub fn of(which: usize) -> Gradient<K> {
        let mut slopes = [0.0; K];
        slopes[which] = 1.0;
        Gradient(slopes)
    }
}

impl<const K: usize> Neg for Gradient<K> {
    type Output = Gradient<K>;
    #[inline(always)]
    fn neg(self) -> Gradient<K> {
        Gradient(self.0.map(|slope| -slope))
    }
}

/// An operator of two gradients, slope by slope.
macro_rules! of_two {
    ($trait:ident, $name:ident, $assigns:tt) => {
        impl<const K: usize> $trait for Gradient<K> {
            type Output = Gradient<K>;
            #[inline(always)]
            fn $name(mut self, other: Gradient<K>) -> Gradient<K> {
                for k in 0..K {
                    self.0[k] $assigns other.0[k];
                }
                self
            }
        }
    };
}

/// An operator of a gradient and a number.
macro_rules! of_number {
    ($trait:ident, $name:ident, $operator:tt) => {
        impl<const K: usize> $trait<f64> for Gradient<K> {
            type Output = Gradient<K>;
            #[inline(always)]
            fn $name(self, other: f64) -> Gradient<K> {
                Gradient(self.0.map(|slope| slope $operator other))
            }
        }
    };
}

of_two!(Add, add, +=);
of_two!(Sub, sub, -=);
of_number!(Mul, mul, *);
of_number!(Div, div, /);

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
}

impl<S: Slope> Dual<S> {
    #[inline(always)]
    fn chain(self, value: f64, slope: f64) -> Dual<S> {
        Dual { value, slope: self.slope * slope }
    }
}

impl<S: Slope> Neg for Dual<S> {
    type Output = Dual<S>;
    #[inline(always)]
    fn neg(self) -> Dual<S> {
        Dual { value: -self.value, slope: -self.slope }
    }
}

impl<S: Slope> Add for Dual<S> {
    type Output = Dual<S>;
    #[inline(always)]
    fn add(self, other: Dual<S>) -> Dual<S> {
        Dual { value: self.value + other.value, slope: self.slope + other.slope }
    }
}

impl<S: Slope> Sub for Dual<S> {
    type Output = Dual<S>;
    #[inline(always)]
    fn sub(self, other: Dual<S>) -> Dual<S> {
        Dual { value: self.value - other.value, slope: self.slope - other.slope }
    }
}

impl<S: Slope> Mul for Dual<S> {
    type Output = Dual<S>;
    #[inline(always)]
    fn mul(self, other: Dual<S>) -> Dual<S> {
        Dual { value: self.value * other.value, slope: self.slope * other.value + other.slope * self.value }
    }
}

impl<S: Slope> Div for Dual<S> {
    type Output = Dual<S>;
    #[inline(always)]
    fn div(self, other: Dual<S>) -> Dual<S> {
        let value = self.value / other.value;
        Dual { value, slope: (self.slope - other.slope * value) / other.value }
    }
}

impl<S: Slope> Add<f64> for Dual<S> {
    type Output = Dual<S>;
    #[inline(always)]
    fn add(self, other: f64) -> Dual<S> {
        Dual { value: self.value + other, ..self }
    }
}

impl<S: Slope> Sub<f64> for Dual<S> {
    type Output = Dual<S>;
    #[inline(always)]
    fn sub(self, other: f64) -> Dual<S> {
        Dual { value: self.value - other, ..self }
    }
}

impl<S: Slope> Mul<f64> for Dual<S> {
    type Output = Dual<S>;
    #[inline(always)]
    fn mul(self, other: f64) -> Dual<S> {
        Dual { value: self.value * other, slope: self.slope * other }
    }
}

impl<S: Slope> Div<f64> for Dual<S> {
    type Output = Dual<S>;
    #[inline(always)]
    fn div(self, other: f64) -> Dual<S> {
        Dual { value: self.value / other, slope: self.slope / other }
    }
}

impl<S: Slope> Number for Dual<S> {
    #[inline(always)]
    fn recip(self) -> Dual<S> {
        let inverse = 1.0 / self.value;
        self.chain(inverse, -inverse * inverse)
    }

    #[inline(always)]
    fn powi(self, n: i32) -> Dual<S> {
        let slope = if n == 0 { 0.0 } else { f64::from(n) * Number::powi(self.value, n - 1) };
        self.chain(Number::powi(self.value, n), slope)
    }

    #[inline(always)]
    fn powf(self, q: f64) -> Dual<S> {
        let value = lane::pow(self.value, q);
        self.chain(value, q * value / self.value)
    }

    #[inline(always)]
    fn exp(self) -> Dual<S> {
        let value = lane::exp(self.value);
        self.chain(value, value)
    }

    #[inline(always)]
    fn exp_m1(self) -> Dual<S> {
        self.chain(lane::exp_m1(self.value), lane::exp(self.value))
    }

    #[inline(always)]
    fn ln(self) -> Dual<S> {
        self.chain(lane::ln(self.value), 1.0 / self.value)
    }

    #[inline(always)]
    fn ln_1p(self) -> Dual<S> {
        self.chain(lane::ln_1p(self.value), 1.0 / (1.0 + self.value))
    }

    #[inline(always)]
    fn sqrt(self) -> Dual<S> {
        let root = self.value.sqrt();
        self.chain(root, 0.5 / root)
    }

    /// With 1 - tanh^2 as 4 sigma(2 x) sigma(-2 x), which does not cancel.
    #[inline(always)]
    fn tanh(self) -> Dual<S> {
        let y = 2.0 * self.value;
        self.chain(lane::tanh(self.value), 4.0 * (lane::sigmoid(y) * lane::sigmoid(-y)))
    }

    #[inline(always)]
    fn softplus(self) -> Dual<S> {
        self.chain(lane::softplus(self.value), lane::sigmoid(self.value))
    }

    /// At 0 the derivative is that of the right-hand side.
    #[inline(always)]
    fn abs(self) -> Dual<S> {
        if self.value < 0.0 { -self } else { self }
    }

    #[inline(always)]
    fn min(self, other: Dual<S>) -> Dual<S> {
        if other.value < self.value { other } else { self }
    }

    #[inline(always)]
    fn max(self, other: Dual<S>) -> Dual<S> {
        if other.value > self.value { other } else { self }
    }
}
