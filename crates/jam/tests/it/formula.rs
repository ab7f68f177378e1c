//! One suite for every law and every way to evaluate it. Built-in laws give the same bits compiled and as formulas;
//! differences, coefficients and derivatives are those of the formula.

use crate::sample::{Random, variants};
use crate::written::{as_formula, law};
use formula::Given;
use jam::force::{Flow, Motion};

fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|value| value.to_bits()).collect()
}

/// Net gaps that are open for every law, and speeds.
fn ring(count: usize, random: &mut Random) -> (Vec<f64>, Vec<f64>) {
    let net_gaps = (0..count).map(|_| random.uniform(1.5, 3.0)).collect();
    let speeds = (0..count).map(|_| random.uniform(0.0, 1.0)).collect();
    (net_gaps, speeds)
}

#[test]
fn accelerations_of_formulas_have_the_bits_of_compiled_laws() {
    let mut random = Random(40);
    for count in [2, 3, 7, 8, 9, 16, 17, 133, 255, 256, 257, 600] {
        for model in variants(&mut random) {
            let (net_gaps, speeds) = ring(count, &mut random);
            let mut rates = [vec![0.0; count], vec![0.0; count]];
            model.force().accelerations(&net_gaps, &speeds, &mut rates[0]);
            as_formula(&model).force().accelerations(&net_gaps, &speeds, &mut rates[1]);
            assert_eq!(bits(&rates[0]), bits(&rates[1]), "{model:?}, {count}");
        }
    }
}

#[test]
fn deviations_of_formulas_have_the_bits_of_compiled_laws() {
    let mut random = Random(41);
    for count in [2, 9, 133, 300] {
        for size in [1e-200, 1e-6, 0.1] {
            for model in variants(&mut random) {
                let flow = Flow { net_gap: random.uniform(1.5, 3.0), speed: random.uniform(0.0, 1.0) };
                let row = |random: &mut Random| (0..count).map(|_| random.uniform(-size, size)).collect::<Vec<_>>();
                let (spacings, speeds) = (row(&mut random), row(&mut random));
                let mut rates = [vec![0.0; count], vec![0.0; count]];
                let compiled = model.force().deviations(flow, &spacings, &speeds, &mut rates[0]);
                let other = as_formula(&model).force().deviations(flow, &spacings, &speeds, &mut rates[1]);
                assert_eq!(compiled.to_bits(), other.to_bits(), "{model:?}");
                assert_eq!(bits(&rates[0]), bits(&rates[1]), "{model:?}, {count}, {size}");
            }
        }
    }
}

#[test]
fn series_of_formulas_have_the_bits_of_compiled_laws() {
    const ORDER: usize = 18;
    let mut random = Random(42);
    for count in [2, 5, 16, 17, 67] {
        for model in variants(&mut random) {
            let (net_gaps, speeds) = ring(count, &mut random);
            let dimension = 2 * count + 1;
            let mut rows = vec![0.0; (ORDER + 1) * dimension];
            rows[..count].copy_from_slice(&net_gaps);
            rows[count..2 * count].copy_from_slice(&speeds);
            let mut rates = vec![0.0; count];
            model.force().accelerations(&net_gaps, &speeds, &mut rates);
            for n in 0..count {
                rows[dimension + n] = 0.25 * (speeds[(n + 1) % count] - speeds[n]);
                rows[dimension + count + n] = 0.25 * rates[n];
            }
            let mut both = [rows.clone(), rows];
            for (coefficients, model) in both.iter_mut().zip([model.clone(), as_formula(&model)]) {
                let flow = Flow { net_gap: 0.0, speed: 0.0 };
                let (pedestrians, order, unit) = (count, ORDER, 0.25);
                model.force().series(Motion { flow, along: None, pedestrians, order, unit, dimension, coefficients });
            }
            assert_eq!(bits(&both[0]), bits(&both[1]), "{model:?}, {count}");
            assert!(both[0].iter().all(|value| value.is_finite()), "{model:?}");
        }
    }
}

#[test]
fn the_response_of_a_formula_is_that_of_the_compiled_law() {
    let mut random = Random(43);
    for model in (0..50).flat_map(|_| variants(&mut random)).collect::<Vec<_>>() {
        let (headway, speed) = (model.contact() + random.uniform(1.5, 3.0), random.uniform(0.0, 1.0));
        let linear = model.linearise(headway, speed);
        for other in [&model, &as_formula(&model)] {
            let Some(response) = other.response(headway, speed) else { panic!("{other:?}") };
            let slope =
                |list: &[(i32, f64)], j: i32| list.iter().filter(|(own, _)| *own == j).map(|(_, f)| f).sum::<f64>();
            let expected = [linear.phi, -1.0 - linear.kappa - linear.beta, linear.kappa - linear.beta];
            let found = [slope(&response.spacings, 0), slope(&response.speeds, 0), slope(&response.speeds, 1)];
            for (expected, found) in expected.iter().zip(found) {
                assert!((expected - found).abs() < 1e-13 * (1.0 + expected.abs()), "{other:?}: {expected} {found}");
            }
        }
    }
}

#[test]
fn a_uniform_flow_relaxes_as_the_speeds_of_its_formula_say() {
    let force = Given::Text("(1 + tanh(s - 2))");
    // with speeds of others; as quotients and with a factor; the relaxation itself alone
    for (acceleration, expected) in [
        ("0.7*(V - v)", -0.7),
        ("0.7*(V - v) + 0.3*(v[1] - v)", -0.7),
        ("0.7*(V - v) - 0.25*v[1] + v[-1]/8", -0.825),
        ("V - (v + v[1])/4", -0.5),
    ] {
        let law = law(&[
            ("acceleration", Given::Text(acceleration)),
            ("V", force),
            ("scale", Given::Number(1.0)),
            ("body", Given::Number(0.0)),
        ]);
        let built = law.force();
        assert!(!built.uses_speeds(), "{acceleration}: speeds enter linearly");
        let rate = |speed: f64| {
            let mut rates = [0.0; 4];
            built.deviations(Flow { net_gap: 2.5, speed }, &[0.0; 4], &[0.0; 4], &mut rates)
        };
        for speed in [0.0, 0.4] {
            let relaxation = built.relaxation(Flow { net_gap: 2.5, speed });
            assert!((relaxation - expected).abs() < 1e-14, "{acceleration}: {relaxation}, right {expected}");
            // the same from the acceleration of the flow at two speeds
            let slope = (rate(speed + 0.5) - rate(speed)) / 0.5;
            assert!((slope - expected).abs() < 1e-14, "{acceleration}: {slope}, right {expected}");
        }
    }
}
