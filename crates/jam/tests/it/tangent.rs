//! The linearised equations of a ring against differences of the equations themselves.

use crate::sample::{Random, laws};
use jam::laws::{Formula, Model};
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

/// Formulas that look at the next pedestrian.
fn formulas() -> Vec<Model> {
    let law = |acceleration: &str| {
        let lines = [("acceleration", acceleration.into()), ("body", 0.5.into())];
        Model::Formula(Formula::written(&lines).expect("a formula"))
    };
    ["2*(tanh(s - 1) - v) + 0.5*(v[1] - v)", "1.5*(tanh(s - body) - v) + 0.3*v*v[1]^2", "tanh(s - 1) - v^2"]
        .map(law)
        .to_vec()
}

#[test]
fn a_small_difference_moves_as_the_tangent_says() {
    let (mut random, mut room) = (Random(31), Vec::new());
    let mut told = 0;
    for _ in 0..40 {
        for model in laws(&mut random).into_iter().chain(formulas()) {
            let ring = Ring { pedestrians: 9, length: 9.0 * (model.contact() + random.uniform(1.0, 3.0)) };
            for kind in [StateVariables::Deviations, StateVariables::Spacings] {
                let form = kind.build(&model, ring);
                let (state, difference) = drawn(&mut random, &*form, ring.pedestrians);
                let mut tangent = vec![0.0; form.tangent_size()];
                let fastest = form.tangent(&state, &mut tangent);
                assert!(fastest >= 0.5, "{model:?}: {fastest}");
                let rates = |factor: f64| {
                    let near: Vec<f64> = state.iter().zip(&difference).map(|(x, d)| x + factor * d).collect();
                    let mut rates = vec![0.0; near.len()];
                    form.rates(&near, &mut rates);
                    rates
                };
                let h = 1e-6;
                let (more, less) = (rates(h), rates(-h));
                // over so short a time that the way is its rate
                let length = 1e-3 / (1.0 + fastest);
                let mut carried = difference.clone();
                let over = Tangent { start: &tangent, end: &[], length, fastest, room: &mut room };
                form.carry(over, &mut carried);
                told += 1;
                for (i, (carried, difference)) in carried.iter().zip(&difference).enumerate() {
                    let measured = (more[i] - less[i]) / (2.0 * h);
                    let told = (carried - difference) / length;
                    // curvature of steep ramps, and the next order
                    let allowed = 1e-2 + 2e-3 * (1.0 + fastest * fastest);
                    assert!((told - measured).abs() < allowed, "{model:?} {kind:?} {i}: {told} not {measured}");
                }
            }
        }
    }
    assert!(told > 200, "{told}");
}

/// The largest absolute eigenvalue of a matrix, from its powers: of `M^k`, entries grow as its `k`-th power.
fn spectral_radius(mut matrix: Vec<Vec<f64>>) -> f64 {
    const SQUARINGS: i32 = 12;
    let (n, mut logarithm, mut power) = (matrix.len(), 0.0, 1.0);
    for _ in 0..SQUARINGS {
        let size = matrix.iter().map(|row| ode::largest(row)).fold(1e-300, math::larger);
        logarithm += math::ln(size) / power;
        power *= 2.0;
        matrix.iter_mut().flatten().for_each(|entry| *entry /= size);
        let entry = |i: usize, j: usize| (0..n).map(|k| matrix[i][k] * matrix[k][j]).sum();
        matrix = (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect();
    }
    math::exp(logarithm)
}

/// The rows of slopes of a law that depends on speeds: by spacings, own speeds and those ahead; and the middle of the
/// eigenvalues.
fn matrix(tangent: &[f64], n: usize) -> Vec<Vec<f64>> {
    let mut matrix = vec![vec![0.0; 2 * n]; 2 * n];
    for i in 0..n {
        let ahead = n + (i + 1) % n;
        matrix[i][n + i] -= 1.0;
        matrix[i][ahead] += 1.0;
        matrix[n + i][i] += tangent[i];
        matrix[n + i][n + i] += tangent[n + i];
        matrix[n + i][ahead] += tangent[2 * n + i];
        matrix[i][i] -= tangent[3 * n];
        matrix[n + i][n + i] -= tangent[3 * n];
    }
    matrix
}

#[test]
fn eigenvalues_are_no_farther_from_their_middle_than_told() {
    let (mut random, mut told, mut nearest) = (Random(5), 0, f64::INFINITY);
    for _ in 0..30 {
        for model in laws(&mut random) {
            let n = 2 + (random.bits() % 7) as usize;
            let ring = Ring { pedestrians: n, length: n as f64 * (model.contact() + random.uniform(0.5, 3.0)) };
            let form = StateVariables::Spacings.build(&model, ring);
            if form.tangent_size() != 3 * n + 1 {
                continue;
            }
            let (state, _) = drawn(&mut random, &*form, n);
            let mut tangent = vec![0.0; form.tangent_size()];
            let fastest = form.tangent(&state, &mut tangent);
            let radius = spectral_radius(matrix(&tangent, n));
            assert!(fastest >= 0.999 * radius, "{model:?}: {fastest} not {radius}");
            (told, nearest) = (told + 1, math::smaller(nearest, fastest / radius));
        }
    }
    assert!(told > 50 && nearest < 1.1, "{told} {nearest}");
}

/// `du_n/dt = w_{n+1} - w_n`, `dw_n/dt = phi_n(t) u_n - a_n(t) w_n + c_n(t) w_{n+1}` with slopes that change linearly,
/// and the way by the first one's speed, by the classical scheme of Runge and Kutta. Slopes by speeds that are not
/// given are those of a relaxation.
fn solved([start, end]: [&[f64]; 2], n: usize, length: f64, difference: &[f64]) -> Vec<f64> {
    const STEPS: usize = 20_000;
    let h = length / STEPS as f64;
    let rates = |state: &[f64], part: f64| {
        let slope = |index: usize, other: f64| {
            let ends = start.get(index).zip(end.get(index));
            ends.map_or(other, |(start, end)| start + part * (end - start))
        };
        let ahead = |i: usize| state[n + (i + 1) % n];
        let closing = (0..n).map(|i| ahead(i) - state[n + i]);
        let pushed = (0..n)
            .map(|i| slope(i, 0.0) * state[i] + slope(n + i, -1.0) * state[n + i] + slope(2 * n + i, 0.0) * ahead(i));
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

/// A difference of this size that is carried over a step, near the right one.
fn carried(
    form: &dyn jam::states::RingSystem,
    over: Tangent<'_>,
    size: f64,
    difference: &[f64],
    right: &[f64],
) -> Vec<f64> {
    let (components, length, largest) = (right.len(), over.length, ode::largest(right));
    let mut carried: Vec<f64> = difference.iter().map(|component| size * component).collect();
    form.carry(over, &mut carried);
    for (carried, right) in carried.iter().zip(right) {
        let apart = (carried / size - right).abs();
        assert!(apart < 0.02 * largest, "{components} components, {length}: {carried} not {size:e} * {right}");
    }
    carried
}

/// Of rings shorter than a vector register, longer, and a multiple of it; over short times and over several pieces;
/// also where slopes do not change; of any size.
#[test]
fn a_difference_is_carried_as_the_linearised_equations_say() {
    let model = Model::Logarithmic(jam::laws::Logarithmic { a_v: 0.0, v0: 1.0, epsilon: 0.01 });
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
            let right = solved([&start, &end], pedestrians, length, &drawn);
            let fastest = 1.1 * (2.0 * math::larger(ode::largest(&start), ode::largest(&end))).sqrt();
            let told = if is_steady { &[][..] } else { &end[..] };
            let over = Tangent { start: &start, end: told, length, fastest, room: &mut room };
            let carried = carried(&*form, over, size, &drawn, &right);
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

/// The same where the force depends on speeds.
#[test]
fn a_difference_is_carried_where_the_force_depends_on_speeds() {
    let model = Model::Logarithmic(jam::laws::Logarithmic { a_v: 0.2, v0: 1.0, epsilon: 0.01 });
    let (mut random, mut room) = (Random(8), Vec::new());
    for (n, length, size) in [
        (2, 1.0, 1.0),
        (5, 0.4, 1.0),
        (7, 4.0, 1e-200),
        (8, 2.0, 1.0),
        (13, 12.0, 1e-12),
        (16, 5.0, 1e90),
        (37, 6.0, 1.0),
    ] {
        let form = StateVariables::Spacings.build(&model, Ring { pedestrians: n, length: 1.6 * n as f64 });
        for is_steady in [true, false] {
            let mut draw = |range: [f64; 2]| (0..n).map(|_| random.uniform(range[0], range[1])).collect::<Vec<f64>>();
            let slopes = |draw: &mut dyn FnMut([f64; 2]) -> Vec<f64>| {
                [draw([-0.2, 1.0]), draw([-3.0, 0.2]), draw([-0.5, 1.0]), vec![-1.5]].concat()
            };
            let start = slopes(&mut draw);
            let end = if is_steady { start.clone() } else { slopes(&mut draw) };
            let drawn: Vec<f64> = (0..form.dimension()).map(|_| random.uniform(-1.0, 1.0)).collect();
            let right = solved([&start, &end], n, length, &drawn);
            let told = if is_steady { &[][..] } else { &end[..] };
            let over = Tangent { start: &start, end: told, length, fastest: 4.5, room: &mut room };
            carried(&*form, over, size, &drawn, &right);
        }
    }
}
