//! Supplement 17: the fundamental diagram. Speed and flow of the uniform flow against the density, the inverse of the
//! headway, with the part that is unstable; on top the pedestrians of the run of figure 11 when its jams travel steadily.

use figures::panels::points;
use figures::{Failure, Job, figure};
use files::table::Table;
use jam::uniform::steady_speed;
use plot::style::COLUMN_WIDTH;
use plot::{Axis, Corner, Legend, Lines, Marker, Picture, Series};
use scene::run::Scene;
use std::process::ExitCode;

fn main() -> ExitCode {
    figure(env!("CARGO_BIN_NAME"), tables, picture)
}

/// Headways of the uniform flow: 1 / STEPS of the length unit apart, up to LONGEST of it.
const STEPS: u32 = 200;
const LONGEST: u32 = 8;
/// The states are those from FIRST on, every APART.
const FIRST: f64 = 2000.0;
const APART: f64 = 100.0;
/// The end of the axes of densities.
const DENSEST: f64 = 1.5;

fn tables(job: &mut Job) -> Result<(), Failure> {
    let scene = scene::run::read(&job.recipe.file, &job.panel("main")?.tables)?;
    job.write("steady", &steady(&scene)?)?;
    job.write("states", &states(&job.run_table("main", "trajectories")?, &scene))
}

/// The uniform flow at every headway, the densest first; `margin` is above 0 where long waves grow.
fn steady(scene: &Scene) -> Result<Table, Failure> {
    let mut table = Table::new(&["headway", "density", "speed", "flow", "margin"]);
    for step in STEPS / 2..=LONGEST * STEPS {
        let headway = f64::from(step) / f64::from(STEPS);
        let speed = steady_speed(&scene.model, headway).map_err(Failure::work)?;
        let margin = scene.model.linearise(headway, speed).long_wave_margin();
        table.push(&[headway, 1.0 / headway, speed, speed / headway, margin]);
    }
    Ok(table)
}

/// All pedestrians at the chosen times: headway to the one ahead, its inverse, speed, and their product.
fn states(run: &Table, scene: &Scene) -> Table {
    let count = scene.ring.pedestrians;
    let rows: Vec<&[f64]> = run.rows().filter(|row| row[0] >= FIRST && row[0] % APART == 0.0).collect();
    let mut table = Table::new(&["t", "n", "headway", "density", "speed", "flow"]);
    for frame in rows.chunks_exact(count) {
        for (n, row) in frame.iter().enumerate() {
            let ahead = if n + 1 < count { frame[n + 1][2] } else { frame[0][2] + scene.ring.length };
            let (headway, speed) = (ahead - row[2], row[3]);
            table.push(&[row[0], row[1], headway, 1.0 / headway, speed, speed / headway]);
        }
    }
    table
}

fn picture(job: &Job) -> Result<Picture, Failure> {
    let scene = scene::run::read(&job.recipe.file, &job.panel("main")?.tables)?;
    let mean = 1.0 / scene.ring.headway();
    let speeds = panel(job, "speed", Axis::linear("speed $v$", 0.0, 1.0).steps(4), mean)?;
    let flows = panel(job, "flow", Axis::linear("flow $\\rho v$", 0.0, 0.6).steps(3), mean)?;
    Ok(Picture::new(COLUMN_WIDTH, 110.0)
        .columns(1)
        .panel(speeds.legend(Legend::Corner(Corner::BottomLeft)))
        .panel(flows.legend(Legend::Hidden).note("mean density", (mean + 0.02, 0.03))))
}

/// A column against the density: the uniform flow, its unstable part thick, and the states.
fn panel(job: &Job, column: &str, axis: Axis, mean: f64) -> Result<Lines, Failure> {
    let steady = job.read("steady")?;
    let all = points(&steady, "density", column)?;
    let margins = steady.column("margin")?;
    let is_drawn = |&(density, _): &(f64, f64)| density <= DENSEST;
    let unstable = all.iter().zip(&margins).filter(|&(point, &margin)| margin > 0.0 && is_drawn(point));
    let states = points(&job.read("states")?, "density", column)?;
    Ok(Lines::new(Axis::linear("density $\\rho = 1 / \\mathrm{headway}$", 0.0, DENSEST).steps(3), axis)
        .vertical(mean)
        .series(Series::points("run of figure 11", Marker::Circle, states).look(2).marker_size(0.5))
        .series(Series::line("uniform flow", all.iter().copied().filter(is_drawn).collect()).look(0).solid())
        .series(Series::line("unstable", unstable.map(|(&point, _)| point).collect()).look(1).solid().thick(2.5)))
}
