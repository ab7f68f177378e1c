//! Supplement 10: the published curves of figures 12 (left) and 13 over the regenerated ones, and the schemes that may
//! have made them.

use figures::panels::points;
use figures::{Failure, Job, figure};
use files::table::Table;
use ode::Method;
use plot::style::FULL_WIDTH;
use plot::{Axis, Corner, Lines, Marker, Picture, Series};
use std::process::ExitCode;
use studies::hard::rows::Rows;
use studies::overlay::{Published, SCHEMES, Sampled, distance, rivals, sampled, scheme};

fn main() -> ExitCode {
    figure(env!("CARGO_BIN_NAME"), tables, picture)
}

/// The step of the public code of the logarithmic run, by Euler's scheme.
const STEP: f64 = 1e-3;
/// Euler's scheme by these steps.
const STEPS: [f64; 6] = [4e-3, 2e-3, 1.5e-3, STEP, 7.5e-4, 5e-4];

fn published(job: &Job) -> Result<Published, Failure> {
    let spread = points(&job.reference("published_std_log")?, "t", "std")?;
    Ok(Published { spread, speeds: points(&job.reference("published_speed_t300")?, "n", "v")? })
}

fn tables(job: &mut Job) -> Result<(), Failure> {
    let published = published(job)?;
    let run = |panel| Sampled::from_tables(&job.run_table(panel, "std")?, &job.run_table(panel, "trajectories")?);
    let (accurate, small_shift) = (run("main")?, run("small_shift")?);
    let mut schemes = Rows::new(&SCHEMES);
    schemes.push(scheme("accurate", None, &accurate, &published)?);
    let mut euler = Sampled::default();
    for step in STEPS {
        let made = Sampled::by_steps(Method::Euler, step)?;
        schemes.push(scheme("euler", Some(step), &made, &published)?);
        euler = if (step - STEP).abs() < 1e-12 { made } else { euler };
    }
    for method in [Method::Ballistic, Method::Heun] {
        schemes.push(scheme(method.name(), Some(STEP), &Sampled::by_steps(method, STEP)?, &published)?);
    }
    job.write_rows("schemes", &schemes)?;
    job.write_rows("rivals", &rivals(&accurate, &euler, &published)?)?;
    let runs = [("accurate", &accurate), ("small_shift", &small_shift), ("euler", &euler)];
    job.write_rows("distance", &distance(&runs, &published)?)?;
    job.write("profile", &curves("n", 1, &accurate.speeds, &euler.speeds))?;
    job.write("curve", &curves("t", 10, &accurate.spread, &euler.spread))?;
    job.write("speeds", &beside("n", &published.speeds, &accurate.speeds, &euler.speeds)?)?;
    job.write("deviations", &beside("t", &published.spread, &accurate.spread, &euler.spread)?)
}

/// Published and regenerated numbers side by side.
fn beside(axis: &str, published: &[(f64, f64)], accurate: &[f64], euler: &[f64]) -> Result<Table, Failure> {
    let mut table = Table::new(&[axis, "published", "accurate", "euler", "from_accurate", "from_euler"]);
    let (of_accurate, of_euler) = (sampled("accurate", axis, accurate), sampled("euler", axis, euler));
    for &(place, value) in published {
        let (accurate, euler) = (of_accurate(place)?, of_euler(place)?);
        table.push(&[place.round(), value, accurate, euler, value - accurate, value - euler]);
    }
    Ok(table)
}

/// Every so many of the regenerated numbers.
fn curves(place: &str, every: usize, accurate: &[f64], euler: &[f64]) -> Table {
    let mut table = Table::new(&[place, "accurate", "euler"]);
    for (i, (a, b)) in accurate.iter().zip(euler).enumerate().step_by(every) {
        table.push(&[i as f64, *a, *b]);
    }
    table
}

fn picture(job: &Job) -> Result<Picture, Failure> {
    Ok(Picture::new(FULL_WIDTH, 120.0)
        .columns(2)
        .titled("speeds at $t = 300$", speeds(job)?)
        .titled("std of speeds", deviations(job)?)
        .titled("published minus regenerated std", differences(job)?)
        .titled("distance of runs by Euler steps", steps(job)?))
}

fn speeds(job: &Job) -> Result<Lines, Failure> {
    let table = job.read("speeds")?;
    let axes = (Axis::linear("pedestrian $n$", 0.0, 140.0).steps(4), Axis::linear("speed", 0.55, 0.75).steps(4));
    Ok(Lines::new(axes.0, axes.1)
        .legend(Corner::TopLeft)
        .series(Series::line("regenerated", points(&job.read("profile")?, "n", "accurate")?))
        .series(Series::points("published", Marker::Circle, points(&table, "n", "published")?).every(3)))
}

fn deviations(job: &Job) -> Result<Lines, Failure> {
    let table = job.read("deviations")?;
    let axes = (Axis::linear("$t$", 0.0, 3000.0).steps(3), Axis::linear("std of speeds", 0.0, 0.4).steps(4));
    Ok(Lines::new(axes.0, axes.1)
        .legend(Corner::BottomRight)
        .series(Series::line("regenerated", points(&job.read("curve")?, "t", "accurate")?))
        .series(Series::points("published", Marker::Circle, points(&table, "t", "published")?).every(8)))
}

fn differences(job: &Job) -> Result<Lines, Failure> {
    let table = job.read("deviations")?;
    let axes = (Axis::linear("$t$", 0.0, 3000.0).steps(3), Axis::linear("difference", -3e-3, 3e-3).steps(6));
    let mut panel = Lines::new(axes.0, axes.1).horizontal(0.0).legend(Corner::TopRight);
    for (name, column, marker) in
        [("accurate run", "from_accurate", Marker::Circle), ("Euler, steps of $10^{-3}$", "from_euler", Marker::Square)]
    {
        panel = panel.series(Series::points(name, marker, points(&table, "t", column)?).every(2));
    }
    Ok(panel)
}

fn steps(job: &Job) -> Result<Lines, Failure> {
    let table = job.read_rows("schemes")?;
    let axes = (Axis::log10("step $\\Delta t$", 3e-4, 6e-3), Axis::log10("root mean square", 1e-5, 1e-2));
    let mut panel = Lines::new(axes.0, axes.1)
        .legend(Corner::TopLeft)
        .note("accurate run, std", (3.2e-4, 6.6e-4))
        .note("accurate run, speeds", (3.2e-4, 1.8e-5));
    for (name, column, marker) in
        [("std", "std_rms", Marker::Circle), ("speeds at $t = 300$", "speed_rms", Marker::Square)]
    {
        let selected = table.select(&[("method", "euler")], &["dt", column])?;
        let accurate = table.select(&[("method", "accurate")], &[column])?.column(column)?;
        panel = panel.series(Series::line(name, points(&selected, "dt", column)?).marker(marker));
        panel = accurate.into_iter().fold(panel, Lines::horizontal);
    }
    Ok(panel)
}
