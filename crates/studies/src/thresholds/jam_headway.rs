//! The least headway in jams of the logarithmic law, and the desired speed from which on pedestrians touch, at several
//! densities: whether either depends on the density.

use super::contact::bracket;
use crate::hard::rows::{Rows, row};
use crate::parameters::jammed::Run;
use figures::failure::Failure;
use jam::run::{AtOverlap, RunObserver, Sample, run_from};
use ode::{Control, Method};

/// The headways of the rings, all of 133 pedestrians.
const HEADWAYS: [f64; 4] = [1.4, 1.5, 1.6, 1.7];
/// Desired speeds below that of the first contacts.
const SPEEDS: [f64; 5] = [1.15, 1.2, 1.23, 1.24, 1.25];
/// The time between samples. Between two of them a headway is a cubic, which is exact to about 1e-6 in these runs.
const SAMPLE: f64 = 0.1;
/// From when on the least headway is looked for: the shifted pedestrian starts too near to the one ahead.
const STARTED: f64 = 100.0;

/// The run of figures 11 to 13 at another headway.
fn at(headway: f64, desired_speed: f64) -> Run {
    let main = Run::default();
    // to the digit the ring of the figures
    let length = if headway == 1.5 { main.length } else { headway * main.pedestrians as f64 };
    Run { length, desired_speed, ..main }
}

/// Between which desired speeds contacts begin, by headway, as in [`super::contact::collision`].
///
/// # Errors
/// A run failed.
pub fn collision_by_headway() -> Result<Rows, Failure> {
    let mut rows = Rows::new(&["headway", "t_end", "none_at", "contact_at", "value", "error", "agree"]);
    for headway in HEADWAYS {
        let found = bracket(|v0| at(headway, v0), (1.2, 1.3), 0.001)?;
        let (value, error) = (found.middle(), found.half());
        let end = Run::default().end;
        rows.push(row![headway, end, found.none_at, found.contact_at, value, error, usize::from(found.agree)]);
    }
    Ok(rows)
}

/// The least headway between t = 100 and the end of the run; `zero_at` is the desired speed at which it would vanish by
/// linear extrapolation from the row before and this one.
///
/// # Errors
/// A run failed.
pub fn jam_headway() -> Result<Rows, Failure> {
    let mut rows = Rows::new(&["headway", "v0", "least_headway", "least_headway_error", "zero_at"]);
    for headway in HEADWAYS {
        let mut before = None;
        for v0 in SPEEDS {
            let run = at(headway, v0);
            let [one, two] = [Method::Taylor, Method::Dop853].map(|method| least(&run, method));
            let (one, two) = (one?, two?);
            let zero = before.map(|(v, least): (f64, f64)| v0 + one * (v0 - v) / (least - one));
            rows.push(row![headway, v0, one, (one - two).abs(), zero]);
            before = Some((v0, one));
        }
    }
    Ok(rows)
}

/// The least headway.
fn least(run: &Run, method: Method) -> Result<f64, Failure> {
    let control = Control::Adaptive { tolerance: 1e-10 };
    let run = jam::run::Run { sample: SAMPLE, at_overlap: AtOverlap::Continue, ..run.made_by(method, control)? };
    let mut looking = Looking { before: None, least: f64::INFINITY };
    run_from(&run, None, &mut looking).map_err(Failure::work)?;
    Ok(looking.least)
}

/// Time, headways and their rates at a sample.
type Sampled = (f64, Vec<f64>, Vec<f64>);

struct Looking {
    before: Option<Sampled>,
    least: f64,
}

impl RunObserver for Looking {
    fn sampled(&mut self, sample: &Sample<'_>) {
        let (time, headways, speeds) = (sample.time, sample.spacings.to_vec(), sample.speeds);
        let count = headways.len();
        let rates: Vec<f64> = (0..count).map(|n| speeds[(n + 1) % count] - speeds[n]).collect();
        if let Some((then, old, falling)) = self.before.as_ref().filter(|_| time > STARTED) {
            for n in (0..count).filter(|&n| falling[n] < 0.0 && rates[n] > 0.0) {
                let lowest = lowest_of_cubic(time - then, [old[n], headways[n]], [falling[n], rates[n]]);
                self.least = math::smaller(self.least, lowest);
            }
        }
        self.before = Some((time, headways, rates));
    }
}

/// The minimum of the cubic with these values and slopes at both ends of an interval, the first slope negative and the
/// second positive.
fn lowest_of_cubic(length: f64, [from, to]: [f64; 2], slopes: [f64; 2]) -> f64 {
    let [begin, end] = slopes.map(|slope| slope * length);
    // from + begin s + b s^2 + a s^3, whose slope changes its sign once on the interval
    let (a, b) = (begin + end - 2.0 * (to - from), 3.0 * (to - from) - 2.0 * begin - end);
    let root = (b * b - 3.0 * a * begin).sqrt();
    // the form without cancellation
    let share = -begin / (b + root);
    from + share * (begin + share * (b + share * a))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_minimum_of_a_cubic_is_found() {
        // (s - 0.3)^2 (s + 2) + 1 over [0, 1] of length 4: a minimum of 1 at 0.3
        let value = |s: f64| (s - 0.3) * (s - 0.3) * (s + 2.0) + 1.0;
        let slope = |s: f64| (2.0 * (s - 0.3) * (s + 2.0) + (s - 0.3) * (s - 0.3)) / 4.0;
        let lowest = lowest_of_cubic(4.0, [value(0.0), value(1.0)], [slope(0.0), slope(1.0)]);
        assert!((lowest - 1.0).abs() < 1e-14, "{lowest}");
        // a parabola, without a cubic term
        let lowest = lowest_of_cubic(2.0, [1.0, 1.0], [-1.0, 1.0]);
        assert!((lowest - 0.5).abs() < 1e-15, "{lowest}");
    }
}
