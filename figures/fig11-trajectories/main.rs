//! Figure 11 (fig:jams): trajectories of 133 pedestrians: speeds of all and paths of some (a), paths of all in a window
//! (b).

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

/// Panel (a) shows the speed of all pedestrians as a field, and the trajectory of every thirty-third.
const TRACED: usize = 33;

fn picture(job: &Job) -> Result<Picture, Failure> {
    let scene = scene::run::read(&job.scene_file.file, &job.panel("main")?.tables)?;
    let (t_end, length) = (scene.t_end, scene.ring.length);
    let paths = trajectories(&job.read("trajectories")?)?;
    let axis = |label: &str, [from, to]: [f64; 2]| Axis::linear(label, from, to).steps(4);
    // the window that panel (b) enlarges: a fifteenth of the time, when the jams are there, and part of the ring
    let (times, positions) = ([t_end / 15.0 * 10.0, t_end / 15.0 * 11.0], [0.0, 0.3 * length]);
    let whole = SpaceTime::new(axis("$t$", [0.0, t_end]), axis("$x'$", [0.0, length]), length, &paths);
    let window = SpaceTime::new(axis("$t$", times), axis("$x'$", positions), length, &paths).line_width(0.25);
    let speeds = paths.iter().flatten().map(|sample| sample[2]);
    Ok(Picture::new(COLUMN_WIDTH, 124.0)
        .columns(1)
        .row_shares(&[1.5, 1.0])
        .scale(ColorScale::sequential("speed $v_n$", speeds))
        .titled(
            &format!("speed of all, path of every {TRACED}rd"),
            whole.field().every(TRACED).line_width(0.12).outline(times, positions),
        )
        .titled("paths of all in the window", window))
}
