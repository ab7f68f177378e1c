//! Case 8: rings of 2 to 1e6 pedestrians: in a short time the size of the ring has no effect far from the shifted
//! pedestrian.

use super::Tables;
use super::rows::{Rows, row};
use super::run::{Case, HardRun, Leg, difference, figure_4, two_methods};
use figures::failure::Failure;
use jam::ring::Ring;
use jam::states::StateVariables;

const HEADWAY: f64 = 3.0;
const END: f64 = 1.0;
/// The shift travels to one more pedestrian behind with every derivative: in this time to these with more than
/// rounding.
const NEAR: usize = 10;

fn run(pedestrians: usize, how: (ode::Method, ode::Control)) -> Result<HardRun, Failure> {
    let model = figure_4(0.55);
    let ring = Ring { pedestrians, length: pedestrians as f64 * HEADWAY };
    let case = Case { model, ring, kind: StateVariables::Deviations };
    case.run(0.1, Leg { method: how.0, control: how.1, begin: 0.0, end: END }).whole()
}

/// The speeds of the shifted pedestrian and those behind it, nearest first.
fn behind(run: &HardRun) -> Vec<f64> {
    let count = run.speeds.len();
    (0..NEAR).map(|k| run.speeds[(count * NEAR - k) % count]).collect()
}

/// Speeds about the shifted pedestrian against those on a ring of 1000, and the sum of the gaps.
pub fn tables(quick: bool) -> Result<Tables, Failure> {
    let mut rows = Rows::new(&["n", "steps", "speed_of_0", "difference_from_1000", "sum_minus_length", "uncertainty"]);
    let [plain, check] = two_methods(1e-13);
    let thousand = behind(&run(1000, plain)?);
    let sizes: &[usize] =
        if quick { &[2, 3, 100, 10_000] } else { &[2, 3, 5, 10, 20, 100, 1000, 10_000, 100_000, 1_000_000] };
    for &count in sizes {
        let one = run(count, plain)?;
        // the check of the largest would take a minute
        let uncertainty = (count <= 10_000).then(|| run(count, check)).transpose()?;
        let uncertainty = uncertainty.map(|two| difference(&one.speeds, &two.speeds));
        let speeds = behind(&one);
        let sum = one.gaps.iter().map(|gap| gap - HEADWAY).sum::<f64>();
        rows.push(row![count, one.steps, speeds[0], difference(&speeds, &thousand), sum, uncertainty]);
    }
    Ok(vec![("sizes", rows)])
}
