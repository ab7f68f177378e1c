//! Supplement 24: the onset of the waves of supplement 19: the standard deviation of the speeds of travelling waves
//! against the strength of the force, on rings of 67, 134 and 268 pedestrians (a), and close to the threshold of the
//! ring (b).

use figures::{Failure, Job, figure};
use plot::style::COLUMN_WIDTH;
use plot::{Axis, Corner, Lines, Marker, Picture, Series};
use std::process::ExitCode;

fn main() -> ExitCode {
    figure(env!("CARGO_BIN_NAME"), tables, picture)
}

fn tables(job: &mut Job) -> Result<(), Failure> {
    studies::travelling::tables()?.iter().try_for_each(|(name, rows)| job.write_rows(name, rows))
}

/// The rings, as words of the tables.
const RINGS: [f64; 3] = [67.0, 134.0, 268.0];

fn picture(job: &Job) -> Result<Picture, Failure> {
    Ok(Picture::new(COLUMN_WIDTH, 110.0)
        .columns(1)
        .row_shares(&[1.2, 1.0])
        .titled("waves along their branch", strength(job)?)
        .titled("near the threshold of each ring", onset(job)?))
}

/// Points of a table of one ring.
fn points(job: &Job, table: &str, pedestrians: f64, x: &str, y: &str) -> Result<Vec<(f64, f64)>, Failure> {
    let rows = job.read_rows(table)?.select(&[], &["pedestrians", x, y])?;
    Ok(rows.rows().filter(|row| row[0] == pedestrians).map(|row| (row[1], row[2])).collect())
}

fn strength(job: &Job) -> Result<Lines, Failure> {
    let axes = (Axis::linear("$\\mu$", 0.270, 0.280).steps(5), Axis::linear("std of speeds", 0.0, 0.15).steps(3));
    let infinite = job.read_rows("turns")?.select(&[], &["infinite"])?;
    let mut panel = Lines::new(axes.0, axes.1).vertical(infinite.row(0)[0]).legend(Corner::TopLeft);
    for (look, ring) in RINGS.into_iter().enumerate() {
        let branch = points(job, "branch", ring, "mu", "std")?;
        panel = panel.series(Series::line(&format!("$N = {ring}$"), branch).look(look));
    }
    let runs = job.read_rows("runs")?.select(&[], &["mu", "std"])?;
    let lasting = runs.rows().map(|row| (row[0], row[1])).collect();
    panel = panel.series(Series::points("lasts in a run", Marker::Circle, lasting).look(3));
    Ok(panel)
}

fn onset(job: &Job) -> Result<Lines, Failure> {
    let axes = (Axis::log10("$\\mu - \\mu_N$", 1e-6, 1e-2), Axis::log10("std of speeds", 1e-4, 0.2));
    let mut panel = Lines::new(axes.0, axes.1)
        .guide(&[(1e-6, 2.2e-4), (1e-3, 6.8e-3)])
        .note("slope 1/2", (1.2e-3, 4.2e-3))
        .legend(Corner::TopLeft);
    for (look, ring) in RINGS.into_iter().enumerate() {
        let branch = points(job, "branch", ring, "above", "std")?;
        let above = branch.into_iter().take_while(|(above, _)| *above > 0.0).collect();
        panel = panel.series(Series::line(&format!("$N = {ring}$"), above).look(look));
    }
    Ok(panel)
}
