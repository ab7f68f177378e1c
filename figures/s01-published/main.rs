//! Supplement 1: published minus regenerated values of figures 12 (t = 300) and 13, with reading errors.

use figures::panels::points;
use figures::titles::number;
use figures::{Failure, Job, figure};
use files::table::Table;
use plot::style::COLUMN_WIDTH;
use plot::{Axis, Lines, Marker, Picture, Series};
use std::process::ExitCode;

fn main() -> ExitCode {
    figure(env!("CARGO_BIN_NAME"), tables, picture)
}

/// Errors of reading the published figures (data/reference/README.md): of speeds, and the largest of deviations.
const READING: (f64, f64) = (3e-5, 2e-3);

/// The time of figure 12, left.
const TIME: f64 = 300.0;

fn tables(job: &mut Job) -> Result<(), Failure> {
    let run = job.run_table("main", "trajectories")?;
    let speeds: Vec<f64> = run.rows().filter(|row| (row[0] - TIME).abs() < 1e-9).map(|row| row[3]).collect();
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
    let speeds = panel(job, "speeds", Axis::linear("pedestrian $n$", 0.0, 140.0), ("n", READING.0))?;
    let deviations = panel(job, "deviations", Axis::linear("$t$", 0.0, 3000.0), ("t", READING.1))?;
    Ok(Picture::new(COLUMN_WIDTH, 90.0)
        .columns(1)
        .titled(&format!("speeds at $t = {}$", number(TIME)), speeds)
        .titled("std of speeds", deviations))
}

/// Differences against the column `x`; dashed lines at the error of reading.
fn panel(job: &Job, table: &str, axis: Axis, (x, reading): (&str, f64)) -> Result<Lines, Failure> {
    let differences = points(&job.read(table)?, x, "difference")?;
    let seen = differences.iter().map(|point| point.1).chain([reading, -reading]);
    Ok(Lines::new(axis.steps(4), Axis::roomy("difference", seen).steps(6))
        .horizontal(reading)
        .horizontal(-reading)
        .series(Series::points("", Marker::Circle, differences).look(0)))
}
