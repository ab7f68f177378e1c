//! An irregular wave train of the algebraic law with widening: what of it is certain. Its trajectories are not, beyond some
//! time: two methods part. Its statistics are, as far as methods and starts agree about them.

mod lyapunov;
mod observed;

use crate::hard::rows::{Rows, row};
use crate::hard::run::{Case, Leg, two_methods};
use figures::failure::Failure;
use jam::laws::{Algebraic, Model};
use jam::ring::Ring;
use jam::states::StateVariables;
use observed::{Window, parting, path, windows};
use ode::{Control, Method};

/// `<0.45, 0, 2, 0.3>` at `v0' = 3` on the ring of figure 4.
fn case() -> Case {
    let law = Algebraic { strength: 0.45, relative: 0.0, power: 2.0, widening: 0.3, epsilon: 0.1, desired_speed: 3.0 };
    let ring = Ring { pedestrians: 67, length: LENGTH };
    Case { model: Model::Algebraic(law), ring, kind: StateVariables::Spacings }
}

/// The length of the ring, in units of `a_0`.
pub const LENGTH: f64 = 200.0;
/// Shifts of the starts: that of the source, and larger ones.
const SHIFTS: [f64; 3] = [1e-4, 1e-2, 0.3];
/// The waves have their final form long before this time, in units of `tau`.
const BEGIN: f64 = 2000.0;
/// Statistics are taken over so many windows of this length.
const WINDOWS: usize = 10;
const WINDOW: f64 = 1000.0;
/// The tolerance of the runs for statistics, and of those that are compared moment by moment.
const TOLERANCE: f64 = 1e-8;
const FINE: f64 = 1e-12;
/// Trajectories are compared up to this time.
const COMPARED: f64 = 1500.0;
/// What the shift of a second start has more.
const NUDGE: f64 = 1e-10;
/// The paths of all are kept from here to there: the two methods agree about them.
pub const SHOWN: [f64; 2] = [400.0, 450.0];

/// The tables: statistics window by window (`windows`) and of whole runs (`runs`), how far runs come apart (`parting`), and
/// paths while they do not (`paths`).
///
/// # Errors
/// A run ended before its time.
pub fn tables() -> Result<[(&'static str, Rows); 4], Failure> {
    let case = case();
    let mut of_windows = Rows::new(&["method", "shift", "t", "std", "least_gap", "least_speed", "largest_speed"]);
    let mut of_runs = Rows::new(&[
        "method",
        "shift",
        "std",
        "std_error",
        "least_gap",
        "least_speed",
        "largest_speed",
        "exponent",
        "exponent_error",
    ]);
    for (method, control) in two_methods(TOLERANCE) {
        for shift in SHIFTS {
            let settled = case.run(shift, Leg { method, control, begin: 0.0, end: BEGIN }).whole()?.state;
            let found = windows(&case, &settled, (method, control), BEGIN, (WINDOWS, WINDOW))?;
            for Window { begin, std, least_gap, least_speed, largest_speed } in &found {
                of_windows.push(row![method.name(), shift, *begin, *std, *least_gap, *least_speed, *largest_speed]);
            }
            let least = |of: fn(&Window) -> f64| found.iter().map(of).fold(f64::INFINITY, math::smaller);
            let largest = found.iter().map(|window| window.largest_speed).fold(f64::NEG_INFINITY, math::larger);
            let (std, std_error) = mean(&found.iter().map(|window| window.std).collect::<Vec<f64>>());
            let (exponent, exponent_error) = mean(&lyapunov::exponents(&case, &settled, (method, control))?);
            of_runs.push(row![
                method.name(),
                shift,
                std,
                std_error,
                least(|window| window.least_gap),
                least(|window| window.least_speed),
                largest,
                exponent,
                exponent_error
            ]);
        }
    }
    let fine = two_methods(FINE);
    let mut apart = Rows::new(&["t", "methods", "starts"]);
    let pairs = [[(fine[0], SHIFTS[0]), (fine[1], SHIFTS[0])], [(fine[0], SHIFTS[0]), (fine[0], SHIFTS[0] + NUDGE)]];
    let [methods, starts] = pairs.map(|pair| parting(&case, pair, COMPARED));
    for ((t, methods), (_, starts)) in methods?.into_iter().zip(starts?) {
        apart.push(row![t, methods, starts]);
    }
    let paths = path(&case, SHIFTS[0], fine[0], SHOWN)?;
    Ok([("windows", of_windows), ("runs", of_runs), ("parting", apart), ("paths", paths)])
}

/// A method with the rule for its steps.
type Scheme = (Method, Control);

/// The mean of values that are independent, with its standard error.
fn mean(values: &[f64]) -> (f64, f64) {
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    let squares = values.iter().map(|value| (value - mean) * (value - mean)).sum::<f64>();
    (mean, (squares / (count - 1.0) / count).sqrt())
}
