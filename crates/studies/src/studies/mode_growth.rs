//! Growth rates of all waves, each measured in a run, against `Re z^+` of the linear theory.

use super::{Extent, figure_4_stable};
use crate::hard::Tables;
use crate::hard::rows::{Rows, row};
use crate::hard::run::{Case, figure_4};
use crate::hard::waves::growth_rate;
use figures::failure::Failure;
use jam::laws::{Exponential, Logarithmic, Model};
use jam::ring::Ring;
use jam::states::StateVariables;
use jam::uniform::steady_speed;
use ode::{Control, Method};
use std::f64::consts::PI;
use std::path::Path;

/// Local errors relative to the wave.
const TOLERANCE: f64 = 1e-14;
/// So small that even its square (1e-13 of it) does not count: the wave `k = 2 pi / 3` feeds itself through its square.
const AMPLITUDE: f64 = 1e-13;
/// A wave is followed until it has grown or decayed by about e^4, if that takes no longer than this.
const LONGEST: f64 = 200.0;

/// A law with a value below the edge of stability and one above.
type Pair = (&'static str, [Model; 2], Ring);

fn laws() -> [Pair; 3] {
    let exponential =
        |strength| Model::Exponential(Exponential { a: strength, b: 1.5, c: 0.0, a_v: 0.0, epsilon: 0.1, v0: 3.0 });
    let logarithmic = |desired_speed| Model::Logarithmic(Logarithmic { v0: desired_speed, a_v: 0.0, epsilon: 0.01 });
    let ring = |pedestrians| Ring { pedestrians, length: figure_4_stable().1.length };
    [
        ("mode_growth_algebraic", [0.45, 0.55].map(figure_4), ring(67)),
        ("mode_growth_exponential", [1.5, 3.0].map(exponential), ring(57)),
        // the scene of figures 11 to 13, and a desired speed at which it is stable
        ("mode_growth_logarithmic", [0.5, 1.0].map(logarithmic), ring(133)),
    ]
}

/// For each law every wave of the ring, stable and unstable: measured rate, `Re z^+`, and what is left.
pub fn tables(extent: Extent, _solutions: &Path) -> Result<Tables, Failure> {
    laws().into_iter().map(|(name, models, ring)| Ok((name, table(extent, models, ring)?))).collect()
}

fn table(extent: Extent, models: [Model; 2], ring: Ring) -> Result<Rows, Failure> {
    let mut rows = Rows::new(&["flow", "l", "k", "time", "measured", "exact", "residual"]);
    let count = ring.pedestrians;
    for (flow, model) in ["stable", "unstable"].into_iter().zip(models) {
        let speed = steady_speed(&model, ring.headway()).map_err(Failure::work)?;
        let linear = model.linearise(ring.headway(), speed);
        let case = Case { model, ring, kind: StateVariables::Deviations };
        for l in (1..=count / 2).filter(|l| extent != Extent::Quick || l % 8 == 1) {
            let k = 2.0 * PI * l as f64 / count as f64;
            let exact = linear.refined_growth_rate(k);
            let time = if exact.abs() > 4.0 / LONGEST { 4.0 / exact.abs() } else { LONGEST };
            let control = Control::Adaptive { tolerance: TOLERANCE };
            let measured = growth_rate(&case, (k, AMPLITUDE), time, (Method::Dop853, control))?;
            rows.push(row![flow, l, k, time, measured, exact, measured - exact]);
        }
    }
    Ok(rows)
}
