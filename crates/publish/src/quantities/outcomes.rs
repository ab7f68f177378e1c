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
    let window = Sheet::read(source.paths, "data/s19/window.csv")?;
    all.rounded("waves.least-speed", window.least("v")?, 3, &window.name);
    all.rounded("waves.largest-speed", window.largest("v")?, 3, &window.name);
    let std = Sheet::read(source.paths, "data/s19/std.csv")?;
    let last = std.numbers("std")?.last().copied().unwrap_or(f64::NAN);
    all.rounded("waves.std", last, 6, &std.name);
    Ok(())
}
