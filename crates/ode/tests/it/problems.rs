//! Small systems with known solutions, and helpers that integrate them.

use ode::{Control, Failure, Group, Measure, Method, Problem, Statistics, Step, System, integrate};
use std::cell::Cell;
use std::ops::{ControlFlow, Range};

/// A system in `dimension` components of which the first `positions` are position-like.
pub struct Equations {
    pub dimension: usize,
    pub positions: usize,
    pub kinematics: fn(&[f64], &mut [f64]),
    pub dynamics: fn(&[f64], &mut [f64]),
    pub domain: fn(&[f64]) -> bool,
    /// How often the dynamics were evaluated.
    pub evaluations: Cell<u64>,
}

impl Equations {
    /// `dy/dt = f(y)` in one component that is no position.
    pub fn scalar(rate: fn(&[f64], &mut [f64])) -> Equations {
        Equations {
            dimension: 1,
            positions: 0,
            kinematics: |_, _| {},
            dynamics: rate,
            domain: |_| true,
            evaluations: Cell::new(0),
        }
    }
}

impl System for Equations {
    fn dimension(&self) -> usize {
        self.dimension
    }

    fn kinematics(&self, state: &[f64], rates: &mut [f64]) {
        (self.kinematics)(state, rates);
    }

    fn dynamics(&self, state: &[f64], rates: &mut [f64]) {
        self.evaluations.set(self.evaluations.get() + 1);
        (self.dynamics)(state, rates);
    }

    fn positions(&self) -> Vec<Range<usize>> {
        vec![0..self.positions; usize::from(self.positions > 0)]
    }

    fn groups(&self) -> Vec<Group> {
        vec![Group { range: 0..self.dimension, measure: Measure::Largest, floor: f64::MIN_POSITIVE }]
    }

    fn in_domain(&self, state: &[f64]) -> bool {
        (self.domain)(state)
    }
}

/// `x'' = -x`: `(cos t, -sin t)` from (1, 0).
pub fn oscillator() -> Equations {
    Equations {
        dimension: 2,
        positions: 1,
        kinematics: |state, rates| rates[0] = state[1],
        dynamics: |state, rates| rates[1] = -state[0],
        domain: |_| true,
        evaluations: Cell::new(0),
    }
}

/// The oscillator's solution.
pub fn oscillation(t: f64) -> [f64; 2] {
    [math::cos(t), -math::sin(t)]
}

/// The oscillator, and `y' = y x` driven by it: `exp(sin t)` from 1. Entire, so that steps may be long.
pub fn driven() -> Equations {
    Equations {
        dimension: 3,
        dynamics: |state, rates| {
            rates[1] = -state[0];
            rates[2] = state[2] * state[0];
        },
        ..oscillator()
    }
}

/// The solution of [`driven`] from (1, 0, 1).
pub fn driven_solution(t: f64) -> [f64; 3] {
    [math::cos(t), -math::sin(t), math::exp(math::sin(t))]
}

/// The eccentricity of [`kepler`]'s ellipse.
pub const ECCENTRICITY: f64 = 0.5;

/// A planet about a sun of mass 1: `[x, y, x', y']`.
pub fn kepler() -> Equations {
    Equations {
        dimension: 4,
        positions: 2,
        kinematics: |state, rates| rates[..2].copy_from_slice(&state[2..]),
        dynamics: |state, rates| {
            let square = state[0] * state[0] + state[1] * state[1];
            let cube = square * square.sqrt();
            rates[2] = -state[0] / cube;
            rates[3] = -state[1] / cube;
        },
        domain: |_| true,
        evaluations: Cell::new(0),
    }
}

/// The planet at the time `t` after it was nearest to the sun, major half-axis 1: Kepler's equation by Newton's method.
pub fn planet(t: f64) -> [f64; 4] {
    let mut anomaly = t;
    for _ in 0..50 {
        let residual = anomaly - ECCENTRICITY * math::sin(anomaly) - t;
        anomaly -= residual / (1.0 - ECCENTRICITY * math::cos(anomaly));
    }
    let (sin, cos) = (math::sin(anomaly), math::cos(anomaly));
    let (axis, pace) = ((1.0 - ECCENTRICITY * ECCENTRICITY).sqrt(), 1.0 / (1.0 - ECCENTRICITY * cos));
    [cos - ECCENTRICITY, axis * sin, -pace * sin, axis * pace * cos]
}

/// Integrates from time 0 to `end`, showing the steps to `look`.
pub fn watched(
    system: &Equations,
    start: &[f64],
    end: f64,
    method: Method,
    control: Control,
    look: &mut dyn FnMut(&mut Step<'_>),
) -> Result<Statistics, Failure> {
    let problem = Problem { system, start, begin: 0.0, end, method, control };
    integrate(&problem, &mut |step: &mut Step<'_>| {
        look(step);
        ControlFlow::Continue(())
    })
}

/// Integrates from time 0 to `end` and returns where it ended.
pub fn solve(system: &Equations, start: &[f64], end: f64, method: Method, control: Control) -> Statistics {
    watched(system, start, end, method, control, &mut |_| {}).expect("nothing stands in the way")
}

/// The largest difference of two states.
pub fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).fold(0.0, |most, (a, b)| if (a - b).abs() > most { (a - b).abs() } else { most })
}

/// `ln(a / b) / ln(c)`: by which power of `c` the numbers differ.
pub fn power(a: f64, b: f64, c: f64) -> f64 {
    math::ln(a / b) / math::ln(c)
}

/// The methods that ask nothing of a system but its rates.
pub fn general_methods() -> impl Iterator<Item = Method> {
    Method::ALL.into_iter().filter(|method| !method.needs_series())
}
