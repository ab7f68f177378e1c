//! What the numbers of the run of figure 11 mean in metres and seconds, for one choice of the units.

use super::sheet::Sheet;
use super::{Quantities, Source};
use checkout::failure::Failure;

/// The unit of length in metres: half the length that a standing pedestrian takes.
const A_0: f64 = 0.6;
/// The unit of time in seconds: the relaxation time that the source calls typical.
const TAU: f64 = 0.5;
/// The headway of single-file experiments as a line of the speed, `0.36 m + 1.06 s v` (Seyfried et al. 2005).
const LINE: (f64, f64) = (0.36, 1.06);

/// Adds all of it.
///
/// # Errors
/// A table is missing, or lacks a column or a row.
pub fn collect(source: &Source<'_>, all: &mut Quantities) -> Result<(), Failure> {
    let chosen = "chosen: v_0 = v_0' a_0 / tau is then the typical desired speed of the source";
    all.exact("units.a_0", A_0, chosen);
    all.exact("units.tau", TAU, chosen);
    let speed = A_0 / TAU;
    all.rounded("units.v0", speed, 2, chosen);
    all.rounded("units.critical-distance", 2.0 * A_0, 2, chosen);
    let run = Sheet::read(source.paths, "data/s13/shift.csv")?.only(&[("start", "one"), ("shift", "0.1")])?;
    let mut add = |name: &str, value: f64, from: &str| all.rounded(&format!("units.{name}"), value, 2, from);
    add("wave", run.first("jam_speed")? * speed, &run.name);
    add("mean-speed", run.first("mean_speed")? * speed, &run.name);
    add("flow", run.first("flow")? / TAU, &run.name);
    add("slowest", run.first("slowest")? * speed, &run.name);
    let states = Sheet::read(source.paths, "data/s17/states.csv")?;
    let headways = states.numbers("headway")?;
    let mean = A_0 * headways.iter().sum::<f64>() / headways.len() as f64;
    add("headway", mean, &states.name);
    add("density", 1.0 / mean, &states.name);
    let least = A_0 * states.least("headway")?;
    add("least-headway", least, &states.name);
    add("largest-headway", A_0 * states.largest("headway")?, &states.name);
    let line = "0.36 m + 1.06 s v";
    add("experiment.mean-speed", (mean - LINE.0) / LINE.1, line);
    add("experiment.flow", (mean - LINE.0) / LINE.1 / mean, line);
    add("experiment.slowest", (least - LINE.0) / LINE.1, line);
    add("experiment.wave", -LINE.0 / LINE.1, line);
    Ok(())
}
