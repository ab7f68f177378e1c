//! Figure 11 (fig:jams): trajectories of 133 pedestrians: speeds and some of them (a), all of them in a window (b).

use figures::panels::trajectories;
use figures::{Failure, Job, figure};
use plot::style::COLUMN_WIDTH;
use plot::{Axis, ColorScale, Picture, SpaceTime};
use std::process::ExitCode;

fn main() -> ExitCode {
    figure(env!("CARGO_BIN_NAME"), tables, picture)
}

fn tables(job: &mut Job) -> Result<(), Failure> {
    job.take("main", "trajectories", "trajectories")
}

/// The window that panel (b) enlarges: times and positions.
const WINDOW: ([f64; 2], [f64; 2]) = ([2000.0, 2200.0], [0.0, 60.0]);

/// Panel (a) shows the speed of all pedestrians as a field, and the trajectory of every thirty-third.
const TRACED: usize = 33;

fn picture(job: &Job) -> Result<Picture, Failure> {
    let paths = trajectories(&job.read("trajectories")?)?;
    let axis = |label: &str, [from, to]: [f64; 2]| Axis::linear(label, from, to).steps(4);
    let (times, positions) = WINDOW;
    let whole = SpaceTime::new(axis("$t$", [0.0, 3000.0]), axis("$x'$", [0.0, 200.0]), 200.0, &paths);
    let window = SpaceTime::new(axis("$t$", times), axis("$x'$", positions), 200.0, &paths).line_width(0.25);
    Ok(Picture::new(COLUMN_WIDTH, 124.0)
        .columns(1)
        .row_shares(&[1.5, 1.0])
        .scale(ColorScale::sequential("speed $v_n$", 0.0, 1.0))
        .titled(
            "speed of all, path of every 33rd",
            whole.field().every(TRACED).line_width(0.12).outline(times, positions),
        )
        .titled("paths of all in the window", window))
}
