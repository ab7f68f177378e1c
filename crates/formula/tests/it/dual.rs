//! A value with its derivative in one direction: forward differentiation of any number.

use formula::Number;

/// `value + slope t` for small t.
#[derive(Clone, Copy, Debug)]
pub struct Dual<T> {
    pub value: T,
    pub slope: T,
}

impl<T: Number> Dual<T> {
    /// f(value), whose slope there is `slope`.
    fn chain(&self, value: T, slope: T) -> Dual<T> {
        Dual { value, slope: slope.mul(&self.slope) }
    }
}

impl<T: Number> Number for Dual<T> {
    fn constant(&self, value: f64) -> Dual<T> {
        Dual { value: self.value.constant(value), slope: self.value.constant(0.0) }
    }
    fn nearest(&self) -> f64 {
        self.value.nearest()
    }
    fn neg(&self) -> Dual<T> {
        Dual { value: self.value.neg(), slope: self.slope.neg() }
    }
    fn add(&self, other: &Dual<T>) -> Dual<T> {
        Dual { value: self.value.add(&other.value), slope: self.slope.add(&other.slope) }
    }
    fn sub(&self, other: &Dual<T>) -> Dual<T> {
        Dual { value: self.value.sub(&other.value), slope: self.slope.sub(&other.slope) }
    }
    fn mul(&self, other: &Dual<T>) -> Dual<T> {
        let slope = self.slope.mul(&other.value).add(&self.value.mul(&other.slope));
        Dual { value: self.value.mul(&other.value), slope }
    }
    fn div(&self, other: &Dual<T>) -> Dual<T> {
        let value = self.value.div(&other.value);
        let slope = self.slope.sub(&value.mul(&other.slope)).div(&other.value);
        Dual { value, slope }
    }
    fn pow(&self, exponent: &Dual<T>) -> Dual<T> {
        let value = self.value.pow(&exponent.value);
        let of_base = exponent.value.mul(&self.slope).div(&self.value);
        let slope = value.mul(&of_base.add(&self.value.ln().mul(&exponent.slope)));
        Dual { value, slope }
    }
    fn min(&self, other: &Dual<T>) -> Dual<T> {
        if other.nearest() < self.nearest() { other.clone() } else { self.clone() }
    }
    fn max(&self, other: &Dual<T>) -> Dual<T> {
        if other.nearest() > self.nearest() { other.clone() } else { self.clone() }
    }
    fn exp(&self) -> Dual<T> {
        let value = self.value.exp();
        self.chain(value.clone(), value)
    }
    fn exp_m1(&self) -> Dual<T> {
        self.chain(self.value.exp_m1(), self.value.exp())
    }
    fn ln(&self) -> Dual<T> {
        self.chain(self.value.ln(), self.value.constant_div(1.0))
    }
    fn ln_1p(&self) -> Dual<T> {
        self.chain(self.value.ln_1p(), self.value.add_constant(1.0).constant_div(1.0))
    }
    fn sqrt(&self) -> Dual<T> {
        let value = self.value.sqrt();
        self.chain(value.clone(), value.constant_div(0.5))
    }
    fn tanh(&self) -> Dual<T> {
        let value = self.value.tanh();
        let slope = value.mul(&value).constant_sub(1.0);
        self.chain(value, slope)
    }
    fn softplus(&self) -> Dual<T> {
        self.chain(self.value.softplus(), self.value.neg().exp().add_constant(1.0).constant_div(1.0))
    }
    fn abs(&self) -> Dual<T> {
        if self.nearest() < 0.0 { self.neg() } else { self.clone() }
    }
    fn mul_constant(&self, c: f64) -> Dual<T> {
        Dual { value: self.value.mul_constant(c), slope: self.slope.mul_constant(c) }
    }
}
