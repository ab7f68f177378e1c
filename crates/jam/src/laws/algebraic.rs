//! The algebraic force, Eq. (8), eq:invd.

use super::{Chosen, Law, Parameter, RAMP_WIDTH, Range};
use crate::ramp::Bend;
use crate::stability::Linear;
use math::number::{Number, whole};
use std::f64::consts::LN_2;

/// Parameters `<mu, delta, q, a_v>` and `v_0'`, `eps`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Algebraic {
    /// `mu >= 0`: strength of the force.
    pub mu: f64,
    /// `delta >= 0`: influence of the relative speed.
    pub delta: f64,
    /// `q > 0`: power of the distance.
    pub q: f64,
    /// `a_v >= 0` (with tilde in the paper): growth of the space requirement with speed, in units of `tau`.
    pub a_v: f64,
    /// `eps > 0`: width of the smooth ramp; without effect when `delta = 0`.
    pub epsilon: f64,
    /// `v_0' > 0`: desired speed, in units of `a_0 / tau`.
    pub v0: f64,
}

impl Law for Algebraic {
    const PARAMETERS: &'static [Parameter<Algebraic>] = &[
        Parameter { name: "mu", range: Range::NotNegative, default: None, place: |law| &mut law.mu },
        Parameter { name: "delta", range: Range::NotNegative, default: Some(0.0), place: |law| &mut law.delta },
        Parameter { name: "q", range: Range::Positive, default: None, place: |law| &mut law.q },
        Parameter { name: "a_v", range: Range::NotNegative, default: Some(0.0), place: |law| &mut law.a_v },
        Parameter { name: "epsilon", range: Range::Positive, default: Some(RAMP_WIDTH), place: |law| &mut law.epsilon },
        Parameter { name: "v0", range: Range::Positive, default: None, place: |law| &mut law.v0 },
    ];

    const CONTACT: f64 = 2.0;

    const SINGULAR: bool = true;

    /// `dv_n/dt = v_0 - v_n - (mu + delta r_eps(v_{n+1} - v_n))^2 / d_n^q`.
    #[inline(always)]
    fn acceleration<X: Number>(&self, net_gap: X, v: X, ahead: X) -> X {
        let Algebraic { mu, delta, q, epsilon, v0, .. } = *self;
        let decay = self.effective_gap(net_gap, v, ahead).power(-q);
        if delta == 0.0 {
            return -v + v0 - decay * (mu * mu);
        }
        let force = (ahead - v).ramp(epsilon) * delta + mu;
        -v + v0 - force.powi(2) * decay
    }

    /// `d_n = s_n - a_v (v_n + v_{n+1}) - 2`.
    #[inline(always)]
    fn effective_gap<X: Number>(&self, net_gap: X, v: X, ahead: X) -> X {
        if self.a_v == 0.0 { net_gap } else { net_gap - (v + ahead) * self.a_v }
    }

    fn bend(&self) -> Option<Bend> {
        let slope = 1.0 / self.epsilon;
        (self.delta != 0.0).then_some(Bend { clearance: 0.0, speed: -slope, ahead: slope, offset: 0.0 })
    }

    #[inline(always)]
    fn is_long(&self) -> bool {
        self.delta != 0.0 || whole(self.q).is_none()
    }

    #[inline(always)]
    fn plain(&self) -> Option<Algebraic> {
        let is_plain = self.delta == 0.0 && self.a_v == 0.0 && self.q == 2.0;
        is_plain.then_some(Algebraic { delta: 0.0, a_v: 0.0, q: 2.0, ..*self })
    }

    /// Powers are products, which as constants need no choice for every pedestrian.
    #[inline(always)]
    fn choose<C: Chosen<Algebraic>>(self, chosen: C) -> C::Output {
        let without = |q: f64| Algebraic { delta: 0.0, a_v: 0.0, q, ..self };
        let alone = |q: f64| Algebraic { delta: 0.0, q, ..self };
        match (self.delta == 0.0, self.a_v == 0.0, self.q) {
            (true, true, 1.0) => chosen.straight(without(1.0)),
            (true, true, 2.0) => chosen.straight(without(2.0)),
            (true, true, 3.0) => chosen.straight(without(3.0)),
            (true, false, 2.0) => chosen.straight(alone(2.0)),
            (true, true, q) if whole(q).is_none() => chosen.straight(without(q)),
            _ => chosen.any(self),
        }
    }
}

impl Algebraic {
    /// `gamma = mu + delta eps ln 2`: strength of the force at equal speeds.
    pub fn gamma(&self) -> f64 {
        self.mu + self.delta * self.epsilon * LN_2
    }

    /// `d' = Delta y - 2 - 2 a_v v'`, the effective gap of the uniform flow, in units of `a_0`.
    pub fn gap(&self, headway: f64, speed: f64) -> f64 {
        headway - 2.0 * self.a_v * speed - 2.0
    }

    /// Coefficients of the linearised law (eq:epsf) at the uniform effective distance `gap = d' > 0`.
    pub fn linearise(&self, gap: f64) -> Linear {
        let Algebraic { delta, q, a_v, .. } = *self;
        let gamma = self.gamma();
        let inverse = math::pow(gap, -q);
        let phi = q * gamma * gamma * inverse / gap;
        Linear { phi, beta: a_v * phi, kappa: delta * gamma * inverse }
    }
}
