//! The laws of motion, `dv_n/dt` from the clearance of a pedestrian and its speed, as the paper prints them.
//!
//! Only terms that the scenes have: no widening (`a_v = 0`), no relative speed (`delta = 0`), no contact force
//! (`c = 0`), `q = 2`. So the speed ahead has no influence.

use math::double_double::{DoubleDouble, full};

/// `e - 1`, the constant of eq:modlog (printed by `mpmath.e - 1`).
const C: DoubleDouble = DoubleDouble { hi: std::f64::consts::E - 1.0, lo: 1.445_646_891_729_250_2e-16 };

/// A law with its parameters, all dimensionless.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Law {
    /// eq:invd with `<mu, 0, 2, 0>`: `v_0 - v - mu^2 / d^2`, where `d = s - 2`.
    Algebraic {
        /// `mu > 0`: strength of the force.
        strength: DoubleDouble,
        /// `v_0 > 0`.
        desired_speed: DoubleDouble,
    },
    /// eq:sfm with `<a, b, 0, 0>`: `v_0 - v - a exp(-d / b)`, where `d = s - 2`.
    Exponential {
        /// `a > 0`: strength of the force.
        strength: DoubleDouble,
        /// `b > 0`: its range.
        range: DoubleDouble,
        /// `v_0 > 0`.
        desired_speed: DoubleDouble,
    },
    /// eq:modlog with `a_v = 0`: `v_0 (1 - ln(1 + (e - 1) r_eps(s / 2 - 1))) - v`.
    Logarithmic {
        /// `v_0 > 0`.
        desired_speed: DoubleDouble,
        /// `eps > 0`: width of the smooth ramp.
        epsilon: DoubleDouble,
    },
}

impl Law {
    /// The gap at which the clearance is 0: 2 where the law speaks of `d = s - 2`, else 0.
    pub fn contact(&self) -> f64 {
        if matches!(self, Law::Logarithmic { .. }) { 0.0 } else { 2.0 }
    }

    /// Whether the force is infinite at clearance 0.
    pub fn is_singular(&self) -> bool {
        matches!(self, Law::Algebraic { .. })
    }
}

/// `v_0 - v - (mu / d)^2` (eq:invd).
#[inline(always)]
pub(crate) fn algebraic(mu: DoubleDouble, v0: DoubleDouble, d: DoubleDouble, v: DoubleDouble) -> DoubleDouble {
    let root = mu / d;
    v0 - v - root * root
}

/// `v_0 - v - a exp(-d / b)` (eq:sfm).
#[inline(always)]
pub(crate) fn exponential(
    a: DoubleDouble,
    b: DoubleDouble,
    v0: DoubleDouble,
    d: DoubleDouble,
    v: DoubleDouble,
) -> DoubleDouble {
    v0 - v - a * full::exp(-(d / b))
}

/// `v_0 (1 - ln(1 + c R)) - v` with `R = r_eps(s / 2 - 1)` (eq:modlog, eq:aTheta).
#[inline(always)]
pub(crate) fn logarithmic(v0: DoubleDouble, epsilon: DoubleDouble, s: DoubleDouble, v: DoubleDouble) -> DoubleDouble {
    let x = s.times(0.5) - 1.0;
    let ramp = epsilon * full::softplus(-(x / epsilon));
    v0 * (-full::ln_1p(C * ramp) + 1.0) - v
}
