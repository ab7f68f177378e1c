//! Margins by two methods; the largest margin over all waves; steady speeds by rows.

use crate::sample::{Random, laws};
use crate::written::law;
use formula::Given;
use jam::laws::Model;
use jam::precise::Precise;
use jam::stability::{Response, Waves};
use jam::uniform::{of_formula, steady_speed};

#[test]
fn margins_by_both_means_differ_by_roundings_and_differ() {
    let mut random = Random(21);
    let (mut compared, mut different) = (0, 0);
    for _ in 0..300 {
        for model in laws(&mut random) {
            let headway = model.contact() + random.uniform(0.5, 3.0);
            let Ok(v) = steady_speed(&model, headway) else { continue };
            let Some(response) = model.response(headway, v) else { continue };
            let margin = response.margin(Waves::All).0;
            let other = Precise::new(&model, headway, v).margin();
            let size = 1.0 + response.spacings.iter().chain(&response.speeds).map(|(_, f)| f * f).sum::<f64>();
            assert!((margin - other).abs() < 1e-12 * size, "{model:?} at {headway}: {margin:?} and {other:?}");
            compared += 1;
            different += usize::from(margin != other);
        }
    }
    assert!(different > compared / 2, "{different} of {compared}: the same numbers twice tell no error");
}

#[test]
fn with_one_predecessor_no_wave_lies_above_the_margin() {
    let mut random = Random(22);
    for _ in 0..2000 {
        let slope = |random: &mut Random| random.uniform(-3.0, 3.0);
        let response = Response {
            spacings: vec![(0, slope(&mut random))],
            speeds: vec![(0, slope(&mut random)), (1, slope(&mut random))],
        };
        let (margin, _) = response.margin(Waves::All);
        for _ in 0..50 {
            let k = random.uniform(1e-3, std::f64::consts::PI);
            let own = response.margin_of(k);
            assert!(own <= margin + 1e-9 * (1.0 + own.abs()), "{response:?}: {own} at {k}, {margin} at most");
        }
    }
}

const SEVERAL: &str = "kappa*(V - v) + c*tanh(20*(v - 1))*tanh(20*(v - 3))*tanh(20*(v - 3.01))";

/// A law whose acceleration in the uniform flow crosses 0 several times, twice within a hundredth.
fn several() -> Model {
    let number = Given::Number;
    law(&[
        ("acceleration", Given::Text(SEVERAL)),
        ("V", Given::Text("v0*tanh(s[1] - body)")),
        ("kappa", number(0.01)),
        ("c", number(1.0)),
        ("v0", number(2.0)),
        ("body", number(0.5)),
    ])
}

#[test]
fn flows_looked_at_together_have_the_bits_of_each_alone() {
    let Model::Formula(formula) = several() else { panic!("a formula") };
    let speeds: Vec<f64> = (0..1300).map(|i| f64::from(i) * 3.7e-3 - 0.2).collect();
    for (speed, found) in speeds.iter().zip(formula.uniform_at(2.0, &speeds)) {
        assert_eq!(found.to_bits(), formula.uniform(2.0, *speed).to_bits(), "{speed}");
    }
}

#[test]
fn steady_speeds_close_to_each_other_are_all_found() {
    let Model::Formula(formula) = several() else { panic!("a formula") };
    let error = of_formula(&formula, 2.0, None).expect_err("several");
    let falls = |v: &f64| formula.uniform(2.0, *v) >= 0.0 && formula.uniform(2.0, v.next_up()) <= 0.0;
    assert!(error.speeds.len() > 1 && error.speeds.iter().all(falls), "{error:?}");
    let nearest = of_formula(&formula, 2.0, Some(3.0)).expect("the nearest");
    assert!(error.speeds.contains(&nearest), "{nearest} of {error:?}");
}
