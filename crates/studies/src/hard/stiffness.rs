//! Case 5: the logarithmic law with desired speeds from 0.1 to 100: stiffness, and collisions from inertia.

use super::Tables;
use super::rows::{Rows, row};
use super::run::{Case, HardRun, Leg, difference, two_methods};
use figures::failure::Failure;
use jam::laws::{Logarithmic, Model};
use jam::ring::Ring;
use jam::states::StateVariables;
use jam::uniform::steady_speed;
use ode::{Control, Method};

const SHIFT: f64 = 0.1;
const END: f64 = 40.0;
/// The error of the speeds, in desired speeds, that the longest step may make.
const ALLOWED: f64 = 1e-2;

fn case(v0: f64) -> Case {
    let model = Model::Logarithmic(Logarithmic { v0, a_v: 0.0, epsilon: 0.01 });
    Case { model, ring: Ring { pedestrians: 20, length: 30.0 }, kind: StateVariables::Deviations }
}

/// Overlap times by two methods; steps and evaluations of every method, and the longest step that is still right.
pub fn tables(quick: bool) -> Result<Tables, Failure> {
    let mut collisions = Rows::new(&["v0", "phi", "growth_rate", "overlap_t", "n", "other_method_t", "uncertainty"]);
    let mut steps = Rows::new(&["v0", "until", "method", "steps_1e_6", "evaluations_1e_6", "longest_step", "error"]);
    let speeds: &[f64] = if quick { &[1.0, 10.0] } else { &[0.1, 0.3, 1.0, 2.0, 3.0, 5.0, 10.0, 30.0, 100.0] };
    for &v0 in speeds {
        let case = case(v0);
        let speed = steady_speed(&case.model, case.ring.headway()).map_err(Failure::work)?;
        let linear = case.model.linearise(case.ring.headway(), speed);
        let run = |(method, control)| case.run(SHIFT, Leg { method, control, begin: 0.0, end: END });
        let [one, two] = two_methods(1e-13).map(run);
        let (a, b) = (overlap(&one), overlap(&two));
        let growth = linear.fastest(case.ring.pedestrians).0;
        let off = a.zip(b).map(|(a, b)| (a - b).abs());
        let n = one.stop.as_ref().map(|stop| stop.pedestrian);
        collisions.push(row![v0, linear.phi, growth, a, n, b, off]);
        // before the overlap, so that every method has the same way to go
        let until = a.map_or(10.0, |time| math::smaller(10.0, 0.9 * time));
        for method in Method::ALL.into_iter().filter(|method| !method.needs_series()) {
            steps.push(effort(&case, v0, method, until)?);
        }
    }
    Ok(vec![("stiffness", collisions), ("stiffness_steps", steps)])
}

fn overlap(run: &HardRun) -> Option<f64> {
    run.stop.as_ref().filter(|stop| stop.name == "overlap").map(|stop| stop.time)
}

fn effort(case: &Case, v0: f64, method: Method, until: f64) -> Result<Vec<super::rows::CellValue>, Failure> {
    let run = |method, control| case.run(SHIFT, Leg { method, control, begin: 0.0, end: until });
    let exact = run(Method::Dop853, Control::Adaptive { tolerance: 1e-13 }).whole()?;
    let adaptive = method.is_adaptive().then(|| run(method, Control::Adaptive { tolerance: 1e-6 }));
    let mut longest = None;
    let mut step = 0.5 * until;
    while longest.is_none() && step > 1e-5 * until {
        let tried = run(method, Control::Fixed { step });
        let error = difference(&tried.speeds, &exact.speeds) / v0;
        if tried.stop.is_none() && error < ALLOWED {
            longest = Some((step, error));
        }
        step *= 0.5;
    }
    Ok(row![
        v0,
        until,
        method.name(),
        adaptive.as_ref().map(|run| run.steps),
        adaptive.as_ref().map(|run| run.evaluations),
        longest.map(|longest| longest.0),
        longest.map(|longest| longest.1)
    ])
}
