//! The stability criteria as the paper prints them, with lengths in units of `a_0` and times in units of `tau`. A
//! negative value means stable. Parameters are in the ranges of their laws; at a gap that is not in the range stated
//! the value is NaN or has no meaning.

use crate::laws::{Algebraic, C, Exponential, Logarithmic};

/// `Phi` of the algebraic law (condition): `phi omega - delta gamma / d'^q - 1/2`, `omega = 1 / (2 a_v phi + 1)`, at
/// the uniform effective distance `gap = d' > 0`.
pub fn algebraic(law: &Algebraic, gap: f64) -> f64 {
    let (delta, q, a_v, gamma) = (law.delta, law.q, law.a_v, law.gamma());
    let phi = q * gamma * gamma / math::pow(gap, q + 1.0);
    let omega = 1.0 / (2.0 * a_v * phi + 1.0);
    phi * omega - delta * gamma / math::pow(gap, q) - 0.5
}

/// `Phi` with tilde of the exponential law (eq:stab_condition_exp), at the uniform effective distance `gap = d'`. The
/// paper linearises the contact force with the slope -1/2, which holds at `d' = 0` only; its figures have `c = 0`.
pub fn exponential(law: &Exponential, gap: f64) -> f64 {
    let (a, b, c, a_v) = (law.a, law.b, law.c, law.a_v);
    let c_tilde = -a * math::exp(-gap / b) / b - 0.5 * c;
    let b_tilde = a_v * c_tilde;
    c_tilde / (2.0 * b_tilde - 1.0) - 0.5
}

/// `Phi` with hat of the logarithmic law (eq:log_condition), at the uniform headway `Delta y < a'` and speed `v'`. The
/// paper takes the limit `eps -> 0`: `R' = 1 - Delta y / a'`.
pub fn logarithmic(law: &Logarithmic, headway: f64, speed: f64) -> f64 {
    let distance = law.critical_distance(speed);
    let a_v = law.a_v / distance;
    let d0 = 1.0 + C * (1.0 - headway / distance);
    let xi = C * law.v0 / (distance * d0);
    let denominator = 1.0 + 2.0 * xi * a_v * headway;
    (xi / denominator + xi * a_v * headway) / denominator - 0.5
}
