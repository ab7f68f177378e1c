//! The linearised equations of a ring against differences of the equations themselves.

use crate::sample::{Random, laws};
use jam::ring::Ring;
use jam::states::StateVariables;
use ode::Tangent;

/// A state somewhat away from the uniform flow, and a difference from it.
fn drawn(random: &mut Random, form: &dyn jam::states::RingSystem, pedestrians: usize) -> (Vec<f64>, Vec<f64>) {
    let mut state = form.start(jam::ring::Start { shift: 0.0 });
    state[..2 * pedestrians].iter_mut().for_each(|component| *component += random.uniform(-0.2, 0.2));
    let difference = (0..state.len()).map(|_| random.uniform(-1.0, 1.0)).collect();
    (state, difference)
}

#[test]
fn a_small_difference_moves_as_the_tangent_says() {
    let mut random = Random(31);
    let (mut told, mut untold) = (0, 0);
    for _ in 0..40 {
        for model in laws(&mut random) {
            let ring = Ring { pedestrians: 9, length: 9.0 * (model.contact() + random.uniform(1.0, 3.0)) };
            for kind in [StateVariables::Deviations, StateVariables::Spacings] {
                let form = kind.build(&model, ring);
                let size = form.tangent_size();
                if size == 0 {
                    untold += 1;
                    continue;
                }
                told += 1;
                let (state, difference) = drawn(&mut random, &*form, ring.pedestrians);
                let mut tangent = vec![0.0; size];
                let fastest = form.tangent(&state, &mut tangent);
                // eigenvalues of the shortest wave, and of relaxation, from their middle
                let shortest = (2.0 * ode::largest(&tangent) - 0.25).abs().sqrt();
                assert!(fastest >= 0.5 && fastest >= shortest, "{model:?}: {fastest}");
                let rates = |factor: f64| {
                    let near: Vec<f64> = state.iter().zip(&difference).map(|(x, d)| x + factor * d).collect();
                    let mut rates = vec![0.0; near.len()];
                    form.rates(&near, &mut rates);
                    rates
                };
                let h = 1e-6;
                let (more, less) = (rates(h), rates(-h));
                let n = ring.pedestrians;
                for i in 0..n {
                    let measured = (more[n + i] - less[n + i]) / (2.0 * h);
                    let told = tangent[i] * difference[i] - difference[n + i];
                    // curvature of steep ramps
                    let allowed = 1e-6 + 1e-4 * (1.0 + fastest * fastest);
                    assert!((told - measured).abs() < allowed, "{model:?} {kind:?}: {told} not {measured}");
                }
            }
        }
    }
    assert!(told > 50 && untold > 50, "{told} {untold}");
}

/// `du_n/dt = w_{n+1} - w_n`, `dw_n/dt = phi_n(t) u_n - w_n` with slopes that change linearly, and the way by the first one's
/// speed, by the classical scheme of Runge and Kutta.
fn solved([start, end]: [&[f64]; 2], length: f64, difference: &[f64]) -> Vec<f64> {
    const STEPS: usize = 20_000;
    let (n, h) = (start.len(), length / STEPS as f64);
    let rates = |state: &[f64], part: f64| {
        let closing = (0..n).map(|i| state[n + (i + 1) % n] - state[n + i]);
        let pushed = (0..n).map(|i| (start[i] + part * (end[i] - start[i])) * state[i] - state[n + i]);
        closing.chain(pushed).chain([state[n]]).collect::<Vec<f64>>()
    };
    let moved = |state: &[f64], by: f64, rates: &[f64]| {
        state.iter().zip(rates).map(|(state, rate)| state + by * rate).collect::<Vec<f64>>()
    };
    let mut state = difference[..2 * n + 1].to_vec();
    for step in 0..STEPS {
        let part = |more: f64| (step as f64 + more) / STEPS as f64;
        let first = rates(&state, part(0.0));
        let second = rates(&moved(&state, 0.5 * h, &first), part(0.5));
        let third = rates(&moved(&state, 0.5 * h, &second), part(0.5));
        let fourth = rates(&moved(&state, h, &third), part(1.0));
        for (by, rates) in [(1.0, first), (2.0, second), (2.0, third), (1.0, fourth)] {
            state = moved(&state, by * h / 6.0, &rates);
        }
    }
    state
}

/// Of rings shorter than a vector register, longer, and a multiple of it; over short times and over several pieces; also where
/// slopes do not change; of any size.
#[test]
fn a_difference_is_carried_as_the_linearised_equations_say() {
    let model = jam::laws::Model::Logarithmic(jam::laws::Logarithmic { a_v: 0.0, v0: 1.0, epsilon: 0.01 });
    let (mut random, mut room) = (Random(7), Vec::new());
    for (pedestrians, length, size) in [
        (2, 1.0, 1.0),
        (5, 0.4, 1.0),
        (7, 6.0, 1e-200),
        (8, 3.0, 1.0),
        (13, 25.0, 1e-12),
        (16, 5.0, 1e90),
        (37, 8.0, 1.0),
    ] {
        let ring = Ring { pedestrians, length: 1.6 * pedestrians as f64 };
        for (kind, is_steady) in [(StateVariables::Deviations, true), (StateVariables::Spacings, false)] {
            let form = kind.build(&model, ring);
            let start: Vec<f64> = (0..pedestrians).map(|_| random.uniform(-0.2, 1.0)).collect();
            let end: Vec<f64> =
                start.iter().map(|slope| if is_steady { *slope } else { slope + random.uniform(-0.5, 0.5) }).collect();
            let drawn: Vec<f64> = (0..form.dimension()).map(|_| random.uniform(-1.0, 1.0)).collect();
            let right = solved([&start, &end], length, &drawn);
            let mut carried: Vec<f64> = drawn.iter().map(|component| size * component).collect();
            let fastest = 1.1 * (2.0 * math::larger(ode::largest(&start), ode::largest(&end))).sqrt();
            let told = if is_steady { &[][..] } else { &end[..] };
            form.carry(Tangent { start: &start, end: told, length, fastest, room: &mut room }, &mut carried);
            let largest = ode::largest(&right);
            for (carried, right) in carried.iter().zip(&right) {
                let apart = (carried / size - right).abs();
                assert!(apart < 0.02 * largest, "{kind:?} {pedestrians} {length}: {carried} not {size:e} * {right}");
            }
            if kind == StateVariables::Deviations {
                // the uniform flow relaxes, and walks on
                let [walked, speed] = [1, 2].map(|i| drawn[2 * pedestrians + i]);
                let left = math::exp(-length);
                let expected = [walked + (1.0 - left) * speed, left * speed];
                for (carried, expected) in carried[2 * pedestrians + 1..].iter().zip(expected) {
                    assert!((carried / size - expected).abs() < 1e-12, "{carried} not {size:e} * {expected}");
                }
            }
        }
    }
}
