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
                let mut rows = [&difference[..], &vec![0.0; difference.len()]].concat();
                form.difference(Tangent { start: &tangent, growth: &[] }, 1, 1.0, &mut rows);
                let rates = |factor: f64| {
                    let near: Vec<f64> = state.iter().zip(&difference).map(|(x, d)| x + factor * d).collect();
                    let mut rates = vec![0.0; near.len()];
                    form.rates(&near, &mut rates);
                    rates
                };
                let h = 1e-6;
                let near = rates(h).into_iter().zip(rates(-h)).zip(&difference);
                for (((more, less), difference), row) in near.zip(&rows[difference.len()..]) {
                    let measured = (more - less) / (2.0 * h) - form.fading() * difference;
                    // curvature of steep ramps
                    let allowed = 1e-6 + 1e-4 * (1.0 + fastest * fastest);
                    assert!((row - measured).abs() < allowed, "{model:?} {kind:?}: {row} not {measured}");
                }
            }
        }
    }
    assert!(told > 50 && untold > 50, "{told} {untold}");
}

/// The series solves `du_n/dt = w_{n+1} - w_n`, `dw_n/dt = phi_n(t) u_n - w_n` with slopes that grow, but for the fading.
#[test]
fn the_series_of_a_difference_solves_the_linearised_equations() {
    let model = jam::laws::Model::Logarithmic(jam::laws::Logarithmic { a_v: 0.0, v0: 1.0, epsilon: 0.01 });
    let (pedestrians, order, unit) = (5, 14, 0.5);
    let ring = Ring { pedestrians, length: 8.0 };
    let mut random = Random(7);
    for kind in [StateVariables::Deviations, StateVariables::Spacings] {
        let form = kind.build(&model, ring);
        let dimension = form.dimension();
        let start: Vec<f64> = (0..pedestrians).map(|_| random.uniform(-0.5, 1.5)).collect();
        let growth: Vec<f64> = (0..pedestrians).map(|_| random.uniform(-1.0, 1.0)).collect();
        let mut rows: Vec<f64> = (0..dimension * (order + 1)).map(|_| random.uniform(-1.0, 1.0)).collect();
        form.difference(Tangent { start: &start, growth: &growth }, order, unit, &mut rows);
        let time = 0.4;
        let sum = |i: usize, slope: bool| {
            let terms = (usize::from(slope)..=order).map(|k| {
                let power = (0..k - usize::from(slope)).fold(1.0, |power, _| power * time);
                rows[k * dimension + i] * power * if slope { k as f64 / unit } else { 1.0 }
            });
            terms.sum::<f64>()
        };
        for n in 0..pedestrians {
            let speed = |n: usize| sum(pedestrians + n % pedestrians, false);
            let phi = start[n] + time * growth[n];
            let slope = |i: usize| sum(i, true) + form.fading() * sum(i, false);
            assert!((slope(n) - (speed(n + 1) - speed(n))).abs() < 1e-9, "{kind:?} {n}");
            assert!((slope(pedestrians + n) - (phi * sum(n, false) - speed(n))).abs() < 1e-9, "{kind:?} {n}");
        }
        // the first one's place, by the own speed
        let place = 2 * pedestrians;
        let slope = sum(place, true) + form.fading() * sum(place, false);
        assert!((slope - sum(pedestrians, false)).abs() < 1e-9, "{kind:?}");
    }
}
