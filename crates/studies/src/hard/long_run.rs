//! Case 7: long runs: drift of the sum of the spacings and of the mean speed, in every form of the state.

use super::Tables;
use super::fixed_steps::name;
use super::rows::{Rows, row};
use super::run::{Case, HardRun, Leg, two_methods};
use figures::failure::Failure;
use jam::laws::{Algebraic, Logarithmic, Model};
use jam::observe::speed_std;
use jam::ring::Ring;
use jam::states::StateVariables;
use jam::uniform::steady_speed;
use math::double_double::DoubleDouble;
use ode::{Control, Method};

const END: f64 = 1e5;

/// A stable ring, which settles, and one with a jam, which does not.
fn rings() -> [(&'static str, Model, Ring); 2] {
    let stable = Algebraic { mu: 0.45, delta: 0.0, q: 2.0, a_v: 0.0, epsilon: 0.1, v0: 3.0 };
    let jammed = Logarithmic { v0: 1.0, a_v: 0.0, epsilon: 0.01 };
    [
        ("algebraic", Model::Algebraic(stable), Ring { pedestrians: 10, length: 30.0 }),
        ("logarithmic", Model::Logarithmic(jammed), Ring { pedestrians: 10, length: 15.0 }),
    ]
}

/// `expected` is the steady speed where the run is stable, else the mean speed of the run by the other method.
pub fn tables(quick: bool) -> Result<Tables, Failure> {
    let mut rows = Rows::new(&[
        "law",
        "state",
        "method",
        "rule",
        "size",
        "t",
        "steps",
        "sum_minus_length",
        "mean_speed",
        "mean_speed_minus_other",
        "std",
    ]);
    let end = if quick { 1e3 } else { END };
    for (law, model, ring) in rings() {
        for kind in [StateVariables::Deviations, StateVariables::Spacings, StateVariables::Positions] {
            let case = Case { model: model.clone(), ring, kind };
            let run = |(method, control)| case.run(0.1, Leg { method, control, begin: 0.0, end }).whole();
            let [(first, control), (second, _)] = two_methods(1e-9);
            let (one, two) = (run((first, control))?, run((second, control))?);
            let steady = steady_speed(&model, ring.headway()).map_err(Failure::work)?;
            let is_stable = matches!(model, Model::Algebraic(_));
            let heun = run((Method::Heun, Control::Fixed { step: 0.02 }))?;
            for (method, rule, size, run, other) in [
                (first, "tolerance", 1e-9, &one, &two),
                (second, "tolerance", 1e-9, &two, &one),
                (Method::Heun, "dt", 0.02, &heun, &one),
            ] {
                let expected = if is_stable { steady } else { mean(&other.speeds) };
                let (sum, speed) = (drift(run, ring), mean(&run.speeds));
                let std = speed_std(&run.speeds);
                let state = name(kind);
                rows.push(row![
                    law,
                    state,
                    method.name(),
                    rule,
                    size,
                    end,
                    run.steps,
                    sum,
                    speed,
                    speed - expected,
                    std
                ]);
            }
        }
    }
    Ok(vec![("long_run", rows)])
}

/// `sum(s_n) - L`, summed without rounding.
fn drift(run: &HardRun, ring: Ring) -> f64 {
    run.gaps.iter().fold(DoubleDouble::from(-ring.length), |sum, &gap| sum + gap).hi
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}
