//! Case 3: the order of each scheme as the width of the smooth ramp goes to 0 and the right-hand side acquires a kink.

use super::Tables;
use super::rows::{Rows, row};
use super::run::{Case, Leg, difference, two_methods};
use figures::failure::Failure;
use jam::laws::{Logarithmic, Model};
use jam::ring::Ring;
use jam::states::StateVariables;
use ode::{Control, Method};

const END: f64 = 8.0;
const SHIFT: f64 = 0.4;
/// Numbers of steps: 2^LEAST to 2^MOST.
const LEAST: u32 = 6;
const MOST: u32 = 12;

/// Eight pedestrians a little closer than where the logarithmic force begins: the gaps that open cross the kink twice.
fn case(epsilon: f64) -> Case {
    let model = Model::Logarithmic(Logarithmic { v0: 1.0, a_v: 0.0, epsilon });
    Case { model, ring: Ring { pedestrians: 8, length: 15.0 }, kind: StateVariables::Spacings }
}

/// `order` is the slope of the least-squares line through log error against log step, over the steps whose error is
/// well above rounding and below 1e-2.
pub fn tables(quick: bool) -> Result<Tables, Failure> {
    let mut rows = Rows::new(&[
        "epsilon",
        "method",
        "formal_order",
        "order",
        "steps_used",
        "error_coarse",
        "error_fine",
        "uncertainty",
    ]);
    let widths: &[f64] = if quick { &[1e-1, 1e-6] } else { &[1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6] };
    for &epsilon in widths {
        let case = case(epsilon);
        let run = |method, control| case.run(SHIFT, Leg { method, control, begin: 0.0, end: END });
        let [one, two] = two_methods(1e-14).map(|(method, control)| run(method, control).whole());
        let (one, two) = (one?, two?);
        let uncertainty = difference(&one.state, &two.state);
        // a series has no order to observe: steps shorter than its radius are exact
        for method in Method::ALL.into_iter().filter(|method| !method.needs_series()) {
            let errors: Vec<(f64, f64)> = (LEAST..=MOST)
                .map(|power| END / f64::from(1u32 << power))
                .map(|step| (step, difference(&run(method, Control::Fixed { step }).state, &one.state)))
                .collect();
            let floor = 20.0 * math::larger(uncertainty, f64::EPSILON);
            let used: Vec<(f64, f64)> = errors.iter().copied().filter(|&(_, e)| e > floor && e < 1e-2).collect();
            let (coarse, fine) = (errors[0].1, errors[errors.len() - 1].1);
            let order = (used.len() > 1).then(|| slope(&used));
            rows.push(row![epsilon, method.name(), method.order(), order, used.len(), coarse, fine, uncertainty]);
        }
    }
    Ok(vec![("kink_orders", rows)])
}

/// The slope of the least-squares line through the logarithms.
fn slope(points: &[(f64, f64)]) -> f64 {
    let logs: Vec<(f64, f64)> = points.iter().map(|&(x, y)| (math::ln(x), math::ln(y))).collect();
    let count = logs.len() as f64;
    let mean = |pick: fn(&(f64, f64)) -> f64| logs.iter().map(pick).sum::<f64>() / count;
    let (x0, y0) = (mean(|p| p.0), mean(|p| p.1));
    let across: f64 = logs.iter().map(|(x, y)| (x - x0) * (y - y0)).sum();
    across / logs.iter().map(|(x, _)| (x - x0) * (x - x0)).sum::<f64>()
}
