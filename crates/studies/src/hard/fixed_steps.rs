//! Case 1, continued: what fixed steps report near the blow-up, and when they report an overlap.

use super::Tables;
use super::blow_up::{NEAR, SHIFT, case, near};
use super::rows::{Rows, row};
use super::run::{Case, Leg, two_methods};
use figures::failure::Failure;
use jam::states::StateVariables;
use ode::{Control, Method};

/// The time of the blow-up on which the two methods of `blow_up_time.csv` agree to 2e-10.
const T_STAR: f64 = 960.872_846_9;

/// The steps tried from t = 0, and from [`NEAR`], where the state is that of the exact solution.
const STEPS: [f64; 6] = [1e-1, 5e-2, 2e-2, 1e-2, 5e-3, 2e-3];
const STEPS_NEAR: [f64; 9] = [1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5];

/// Every method with every step, from both starts.
pub fn tables(quick: bool) -> Result<Tables, Failure> {
    let mut rows = Rows::new(&["method", "state", "from", "dt", "event", "t", "n", "gap", "early", "negative_speed_t"]);
    let [(method, control), _] = two_methods(1e-13);
    let start = near(method, control)?;
    let (few, few_near) = if quick { (2, 4) } else { (STEPS.len(), STEPS_NEAR.len()) };
    // a series knows no wall: steps of fixed length far beyond its radius mean nothing
    for method in Method::ALL.into_iter().filter(|method| !method.needs_series()) {
        for &step in &STEPS[..if method.order() > 4 { 2 } else { few }] {
            for kind in [StateVariables::Deviations, StateVariables::Positions] {
                let case = case(kind);
                push(&mut rows, case.clone(), &case.form().start(jam::ring::Start { shift: SHIFT }), method, step, 0.0);
            }
        }
        for &step in &STEPS_NEAR[..few_near] {
            push(&mut rows, case(StateVariables::Spacings), &start, method, step, NEAR);
        }
    }
    Ok(vec![("blow_up_fixed_steps", rows)])
}

fn push(rows: &mut Rows, case: Case, start: &[f64], method: Method, step: f64, begin: f64) {
    let run = case.run_from(start, Leg { method, control: Control::Fixed { step }, begin, end: 1000.0 });
    let negative = run.events.iter().find(|happening| happening.kind == jam::events::EventKind::NegativeSpeed);
    let (form, negative) = (name(case.kind), negative.map(|happening| happening.time));
    match run.stop {
        Some(stop) => rows.push(row![
            method.name(),
            form,
            begin,
            step,
            stop.name,
            stop.time,
            stop.pedestrian,
            stop.gap,
            T_STAR - stop.time,
            negative
        ]),
        None => {
            let nothing = None::<f64>;
            rows.push(row![method.name(), form, begin, step, "none", nothing, nothing, nothing, nothing, negative]);
        }
    }
}

/// The name of a form in scene files.
pub fn name(kind: StateVariables) -> &'static str {
    match kind {
        StateVariables::Deviations => "deviations",
        StateVariables::Spacings => "gaps",
        StateVariables::Positions => "positions",
    }
}
