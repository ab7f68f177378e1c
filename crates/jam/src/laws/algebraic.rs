//! The algebraically decaying force, Eq. (8), eq:invd.

use super::{Chosen, Law, Parameter, RAMP_WIDTH, Range};
use crate::ramp::Bend;
use crate::stability::Linear;
use math::number::Number;
use std::f64::consts::LN_2;

/// Parameters `<mu, delta, q, a_v>` and `v_0'`, `eps`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Algebraic {
    /// `mu >= 0`: strength of the force.
    pub strength: f64,
    /// `delta >= 0`: influence of the relative speed.
    pub relative: f64,
    /// `q > 0`: power of the distance.
    pub power: f64,
    /// `a_v >= 0` (with tilde in the paper): growth of the space requirement with speed, in units of `tau`.
    pub widening: f64,
    /// `eps > 0`: width of the smooth ramp; without effect when `delta = 0`.
    pub epsilon: f64,
    /// `v_0' > 0`: desired speed, in units of `a_0 / tau`.
    pub desired_speed: f64,
}

impl Law for Algebraic {
    const PARAMETERS: &'static [Parameter<Algebraic>] = &[
        Parameter { name: "mu", range: Range::NotNegative, default: None, place: |law| &mut law.strength },
        Parameter { name: "delta", range: Range::NotNegative, default: Some(0.0), place: |law| &mut law.relative },
        Parameter { name: "q", range: Range::Positive, default: None, place: |law| &mut law.power },
        Parameter { name: "a_v", range: Range::NotNegative, default: Some(0.0), place: |law| &mut law.widening },
        Parameter { name: "epsilon", range: Range::Positive, default: Some(RAMP_WIDTH), place: |law| &mut law.epsilon },
        Parameter { name: "v0", range: Range::Positive, default: None, place: |law| &mut law.desired_speed },
    ];

    const CONTACT: f64 = 2.0;

    const SINGULAR: bool = true;

    /// `dv_n/dt = v_0 - v_n - (mu + delta r_eps(v_{n+1} - v_n))^2 / d_n^q`.
    #[inline(always)]
    fn acceleration<X: Number>(&self, net_gap: X, v: X, ahead: X) -> X {
        let Algebraic { strength: mu, relative: delta, power: q, epsilon, desired_speed: v0, .. } = *self;
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
        if self.widening == 0.0 { net_gap } else { net_gap - (v + ahead) * self.widening }
    }

    fn bend(&self) -> Option<Bend> {
        let slope = 1.0 / self.epsilon;
        (self.relative != 0.0).then_some(Bend { clearance: 0.0, speed: -slope, ahead: slope, offset: 0.0 })
    }

    #[inline(always)]
    fn is_long(&self) -> bool {
        self.relative != 0.0 || math::number::whole(self.power).is_none()
    }

    #[inline(always)]
    fn plain(&self) -> Option<Algebraic> {
        let is_plain = self.relative == 0.0 && self.widening == 0.0 && self.power == 2.0;
        is_plain.then_some(Algebraic { relative: 0.0, widening: 0.0, power: 2.0, ..*self })
    }

    /// Powers are products, which as constants need no choice for every pedestrian.
    #[inline(always)]
    fn choose<C: Chosen<Algebraic>>(self, chosen: C) -> C::Output {
        let without = |power: f64| Algebraic { relative: 0.0, widening: 0.0, power, ..self };
        let alone = |power: f64| Algebraic { relative: 0.0, power, ..self };
        match (self.relative == 0.0, self.widening == 0.0, self.power) {
            (true, true, 1.0) => chosen.straight(without(1.0)),
            (true, true, 2.0) => chosen.straight(without(2.0)),
            (true, true, 3.0) => chosen.straight(without(3.0)),
            (true, false, 2.0) => chosen.straight(alone(2.0)),
            _ => chosen.any(self),
        }
    }
}

impl Algebraic {
    /// `gamma = mu + delta eps ln 2`: strength of the force at equal speeds.
    pub fn gamma(&self) -> f64 {
        self.strength + self.relative * self.epsilon * LN_2
    }

    /// `d' = Delta y - 2 - 2 a_v v'`, the effective gap of the uniform flow, in units of `a_0`.
    pub fn gap(&self, headway: f64, speed: f64) -> f64 {
        headway - 2.0 * self.widening * speed - 2.0
    }

    /// Coefficients of the linearised law (eq:epsf) at the uniform effective distance `gap = d' > 0`.
    pub fn linearise(&self, gap: f64) -> Linear {
        let (delta, q, a_v, gamma) = (self.relative, self.power, self.widening, self.gamma());
        let inverse = math::pow(gap, -q);
        let phi = q * gamma * gamma * inverse / gap;
        Linear { phi, beta: a_v * phi, kappa: delta * gamma * inverse }
    }
}
