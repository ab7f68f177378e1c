//! Case 10: the preset CFM, whose force comes from the smooth ramp alone (`mu = 0`), as its width goes to 0.

use super::Tables;
use super::rows::{Rows, row};
use super::run::{Case, Leg, difference, two_methods};
use figures::failure::Failure;
use jam::laws::Model;
use jam::laws::presets::PRESETS;
use jam::observe::speed_std;
use jam::ring::Ring;
use jam::states::StateVariables;
use jam::uniform::steady_speed;

const END: f64 = 100.0;

/// `gamma = eps ln 2`, the steady speed, the edge of stability, and a run with two methods.
pub fn tables(quick: bool) -> Result<Tables, Failure> {
    let mut rows = Rows::new(&[
        "epsilon",
        "gamma",
        "deficit",
        "deficit_expected",
        "phi",
        "kappa",
        "growth_rate",
        "steps",
        "event",
        "std",
        "mean_speed",
        "uncertainty",
    ]);
    let ring = Ring { pedestrians: 20, length: 60.0 };
    for epsilon in [1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6] {
        let law = PRESETS[0].law(0.0, 0.0, epsilon, 3.0);
        let model = Model::Algebraic(law);
        let speed = steady_speed(&model, ring.headway()).map_err(Failure::work)?;
        let linear = model.linearise(ring.headway(), speed);
        let case = Case { model, ring, kind: StateVariables::Deviations };
        let end = if quick { 10.0 } else { END };
        let [one, two] =
            two_methods(1e-11).map(|(method, control)| case.run(0.5, Leg { method, control, begin: 0.0, end }));
        let event = one.stop.as_ref().map_or("none", |stop| stop.name);
        let mean = one.speeds.iter().sum::<f64>() / one.speeds.len() as f64;
        // v' = v_0 - gamma^2 / d', d' = 1
        rows.push(row![
            epsilon,
            law.gamma(),
            3.0 - speed,
            law.gamma() * law.gamma(),
            linear.phi,
            linear.kappa,
            linear.fastest(ring.pedestrians).0,
            one.steps,
            event,
            speed_std(&one.speeds),
            mean,
            difference(&one.speeds, &two.speeds)
        ]);
    }
    Ok(vec![("cfm", rows)])
}
