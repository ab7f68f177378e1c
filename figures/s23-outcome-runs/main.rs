//! Supplement 23: one run for each outcome of the logarithmic law, side by side: the speeds of all pedestrians and the
//! paths of some.

use figures::panels::trajectories;
use figures::{Failure, Job, figure};
use plot::style::FULL_WIDTH;
use plot::{Axis, ColorScale, Picture, SpaceTime};
use std::process::ExitCode;

fn main() -> ExitCode {
    figure(env!("CARGO_BIN_NAME"), tables, picture)
}

/// The runs with their titles.
const RUNS: [(&str, &str); 3] = [
    ("decays", "$v_0' = 0.7$: decays"),
    ("waves", "$v_0' = 1.1$: waves"),
    ("contact", "$v_0' = 1.3$: contact, at the end"),
];
/// Interval of the pedestrians whose paths are drawn.
const TRACED: usize = 19;

fn tables(job: &mut Job) -> Result<(), Failure> {
    RUNS.iter().try_for_each(|(run, _)| job.take(run, "trajectories", run))
}

fn picture(job: &Job) -> Result<Picture, Failure> {
    let mut runs = Vec::new();
    for (run, title) in RUNS {
        let scene = scene::run::read(&job.scene_file.file, &job.panel(run)?.tables)?;
        runs.push((title, scene, trajectories(&job.read(run)?)?));
    }
    let speeds = runs.iter().flat_map(|(_, _, paths)| paths.iter().flatten()).map(|sample| sample[2]);
    let mut picture = Picture::new(FULL_WIDTH, 70.0).columns(3).scale(ColorScale::sequential("speed $v_n$", speeds));
    for (index, (title, scene, paths)) in runs.iter().enumerate() {
        let length = scene.ring.length;
        let position = Axis::linear(if index == 0 { "$x'$" } else { "" }, 0.0, length).steps(4);
        let position = if index == 0 { position } else { position.without_numbers() };
        let time = Axis::linear("$t$", 0.0, scene.t_end).steps(3);
        let panel = SpaceTime::new(time, position, length, paths).field().every(TRACED).line_width(0.12);
        picture = picture.titled(title, panel);
    }
    Ok(picture)
}
