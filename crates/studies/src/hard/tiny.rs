//! Case 12: perturbations whose square underflows, and no perturbation at all.

use super::Tables;
use super::fixed_steps::name;
use super::rows::{Rows, row};
use super::run::{Case, Leg};
use figures::failure::Failure;
use jam::laws::{Algebraic, Exponential, Logarithmic, Model};
use jam::ring::Ring;
use jam::states::StateVariables;
use ode::Control;

const COUNT: usize = 10;
const END: f64 = 20.0;

fn models() -> [(Model, f64); 3] {
    let (widening, epsilon) = (0.0, 0.1);
    let algebraic = Algebraic { mu: 0.55, delta: 0.0, q: 2.0, a_v: widening, epsilon, v0: 3.0 };
    let exponential = Exponential { a: 3.0, b: 1.5, c: 0.0, a_v: widening, epsilon, v0: 3.0 };
    let logarithmic = Logarithmic { v0: 1.0, a_v: widening, epsilon: 0.01 };
    [
        (Model::Algebraic(algebraic), 30.0),
        (Model::Exponential(exponential), 35.0),
        (Model::Logarithmic(logarithmic), 15.0),
    ]
}

/// The largest difference between two gaps or two speeds, and in the form of deviations the largest deviation in
/// shifts: the same for every shift that is small enough, down to the least double.
pub fn tables(quick: bool) -> Result<Tables, Failure> {
    let mut rows = Rows::new(&["law", "state", "method", "shift", "gap_range", "speed_range", "deviation_per_shift"]);
    for (model, length) in models() {
        for kind in [StateVariables::Deviations, StateVariables::Spacings, StateVariables::Positions] {
            let case = Case { model: model.clone(), ring: Ring { pedestrians: COUNT, length }, kind };
            for method in case.methods() {
                let control = if method.is_adaptive() {
                    Control::Adaptive { tolerance: 1e-12 }
                } else {
                    Control::Fixed { step: 0.01 }
                };
                let shifts: &[f64] = if quick { &[0.0, 1e-300, 1e-160] } else { &[0.0, 5e-324, 1e-300, 1e-160, 1e-9] };
                for &shift in shifts {
                    let leg = Leg { method, control, begin: 0.0, end: END };
                    let run = case.run(shift, leg).whole()?;
                    let largest = run.state[..2 * COUNT].iter().fold(0.0, |most, u| math::larger(most, u.abs()));
                    let scaled = (kind == StateVariables::Deviations && shift > 0.0).then(|| largest / shift);
                    let (state, gaps, speeds) = (name(kind), range(&run.gaps), range(&run.speeds));
                    rows.push(row![model.name(), state, method.name(), shift, gaps, speeds, scaled]);
                }
            }
        }
    }
    Ok(vec![("tiny", rows)])
}

fn range(values: &[f64]) -> f64 {
    let high = values.iter().copied().fold(f64::NEG_INFINITY, math::larger);
    high - values.iter().copied().fold(f64::INFINITY, math::smaller)
}
