//! Distances between the regenerated and the published curves, and the reading errors of the latter.

use super::{Quantities, Source, largest, table};
use checkout::failure::Failure;
use checkout::paths::Paths;
use files::table::Table;
use verify::published::CURVES;

/// Adds number of points, largest and root-mean-square distance, and the reading errors that `data/reference` states.
///
/// # Errors
/// A table is missing or lacks a column; a reading error is not stated.
pub fn collect(source: &Source<'_>, all: &mut Quantities) -> Result<(), Failure> {
    for curve in CURVES {
        let ours = Paths::table(curve.table);
        let from = format!("{ours} against {}", curve.source());
        let [usual, largest_reading] = curve.reading_errors(source.paths)?;
        let start = format!("published.{}", curve.name);
        all.exact(&format!("{start}.reading"), largest_reading, "data/reference/README.md");
        all.exact(&format!("{start}.reading-median"), usual, "data/reference/README.md");
        let made: Table = table(source.paths, &ours)?;
        let points = curve.beside(source.paths, &made)?;
        let [keys, values] = curve.columns.map(|column| made.column(column).unwrap_or_default());
        all.exact(&format!("{start}.points"), points.x.len() as f64, &from);
        all.rounded(&format!("{start}.largest"), points.largest(), 2, &from);
        all.rounded(&format!("{start}.percent"), 100.0 * points.largest() / largest(&values), 1, &from);
        all.rounded(&format!("{start}.rms"), points.root_mean_square(), 2, &from);
        // a curve is read the worse the steeper it is: from the usual error on, in proportion to the slope, to the
        // largest
        let slopes: Vec<f64> = points.x.iter().map(|&place| slope(&keys, &values, place)).collect();
        let steepest = largest(&slopes);
        let reading = slopes.iter().map(|slope| {
            let steep = largest_reading * slope / steepest;
            if steep > usual { steep } else { usual }
        });
        let distances = points.differences().into_iter().map(f64::abs);
        let shares: Vec<f64> = distances.zip(reading).map(|(distance, reading)| distance / reading).collect();
        let outside = shares.iter().filter(|share| **share > 1.0).count();
        all.exact(&format!("{start}.outside"), outside as f64, &from);
        all.rounded(&format!("{start}.outside-times"), largest(&shares), 2, &from);
    }
    Ok(())
}

/// The slope of a curve at one of its points, as a magnitude: over five points to either side, as far as there are any.
fn slope(keys: &[f64], values: &[f64], place: f64) -> f64 {
    const SIDE: usize = 5;
    let Some(at) = keys.iter().position(|&key| key == place) else { return 0.0 };
    let (from, to) = (at.saturating_sub(SIDE), (at + SIDE).min(keys.len() - 1));
    ((values[to] - values[from]) / (keys[to] - keys[from])).abs()
}
