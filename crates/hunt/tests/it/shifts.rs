//! Small shifts under laws with every term: the usual run against the reference to 106 bits.

use jam::laws::{Algebraic, Exponential, Logarithmic, Model};
use jam::ring::{Ring, Start};
use jam::run::{Run, run};
use jam::states::StateVariables;
use math::double_double::DoubleDouble;
use ode::{Control, Method};
use reference::flow::Form;
use reference::formula::Formula;
use reference::solution::{End, Question, solve};
use reference::solver::Care;

/// Laws whose force depends on speeds, with the same laws for the reference.
fn laws() -> [(Model, Formula); 4] {
    let (relative, both) = ((0.4, 0.0), (0.4, 0.1));
    let algebraic = |(delta, a_v): (f64, f64)| {
        let (mu, q, epsilon, v0) = (0.5, 2.0, 0.1, 1.5);
        let law = Algebraic { mu, delta, q, a_v, epsilon, v0 };
        (Model::Algebraic(law), Formula::Algebraic { mu, delta, q, a_v, epsilon, v0 })
    };
    let (a, b, c, a_v, epsilon, v0) = (1.5, 1.2, 0.4, 0.1, 0.1, 1.5);
    let exponential = Exponential { a, b, c, a_v, epsilon, v0 };
    let logarithmic = Logarithmic { v0: 1.0, a_v: 0.1, epsilon: 0.05 };
    [
        algebraic(relative),
        algebraic(both),
        (Model::Exponential(exponential), Formula::Exponential { a, b, c, a_v, epsilon, v0 }),
        (Model::Logarithmic(logarithmic), Formula::Logarithmic { a_v: 0.1, epsilon: 0.05, v0: 1.0 }),
    ]
}

#[test]
fn a_small_shift_keeps_its_digits_whatever_terms_the_law_has() {
    let times: Vec<f64> = (1..=12).map(f64::from).collect();
    for (model, formula) in laws() {
        // near enough for the force to be felt
        let headway = if matches!(model, Model::Logarithmic(_)) { 2.25 } else { 3.5 };
        let ring = Ring { pedestrians: 12, length: 12.0 * headway };
        for shift in [1e-4, 1e-12, 1e-100] {
            let mut own = Run::new(model.clone(), ring, Start { shift }, 12.0).expect("a valid run");
            assert_eq!((own.method, own.form), (Method::Taylor, StateVariables::Deviations), "{model:?}");
            own.control = Control::Adaptive { tolerance: 1e-14 };
            let outcome = run(&own).expect("it ends");

            let (pedestrians, length) = (ring.pedestrians, ring.length);
            let (formula, times, displacements) = (formula.clone(), times.clone(), Vec::new());
            let question = Question { formula, pedestrians, length, shift, displacements, times };
            let care = Care { nodes: 16, tolerance: 1e-20, most_work: 10_000_000 };
            let right = solve::<DoubleDouble>(&question, Form::Differences, care, 1e6);
            assert_eq!(right.end, End::Reached, "{model:?}");
            for sample in &right.samples {
                let index = outcome.samples.times.iter().position(|time| *time == sample.time).expect("a sample");
                let error = outcome.samples.std[index] / sample.std - 1.0;
                assert!(error.abs() < 1e-12, "{model:?}, shift {shift:e}, t = {}: {error:e}", sample.time);
            }
        }
    }
}
