//! Supplement 13: how the jams of figures 11 to 13 depend on the choices made.

use figures::{Failure, Job, figure};
use plot::style::FULL_WIDTH;
use plot::{Axis, Corner, Lines, Marker, Picture, Series};
use std::process::ExitCode;
use studies::parameters;

fn main() -> ExitCode {
    figure(env!("CARGO_BIN_NAME"), tables, picture)
}

fn tables(job: &mut Job) -> Result<(), Failure> {
    parameters::tables()?.iter().try_for_each(|(name, rows)| job.write_rows(name, rows))
}

fn picture(job: &Job) -> Result<Picture, Failure> {
    Ok(Picture::new(FULL_WIDTH, 110.0)
        .columns(3)
        .titled("when jams form", onset(job)?)
        .titled("how many are left", jams_by_shift(job)?)
        .titled("how many in the course of time", jams_by_time(job)?)
        .titled("how fast they travel", jam_speed(job)?)
        .titled("how much passes", flow(job)?)
        .titled("how deep they are", plateau(job)?))
}

/// Points (x, y) of the rows with these words that have both.
fn pairs(job: &Job, table: &str, words: &[(&str, &str)], x: &str, y: &str) -> Result<Vec<(f64, f64)>, Failure> {
    let selected = job.read_rows(table)?.select(words, &[x, y])?;
    Ok(selected.rows().map(|row| (row[0], row[1])).collect())
}

const STARTS: [(&str, &str, Marker); 2] = [("one", "one shifted", Marker::Circle), ("random", "all", Marker::Square)];

fn shift_axis() -> Axis {
    let ticks = [(1e-6, "$10^{-6}$"), (1e-4, "$10^{-4}$"), (1e-2, "$10^{-2}$"), (1.0, "1")];
    Axis::log10("shift $\\epsilon_1$", 3e-7, 1.5).ticks(&ticks)
}

fn onset(job: &Job) -> Result<Lines, Failure> {
    let mut panel = Lines::new(shift_axis(), Axis::linear("time when std passes 0.1", 0.0, 2500.0).steps(5));
    for (word, name, marker) in STARTS {
        panel = panel.series(Series::points(name, marker, pairs(job, "shift", &[("start", word)], "shift", "onset")?));
    }
    Ok(panel.legend(Corner::TopRight))
}

fn jams_by_shift(job: &Job) -> Result<Lines, Failure> {
    let mut panel = Lines::new(shift_axis(), Axis::linear("jams at $t = 3000$", 0.0, 12.0).steps(4));
    for (word, name, marker) in STARTS {
        panel = panel.series(Series::points(name, marker, pairs(job, "shift", &[("start", word)], "shift", "jams")?));
    }
    Ok(panel.legend(Corner::BottomLeft))
}

fn jams_by_time(job: &Job) -> Result<Lines, Failure> {
    let (times, jams) = (Axis::linear("$t / 1000$", 0.0, 10.0).steps(5), Axis::linear("jams", 0.0, 12.0).steps(4));
    let points = pairs(job, "time", &[], "t", "jams")?.into_iter().map(|(t, jams)| (t / 1000.0, jams)).collect();
    Ok(Lines::new(times, jams).vertical(3.0).series(Series::line("", points)))
}

fn jam_speed(job: &Job) -> Result<Lines, Failure> {
    let axes = (Axis::linear("$v_0'$", 0.8, 1.4).steps(3), Axis::linear("speed of the jams", -0.3, 0.1).steps(4));
    let points = pairs(job, "speed", &[], "v0", "jam_speed")?;
    Ok(Lines::new(axes.0, axes.1).horizontal(0.0).series(Series::line("", points).marker(Marker::Circle)))
}

fn flow(job: &Job) -> Result<Lines, Failure> {
    let axes = (Axis::linear("headway $L / N$", 1.2, 2.0).steps(4), Axis::linear("flow", 0.38, 0.52).steps(7));
    let uniform: Vec<(f64, f64)> =
        pairs(job, "length", &[], "headway", "steady_speed")?.into_iter().map(|(dy, v)| (dy, v / dy)).collect();
    Ok(Lines::new(axes.0, axes.1)
        .legend(Corner::TopLeft)
        .series(Series::line("with jams", pairs(job, "length", &[], "headway", "flow")?).marker(Marker::Circle))
        .series(Series::line("uniform", uniform)))
}

fn plateau(job: &Job) -> Result<Lines, Failure> {
    let ticks = [(1e-3, "$10^{-3}$"), (1e-2, "$10^{-2}$"), (1e-1, "$10^{-1}$")];
    let eps = Axis::log10("$\\varepsilon$", 7e-4, 0.15).ticks(&ticks);
    let points = pairs(job, "eps", &[], "epsilon", "plateau")?;
    Ok(Lines::new(eps, Axis::linear("std of speeds, late", 0.0, 0.4).steps(4))
        .vertical(0.01)
        .series(Series::line("", points).marker(Marker::Circle)))
}
