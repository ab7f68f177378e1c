//! Case 2: one pedestrian runs into another: the gap shrinks to nearly 0 and opens again, for several exponents of the
//! force.

use super::Tables;
use super::rows::{Rows, row};
use super::run::{Case, Leg, difference, two_methods};
use figures::failure::Failure;
use jam::laws::{Algebraic, Model};
use jam::ring::Ring;
use jam::states::{StateVariables, gaps_state};
use ode::{Control, Method, Problem, Step, integrate};
use std::ops::ControlFlow;

const END: f64 = 1.0;

/// `<0.55, 0, q, 0>` on a ring of two with much room, in gaps.
fn case(q: f64) -> Case {
    let model = Model::Algebraic(Algebraic { mu: 0.55, delta: 0.0, q, a_v: 0.0, epsilon: 0.1, v0: 3.0 });
    Case { model, ring: Ring { pedestrians: 2, length: 100.0 }, kind: StateVariables::Spacings }
}

/// Pedestrian 0 runs with this speed towards 1, which stands, with room 1 between them.
fn start(case: &Case, speed: f64) -> Vec<f64> {
    gaps_state(&case.model, &[3.0, 97.0], &[speed, 0.0], 0.0)
}

/// The smallest room of pedestrian 0 at the ends of the steps.
fn smallest_room(case: &Case, start: &[f64], method: Method, control: Control) -> Result<f64, Failure> {
    let form = case.form();
    let mut least = f64::INFINITY;
    let mut observer = |step: &mut Step<'_>| {
        // the minimum lies inside a step: the interpolant has it, a parabola's worth of points is enough
        let mut state = vec![0.0; form.dimension()];
        for part in 1..=8 {
            step.at_fraction(f64::from(part) / 8.0, &mut state);
            least = math::smaller(least, state[0]);
        }
        ControlFlow::Continue(())
    };
    integrate(&Problem { system: &*form, start, begin: 0.0, end: END, method, control }, &mut observer)
        .map_err(Failure::work)?;
    Ok(least)
}

/// Every method with fixed steps and, if it can, with adaptive ones.
pub fn tables(quick: bool) -> Result<Tables, Failure> {
    let mut rows = Rows::new(&[
        "q",
        "speed",
        "smallest_room",
        "uncertainty",
        "method",
        "rule",
        "size",
        "steps",
        "error",
        "event",
        "t",
        "n",
        "gap",
    ]);
    let powers: &[f64] = if quick { &[2.0] } else { &[1.0, 1.5, 2.0, 3.0] };
    for &q in powers {
        for speed in [2.0, 4.0, 8.0] {
            approach(&mut rows, q, speed)?;
        }
    }
    Ok(vec![("near_contact", rows)])
}

fn approach(rows: &mut Rows, q: f64, speed: f64) -> Result<(), Failure> {
    let case = case(q);
    let start = start(&case, speed);
    let leg = |(method, control)| Leg { method, control, begin: 0.0, end: END };
    let [one, two] = two_methods(1e-14).map(|how| case.run_from(&start, leg(how)).whole());
    let (one, two) = (one?, two?);
    let uncertainty = difference(&one.state, &two.state);
    let room = smallest_room(&case, &start, Method::Extrapolation, Control::Adaptive { tolerance: 1e-13 })?;
    for method in case.methods() {
        let fixed = [1e-2, 1e-3, 1e-4].map(|step| ("dt", step, Control::Fixed { step }));
        let adaptive = [1e-6, 1e-9, 1e-12].map(|tolerance| ("tolerance", tolerance, Control::Adaptive { tolerance }));
        let adaptive = adaptive.into_iter().filter(|_| method.is_adaptive());
        let fixed = fixed.into_iter().filter(|_| !method.needs_series());
        for (rule, size, control) in fixed.chain(adaptive) {
            let run = case.run_from(&start, leg((method, control)));
            let error = run.stop.is_none().then(|| difference(&run.state, &one.state));
            let stop = run.stop.as_ref();
            rows.push(row![
                q,
                speed,
                room,
                uncertainty,
                method.name(),
                rule,
                size,
                run.steps,
                error,
                stop.map_or("none", |stop| stop.name),
                stop.map(|stop| stop.time),
                stop.map(|stop| stop.pedestrian),
                stop.map(|stop| stop.gap)
            ]);
        }
    }
    Ok(())
}
