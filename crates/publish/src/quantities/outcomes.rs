//! What became of the runs of planes, and the waves of the algebraic law.

use super::sheet::Sheet;
use super::{Quantities, Source};
use checkout::failure::Failure;

/// Adds all of it: of each plane the part of its unstable cells that has an outcome, in percent, and how many of its cells were
/// run; where waves lie; how sure that is; how waves of the algebraic law begin.
///
/// # Errors
/// A table is missing, or lacks a column or a row.
pub fn collect(source: &Source<'_>, all: &mut Quantities) -> Result<(), Failure> {
    for (figure, planes) in PLANES {
        let shares = Sheet::read(source.paths, &format!("data/{figure}/shares.csv"))?;
        for plane in planes {
            for outcome in ["contact", "blow_up", "waves", "waves_backwards", "decays", "undecided"] {
                let rows = shares.only(&[("plane", plane), ("flow", "unstable"), ("outcome", outcome)]);
                let share = rows.and_then(|rows| rows.first("share")).unwrap_or(0.0);
                let name = format!("outcomes.{plane}.{}", outcome.replace('_', "-"));
                all.rounded(&name, 100.0 * share, 2, &shares.name);
            }
            let cells = Sheet::read(source.paths, &format!("data/{figure}/{plane}.csv"))?;
            let decided = cells.words("decided_by")?;
            let filled = decided.iter().filter(|by| *by == "neighbours").count();
            all.exact(&format!("outcomes.{plane}.run"), (decided.len() - filled) as f64, &cells.name);
            all.rounded(
                &format!("outcomes.{plane}.filled"),
                100.0 * filled as f64 / decided.len() as f64,
                2,
                &cells.name,
            );
        }
    }
    how_sure(source, all)?;
    bands(source, all)?;
    begin(source, all)?;
    waves(source, all)?;
    irregular(source, all)
}

/// The planes of each supplement.
const PLANES: [(&str, &[&str]); 4] = [
    ("s18", &["logarithmic", "exponential", "relative", "plain"]),
    ("s21", &["logarithmic_shift", "logarithmic_headway", "logarithmic_wide", "relative_widened"]),
    (
        "s22",
        &[
            "exponential_far",
            "exponential_middle",
            "exponential_near",
            "exponential_widened_far",
            "exponential_widened_middle",
            "exponential_widened_near",
        ],
    ),
    ("s25", &["widened"]),
];

/// Of the samples of the planes of supplement 18: how many filled cells were run, and how many of all samples have another
/// outcome, decided both times.
fn how_sure(source: &Source<'_>, all: &mut Quantities) -> Result<(), Failure> {
    let table = Sheet::read(source.paths, "data/s18/how_sure.csv")?;
    let name = &table.name;
    let sum = |rows: &Sheet, column: &str| Ok::<f64, Failure>(rows.numbers(column)?.iter().sum());
    let filled = table.only(&[("change", "filled_cells_run")])?;
    all.exact("how-sure.filled", sum(&filled, "cells")?, name);
    all.exact("how-sure.filled.differ", sum(&filled, "differ")?, name);
    for plane in PLANES[0].1 {
        let rows = table.only(&[("plane", plane), ("change", "tolerance_1e-8")])?;
        all.exact(&format!("how-sure.{plane}.cells"), rows.first("cells")?, name);
        for (change, short) in [("tolerance_1e-8", "tolerance"), ("t_end_12000", "time"), ("dop853", "method")] {
            let rows = table.only(&[("plane", plane), ("change", change)])?;
            all.exact(&format!("how-sure.{plane}.{short}"), rows.first("differ")?, name);
        }
        all.exact(
            &format!("how-sure.{plane}.decided"),
            sum(&table.only(&[("plane", plane)])?, "decided_differ")?,
            name,
        );
    }
    Ok(())
}

/// The band of waves of the logarithmic law.
fn bands(source: &Source<'_>, all: &mut Quantities) -> Result<(), Failure> {
    let band = Sheet::read(source.paths, "data/s18/bands.csv")?;
    let (widenings, widths) = (band.numbers("value")?, band.numbers("width")?);
    let widest = widenings.iter().zip(&widths).filter(|(_, width)| **width > 0.0).map(|(a_v, _)| *a_v);
    let largest = widest.fold(0.0, |largest, a_v| if a_v > largest { a_v } else { largest });
    all.rounded("band.largest-widening", largest, 2, &band.name);
    // the first column with a widening of at least so much
    for (label, from) in [("0", 0.0), ("0-1", 0.1), ("0-2", 0.2)] {
        let row = widenings.iter().position(|a_v| *a_v >= from).unwrap_or(0);
        all.uncertain(&format!("band.widening-{label}"), widths[row], band.numbers("error")?[row], &band.name);
    }
    let further = Sheet::read(source.paths, "data/s21/bands.csv")?;
    let band = further.only(&[("plane", "logarithmic_headway")])?;
    let (headways, widths) = (band.numbers("value")?, band.numbers("width")?);
    for (label, from) in [("1-2", 1.2), ("1-5", 1.5), ("1-9", 1.9)] {
        let row = headways.iter().position(|headway| *headway >= from).unwrap_or(0);
        all.uncertain(&format!("band.headway-{label}"), widths[row], band.numbers("error")?[row], &band.name);
    }
    all.rounded("band.headway.last", band.largest("last")?, 3, &band.name);
    let shifts = further.only(&[("plane", "logarithmic_shift")])?;
    all.rounded("band.shift.narrowest", shifts.least("width")?, 2, &shifts.name);
    all.rounded("band.shift.widest", shifts.largest("width")?, 2, &shifts.name);
    let places = headways.iter().zip(&widths).filter(|(_, width)| **width > 0.0).map(|(headway, _)| *headway);
    let places: Vec<f64> = places.collect();
    all.rounded("band.headway.from", places.first().copied().unwrap_or(f64::NAN), 2, &band.name);
    all.rounded("band.headway.to", places.last().copied().unwrap_or(f64::NAN), 3, &band.name);
    Ok(())
}

/// How waves of the algebraic law begin.
fn begin(source: &Source<'_>, all: &mut Quantities) -> Result<(), Failure> {
    let turns = Sheet::read(source.paths, "data/s24/turns.csv")?;
    all.rounded("turns.infinite", turns.first("infinite")?, 5, &turns.name);
    for count in ["67", "134", "268"] {
        let row = turns.only(&[("pedestrians", count)])?;
        all.rounded(&format!("turns.{count}.threshold"), row.first("threshold")?, 5, &turns.name);
        all.rounded(&format!("turns.{count}.onset"), row.first("onset")?, 2, &turns.name);
        for column in ["highest", "lowest"] {
            if let Ok(value) = row.first(column) {
                all.rounded(&format!("turns.{count}.{column}"), value, 4, &turns.name);
            }
        }
    }
    let runs = Sheet::read(source.paths, "data/s24/runs.csv")?.only(&[("pedestrians", "268")])?;
    all.rounded("turns.268.run.mu", runs.first("mu")?, 5, &runs.name);
    all.rounded("turns.268.run.before", runs.first("std_start")?, 3, &runs.name);
    all.rounded("turns.268.run.after", runs.first("std")?, 3, &runs.name);
    let presets = Sheet::read(source.paths, "data/s24/presets.csv")?;
    for preset in ["HFV", "SEY", "GUO"] {
        let row = presets.only(&[("preset", preset)])?;
        all.rounded(&format!("presets.{preset}.mu"), row.first("mu")?, 3, &presets.name);
    }
    Ok(())
}

/// The waves of supplement 19.
fn waves(source: &Source<'_>, all: &mut Quantities) -> Result<(), Failure> {
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
    // with a desired speed larger by as much as the slowest is slow, nobody in the plane walks backwards
    let plane = Sheet::read(source.paths, "data/s18/relative.csv")?;
    let backwards = plane.only(&[("outcome", "waves_backwards")])?;
    all.rounded("waves.slowest-of-plane", backwards.least("least_speed")?, 2, &plane.name);
    for what in ["method", "shift"] {
        all.rounded(&format!("waves.{what}.std-differs"), spread(what, "std")?, 1, name);
        all.rounded(&format!("waves.{what}.speed-differs"), spread(what, "wave_speed")?, 1, name);
    }
    for count in ["134", "268"] {
        let row = run("pedestrians", count)?;
        all.rounded(&format!("waves.{count}.speed"), row.first("wave_speed")?, 3, name);
        all.rounded(&format!("waves.{count}.slowest"), row.first("least_speed")?, 2, name);
    }
    for mu in ["0.36", "0.4"] {
        let row = run("mu_narrow", mu)?;
        all.rounded(&format!("waves.narrow-{}.std", mu.replace('.', "-")), row.first("std")?, 2, name);
    }
    for mu in ["0.28", "0.3", "0.34", "0.36"] {
        let row = run("mu", mu)?;
        let of = format!("waves.mu-{}", mu.replace('.', "-"));
        all.rounded(&format!("{of}.std"), row.first("std")?, 2, name);
        all.rounded(&format!("{of}.slowest"), row.first("least_speed")?, 2, name);
    }
    Ok(())
}

/// The irregular waves of supplement 26, and the regular ones that they become.
fn irregular(source: &Source<'_>, all: &mut Quantities) -> Result<(), Failure> {
    let runs = Sheet::read(source.paths, "data/s26/runs.csv")?;
    let name = &runs.name;
    let [first, error] = ["irregular_std", "irregular_std_error"].map(|column| runs.first(column));
    all.uncertain("irregular.std", first?, error?, name);
    all.uncertain("irregular.exponent", runs.first("exponent")?, runs.first("exponent_error")?, name);
    all.rounded("irregular.slowest", runs.least("irregular_least_speed")?, 1, name);
    all.exact("irregular.until.first", runs.least("irregular_until")?, name);
    all.exact("irregular.until.last", runs.largest("irregular_until")?, name);
    // all runs end in one and the same train: how far they are from it shows in how far they are from each other
    for (label, column) in
        [("std", "std"), ("gap", "least_gap"), ("slowest", "least_speed"), ("fastest", "largest_speed")]
    {
        let [least, largest] = [runs.least(column)?, runs.largest(column)?];
        all.uncertain(&format!("regular.{label}"), 0.5 * (least + largest), largest - least, name);
    }
    all.exact("regular.waves", runs.first("waves")?, name);
    let steepest = runs.numbers("late_exponent")?.into_iter().map(f64::abs).fold(0.0, |a, b| if b > a { b } else { a });
    all.rounded("regular.exponent", steepest, 1, name);
    let parting = Sheet::read(source.paths, "data/s26/parting.csv")?;
    let (times, apart) = (parting.numbers("t")?, parting.numbers("methods")?);
    let together = times.iter().zip(&apart).take_while(|(_, apart)| **apart < TOGETHER).map(|(t, _)| *t).last();
    all.exact("irregular.together", together.unwrap_or(0.0), &parting.name);
    Ok(())
}

/// Runs are together as long as no speed differs by as much.
const TOGETHER: f64 = 1e-3;
