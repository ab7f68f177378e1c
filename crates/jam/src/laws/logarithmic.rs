//! The logarithmic force, eq:modlog.

use super::{Law, Parameter, Range};
use crate::ramp::{Bend, smooth_ramp};
use crate::stability::Linear;
use math::lane;
use math::number::Number;
use std::f64::consts::E;

/// `c = e - 1`: the force at contact just cancels the drive.
pub const C: f64 = E - 1.0;

/// Parameters `(v_0', a_v)` and `eps`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Logarithmic {
    /// `v_0' > 0`: desired speed, in units of `a_0 / tau`.
    pub v0: f64,
    /// `a_v >= 0` (with tilde in the paper): growth of the safety distance with speed, in units of `tau`.
    pub a_v: f64,
    /// `eps > 0`: width of the smooth ramp, a part of the critical distance.
    pub epsilon: f64,
}

impl Law for Logarithmic {
    const PARAMETERS: &'static [Parameter<Logarithmic>] = &[
        Parameter { name: "a_v", range: Range::NotNegative, default: Some(0.0), place: |law| &mut law.a_v },
        Parameter { name: "epsilon", range: Range::Positive, default: None, place: |law| &mut law.epsilon },
        Parameter { name: "v0", range: Range::Positive, default: None, place: |law| &mut law.v0 },
    ];

    const CONTACT: f64 = 0.0;

    const SINGULAR: bool = false;

    /// `dv_n/dt = v_0 (1 - ln(1 + c R_n)) - v_n`, `R_n = r_eps(s_n / (2 + a_v (v_n + v_{n+1})) - 1)`.
    #[inline(always)]
    fn acceleration<X: Number>(&self, spacing: X, v: X, ahead: X) -> X {
        let Logarithmic { v0, a_v, epsilon } = *self;
        let ratio = if a_v == 0.0 { spacing * 0.5 } else { spacing / ((v + ahead) * a_v + 2.0) };
        let r = (ratio - 1.0).ramp(epsilon);
        (-(r * C).ln_1p() + 1.0) * v0 - v
    }

    /// The spacing: the law stops pedestrians only when two centres meet.
    #[inline(always)]
    fn effective_gap<X: Number>(&self, spacing: X, _v: X, _ahead: X) -> X {
        spacing
    }

    fn bend(&self) -> Option<Bend> {
        let (clearance, speed) = (0.5 / self.epsilon, -0.5 * self.a_v / self.epsilon);
        Some(Bend { clearance, speed, ahead: speed, offset: -1.0 / self.epsilon })
    }

    #[inline(always)]
    fn plain(&self) -> Option<Logarithmic> {
        (self.a_v == 0.0).then_some(Logarithmic { a_v: 0.0, ..*self })
    }
}

impl Logarithmic {
    /// `a' = 2 (1 + a_v v')`: the critical distance at the speed `v'`, in units of `a_0`; beyond it pedestrians walk
    /// freely.
    pub fn critical_distance(&self, speed: f64) -> f64 {
        2.0 + 2.0 * self.a_v * speed
    }

    /// Coefficients of the linearised law at the uniform headway `Delta y` and speed `v'`, without the paper's
    /// approximation `eps -> 0`.
    pub fn linearise(&self, headway: f64, speed: f64) -> Linear {
        let Logarithmic { v0, a_v, epsilon } = *self;
        let distance = self.critical_distance(speed);
        let x = headway / distance - 1.0;
        let d0 = 1.0 + C * smooth_ramp(x, epsilon);
        let xi = lane::sigmoid(-x / epsilon) * C * v0 / (distance * d0);
        Linear { phi: xi, beta: xi * (a_v / distance) * headway, kappa: 0.0 }
    }
}
