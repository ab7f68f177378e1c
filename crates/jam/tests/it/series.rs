//! Taylor coefficients against the equations themselves.

use crate::sample::Random;
use jam::laws::{Algebraic, Exponential, Logarithmic, Model};
use jam::ring::{Ring, Start};
use jam::states::{Form, FormKind};

const ORDER: usize = 18;

fn models() -> Vec<Model> {
    let algebraic = |power: f64| {
        let (strength, relative, widening, epsilon, desired_speed) = (0.5, 0.0, 0.0, 0.1, 3.0);
        Model::Algebraic(Algebraic { strength, relative, power, widening, epsilon, desired_speed })
    };
    let mut models: Vec<Model> = [1.0, 2.0, 3.0, 1.5].map(algebraic).to_vec();
    models.push(Model::Exponential(Exponential {
        strength: 3.0,
        range: 1.5,
        contact: 0.0,
        widening: 0.0,
        epsilon: 0.1,
        desired_speed: 3.0,
    }));
    models.push(Model::Logarithmic(Logarithmic { desired_speed: 1.0, widening: 0.0, epsilon: 0.05 }));
    models
}

/// Gaps and speeds moved at random by up to `size`; the uniform flow at rest.
fn state(form: &dyn Form, pedestrians: usize, size: f64, random: &mut Random) -> Vec<f64> {
    let mut state = form.start(Start { shift: 0.0 });
    for component in &mut state[..2 * pedestrians] {
        *component += random.uniform(-size, size);
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

/// The largest difference between the derivative of the series and the rates at its value, relative to the size of the
/// perturbation. Both the rounding of a few dozen operations and the term of order 18, below 1e-17 of the first at this
/// time, stay far under the bound of the callers.
fn residual(model: &Model, kind: FormKind, pedestrians: usize, size: f64, random: &mut Random) -> f64 {
    let ring = Ring { pedestrians, length: 3.0 * pedestrians as f64 };
    let form = kind.build(model, ring);
    let n = form.dimension();
    let mut coefficients = vec![f64::NAN; (ORDER + 1) * n];
    let state = state(&*form, pedestrians, size, random);
    coefficients[..n].copy_from_slice(&state);
    let mut rates = vec![0.0; n];
    form.rates(&state, &mut rates);
    coefficients[n..2 * n].copy_from_slice(&rates);
    assert!(form.has_series());
    form.series(ORDER, 1.0, &mut coefficients);
    let (derivative, value) = derivative_and_value(&coefficients, n, 0.02);
    form.rates(&value, &mut rates);
    let differences = derivative.iter().zip(&rates).map(|(a, b)| (a - b).abs());
    differences.take(2 * pedestrians).fold(0.0, |worst: f64, next| if next > worst { next } else { worst }) / size
}

#[test]
fn series_solve_the_equations() {
    let mut random = Random(17);
    for model in models() {
        for pedestrians in [2, 7, 16, 33, 67] {
            for kind in [FormKind::Deviations, FormKind::Gaps] {
                let residual = residual(&model, kind, pedestrians, 0.3, &mut random);
                assert!(residual < 1e-13, "{} {kind:?} {pedestrians}: {residual:e}", model.name());
            }
        }
    }
}

#[test]
fn series_of_deviations_keep_the_digits_of_a_small_perturbation() {
    let mut random = Random(18);
    for model in models() {
        let residual = residual(&model, FormKind::Deviations, 33, 1e-100, &mut random);
        assert!(residual < 1e-13, "{}: {residual:e}", model.name());
    }
}

#[test]
fn a_force_that_depends_on_speeds_has_no_series() {
    let widening = Model::Logarithmic(Logarithmic { desired_speed: 1.0, widening: 0.1, epsilon: 0.05 });
    let form = FormKind::Deviations.build(&widening, Ring { pedestrians: 5, length: 15.0 });
    assert!(!form.has_series());
}
