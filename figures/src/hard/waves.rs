//! The growth of one wave, measured.

use super::run::{Case, Leg};
use crate::failure::Failure;
use jam::uniform::steady_speed;
use jam::waves;
use ode::{Control, Method};

/// So small that quadratic terms, which feed other waves than this one, and cubic ones (1e-16) do not count.
const AMPLITUDE: f64 = 1e-8;

/// The growth rate of the wave `k` of the steady flow: the logarithm of its size after `time` over that before, by time.
/// The case must be in deviations.
///
/// # Errors
/// There is no steady flow, or the run ended before its time.
pub fn growth_rate(case: &Case, k: f64, time: f64, (method, control): (Method, Control)) -> Result<f64, Failure> {
    let (count, headway) = (case.ring.pedestrians, case.ring.headway());
    let speed = steady_speed(&case.model, headway).map_err(Failure::work)?;
    let z = case.model.linearise(headway, speed).root(k);
    let start = waves::start(count, speed, z, k, AMPLITUDE);
    let end = case.run_from(&start, Leg { method, control, begin: 0.0, end: time }).whole()?;
    let size = |state: &[f64]| {
        let (re, im) = waves::coefficient(&state[count..2 * count], k);
        (re * re + im * im).sqrt()
    };
    // ln_1p keeps the digits of a ratio near 1
    Ok(math::ln_1p(size(&end.state) / size(&start) - 1.0) / time)
}
