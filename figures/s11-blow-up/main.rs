//! Supplement 11: the blow-up of the unstable algebraic run of figure 4, from the tables of the hard cases: speeds that
//! double from pedestrian to pedestrian, the smallest gap, and what fixed steps report instead.

use figures::panels::points;
use figures::{Failure, Job, figure};
use files::table::Table;
use plot::style::COLUMN_WIDTH;
use plot::{Axis, Corner, Lines, Marker, Picture, Series};
use std::process::ExitCode;

fn main() -> ExitCode {
    figure(env!("CARGO_BIN_NAME"), tables, picture)
}

/// The methods whose fixed steps are drawn, with their names in the legend.
const METHODS: [(&str, &str); 4] = [("euler", "Euler"), ("ballistic", "ballistic"), ("heun", "Heun"), ("rk4", "RK4")];

fn tables(job: &mut Job) -> Result<(), Failure> {
    let cascade = job.accuracy("blow_up_cascade")?.select(&[], &["k", "n", "remaining", "room", "speed"])?;
    job.write("cascade", &cascade)?;
    job.write("scaling", &job.accuracy("blow_up_scaling")?.select(&[], &["remaining", "room", "smallest_so_far"])?)?;
    let steps = job.accuracy("blow_up_fixed_steps")?;
    for (method, _) in METHODS {
        let words = [("method", method), ("state", "gaps"), ("event", "overlap")];
        job.write(&format!("fixed_{method}"), &steps.select(&words, &["dt", "t", "n", "early"])?)?;
    }
    Ok(())
}

fn picture(job: &Job) -> Result<Picture, Failure> {
    let cascade = job.read("cascade")?;
    Ok(Picture::new(COLUMN_WIDTH, 150.0)
        .columns(1)
        .titled("speeds double from collision to collision", speeds(&cascade)?)
        .titled("least gaps of collisions fall as the square of the time left", rooms(job, &cascade)?)
        .titled("fixed steps report an overlap before $T^*$", steps(job)?))
}

/// Binary logarithm of the largest speed backwards against the order of the throws.
fn speeds(cascade: &Table) -> Result<Lines, Failure> {
    let doublings = points(cascade, "k", "speed")?.into_iter().map(|(k, v)| (k, math::ln(v) / std::f64::consts::LN_2));
    let axis = Axis::linear("collision $k$", 0.0, 36.0).steps(4);
    Ok(Lines::new(axis, Axis::linear("$\\mathrm{log}_2 (-v)$", 0.0, 40.0).steps(4))
        .guide(&[(4.0, 4.0 + FIRST), (36.0, 36.0 + FIRST)])
        .note("doubling", (22.0, 16.0))
        .series(Series::points("", Marker::Circle, doublings.collect()).look(0)))
}

/// Binary logarithm of the speed of the cascade before its first throw, from its fourth on.
const FIRST: f64 = 1.66;

fn rooms(job: &Job, cascade: &Table) -> Result<Lines, Failure> {
    let along = points(&job.read("scaling")?, "remaining", "smallest_so_far")?;
    let throws = points(cascade, "remaining", "room")?;
    let slope = |remaining: f64| (remaining, SQUARE * remaining * remaining);
    Ok(Lines::new(Axis::log10("time left $T^* - t$", 1e-11, 1.0), Axis::log10("smallest gap $d$", 1e-24, 1e2))
        .legend(Corner::BottomRight)
        .guide(&[slope(1e-11), slope(1.0)])
        .note("slope 2", (1e-5, 1e-13))
        .series(Series::line("so far", along).look(0))
        .series(Series::points("at the collisions", Marker::Circle, throws).look(1)))
}

/// The smallest gap of a throw over the square of the time left: `8 mu^2 / (speed * time)^2`.
const SQUARE: f64 = 0.6;

fn steps(job: &Job) -> Result<Lines, Failure> {
    let markers = [Marker::Circle, Marker::Square, Marker::Triangle, Marker::Diamond];
    let cube_root = |step: f64| (step, 0.85 * math::pow(step, 1.0 / 3.0));
    let mut panel =
        Lines::new(Axis::log10("step $\\Delta t$", 1e-5, 1e-1), Axis::log10("$T^* - t$ at the report", 1e-3, 1.0))
            .legend(Corner::BottomRight)
            .guide(&[cube_root(1e-5), cube_root(1e-1)])
            .note("slope 1/3", (2e-5, 5e-2));
    for ((method, name), marker) in METHODS.into_iter().zip(markers) {
        let early = points(&job.read(&format!("fixed_{method}"))?, "dt", "early")?;
        panel = panel.series(Series::line(name, early).marker(marker));
    }
    Ok(panel)
}
