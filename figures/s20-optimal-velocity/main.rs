//! Supplement 20: the laws as optimal-velocity models. It shows their `V(s)` with the slope of 1/2 beyond which the
//! uniform flow is unstable, the effect of the desired speed on the order of events, and a run of the logarithmic law
//! with widening.

use figures::panels::points;
use figures::{Failure, Job, figure};
use files::table::Table;
use plot::style::FULL_WIDTH;
use plot::{Axis, Corner, Lines, Marker, Picture, Series};
use std::process::ExitCode;
use studies::optimal_velocity::{critical, events, velocities};

fn main() -> ExitCode {
    figure(env!("CARGO_BIN_NAME"), tables, picture)
}

/// The times of the profiles.
const TIMES: [(&str, f64); 2] = [("early", 1000.0), ("late", 3000.0)];
/// The runs: with widening, and that of figure 11.
const PANELS: [&str; 2] = ["widened", "plain"];
/// Every so many of the standard deviations.
const EVERY: usize = 5;

fn tables(job: &mut Job) -> Result<(), Failure> {
    job.write_rows("velocities", &velocities()?)?;
    job.write_rows("order", &events()?)?;
    job.write_rows("critical", &critical()?)?;
    for panel in PANELS {
        let mut thinned = Table::new(&["t", "std"]);
        job.run_table(panel, "std")?.rows().step_by(EVERY).for_each(|row| thinned.push(row));
        job.write(panel, &thinned)?;
    }
    let run = job.run_table(PANELS[0], "trajectories")?;
    for (name, time) in TIMES {
        let mut profile = Table::new(&["t", "n", "v"]);
        run.rows().filter(|row| row[0] == time).for_each(|row| profile.push(&[row[0], row[1], row[3]]));
        job.write(name, &profile)?;
    }
    let mut least = Table::new(&["t", "least"]);
    for frame in run.rows().collect::<Vec<_>>().chunk_by(|a, b| a[0] == b[0]).step_by(EVERY) {
        least.push(&[frame[0][0], frame.iter().map(|row| row[3]).fold(f64::INFINITY, math::smaller)]);
    }
    job.write("least", &least)
}

fn picture(job: &Job) -> Result<Picture, Failure> {
    Ok(Picture::new(FULL_WIDTH, 125.0)
        .columns(2)
        .titled("optimal velocity; thick: slope above 1/2", velocity(job)?)
        .titled("unstable runs with other desired speeds", order(job)?)
        .titled("logarithmic law, with and without $\\tilde a_v$", std(job)?)
        .titled("$\\tilde a_v = 0.1$, $v_0' = 1.3$: speeds", profile(job)?))
}

const LAWS: [(&str, &str); 4] = [
    ("algebraic", "algebraic, $\\mu = 0.55$"),
    ("exponential", "exponential, $a = 3$"),
    ("logarithmic_3", "logarithmic, $v_0' = 3$"),
    ("logarithmic", "logarithmic, $v_0' = 1$"),
];

fn velocity(job: &Job) -> Result<Lines, Failure> {
    let table = job.read_rows("velocities")?;
    let axes = (Axis::linear("headway $s$", 0.0, 5.0).steps(5), Axis::linear("$V(s)$", -2.0, 3.0).steps(5));
    let mut panel = Lines::new(axes.0, axes.1).horizontal(0.0).vertical(2.0).legend(Corner::BottomLeft);
    for (index, (law, name)) in LAWS.into_iter().enumerate() {
        let curve = table.select(&[("law", law)], &["headway", "velocity", "slope"])?;
        let steep = curve.rows().filter(|row| row[2] > 0.5).map(|row| (row[0], row[1])).collect();
        panel = panel.series(Series::line(name, points(&curve, "headway", "velocity")?).look(index));
        panel = panel.series(Series::line("", steep).look(index).thick(2.5));
    }
    Ok(panel)
}

/// Where the axis of times begins.
const EARLIEST: f64 = 445.0;

fn order(job: &Job) -> Result<Lines, Failure> {
    let table = job.read_rows("order")?;
    let axes =
        (Axis::linear("desired speed $v_0'$", 0.0, 6.0).steps(6), Axis::linear("time", EARLIEST, 465.0).steps(4));
    let mut panel = Lines::new(axes.0, axes.1).legend(Corner::BottomRight);
    for (column, name, marker) in
        [("stop_t", "overlap", Marker::Circle), ("negative_t", "first negative speed", Marker::Square)]
    {
        let words = [("law", "exponential"), ("varied", "speed")];
        let along = points(&table.select(&words, &["v0", column])?, "v0", column)?;
        // at v0' = 1 the uniform flow itself walks backwards: somebody does from the start on
        let grown = along.into_iter().filter(|(_, time)| *time >= EARLIEST).collect();
        panel = panel.series(Series::line(name, grown).marker(marker));
    }
    Ok(panel.note("exponential, $a = 3$", (0.3, 463.0)))
}

fn std(job: &Job) -> Result<Lines, Failure> {
    let axes =
        (Axis::linear("$t$", 0.0, 3000.0).steps(3), Axis::linear("std or least of the speeds", 0.0, 0.8).steps(4));
    Ok(Lines::new(axes.0, axes.1)
        .legend(Corner::TopRight)
        .series(Series::line("std, $\\tilde a_v = 0.1$, $v_0' = 1.3$", points(&job.read("widened")?, "t", "std")?))
        .series(Series::line("least speed, same run", points(&job.read("least")?, "t", "least")?))
        .series(Series::line("std, $\\tilde a_v = 0$, $v_0' = 1$", points(&job.read("plain")?, "t", "std")?)))
}

fn profile(job: &Job) -> Result<Lines, Failure> {
    let axes = (Axis::linear("pedestrian $n$", 0.0, 140.0).steps(4), Axis::linear("speed $v$", 0.0, 2.0).steps(4));
    let mut panel = Lines::new(axes.0, axes.1).legend(Corner::TopRight);
    for (name, time) in TIMES {
        let label = format!("$t = {}$", figures::titles::number(time));
        panel = panel.series(Series::line(&label, points(&job.read(name)?, "n", "v")?));
    }
    Ok(panel)
}
