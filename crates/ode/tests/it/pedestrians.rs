//! Rings of pedestrians against the solver of another crate, with the laws written out again from the paper.

use crate::problems::{Equations, distance, solve};
use differential_equations::ode::ODE;
use differential_equations::prelude::{ExplicitRungeKutta, IVP};
use ode::{Control, Method};
use std::cell::Cell;
use std::f64::consts::E;

/// Pedestrians on the ring.
const COUNT: usize = 20;

/// Gaps, then speeds.
const SIZE: usize = 2 * COUNT;

/// `dv_n/dt` from the gap, the own speed and the speed ahead.
type Acceleration = fn(f64, f64, f64) -> f64;

/// `r_eps(x) = eps ln(1 + exp(-x / eps))`, by the branch that does not overflow.
fn ramp(x: f64, epsilon: f64) -> f64 {
    if x < 0.0 {
        epsilon * math::ln_1p(math::exp(x / epsilon)) - x
    } else {
        epsilon * math::ln_1p(math::exp(-x / epsilon))
    }
}

/// eq:invd with `mu = 0.55, delta = 1, q = 2, a_v = 0.1`, `v_0' = 3`, `eps = 0.1`.
fn algebraic(gap: f64, speed: f64, ahead: f64) -> f64 {
    let room = gap - 0.1 * (speed + ahead) - 2.0;
    let strength = 0.55 + ramp(ahead - speed, 0.1);
    3.0 - speed - strength * strength / (room * room)
}

/// eq:sfm with `a = 3, b = 1.5, c = 2, a_v = 0.1`, `v_0' = 3`, `eps = 0.1`.
fn exponential(gap: f64, speed: f64, ahead: f64) -> f64 {
    let room = gap - 0.1 * (speed + ahead) - 2.0;
    3.0 - speed - 3.0 * math::exp(-room / 1.5) - 2.0 * ramp(room, 0.1)
}

/// eq:modlog with `a_v = 0.1`, `v_0' = 1`, `eps = 0.01`.
fn logarithmic(gap: f64, speed: f64, ahead: f64) -> f64 {
    let force = math::ln(1.0 + (E - 1.0) * ramp(gap / (2.0 + 0.1 * (speed + ahead)) - 1.0, 0.01));
    1.0 - force - speed
}

/// Rates of the gaps.
fn close(state: &[f64], rates: &mut [f64]) {
    let speeds = &state[COUNT..];
    for n in 0..COUNT {
        rates[n] = speeds[(n + 1) % COUNT] - speeds[n];
    }
}

/// Rates of the speeds.
fn accelerate(law: Acceleration, state: &[f64], rates: &mut [f64]) {
    let (gaps, speeds) = state.split_at(COUNT);
    for n in 0..COUNT {
        rates[COUNT + n] = law(gaps[n], speeds[n], speeds[(n + 1) % COUNT]);
    }
}

/// The ring for the other crate.
struct Theirs(Acceleration);

impl ODE<f64, [f64; SIZE]> for Theirs {
    fn diff(&self, _t: f64, state: &[f64; SIZE], rates: &mut [f64; SIZE]) {
        close(state, rates);
        accelerate(self.0, state, rates);
    }
}

/// The ring for this one.
fn ours(dynamics: fn(&[f64], &mut [f64])) -> Equations {
    Equations {
        dimension: SIZE,
        positions: COUNT,
        kinematics: close,
        dynamics,
        domain: |_| true,
        evaluations: Cell::new(0),
    }
}

/// Equal gaps of this headway but for pedestrian 0, who stands `shift` further on; nobody walks.
fn start(headway: f64, shift: f64) -> [f64; SIZE] {
    let mut state = [0.0; SIZE];
    state[..COUNT].fill(headway);
    state[0] -= shift;
    state[COUNT - 1] += shift;
    state
}

/// Both crates run the ring until t = 20.
fn compare(name: &str, law: Acceleration, dynamics: fn(&[f64], &mut [f64]), start: [f64; SIZE]) {
    let (end, tolerance) = (20.0, 1e-13);
    let theirs = IVP::ode(&Theirs(law), 0.0, end, start)
        .method(ExplicitRungeKutta::dop853().rtol(tolerance).atol(tolerance))
        .solve()
        .expect("the other crate solves it");
    let ours = solve(&ours(dynamics), &start, end, Method::Dop853, Control::Adaptive { tolerance });
    let last = theirs.y.last().expect("a last state");
    let speeds = &ours.state[COUNT..];
    let unevenness = distance(&speeds[1..], &speeds[..COUNT - 1]);
    let difference = distance(&ours.state, last);
    println!("{name}: {difference:e} apart after {} steps, neighbours' speeds differ by {unevenness:e}", ours.steps);
    // the wave is still there, or there would be little to compare
    assert!(unevenness > 1e-4, "{name}: {unevenness:e}");
    assert!(difference < 1e-12, "{name}: {difference:e}");
}

#[test]
fn another_crate_finds_the_same_ring_of_the_algebraic_law() {
    compare("algebraic", algebraic, |state, rates| accelerate(algebraic, state, rates), start(3.5, 0.2));
}

#[test]
fn another_crate_finds_the_same_ring_of_the_exponential_law() {
    compare("exponential", exponential, |state, rates| accelerate(exponential, state, rates), start(3.5, 0.2));
}

#[test]
fn another_crate_finds_the_same_ring_of_the_logarithmic_law() {
    compare("logarithmic", logarithmic, |state, rates| accelerate(logarithmic, state, rates), start(1.5, 0.2));
}
