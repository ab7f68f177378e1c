//! Taylor coefficients against the equations themselves.

use crate::sample::{Random, variants};
use jam::laws::{Algebraic, Exponential, Logarithmic, Model};
use jam::ring::{Ring, Start};
use jam::states::{RingSystem, StateVariables};
use jam::uniform::steady_speed;

const ORDER: usize = 18;

fn models() -> Vec<Model> {
    let algebraic = |power: f64| {
        let (strength, relative, widening, epsilon, desired_speed) = (0.5, 0.0, 0.0, 0.1, 3.0);
        Model::Algebraic(Algebraic {
            mu: strength,
            delta: relative,
            q: power,
            a_v: widening,
            epsilon,
            v0: desired_speed,
        })
    };
    let mut models: Vec<Model> = [1.0, 2.0, 3.0, 1.5].map(algebraic).to_vec();
    models.push(Model::Exponential(Exponential { a: 3.0, b: 1.5, c: 0.0, a_v: 0.0, epsilon: 0.1, v0: 3.0 }));
    models.push(Model::Logarithmic(Logarithmic { v0: 1.0, a_v: 0.0, epsilon: 0.05 }));
    models
}

/// Spacings and speeds moved at random by up to `size`; the uniform flow, if there is one in the state, with this
/// speed.
fn state(form: &dyn RingSystem, pedestrians: usize, size: f64, speed: f64, random: &mut Random) -> Vec<f64> {
    let mut state = form.start(Start { shift: 0.0 });
    for component in &mut state[..2 * pedestrians] {
        *component += random.uniform(-size, size);
    }
    if let Some(own) = state.get_mut(2 * pedestrians + 2) {
        *own = speed;
    }
    state
}

/// `c_1 + 2 c_2 t + ...` and `c_0 + c_1 t + ...`
fn derivative_and_value(coefficients: &[f64], dimension: usize, t: f64) -> (Vec<f64>, Vec<f64>) {
    let (mut derivative, mut value) = (vec![0.0; dimension], vec![0.0; dimension]);
    for row in coefficients.rchunks_exact(dimension) {
        for ((derivative, value), coefficient) in derivative.iter_mut().zip(&mut value).zip(row) {
            *derivative = *derivative * t + *value;
            *value = *value * t + coefficient;
        }
    }
    (derivative, value)
}

const HEADWAY: f64 = 3.0;

/// The unit of time of the coefficients.
const UNIT: f64 = 0.75;

/// The largest difference between the derivative of the series and the rates at its value, relative to the size of the
/// perturbation, and the largest for what the form keeps beside gaps and speeds, of order 1. Both the rounding of a few
/// dozen operations and the term of order 18, below 1e-17 of the first at this time, stay far under the bound of the
/// callers.
fn residual(
    model: &Model,
    kind: StateVariables,
    pedestrians: usize,
    (size, speed): (f64, f64),
    random: &mut Random,
) -> (f64, f64) {
    let ring = Ring { pedestrians, length: HEADWAY * pedestrians as f64 };
    let form = kind.build(model, ring);
    let n = form.dimension();
    let mut coefficients = vec![f64::NAN; (ORDER + 1) * n];
    let state = state(&*form, pedestrians, size, speed, random);
    coefficients[..n].copy_from_slice(&state);
    let mut rates = vec![0.0; n];
    form.rates(&state, &mut rates);
    (0..n).for_each(|i| coefficients[n + i] = UNIT * rates[i]);
    assert!(form.has_series());
    form.series(ORDER, UNIT, &mut coefficients);
    let (derivative, value) = derivative_and_value(&coefficients, n, 0.02);
    form.rates(&value, &mut rates);
    let differences: Vec<f64> = derivative.iter().zip(&rates).map(|(a, b)| (a / UNIT - b).abs()).collect();
    let largest = |of: &[f64]| of.iter().fold(0.0, |worst: f64, &next| if next <= worst { worst } else { next });
    let (ring, rest) = differences.split_at(2 * pedestrians);
    (largest(ring) / size, largest(rest))
}

#[test]
fn series_solve_the_equations() {
    let mut random = Random(17);
    for model in models() {
        for pedestrians in [2, 7, 16, 33, 67] {
            for kind in [StateVariables::Deviations, StateVariables::Spacings] {
                let (ring, rest) = residual(&model, kind, pedestrians, (0.3, 0.0), &mut random);
                assert!(ring < 1e-13 && rest < 1e-14, "{} {kind:?} {pedestrians}: {ring:e}, {rest:e}", model.name());
            }
        }
    }
}

#[test]
fn series_of_deviations_keep_the_digits_of_a_small_perturbation() {
    let mut random = Random(18);
    for model in models() {
        let (ring, _) = residual(&model, StateVariables::Deviations, 33, (1e-100, 0.0), &mut random);
        assert!(ring < 1e-13, "{}: {ring:e}", model.name());
    }
}

#[test]
fn series_of_deviations_keep_them_where_the_force_depends_on_speeds() {
    let mut random = Random(20);
    for model in variants(&mut random) {
        for pedestrians in [2, 16, 33] {
            for size in [0.01, 1e-12, 1e-100] {
                // at rest, and the steady flow, whose series is constant
                for speed in [0.0, steady_speed(&model, HEADWAY).expect("one")] {
                    let of = (size, speed);
                    let (ring, rest) = residual(&model, StateVariables::Deviations, pedestrians, of, &mut random);
                    assert!(ring < 1e-13 && rest < 1e-14, "{model:?} {pedestrians} {of:?}: {ring:e}, {rest:e}");
                }
            }
        }
    }
}

#[test]
fn deviations_and_spacings_have_a_series() {
    for model in variants(&mut Random(19)) {
        for kind in [StateVariables::Deviations, StateVariables::Spacings, StateVariables::Positions] {
            let form = kind.build(&model, Ring { pedestrians: 5, length: 22.5 });
            assert_eq!(form.has_series(), kind != StateVariables::Positions, "{model:?} {kind:?}");
        }
    }
}
