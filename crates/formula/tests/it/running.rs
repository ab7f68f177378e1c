//! A double with a running error bound: each operation passes on the errors of its operands through the steepest slope
//! between them and adds its own rounding.

use crate::dual::Nearest;
use math::lane;
use math::number::Number;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// The unit roundoff.
const U: f64 = f64::EPSILON / 2.0;
/// For the roundings of the bounds themselves, and for the second order of roundings.
const CARE: f64 = 1.0 + 1e-9;
/// What underflow may take.
const TINY: f64 = 1e-300;

/// `value`, which differs from the exact result by at most `bound`; infinite where nothing can be said.
#[derive(Clone, Copy, Debug)]
pub struct Running {
    pub value: f64,
    pub bound: f64,
}

impl Running {
    pub fn exact(value: f64) -> Running {
        Running { value, bound: 0.0 }
    }

    /// A result with the error passed on and its own, in units in the last place.
    fn new(value: f64, passed: f64, units: f64) -> Running {
        let bound = (passed + units * 2.0 * U * value.abs()) * CARE + if units > 0.5 { TINY } else { 0.0 };
        Running { value, bound: if bound.is_nan() || !value.is_finite() { f64::INFINITY } else { bound } }
    }

    /// How much ln x may be off.
    fn of_logarithm(x: f64, error: f64) -> f64 {
        if error < x { -math::ln_1p(-error / x) } else { f64::INFINITY }
    }
}

impl Nearest for Running {
    fn nearest(self) -> f64 {
        self.value
    }
}

impl Neg for Running {
    type Output = Running;
    fn neg(self) -> Running {
        Running { value: -self.value, ..self }
    }
}

impl Add for Running {
    type Output = Running;
    fn add(self, other: Running) -> Running {
        Running::new(self.value + other.value, self.bound + other.bound, 0.5)
    }
}

impl Sub for Running {
    type Output = Running;
    fn sub(self, other: Running) -> Running {
        Running::new(self.value - other.value, self.bound + other.bound, 0.5)
    }
}

impl Mul for Running {
    type Output = Running;
    fn mul(self, other: Running) -> Running {
        let passed = self.value.abs() * other.bound + other.value.abs() * self.bound + self.bound * other.bound;
        let value = self.value * other.value;
        let underflow = if value.abs() < TINY && self.value != 0.0 && other.value != 0.0 { TINY } else { 0.0 };
        Running::new(value, passed + underflow, 0.5)
    }
}

impl Div for Running {
    type Output = Running;
    fn div(self, other: Running) -> Running {
        let value = self.value / other.value;
        let least = other.value.abs() - other.bound;
        if least > 0.0 {
            Running::new(value, (self.bound + value.abs() * CARE * other.bound) / least + TINY, 0.5)
        } else {
            Running { value, bound: f64::INFINITY }
        }
    }
}

impl Add<f64> for Running {
    type Output = Running;
    fn add(self, c: f64) -> Running {
        self + Running::exact(c)
    }
}

impl Sub<f64> for Running {
    type Output = Running;
    fn sub(self, c: f64) -> Running {
        self - Running::exact(c)
    }
}

impl Mul<f64> for Running {
    type Output = Running;
    fn mul(self, c: f64) -> Running {
        self * Running::exact(c)
    }
}

impl Div<f64> for Running {
    type Output = Running;
    fn div(self, c: f64) -> Running {
        self / Running::exact(c)
    }
}

impl Number for Running {
    fn recip(self) -> Running {
        Running::exact(1.0) / self
    }
    fn powi(self, n: i32) -> Running {
        let product = (1..n.abs()).fold(self, |product, _| product * self);
        if n < 0 { product.recip() } else { product }
    }
    fn powf(self, q: f64) -> Running {
        let value = lane::pow(self.value, q);
        let logarithm = lane::ln(self.value).abs();
        let passed = q.abs() * Running::of_logarithm(self.value, self.bound);
        Running::new(value, value * CARE * math::exp_m1(passed), 1.0 + 2.5 * logarithm * q.abs())
    }
    fn min(self, other: Running) -> Running {
        let value = Number::min(self.value, other.value);
        Running { value, bound: if self.bound > other.bound { self.bound } else { other.bound } }
    }
    fn max(self, other: Running) -> Running {
        let value = Number::max(self.value, other.value);
        Running { value, bound: if self.bound > other.bound { self.bound } else { other.bound } }
    }
    fn exp(self) -> Running {
        let value = lane::exp(self.value);
        // below -708 it is 0
        Running::new(value, (value + TINY) * CARE * math::exp_m1(self.bound), 0.7)
    }
    fn exp_m1(self) -> Running {
        let slope = (lane::exp(self.value) + TINY) * CARE;
        Running::new(lane::exp_m1(self.value), slope * math::exp_m1(self.bound), 1.3)
    }
    fn ln(self) -> Running {
        Running::new(lane::ln(self.value), Running::of_logarithm(self.value, self.bound), 1.2)
    }
    fn ln_1p(self) -> Running {
        let passed = Running::of_logarithm(1.0 + self.value, self.bound);
        Running::new(lane::ln_1p(self.value), passed, 1.2)
    }
    fn sqrt(self) -> Running {
        let (value, least) = (self.value.sqrt(), self.value - self.bound);
        let passed = match self.bound {
            0.0 => 0.0,
            error if least >= 0.0 => error / (value + least.sqrt()),
            _ => f64::INFINITY,
        };
        Running::new(value, passed, 0.5)
    }
    fn tanh(self) -> Running {
        // the slope falls with the size
        let nearest = self.value.abs() - self.bound;
        let flattest = lane::tanh(if nearest > 0.0 { nearest } else { 0.0 });
        let slope = (1.0 - flattest) * (1.0 + flattest) + 8.0 * U;
        Running::new(lane::tanh(self.value), slope * self.bound, 3.0)
    }
    fn softplus(self) -> Running {
        let slope = lane::sigmoid(self.value + self.bound);
        Running::new(lane::softplus(self.value), slope * CARE * self.bound, 2.0)
    }
    fn abs(self) -> Running {
        Running { value: self.value.abs(), ..self }
    }
}
