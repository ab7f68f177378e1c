//! The exponential force, eq:sfm:
//! `dv_n/dt = v_0 - v_n - a exp(-d_n / b) - c r_eps(d_n)`, `d_n = s_n - a_v (v_n + v_{n+1}) - 2`.

use super::{Law, Visitor, Work};
use crate::ramp::{Bend, smooth_ramp};
use crate::series::{Block, inner_product, lanes};
use crate::stability::Linear;
use math::lane::{self, SoftplusBase};
use math::row;

/// Parameters `<a, b, c, a_v>` and `v_0'`, `eps`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exponential {
    /// `a >= 0`: strength of the force.
    pub strength: f64,
    /// `b > 0`: its range.
    pub range: f64,
    /// `c >= 0`: stiffness of the contact.
    pub contact: f64,
    /// `a_v >= 0` (with tilde in the paper): growth of the space requirement with speed.
    pub widening: f64,
    /// `eps > 0`: width of the smooth ramp; without effect when `c = 0`.
    pub epsilon: f64,
    /// `v_0' > 0`: desired speed.
    pub desired_speed: f64,
}

impl Exponential {
    /// `d'` of the uniform flow.
    pub fn gap(&self, headway: f64, speed: f64) -> f64 {
        headway - 2.0 * self.widening * speed - 2.0
    }

    /// Coefficients of the linearised law at the uniform effective distance `gap = d'`.
    pub fn linearise(&self, gap: f64) -> Linear {
        let (a, b, c, a_v) = (self.strength, self.range, self.contact, self.widening);
        let phi = a / b * math::exp(-gap / b) + c * lane::sigmoid(-gap / self.epsilon);
        Linear { phi, beta: a_v * phi, kappa: 0.0 }
    }

    pub(super) fn visit<V: Visitor>(&self, visitor: V) -> V::Output {
        let parameters = *self;
        match (self.contact != 0.0, self.widening != 0.0) {
            (false, false) => visitor.visit(ExponentialLaw::<false, false> { parameters }),
            (false, true) => visitor.visit(ExponentialLaw::<false, true> { parameters }),
            (true, false) => visitor.visit(ExponentialLaw::<true, false> { parameters }),
            (true, true) => visitor.visit(ExponentialLaw::<true, true> { parameters }),
        }
    }
}

/// The law with the terms it has: the contact force, the widening.
#[derive(Clone, Copy, Debug)]
pub struct ExponentialLaw<const CONTACT: bool, const WIDENING: bool> {
    parameters: Exponential,
}

/// Coefficients of the force `a exp(y)`, `y = -d / b`, and of the rate of `y`.
#[derive(Clone, Copy, Debug, Default)]
pub struct Terms {
    force: Block,
    rate: Block,
}

/// The uniform flow: its force `a exp(-d' / b)`, `-1 / b`, the ramp at `d'`, and `-1 / eps`.
#[derive(Clone, Copy, Debug)]
pub struct Base {
    force: f64,
    decay: f64,
    ramp: SoftplusBase,
    slope: f64,
}

impl<const CONTACT: bool, const WIDENING: bool> Law for ExponentialLaw<CONTACT, WIDENING> {
    type Base = Base;

    const SINGULAR: bool = false;

    const CONTACT: f64 = 2.0;

    const IN_ROWS: bool = CONTACT;

    #[inline(always)]
    fn acceleration(&self, clearance: f64, speed: f64, ahead: f64) -> f64 {
        let Exponential { strength: a, range: b, contact: c, epsilon, desired_speed: v0, .. } = self.parameters;
        let d = self.room(clearance, speed, ahead);
        let far = v0 - speed - a * lane::exp(-d / b);
        if CONTACT { far - c * smooth_ramp(d, epsilon) } else { far }
    }

    #[inline(always)]
    fn accelerations(&self, row: &mut [f64], speeds: &[f64], ahead: &[f64], work: &mut Work) {
        let Exponential { strength: a, range: b, contact: c, epsilon, desired_speed: v0, .. } = self.parameters;
        let n = row.len();
        let (speeds, ahead, ramp) = (&speeds[..n], &ahead[..n], &mut work.row[..n]);
        for i in 0..n {
            let d = self.room(row[i], speeds[i], ahead[i]);
            row[i] = -d / b;
            ramp[i] = -d / epsilon;
        }
        row::exp(row, &mut work.room);
        if CONTACT {
            row::softplus(ramp, &mut work.room);
        }
        for i in 0..n {
            let far = v0 - speeds[i] - a * row[i];
            row[i] = if CONTACT { far - c * (epsilon * ramp[i]) } else { far };
        }
    }

    fn base(&self, clearance: f64, speed: f64) -> Base {
        let Exponential { strength: a, range: b, epsilon, .. } = self.parameters;
        let d = self.room(clearance, speed, speed);
        Base {
            force: a * math::exp(-d / b),
            decay: -1.0 / b,
            // without contact nothing reads it
            ramp: if CONTACT { SoftplusBase::new(-d / epsilon) } else { SoftplusBase::ZERO },
            slope: -1.0 / epsilon,
        }
    }

    #[inline(always)]
    fn deviation(&self, base: &Base, gap: f64, speed: f64, ahead: f64) -> f64 {
        let Exponential { contact: c, widening: a_v, epsilon, .. } = self.parameters;
        let change = if WIDENING { gap - a_v * (speed + ahead) } else { gap };
        let far = -speed - base.force * lane::exp_m1(change * base.decay);
        if CONTACT { far - c * (epsilon * lane::softplus_difference(&base.ramp, change * base.slope)) } else { far }
    }

    const HAS_SERIES: bool = !CONTACT && !WIDENING;

    type Terms = Terms;

    #[inline(always)]
    fn start_terms(&self, clearance: &Block, terms: &mut Terms) {
        let Exponential { strength: a, range: b, .. } = self.parameters;
        terms.force = lanes(|lane| a * lane::exp(-clearance[lane] / b));
    }

    /// From `f' = f y'`, `y = -d / b`: `k f_k = sum f_j (k - j) y_{k-j}` over `j < k`.
    #[inline(always)]
    fn next_terms(&self, earlier: &[Terms], clearance: &Block, terms: &mut Terms) -> Block {
        let (first, order) = (earlier[0], earlier.len() as f64);
        let (slope, inverse_order) = (-order / self.parameters.range, 1.0 / order);
        let rate = lanes(|lane| slope * clearance[lane]);
        let sum = inner_product(earlier, |terms| &terms.force, |terms| &terms.rate);
        let force = lanes(|lane| (first.force[lane] * rate[lane] + sum[lane]) * inverse_order);
        *terms = Terms { force, rate };
        lanes(|lane| -force[lane])
    }

    #[inline(always)]
    fn deviations(&self, base: &Base, row: &mut [f64], speeds: &[f64], ahead: &[f64], work: &mut Work) {
        let Exponential { contact: c, widening: a_v, epsilon, .. } = self.parameters;
        let n = row.len();
        let (speeds, ahead, ramp) = (&speeds[..n], &ahead[..n], &mut work.row[..n]);
        for i in 0..n {
            let change = if WIDENING { row[i] - a_v * (speeds[i] + ahead[i]) } else { row[i] };
            row[i] = change * base.decay;
            ramp[i] = change * base.slope;
        }
        row::exp_m1(row, &mut work.room);
        if CONTACT {
            row::softplus_difference(&base.ramp, ramp, &mut work.room);
        }
        for i in 0..n {
            let far = -speeds[i] - base.force * row[i];
            row[i] = if CONTACT { far - c * (epsilon * ramp[i]) } else { far };
        }
    }

    #[inline(always)]
    fn room(&self, clearance: f64, speed: f64, ahead: f64) -> f64 {
        if WIDENING { clearance - self.parameters.widening * (speed + ahead) } else { clearance }
    }

    fn room_per_speed(&self) -> f64 {
        self.parameters.widening
    }

    fn bend(&self) -> Option<Bend> {
        let Exponential { widening: a_v, epsilon, .. } = self.parameters;
        let speed = if WIDENING { -a_v / epsilon } else { 0.0 };
        CONTACT.then_some(Bend { clearance: 1.0 / epsilon, speed, ahead: speed, offset: 0.0 })
    }
}
