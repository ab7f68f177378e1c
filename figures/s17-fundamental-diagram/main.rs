//! Supplement 17: the fundamental diagram. It shows speed and flow of the uniform flow against the density (the inverse
//! of the headway), with the unstable part, and the pedestrians of figure 11's run once its jams travel steadily.

use figures::panels::points;
use figures::{Failure, Job, figure};
use files::table::Table;
use jam::uniform::steady_speed;
use plot::style::COLUMN_WIDTH;
use plot::{Axis, Corner, Lines, Marker, Picture, Series};
use scene::run::Scene;
use std::process::ExitCode;

fn main() -> ExitCode {
    figure(env!("CARGO_BIN_NAME"), tables, picture)
}

/// Densities of the uniform flow: whole multiples of 1 / STEPS, up to MOST of them.
const STEPS: u32 = 200;
const MOST: u32 = 300;
/// The states are those from FIRST on, every APART.
const FIRST: f64 = 2000.0;
const APART: f64 = 100.0;
/// Interval of the states that are drawn.
const DRAWN: usize = 3;

fn tables(job: &mut Job) -> Result<(), Failure> {
    let scene = scene::run::read(&job.scene_file.file, &job.panel("main")?.tables)?;
    job.write("steady", &steady(&scene)?)?;
    job.write("states", &states(&job.run_table("main", "trajectories")?, &scene))
}

/// The uniform flow at every density; `margin` is above 0 where long waves grow.
fn steady(scene: &Scene) -> Result<Table, Failure> {
    let mut table = Table::new(&["headway", "density", "speed", "flow", "margin"]);
    for step in 1..=MOST {
        let (density, headway) = (f64::from(step) / f64::from(STEPS), f64::from(STEPS) / f64::from(step));
        let speed = steady_speed(&scene.model, headway).map_err(Failure::work)?;
        let margin = scene.model.linearise(headway, speed).long_wave_margin();
        table.push(&[headway, density, speed, speed * density, margin]);
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
    let scene = scene::run::read(&job.scene_file.file, &job.panel("main")?.tables)?;
    let mean = 1.0 / scene.ring.headway();
    let speeds = panel(job, "speed", Axis::linear("speed $v$", 0.0, 1.2).steps(4), mean)?;
    let flows = panel(job, "flow", Axis::linear("flow $\\rho v$", 0.0, 0.6).steps(3), mean)?.unnamed();
    Ok(Picture::new(COLUMN_WIDTH, 110.0).columns(1).panel(speeds.legend(Corner::BottomLeft)).panel(
        // who is faster than the uniform flow at the same headway slows down: the law says so
        flows
            .note("mean density", (mean + 0.02, 0.03))
            .note("slowing down", (0.8, 0.525))
            .note("speeding up", (0.8, 0.29)),
    ))
}

/// A column against the density: the uniform flow, its unstable part thick, and the states.
fn panel(job: &Job, column: &str, axis: Axis, mean: f64) -> Result<Lines, Failure> {
    let steady = job.read("steady")?;
    let all = points(&steady, "density", column)?;
    let margins = steady.column("margin")?;
    let unstable = all.iter().zip(&margins).filter(|&(_, &margin)| margin > 0.0);
    let unstable = unstable.map(|(&point, _)| point).collect();
    let states = points(&job.read("states")?, "density", column)?;
    let densest = f64::from(MOST) / f64::from(STEPS);
    Ok(Lines::new(Axis::linear("density $\\rho = 1 / \\mathrm{headway}$", 0.0, densest).steps(3), axis)
        .vertical(mean)
        .series(Series::points("run of figure 11", Marker::Circle, states).every(DRAWN).look(2).marker_size(0.5))
        .series(Series::line("uniform flow", all).look(0).solid())
        .series(Series::line("unstable", unstable).look(1).solid().thick(2.5)))
}
