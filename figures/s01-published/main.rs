//! Supplement 1: published minus regenerated numbers of figures 12 (t = 300) and 13, with the errors of reading.

use figures::panels::points;
use figures::{Failure, Job, figure};
use files::table::Table;
use plot::style::COLUMN_WIDTH;
use plot::{Axis, Legend, Lines, Marker, Picture, Series};
use std::process::ExitCode;

fn main() -> ExitCode {
    figure(env!("CARGO_BIN_NAME"), tables, picture)
}

/// Errors of reading the published figures (data/reference/README.md): of speeds, and the largest of deviations.
const READING: (f64, f64) = (3e-5, 2e-3);

fn tables(job: &mut Job) -> Result<(), Failure> {
    let run = job.run_table("main", "trajectories")?;
    let speeds: Vec<f64> = run.rows().filter(|row| row[0] == 300.0).map(|row| row[3]).collect();
    let mut table = Table::new(&["n", "published", "v", "difference"]);
    for (n, published) in points(&job.reference("published_speed_t300")?, "n", "v")? {
        // numbers of pedestrians were read off an axis: whole up to their reading error
        let v = speeds[(n.round() as usize).min(speeds.len() - 1)];
        table.push(&[n.round(), published, v, published - v]);
    }
    job.write("speeds", &table)?;
    let deviations = job.run_table("main", "std")?.column("std")?;
    let mut table = Table::new(&["t", "published", "std", "difference"]);
    for (t, published) in points(&job.reference("published_std_log")?, "t", "std")? {
        let std = deviations[(t.round() as usize).min(deviations.len() - 1)];
        table.push(&[t, published, std, published - std]);
    }
    job.write("deviations", &table)
}

fn picture(job: &Job) -> Result<Picture, Failure> {
    let speeds = panel(job, "speeds", Axis::linear("pedestrian $n$", 0.0, 140.0), ("n", 1e-5, READING.0, 4.0))?;
    let deviations = panel(job, "deviations", Axis::linear("$t$", 0.0, 3000.0), ("t", 1e-3, READING.1, 3.0))?;
    Ok(Picture::new(COLUMN_WIDTH, 90.0)
        .columns(1)
        .titled("speeds at $t = 300$", speeds)
        .titled("std of speeds", deviations))
}

/// Differences in units of `unit`, up to `top` of them, against the column `x`; dashed lines at the error of reading.
fn panel(job: &Job, table: &str, axis: Axis, (x, unit, reading, top): (&str, f64, f64, f64)) -> Result<Lines, Failure> {
    let scaled = points(&job.read(table)?, x, "difference")?.into_iter().map(|(x, d)| (x, d / unit)).collect();
    let label = if unit == 1e-5 { "difference $/ 10^{-5}$" } else { "difference $/ 10^{-3}$" };
    Ok(Lines::new(axis.steps(4), Axis::linear(label, -top, top).steps(6))
        .legend(Legend::Hidden)
        .horizontal(reading / unit)
        .horizontal(-reading / unit)
        .series(Series::points("", Marker::Circle, scaled).look(0)))
}
