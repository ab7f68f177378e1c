//! Whether a formula is linear in some of its variables, and with which constant slopes.
//!
//! [`Affine`] carries no value. The variables that are not counted stand for anything, so what it says holds for all
//! values of all variables: it is read off the formula, not off samples of it.

use crate::number::Number;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// The slopes of a number with respect to `N` variables, where they are the same everywhere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Affine<const N: usize> {
    /// The slopes, one for each of the `N` variables, in the unit of the number over that of the variable; `None` where
    /// one of them depends on a variable.
    pub slopes: Option<[f64; N]>,
}

impl<const N: usize> Affine<N> {
    /// A number that depends on none of the `N` variables, though perhaps on others.
    pub const FREE: Affine<N> = Affine { slopes: Some([0.0; N]) };

    /// What depends on them in another way.
    const OTHER: Affine<N> = Affine { slopes: None };

    /// The variable of this index, below `N`.
    pub fn variable(index: usize) -> Affine<N> {
        Affine { slopes: Some(std::array::from_fn(|i| if i == index { 1.0 } else { 0.0 })) }
    }

    fn map(self, f: impl Fn(f64) -> f64) -> Affine<N> {
        Affine { slopes: self.slopes.map(|slopes| slopes.map(f)) }
    }

    fn is_free(self) -> bool {
        self == Affine::FREE
    }

    /// A function that is not linear.
    fn curved(self) -> Affine<N> {
        if self.is_free() { Affine::FREE } else { Affine::OTHER }
    }

    /// A function of two numbers that is not linear in them.
    fn joined(self, other: Affine<N>) -> Affine<N> {
        if self.is_free() && other.is_free() { Affine::FREE } else { Affine::OTHER }
    }

    fn zipped(self, other: Affine<N>, f: impl Fn(f64, f64) -> f64) -> Affine<N> {
        let slopes = self.slopes.zip(other.slopes);
        Affine { slopes: slopes.map(|(a, b)| std::array::from_fn(|i| f(a[i], b[i]))) }
    }
}

impl<const N: usize> Neg for Affine<N> {
    type Output = Affine<N>;
    fn neg(self) -> Affine<N> {
        self.map(|slope| -slope)
    }
}

impl<const N: usize> Add for Affine<N> {
    type Output = Affine<N>;
    fn add(self, other: Affine<N>) -> Affine<N> {
        self.zipped(other, |a, b| a + b)
    }
}

impl<const N: usize> Sub for Affine<N> {
    type Output = Affine<N>;
    fn sub(self, other: Affine<N>) -> Affine<N> {
        self.zipped(other, |a, b| a - b)
    }
}

impl<const N: usize> Mul for Affine<N> {
    type Output = Affine<N>;
    /// The slope of a product depends on the other factor, which is no constant.
    fn mul(self, other: Affine<N>) -> Affine<N> {
        self.joined(other)
    }
}

impl<const N: usize> Div for Affine<N> {
    type Output = Affine<N>;
    fn div(self, other: Affine<N>) -> Affine<N> {
        self.joined(other)
    }
}

impl<const N: usize> Add<f64> for Affine<N> {
    type Output = Affine<N>;
    fn add(self, _constant: f64) -> Affine<N> {
        self
    }
}

impl<const N: usize> Sub<f64> for Affine<N> {
    type Output = Affine<N>;
    fn sub(self, _constant: f64) -> Affine<N> {
        self
    }
}

impl<const N: usize> Mul<f64> for Affine<N> {
    type Output = Affine<N>;
    fn mul(self, constant: f64) -> Affine<N> {
        if self.is_free() { self } else { self.map(|slope| slope * constant) }
    }
}

impl<const N: usize> Div<f64> for Affine<N> {
    type Output = Affine<N>;
    fn div(self, constant: f64) -> Affine<N> {
        if self.is_free() { self } else { self.map(|slope| slope / constant) }
    }
}

impl<const N: usize> Number for Affine<N> {
    fn recip(self) -> Affine<N> {
        self.curved()
    }
    fn powi(self, n: i32) -> Affine<N> {
        match n {
            0 => Affine::FREE,
            1 => self,
            _ => self.curved(),
        }
    }
    fn powf(self, _q: f64) -> Affine<N> {
        self.curved()
    }
    fn exp(self) -> Affine<N> {
        self.curved()
    }
    fn exp_m1(self) -> Affine<N> {
        self.curved()
    }
    fn ln(self) -> Affine<N> {
        self.curved()
    }
    fn ln_1p(self) -> Affine<N> {
        self.curved()
    }
    fn sqrt(self) -> Affine<N> {
        self.curved()
    }
    fn tanh(self) -> Affine<N> {
        self.curved()
    }
    fn softplus(self) -> Affine<N> {
        self.curved()
    }
    fn abs(self) -> Affine<N> {
        self.curved()
    }
    fn min(self, other: Affine<N>) -> Affine<N> {
        self.joined(other)
    }
    fn max(self, other: Affine<N>) -> Affine<N> {
        self.joined(other)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The slopes of a formula of a variable that is not counted and of two that are.
    fn slopes(formula: fn(Affine<2>, Affine<2>, Affine<2>) -> Affine<2>) -> Option<[f64; 2]> {
        formula(Affine::FREE, Affine::variable(0), Affine::variable(1)).slopes
    }

    #[test]
    fn constant_slopes_are_told() {
        assert_eq!(slopes(|s, v, _| s.tanh() * 3.0 - v), Some([-1.0, 0.0]));
        assert_eq!(slopes(|s, v, w| (s.exp() - v) * 0.5 + (w - v) * 2.0), Some([-2.5, 2.0]));
        assert_eq!(slopes(|s, v, w| (v + w) * 0.0 + s), Some([0.0, 0.0]));
        assert_eq!(slopes(|s, v, _| s * s / s - (v / 4.0).powi(1)), Some([-0.25, 0.0]));
    }

    #[test]
    fn slopes_that_depend_on_anything_are_none() {
        assert_eq!(slopes(|s, v, _| s * v), None);
        assert_eq!(slopes(|s, v, _| s.max(v)), None);
        assert_eq!(slopes(|s, v, _| s / (v + 1.0)), None);
        assert_eq!(slopes(|_, v, w| (w - v).softplus() * 0.1 - v), None);
        assert_eq!(slopes(|_, v, _| v.powi(2)), None);
    }
}
