//! The laws of motion with all their terms, written once for any kind of number ([`crate::number`]).

use crate::graph::Graph;
use crate::number::Number;

/// `e` to a double; `c = e - 1` of eq:modlog is rounded once more.
const C: f64 = std::f64::consts::E - 1.0;

/// A law with its parameters, named as in the paper.
#[derive(Clone, Debug, PartialEq)]
pub enum Formula {
    /// eq:invd: `v_0 - v - (mu + delta r_eps(v_ahead - v))^2 / d^q`, `d = s - a_v (v + v_ahead) - 2`.
    Algebraic {
        /// `mu >= 0`.
        mu: f64,
        /// `delta >= 0`.
        delta: f64,
        /// `q > 0`.
        q: f64,
        /// `a_v >= 0`.
        a_v: f64,
        /// `eps > 0`.
        epsilon: f64,
        /// `v_0 > 0`.
        v0: f64,
    },
    /// eq:sfm: `v_0 - v - a exp(-d / b) - c r_eps(d)`, `d = s - a_v (v + v_ahead) - 2`.
    Exponential {
        /// `a >= 0`.
        a: f64,
        /// `b > 0`.
        b: f64,
        /// `c >= 0`.
        c: f64,
        /// `a_v >= 0`.
        a_v: f64,
        /// `eps > 0`.
        epsilon: f64,
        /// `v_0 > 0`.
        v0: f64,
    },
    /// eq:modlog: `v_0 (1 - ln(1 + (e - 1) r_eps(s / (2 + a_v (v + v_ahead)) - 1))) - v`.
    Logarithmic {
        /// `a_v >= 0`.
        a_v: f64,
        /// `eps > 0`.
        epsilon: f64,
        /// `v_0 > 0`.
        v0: f64,
    },
    /// Any other, from the formulas of a scene.
    Graph(Graph),
}

impl Formula {
    /// `dv/dt` of a pedestrian, from the spacing and speed of the pedestrian a given number of places ahead. Ramps are
    /// left to `ramp(x, eps)`, so that whoever integrates sees the kinks.
    pub fn acceleration<T: Number>(
        &self,
        spacing: impl Fn(i32) -> T,
        speed: impl Fn(i32) -> T,
        ramp: &mut impl FnMut(T, f64) -> T,
    ) -> T {
        if let Formula::Graph(graph) = self {
            return graph.acceleration(spacing, speed, ramp);
        }
        let number = |value: f64| T::from(value);
        let (s, v, ahead) = (spacing(0), speed(0), speed(1));
        match *self {
            Formula::Graph(_) => number(f64::NAN),
            Formula::Algebraic { mu, delta, q, epsilon, v0, .. } => {
                let strength = match delta {
                    0.0 => number(mu),
                    _ => number(mu) + number(delta) * ramp(ahead - v, epsilon),
                };
                number(v0) - v - strength * strength * self.room(&spacing, &speed).power(-q)
            }
            Formula::Exponential { a, b, c, epsilon, v0, .. } => {
                let room = self.room(&spacing, &speed);
                let far = number(v0) - v - number(a) * (-room / number(b)).exp();
                if c == 0.0 { far } else { far - number(c) * ramp(room, epsilon) }
            }
            Formula::Logarithmic { a_v, epsilon, v0 } => {
                let distance = number(2.0) + number(a_v) * (v + ahead);
                let r = ramp(s / distance - number(1.0), epsilon);
                number(v0) * (number(1.0) - (number(C) * r).ln_1p()) - v
            }
        }
    }

    /// What an overlap uses up: `d`, or the spacing under eq:modlog.
    pub fn room<T: Number>(&self, spacing: impl Fn(i32) -> T, speed: impl Fn(i32) -> T) -> T {
        match *self {
            Formula::Graph(ref graph) => graph.room(spacing, speed),
            Formula::Algebraic { a_v, .. } | Formula::Exponential { a_v, .. } => {
                // contact first: no digit of a small room is lost to it
                spacing(0) - T::from(2.0) - T::from(a_v) * (speed(0) + speed(1))
            }
            Formula::Logarithmic { .. } => spacing(0),
        }
    }

    /// How far it looks behind and ahead.
    pub fn reach(&self) -> [i32; 2] {
        match self {
            Formula::Graph(graph) => graph.reach(),
            _ => [0, 1],
        }
    }

    /// The spacing that clearances are counted from: where standing pedestrians touch.
    pub fn contact(&self) -> f64 {
        match self {
            Formula::Graph(graph) => graph.contact(),
            _ => 2.0,
        }
    }

    /// Whether the force is infinite at contact.
    pub fn is_singular(&self) -> bool {
        match self {
            Formula::Algebraic { .. } => true,
            Formula::Graph(graph) => graph.is_singular(),
            _ => false,
        }
    }

    /// `v_0`; of other formulas the size of speeds.
    pub fn desired_speed(&self) -> f64 {
        match *self {
            Formula::Graph(ref graph) => graph.scale(),
            Formula::Algebraic { v0, .. } | Formula::Exponential { v0, .. } | Formula::Logarithmic { v0, .. } => v0,
        }
    }
}

/// `r_eps(x) = eps ln(1 + exp(-x / eps))` (eq:aTheta).
pub fn smooth_ramp<T: Number>(x: T, epsilon: f64) -> T {
    T::from(epsilon) * (-x / T::from(epsilon)).softplus()
}
