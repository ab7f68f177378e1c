//! The algebraically decaying force, eq:invd:
//! `dv_n/dt = v_0 - v_n - (mu + delta r_eps(v_{n+1} - v_n))^2 / d_n^q`, `d_n = s_n - a_v (v_n + v_{n+1}) - 2`.

use super::{Law, Visitor, Work};
use crate::ramp::{Bend, smooth_ramp};
use crate::series::{Block, lanes};
use crate::stability::Linear;
use math::lane::{self, SoftplusBase};
use math::row;
use std::f64::consts::LN_2;

/// Parameters `<mu, delta, q, a_v>` and `v_0'`, `eps`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Algebraic {
    /// `mu >= 0`: strength of the force.
    pub strength: f64,
    /// `delta >= 0`: influence of the relative speed.
    pub relative: f64,
    /// `q > 0`: power of the distance.
    pub power: f64,
    /// `a_v >= 0` (with tilde in the paper): growth of the space requirement with speed.
    pub widening: f64,
    /// `eps > 0`: width of the smooth ramp; without effect when `delta = 0`.
    pub epsilon: f64,
    /// `v_0' > 0`: desired speed.
    pub desired_speed: f64,
}

impl Algebraic {
    /// `gamma = mu + delta eps ln 2`: strength of the force at equal speeds.
    pub fn gamma(&self) -> f64 {
        self.strength + self.relative * self.epsilon * LN_2
    }

    /// `d'` of the uniform flow.
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

    /// The power among those that need no general one.
    fn special_power(&self) -> u8 {
        match self.power {
            1.0 => 1,
            2.0 => 2,
            3.0 => 3,
            _ => 0,
        }
    }

    pub(super) fn visit<V: Visitor>(&self, visitor: V) -> V::Output {
        match (self.relative != 0.0, self.widening != 0.0) {
            (false, false) => self.visit_power::<V, false, false>(visitor),
            (false, true) => self.visit_power::<V, false, true>(visitor),
            (true, false) => self.visit_power::<V, true, false>(visitor),
            (true, true) => self.visit_power::<V, true, true>(visitor),
        }
    }

    fn visit_power<V: Visitor, const RELATIVE: bool, const WIDENING: bool>(&self, visitor: V) -> V::Output {
        let parameters = *self;
        match self.special_power() {
            1 => visitor.visit(AlgebraicLaw::<RELATIVE, WIDENING, 1> { parameters }),
            2 => visitor.visit(AlgebraicLaw::<RELATIVE, WIDENING, 2> { parameters }),
            3 => visitor.visit(AlgebraicLaw::<RELATIVE, WIDENING, 3> { parameters }),
            _ => visitor.visit(AlgebraicLaw::<RELATIVE, WIDENING, 0> { parameters }),
        }
    }
}

/// The law with the terms it has: the relative speed, the widening, and `q` = 1, 2, 3 or (0) any.
#[derive(Clone, Copy, Debug)]
pub struct AlgebraicLaw<const RELATIVE: bool, const WIDENING: bool, const POWER: u8> {
    parameters: Algebraic,
}

/// Coefficients of the distance and of the force `mu^2 / d^q`; at order 0 also `1 / d_0`.
#[derive(Clone, Copy, Debug, Default)]
pub struct Terms {
    distance: Block,
    force: Block,
    inverse: Block,
}

/// The uniform flow: `d'`, `1 / d'`, `1 / d'^q`, `gamma`, the ramp at equal speeds, and `1 / eps`.
#[derive(Clone, Copy, Debug)]
pub struct Base {
    gap: f64,
    inverse: f64,
    inverse_power: f64,
    gamma: f64,
    ramp: SoftplusBase,
    slope: f64,
}

impl<const RELATIVE: bool, const WIDENING: bool, const POWER: u8> AlgebraicLaw<RELATIVE, WIDENING, POWER> {
    /// `1 / d^q`.
    #[inline(always)]
    fn inverse_power(&self, d: f64) -> f64 {
        match POWER {
            1 => 1.0 / d,
            2 => 1.0 / (d * d),
            3 => 1.0 / (d * d * d),
            _ => lane::pow(d, -self.parameters.power),
        }
    }

    /// `(1 / d^q, 1 / d^q - 1 / d_0^q)` for `d = d_0 + change`.
    #[inline(always)]
    fn inverse_power_change(&self, base: &Base, change: f64) -> (f64, f64) {
        if POWER == 0 {
            let ratio = lane::pow_m1(change * base.inverse, -self.parameters.power);
            let difference = base.inverse_power * ratio;
            return (base.inverse_power + difference, difference);
        }
        let (inverse, before) = (1.0 / (base.gap + change), base.inverse);
        let difference = -(change * (inverse * before));
        match POWER {
            1 => (inverse, difference),
            2 => (inverse * inverse, difference * (inverse + before)),
            _ => {
                let square = inverse * inverse;
                (square * inverse, difference * (square + before * (inverse + before)))
            }
        }
    }

    /// [`Law::deviation`], given how much the ramp differs from that at equal speeds, in units of `eps`.
    #[inline(always)]
    fn deviation_with(&self, base: &Base, gap: f64, speed: f64, ahead: f64, ramp: f64) -> f64 {
        let Algebraic { relative: delta, widening: a_v, epsilon, .. } = self.parameters;
        let change = if WIDENING { gap - a_v * (speed + ahead) } else { gap };
        let (inverse_power, difference) = self.inverse_power_change(base, change);
        let by_distance = base.gamma * base.gamma * difference;
        if !RELATIVE {
            return -speed - by_distance;
        }
        let force = delta * (epsilon * ramp);
        -speed - (by_distance + force * (2.0 * base.gamma + force) * inverse_power)
    }
}

impl<const RELATIVE: bool, const WIDENING: bool, const POWER: u8> Law for AlgebraicLaw<RELATIVE, WIDENING, POWER> {
    type Base = Base;

    const SINGULAR: bool = true;

    const CONTACT: f64 = 2.0;

    const IN_ROWS: bool = RELATIVE;

    #[inline(always)]
    fn acceleration(&self, clearance: f64, speed: f64, ahead: f64) -> f64 {
        let Algebraic { strength: mu, relative: delta, epsilon, desired_speed: v0, .. } = self.parameters;
        let force = if RELATIVE { mu + delta * smooth_ramp(ahead - speed, epsilon) } else { mu };
        v0 - speed - force * force * self.inverse_power(self.room(clearance, speed, ahead))
    }

    #[inline(always)]
    fn accelerations(&self, row: &mut [f64], speeds: &[f64], ahead: &[f64], work: &mut Work) {
        let Algebraic { strength: mu, relative: delta, epsilon, desired_speed: v0, .. } = self.parameters;
        let n = row.len();
        let (speeds, ahead, ramp) = (&speeds[..n], &ahead[..n], &mut work.row[..n]);
        if RELATIVE {
            for i in 0..n {
                ramp[i] = -(ahead[i] - speeds[i]) / epsilon;
            }
            row::softplus(ramp, &mut work.room);
        }
        for i in 0..n {
            let force = if RELATIVE { mu + delta * (epsilon * ramp[i]) } else { mu };
            row[i] = v0 - speeds[i] - force * force * self.inverse_power(self.room(row[i], speeds[i], ahead[i]));
        }
    }

    fn base(&self, clearance: f64, speed: f64) -> Base {
        let gap = self.room(clearance, speed, speed);
        Base {
            gap,
            inverse: 1.0 / gap,
            inverse_power: self.inverse_power(gap),
            gamma: self.parameters.gamma(),
            ramp: SoftplusBase::ZERO,
            slope: 1.0 / self.parameters.epsilon,
        }
    }

    #[inline(always)]
    fn deviation(&self, base: &Base, gap: f64, speed: f64, ahead: f64) -> f64 {
        let ramp = if RELATIVE { lane::softplus_difference(&base.ramp, (speed - ahead) * base.slope) } else { 0.0 };
        self.deviation_with(base, gap, speed, ahead, ramp)
    }

    #[inline(always)]
    fn deviations(&self, base: &Base, row: &mut [f64], speeds: &[f64], ahead: &[f64], work: &mut Work) {
        let n = row.len();
        let (speeds, ahead, ramp) = (&speeds[..n], &ahead[..n], &mut work.row[..n]);
        if RELATIVE {
            for i in 0..n {
                ramp[i] = (speeds[i] - ahead[i]) * base.slope;
            }
            row::softplus_difference(&base.ramp, ramp, &mut work.room);
        }
        for i in 0..n {
            row[i] = self.deviation_with(base, row[i], speeds[i], ahead[i], ramp[i]);
        }
    }

    const HAS_SERIES: bool = !RELATIVE && !WIDENING;

    type Terms = Terms;

    #[inline(always)]
    fn start_terms(&self, clearance: &Block, terms: &mut Terms) {
        let mu = self.parameters.strength;
        terms.distance = *clearance;
        terms.force = lanes(|lane| mu * mu * self.inverse_power(clearance[lane]));
        terms.inverse = lanes(|lane| 1.0 / clearance[lane]);
    }

    /// From `d f' = -q f d'`: `k d_0 f_k = -sum (q (k - j) + j) d_{k-j} f_j` over `j < k`.
    #[inline(always)]
    fn next_terms(&self, earlier: &[Terms], clearance: &Block, terms: &mut Terms) -> Block {
        let (q, k) = (self.parameters.power, earlier.len());
        let (first, order) = (earlier[0], k as f64);
        let mut sum = lanes(|lane| (q * order) * (first.force[lane] * clearance[lane]));
        for (i, (there, back)) in earlier[1..].iter().zip(earlier[1..].iter().rev()).enumerate() {
            let j = (i + 1) as f64;
            let weight = q * (order - j) + j;
            for ((sum, f), d) in sum.iter_mut().zip(&there.force).zip(&back.distance) {
                *sum += weight * (f * d);
            }
        }
        let scale = -1.0 / order;
        let force = lanes(|lane| sum[lane] * (first.inverse[lane] * scale));
        terms.distance = *clearance;
        terms.force = force;
        lanes(|lane| -force[lane])
    }

    #[inline(always)]
    fn room(&self, clearance: f64, speed: f64, ahead: f64) -> f64 {
        if WIDENING { clearance - self.parameters.widening * (speed + ahead) } else { clearance }
    }

    fn room_per_speed(&self) -> f64 {
        self.parameters.widening
    }

    fn bend(&self) -> Option<Bend> {
        let slope = 1.0 / self.parameters.epsilon;
        RELATIVE.then_some(Bend { clearance: 0.0, speed: -slope, ahead: slope, offset: 0.0 })
    }
}
