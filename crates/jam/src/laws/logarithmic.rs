//! The logarithmic force, eq:modlog: `dv_n/dt = v_0 (1 - ln(1 + c R_n)) - v_n`, `c = e - 1`,
//! `R_n = r_eps(s_n / (2 + a_v (v_n + v_{n+1})) - 1)`.

use super::{Law, Visitor, Work};
use crate::ramp::{Bend, smooth_ramp};
use crate::series::{Block, inner_product, lanes};
use crate::stability::Linear;
use math::lane::{self, SoftplusBase};
use math::row;
use std::f64::consts::E;

/// `c = e - 1`: the force at contact just cancels the drive.
pub const C: f64 = E - 1.0;

/// Parameters `(v_0', a_v)` and `eps`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Logarithmic {
    /// `v_0' > 0`: desired speed.
    pub desired_speed: f64,
    /// `a_v >= 0` (with tilde in the paper): growth of the safety distance with speed.
    pub widening: f64,
    /// `eps > 0`: width of the smooth ramp.
    pub epsilon: f64,
}

impl Logarithmic {
    /// `a' = 2 (1 + a_v v')`: the critical distance at the speed `v'`.
    pub fn critical_distance(&self, speed: f64) -> f64 {
        2.0 + 2.0 * self.widening * speed
    }

    /// Coefficients of the linearised law at the uniform headway `Delta y` and speed `v'`, without the paper's
    /// approximation `eps -> 0`.
    pub fn linearise(&self, headway: f64, speed: f64) -> Linear {
        let (v0, a_v, epsilon) = (self.desired_speed, self.widening, self.epsilon);
        let distance = self.critical_distance(speed);
        let x = headway / distance - 1.0;
        let d0 = 1.0 + C * smooth_ramp(x, epsilon);
        let xi = lane::sigmoid(-x / epsilon) * C * v0 / (distance * d0);
        Linear { phi: xi, beta: xi * (a_v / distance) * headway, kappa: 0.0 }
    }

    pub(super) fn visit<V: Visitor>(&self, visitor: V) -> V::Output {
        let (parameters, slope) = (*self, -1.0 / self.epsilon);
        if self.widening != 0.0 {
            visitor.visit(LogarithmicLaw::<true> { parameters, slope })
        } else {
            visitor.visit(LogarithmicLaw::<false> { parameters, slope })
        }
    }
}

/// The law with or without the widening, and `-1 / eps`.
#[derive(Clone, Copy, Debug)]
pub struct LogarithmicLaw<const WIDENING: bool> {
    parameters: Logarithmic,
    slope: f64,
}

/// Coefficients of `e = exp(-|y|)` and of the ramp times `c eps`, and (each `k` times a coefficient) of the rates of the
/// exponent, of `h = ln(1 + e)` and of `ln(1 + c R)`; see [`LogarithmicLaw::next_terms`].
#[derive(Clone, Copy, Debug, Default)]
pub struct Terms {
    decay: Block,
    exponent_rate: Block,
    rest_rate: Block,
    ramp: Block,
    force_rate: Block,
}

/// The uniform flow: headway, `a'`, `1 / a'`, the ramp and `c eps / (1 + c R')`.
#[derive(Clone, Copy, Debug)]
pub struct Base {
    headway: f64,
    distance: f64,
    inverse_distance: f64,
    ramp: SoftplusBase,
    scale: f64,
}

impl<const WIDENING: bool> LogarithmicLaw<WIDENING> {
    /// `-(s / (2 + a_v (v + v_ahead)) - 1) / eps`: the argument of the softplus function in the smooth ramp.
    #[inline(always)]
    fn ramp_argument(&self, gap: f64, speed: f64, ahead: f64) -> f64 {
        let a_v = self.parameters.widening;
        let ratio = if WIDENING { gap / (2.0 + a_v * (speed + ahead)) } else { 0.5 * gap };
        (ratio - 1.0) * self.slope
    }

    /// How much that argument differs from the uniform flow's.
    #[inline(always)]
    fn ramp_difference(&self, base: &Base, gap: f64, speed: f64, ahead: f64) -> f64 {
        let ratio = if WIDENING {
            let wider = self.parameters.widening * (speed + ahead);
            (gap - base.headway * (wider * base.inverse_distance)) / (base.distance + wider)
        } else {
            0.5 * gap
        };
        ratio * self.slope
    }
}

impl<const WIDENING: bool> Law for LogarithmicLaw<WIDENING> {
    type Base = Base;

    const SINGULAR: bool = false;

    const CONTACT: f64 = 0.0;

    const IN_ROWS: bool = true;

    #[inline(always)]
    fn acceleration(&self, gap: f64, speed: f64, ahead: f64) -> f64 {
        let Logarithmic { desired_speed: v0, epsilon, .. } = self.parameters;
        let r = epsilon * lane::softplus(self.ramp_argument(gap, speed, ahead));
        v0 * (1.0 - lane::ln_1p(C * r)) - speed
    }

    #[inline(always)]
    fn accelerations(&self, row: &mut [f64], speeds: &[f64], ahead: &[f64], work: &mut Work) {
        let Logarithmic { desired_speed: v0, epsilon, .. } = self.parameters;
        let n = row.len();
        let (speeds, ahead) = (&speeds[..n], &ahead[..n]);
        for i in 0..n {
            row[i] = self.ramp_argument(row[i], speeds[i], ahead[i]);
        }
        row::softplus(row, &mut work.room);
        row.iter_mut().for_each(|r| *r = C * (epsilon * *r));
        row::ln_1p(row, &mut work.room);
        for i in 0..n {
            row[i] = v0 * (1.0 - row[i]) - speeds[i];
        }
    }

    fn base(&self, gap: f64, speed: f64) -> Base {
        let Logarithmic { widening: a_v, epsilon, .. } = self.parameters;
        let distance = 2.0 + 2.0 * a_v * speed;
        let x = gap / distance - 1.0;
        let r = smooth_ramp(x, epsilon);
        Base {
            headway: gap,
            distance,
            inverse_distance: 1.0 / distance,
            ramp: SoftplusBase::new(-x / epsilon),
            scale: C * epsilon / (1.0 + C * r),
        }
    }

    #[inline(always)]
    fn deviation(&self, base: &Base, gap: f64, speed: f64, ahead: f64) -> f64 {
        let r = lane::softplus_difference(&base.ramp, self.ramp_difference(base, gap, speed, ahead));
        -(self.parameters.desired_speed * lane::ln_1p(base.scale * r)) - speed
    }

    const HAS_SERIES: bool = !WIDENING;

    type Terms = Terms;

    /// At order 0 the rates have no meaning: their places hold constants of the recurrences.
    #[inline(always)]
    fn start_terms(&self, clearance: &Block, terms: &mut Terms) {
        let a = C * self.parameters.epsilon;
        let y = lanes(|lane| self.ramp_argument(clearance[lane], 0.0, 0.0));
        let e = lanes(|lane| lane::exp(-y[lane].abs()));
        terms.decay = e;
        terms.exponent_rate = lanes(|lane| if y[lane] > 0.0 { -1.0 } else { 1.0 });
        terms.rest_rate = lanes(|lane| 1.0 / (1.0 + e[lane]));
        terms.force_rate = lanes(|lane| 1.0 / (1.0 + a * lane::softplus(y[lane])));
    }

    /// With `y = -(s / 2 - 1) / eps` the ramp is `eps (h + max(y, 0))`, `h = ln(1 + e)`, `e = exp(-|y|)`. From
    /// `e' = -|y|' e`, `(1 + e) h' = e'`, and `(1 + a r) f' = a r'` for `f = ln(1 + a r)`, `r = h + max(y, 0)`, `a = c eps`.
    #[inline(always)]
    fn next_terms(&self, earlier: &[Terms], clearance: &Block, terms: &mut Terms) -> Block {
        let Logarithmic { desired_speed: v0, epsilon, .. } = self.parameters;
        let (order, a) = (earlier.len() as f64, C * epsilon);
        let (slope, inverse_order) = (0.5 * order * self.slope, 1.0 / order);
        let e_sum = inner_product(earlier, |terms| &terms.decay, |terms| &terms.exponent_rate);
        let h_sum = inner_product(earlier, |terms| &terms.rest_rate, |terms| &terms.decay);
        let f_sum = inner_product(earlier, |terms| &terms.force_rate, |terms| &terms.ramp);
        let first = &earlier[0];
        let y_rate = lanes(|lane| slope * clearance[lane]);
        let above = lanes(|lane| if first.exponent_rate[lane] < 0.0 { y_rate[lane] } else { 0.0 });
        let exponent_rate = lanes(|lane| first.exponent_rate[lane] * y_rate[lane]);
        let e_rate = lanes(|lane| first.decay[lane] * exponent_rate[lane] + e_sum[lane]);
        let rest_rate = lanes(|lane| (e_rate[lane] - h_sum[lane]) * first.rest_rate[lane]);
        let ramp_rate = lanes(|lane| a * (rest_rate[lane] + above[lane]));
        let force_rate = lanes(|lane| (ramp_rate[lane] - f_sum[lane]) * first.force_rate[lane]);
        let decay = lanes(|lane| e_rate[lane] * inverse_order);
        let ramp = lanes(|lane| ramp_rate[lane] * inverse_order);
        *terms = Terms { decay, exponent_rate, rest_rate, ramp, force_rate };
        lanes(|lane| -v0 * (force_rate[lane] * inverse_order))
    }

    #[inline(always)]
    fn deviations(&self, base: &Base, row: &mut [f64], speeds: &[f64], ahead: &[f64], work: &mut Work) {
        let n = row.len();
        let (speeds, ahead) = (&speeds[..n], &ahead[..n]);
        for i in 0..n {
            row[i] = self.ramp_difference(base, row[i], speeds[i], ahead[i]);
        }
        row::softplus_difference(&base.ramp, row, &mut work.room);
        row.iter_mut().for_each(|r| *r *= base.scale);
        row::ln_1p(row, &mut work.room);
        for i in 0..n {
            row[i] = -(self.parameters.desired_speed * row[i]) - speeds[i];
        }
    }

    #[inline(always)]
    fn room(&self, gap: f64, _speed: f64, _ahead: f64) -> f64 {
        gap
    }

    fn room_per_speed(&self) -> f64 {
        0.0
    }

    fn bend(&self) -> Option<Bend> {
        let Logarithmic { widening: a_v, epsilon, .. } = self.parameters;
        let (clearance, speed) = (0.5 / epsilon, -0.5 * a_v / epsilon);
        Some(Bend { clearance, speed, ahead: speed, offset: -1.0 / epsilon })
    }
}
