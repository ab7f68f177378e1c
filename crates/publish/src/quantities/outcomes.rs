//! What became of the runs of planes, and the waves of the algebraic law.

use super::sheet::Sheet;
use super::{Quantities, Source};
use checkout::failure::Failure;

/// Adds all of it: of each plane the part of its unstable cells that has an outcome, in percent.
///
/// # Errors
/// A table is missing, or lacks a column or a row.
pub fn collect(source: &Source<'_>, all: &mut Quantities) -> Result<(), Failure> {
    let shares = Sheet::read(source.paths, "data/s18/shares.csv")?;
    for plane in ["logarithmic", "exponential", "relative", "plain"] {
        for outcome in ["contact", "blow_up", "waves", "waves_backwards", "decays", "undecided"] {
            let rows = shares.only(&[("plane", plane), ("flow", "unstable"), ("outcome", outcome)]);
            let share = rows.and_then(|rows| rows.first("share")).unwrap_or(0.0);
            let name = format!("outcomes.{plane}.{}", outcome.replace('_', "-"));
            all.rounded(&name, 100.0 * share, 2, &shares.name);
        }
    }
    let varied = Sheet::read(source.paths, "data/s19/varied.csv")?;
    let name = &varied.name;
    let run = |what: &str, value: &str| varied.only(&[("varied", what), ("value", value)]);
    let base = run("shift", "0.1")?;
    all.rounded("waves.std", base.first("std")?, 4, name);
    all.rounded("waves.speed", base.first("wave_speed")?, 4, name);
    all.rounded("waves.slowest", base.first("least_speed")?, 3, name);
    let spread = |what: &str, column: &str| -> Result<f64, Failure> {
        let rows = varied.only(&[("varied", what)])?;
        Ok(rows.largest(column)? - rows.least(column)?)
    };
    for what in ["method", "shift"] {
        all.rounded(&format!("waves.{what}.std-differs"), spread(what, "std")?, 1, name);
        all.rounded(&format!("waves.{what}.speed-differs"), spread(what, "wave_speed")?, 1, name);
    }
    for count in ["134", "268"] {
        let row = run("pedestrians", count)?;
        all.rounded(&format!("waves.{count}.speed"), row.first("wave_speed")?, 3, name);
        all.rounded(&format!("waves.{count}.slowest"), row.first("least_speed")?, 2, name);
    }
    for mu in ["0.28", "0.3", "0.34", "0.36"] {
        let row = run("mu", mu)?;
        let of = format!("waves.mu-{}", mu.replace('.', "-"));
        all.rounded(&format!("{of}.std"), row.first("std")?, 2, name);
        all.rounded(&format!("{of}.slowest"), row.first("least_speed")?, 2, name);
    }
    Ok(())
}
