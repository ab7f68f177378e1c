//! The smooth ramp of eq:aTheta.

use math::lane;

/// `r(x)`: `-x` for negative `x`, else 0.
pub fn ramp(x: f64) -> f64 {
    if x < 0.0 { -x } else { 0.0 }
}

/// `r_eps(x) = eps ln(1 + exp(-x / eps))`, for `eps > 0`; it overflows nowhere (eq:aTheta).
#[inline(always)]
pub fn smooth_ramp(x: f64, epsilon: f64) -> f64 {
    epsilon * lane::softplus(-x / epsilon)
}
