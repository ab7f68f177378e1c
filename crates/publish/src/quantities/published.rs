//! Distances between the regenerated and the published curves, and the reading errors of the latter.

use super::{Quantities, Source, largest, numbers, table};
use checkout::disk;
use checkout::failure::Failure;

/// What is compared: short name, published points, their column, our table and column, and the key that both share.
const PAIRS: [(&str, &str, &str, &str, &str); 2] = [
    ("speeds", "published_speed_t300", "data/fig12/t300.csv", "v", "n"),
    ("deviations", "published_std_log", "data/fig13/std.csv", "std", "t"),
];

/// Adds number of points, largest and root-mean-square distance, and the reading errors that `data/reference` states.
///
/// # Errors
/// A table is missing or lacks a column; a reading error is not stated.
pub fn collect(source: &Source<'_>, all: &mut Quantities) -> Result<(), Failure> {
    for (short, points, ours, column, key) in PAIRS {
        let (usual, largest_reading) = reading_errors(source, all, short, points)?;
        let published = table(source.paths, &format!("data/reference/{points}.csv"))?;
        let made = table(source.paths, ours)?;
        let (keys, values) = (numbers(&made, key)?, numbers(&made, column)?);
        let read = numbers(&published, key)?.into_iter().zip(numbers(&published, column)?);
        // read off a drawing, so keys are whole numbers only nearly
        let at = |wanted: f64| keys.iter().position(|&key| key == wanted.round()).map(|place| values[place]);
        let (places, distances): (Vec<f64>, Vec<f64>) =
            read.filter_map(|(key, value)| Some((key.round(), (at(key)? - value).abs()))).unzip();
        let from = format!("{ours} against data/reference/{points}.csv");
        let squares: f64 = distances.iter().map(|distance| distance * distance).sum();
        all.exact(&format!("published.{short}.points"), distances.len() as f64, &from);
        let furthest = largest(&distances);
        all.rounded(&format!("published.{short}.largest"), furthest, 2, &from);
        all.rounded(&format!("published.{short}.percent"), 100.0 * furthest / largest(&values), 1, &from);
        all.rounded(&format!("published.{short}.rms"), (squares / distances.len() as f64).sqrt(), 2, &from);
        // a curve is read the worse the steeper it is: from the usual error on, in proportion to the slope, to the largest
        let slopes: Vec<f64> = places.iter().map(|&place| slope(&keys, &values, place)).collect();
        let steepest = largest(&slopes);
        let reading = slopes.iter().map(|slope| {
            let steep = largest_reading * slope / steepest;
            if steep > usual { steep } else { usual }
        });
        let shares: Vec<f64> = distances.iter().zip(reading).map(|(distance, reading)| distance / reading).collect();
        let outside = shares.iter().filter(|share| **share > 1.0).count();
        all.exact(&format!("published.{short}.outside"), outside as f64, &from);
        all.rounded(&format!("published.{short}.outside-times"), largest(&shares), 2, &from);
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

/// The usual and the largest reading error, from the last column of the table in `data/reference/README.md`: `3e-5`, or
/// `median 4e-4, largest 2e-3 (...)`.
fn reading_errors(source: &Source<'_>, all: &mut Quantities, short: &str, points: &str) -> Result<(f64, f64), Failure> {
    let name = "data/reference/README.md";
    let text = disk::read_text(&source.paths.root.join(name))?.unwrap_or_default();
    let row = text.lines().find(|line| line.starts_with(&format!("| {points}.csv")));
    let cell = row.and_then(|row| row.trim_end_matches([' ', '|']).rsplit('|').next()).unwrap_or("");
    let numbers: Vec<f64> = cell.split([' ', ',']).filter_map(|word| word.parse().ok()).collect();
    let missing = || Failure::Usage(format!("{name}: no reading error of {points}"));
    let (first, last) = (numbers.first().ok_or_else(missing)?, numbers.last().ok_or_else(missing)?);
    all.exact(&format!("published.{short}.reading"), *last, name);
    all.exact(&format!("published.{short}.reading-median"), *first, name);
    Ok((*first, *last))
}
