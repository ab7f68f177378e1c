//! The growth of one wave, measured.

use super::run::{Case, Leg};
use figures::failure::Failure;
use jam::uniform::steady_speed;
use jam::waves;
use ode::{Control, Method};

/// The growth rate of the wave `k` of the steady flow: the logarithm of its size after `time` over that before, by
/// time. The case must be in deviations. `amplitude` is that of the places at the start; products of waves are as much
/// smaller than it as it is smaller than 1, and make other waves than this one, but for `k = 2 pi / 3`, whose square is
/// that wave again.
///
/// # Errors
/// There is no steady flow, or the run ended before its time.
pub fn growth_rate(
    case: &Case,
    (k, amplitude): (f64, f64),
    time: f64,
    (method, control): (Method, Control),
) -> Result<f64, Failure> {
    let (count, headway) = (case.ring.pedestrians, case.ring.headway());
    let speed = steady_speed(&case.model, headway).map_err(Failure::work)?;
    let z = case.model.linearise(headway, speed).root(k);
    let start = waves::start(count, speed, z, k, amplitude);
    let end = case.run_from(&start, Leg { method, control, begin: 0.0, end: time }).whole()?;
    let size = |state: &[f64]| {
        let (re, im) = waves::coefficient(&state[count..2 * count], k);
        (re * re + im * im).sqrt()
    };
    // ln_1p keeps the digits of a ratio near 1
    Ok(math::ln_1p(size(&end.state) / size(&start) - 1.0) / time)
}
