//! The exponential force, eq:sfm.

use super::{Chosen, Law, Parameter, RAMP_WIDTH, Range};
use crate::ramp::Bend;
use crate::stability::Linear;
use math::lane;
use math::number::Number;

/// Parameters `<a, b, c, a_v>` and `v_0'`, `eps`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Exponential {
    /// `a >= 0`: strength of the force, in units of `a_0 / tau^2`.
    pub a: f64,
    /// `b > 0`: its range, in units of `a_0`.
    pub b: f64,
    /// `c >= 0`: stiffness of the contact, in units of `1 / tau^2`.
    pub c: f64,
    /// `a_v >= 0` (with tilde in the paper): growth of the space requirement with speed, in units of `tau`.
    pub a_v: f64,
    /// `eps > 0`: width of the smooth ramp, in units of `a_0`; without effect when `c = 0`.
    pub epsilon: f64,
    /// `v_0' > 0`: desired speed, in units of `a_0 / tau`.
    pub v0: f64,
}

impl Law for Exponential {
    const PARAMETERS: &'static [Parameter<Exponential>] = &[
        Parameter { name: "a", range: Range::NotNegative, default: None, place: |law| &mut law.a },
        Parameter { name: "b", range: Range::Positive, default: None, place: |law| &mut law.b },
        Parameter { name: "c", range: Range::NotNegative, default: Some(0.0), place: |law| &mut law.c },
        Parameter { name: "a_v", range: Range::NotNegative, default: Some(0.0), place: |law| &mut law.a_v },
        Parameter { name: "epsilon", range: Range::Positive, default: Some(RAMP_WIDTH), place: |law| &mut law.epsilon },
        Parameter { name: "v0", range: Range::Positive, default: None, place: |law| &mut law.v0 },
    ];

    const CONTACT: f64 = 2.0;

    const SINGULAR: bool = false;

    /// `dv_n/dt = v_0 - v_n - a exp(-d_n / b) - c r_eps(d_n)`.
    #[inline(always)]
    fn acceleration<X: Number>(&self, net_gap: X, v: X, ahead: X) -> X {
        let Exponential { a, b, c, epsilon, v0, .. } = *self;
        let d = self.effective_gap(net_gap, v, ahead);
        let repelled = -v + v0 - (d / -b).exp() * a;
        if c == 0.0 { repelled } else { repelled - d.ramp(epsilon) * c }
    }

    /// `d_n = s_n - a_v (v_n + v_{n+1}) - 2`.
    #[inline(always)]
    fn effective_gap<X: Number>(&self, net_gap: X, v: X, ahead: X) -> X {
        if self.a_v == 0.0 { net_gap } else { net_gap - (v + ahead) * self.a_v }
    }

    fn bend(&self) -> Option<Bend> {
        let (slope, speed) = (1.0 / self.epsilon, -self.a_v / self.epsilon);
        (self.c != 0.0).then_some(Bend { clearance: slope, speed, ahead: speed, offset: 0.0 })
    }

    #[inline(always)]
    fn is_long(&self) -> bool {
        self.c != 0.0
    }

    #[inline(always)]
    fn plain(&self) -> Option<Exponential> {
        let is_plain = self.c == 0.0 && self.a_v == 0.0;
        is_plain.then_some(Exponential { c: 0.0, a_v: 0.0, ..*self })
    }

    #[inline(always)]
    fn choose<C: Chosen<Exponential>>(self, chosen: C) -> C::Output {
        match (self.c == 0.0, self.a_v == 0.0) {
            (true, true) => chosen.straight(Exponential { c: 0.0, a_v: 0.0, ..self }),
            (true, false) => chosen.straight(Exponential { c: 0.0, ..self }),
            _ => chosen.any(self),
        }
    }
}

impl Exponential {
    /// `d' = Delta y - 2 - 2 a_v v'`, the effective gap of the uniform flow, in units of `a_0`.
    pub fn gap(&self, headway: f64, speed: f64) -> f64 {
        headway - 2.0 * self.a_v * speed - 2.0
    }

    /// Coefficients of the linearised law at the uniform effective distance `gap = d'`.
    pub fn linearise(&self, gap: f64) -> Linear {
        let Exponential { a, b, c, a_v, .. } = *self;
        let phi = a / b * math::exp(-gap / b) + c * lane::sigmoid(-gap / self.epsilon);
        Linear { phi, beta: a_v * phi, kappa: 0.0 }
    }
}
