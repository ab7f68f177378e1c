//! A value with its derivative in one direction, over any kind of number: in double-double, and with a running error
//! bound.

use math::double_double::DoubleDouble;
use math::number::Number;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// The double nearest to a number: which side of a kink it is on.
pub trait Nearest {
    fn nearest(self) -> f64;
}

impl Nearest for f64 {
    fn nearest(self) -> f64 {
        self
    }
}

impl Nearest for DoubleDouble {
    fn nearest(self) -> f64 {
        self.hi
    }
}

/// `value + slope t` for small t.
#[derive(Clone, Copy, Debug)]
pub struct Dual<T> {
    pub value: T,
    pub slope: T,
}

impl<T: Number> Dual<T> {
    /// f(value), whose slope there is `slope`.
    fn chain(self, value: T, slope: T) -> Dual<T> {
        Dual { value, slope: slope * self.slope }
    }
}

impl<T: Number> Neg for Dual<T> {
    type Output = Dual<T>;
    fn neg(self) -> Dual<T> {
        Dual { value: -self.value, slope: -self.slope }
    }
}

impl<T: Number> Add for Dual<T> {
    type Output = Dual<T>;
    fn add(self, other: Dual<T>) -> Dual<T> {
        Dual { value: self.value + other.value, slope: self.slope + other.slope }
    }
}

impl<T: Number> Sub for Dual<T> {
    type Output = Dual<T>;
    fn sub(self, other: Dual<T>) -> Dual<T> {
        Dual { value: self.value - other.value, slope: self.slope - other.slope }
    }
}

impl<T: Number> Mul for Dual<T> {
    type Output = Dual<T>;
    fn mul(self, other: Dual<T>) -> Dual<T> {
        Dual { value: self.value * other.value, slope: self.slope * other.value + self.value * other.slope }
    }
}

impl<T: Number> Div for Dual<T> {
    type Output = Dual<T>;
    fn div(self, other: Dual<T>) -> Dual<T> {
        let value = self.value / other.value;
        Dual { value, slope: (self.slope - value * other.slope) / other.value }
    }
}

impl<T: Number> Add<f64> for Dual<T> {
    type Output = Dual<T>;
    fn add(self, c: f64) -> Dual<T> {
        Dual { value: self.value + c, ..self }
    }
}

impl<T: Number> Sub<f64> for Dual<T> {
    type Output = Dual<T>;
    fn sub(self, c: f64) -> Dual<T> {
        Dual { value: self.value - c, ..self }
    }
}

impl<T: Number> Mul<f64> for Dual<T> {
    type Output = Dual<T>;
    fn mul(self, c: f64) -> Dual<T> {
        Dual { value: self.value * c, slope: self.slope * c }
    }
}

impl<T: Number> Div<f64> for Dual<T> {
    type Output = Dual<T>;
    fn div(self, c: f64) -> Dual<T> {
        Dual { value: self.value / c, slope: self.slope / c }
    }
}

impl<T: Number + Nearest> Number for Dual<T> {
    fn recip(self) -> Dual<T> {
        let inverse = self.value.recip();
        // in this order the square of a small inverse does not underflow
        Dual { value: inverse, slope: -(inverse * self.slope) * inverse }
    }
    fn powi(self, n: i32) -> Dual<T> {
        let product = (1..n.abs()).fold(self, |product, _| product * self);
        if n < 0 { product.recip() } else { product }
    }
    fn powf(self, q: f64) -> Dual<T> {
        let value = self.value.powf(q);
        self.chain(value, value * q / self.value)
    }
    fn exp(self) -> Dual<T> {
        let value = self.value.exp();
        self.chain(value, value)
    }
    fn exp_m1(self) -> Dual<T> {
        self.chain(self.value.exp_m1(), self.value.exp())
    }
    fn ln(self) -> Dual<T> {
        self.chain(self.value.ln(), self.value.recip())
    }
    fn ln_1p(self) -> Dual<T> {
        self.chain(self.value.ln_1p(), (self.value + 1.0).recip())
    }
    fn sqrt(self) -> Dual<T> {
        let value = self.value.sqrt();
        self.chain(value, (value * 2.0).recip())
    }
    fn tanh(self) -> Dual<T> {
        let value = self.value.tanh();
        self.chain(value, -(value * value) + 1.0)
    }
    fn softplus(self) -> Dual<T> {
        self.chain(self.value.softplus(), ((-self.value).exp() + 1.0).recip())
    }
    fn abs(self) -> Dual<T> {
        if self.value.nearest() < 0.0 { -self } else { self }
    }
    fn min(self, other: Dual<T>) -> Dual<T> {
        if other.value.nearest() < self.value.nearest() { other } else { self }
    }
    fn max(self, other: Dual<T>) -> Dual<T> {
        if other.value.nearest() > self.value.nearest() { other } else { self }
    }
}
