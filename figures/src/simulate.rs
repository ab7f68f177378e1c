//! Running a scene from the command line: tables, events and a summary.

use crate::checkpoint::{Care, Ended};
use crate::failure::{Failure, print};
use crate::panels::{points, trajectories};
use files::recipe::{self, Kind};
use files::table::Table;
use files::write::atomic_all;
use ode::Control;
use plot::style::COLUMN_WIDTH;
use plot::{Axis, ColorScale, Legend, Lines, Picture, Series, SpaceTime};
use scene::Overrides;
use scene::run::Scene;
use scene::simulation::Outcome;
use serde_json::{Value, json};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// What the command line asks for.
#[derive(Debug, clap::Parser)]
#[command(name = "simulate", about = "Runs a scene and writes its tables, events, summary and pictures")]
pub struct Arguments {
    /// The scene file
    scene: PathBuf,
    /// The panel of a scene that has several
    #[arg(long)]
    panel: Option<String>,
    /// Folder for std.csv, trajectories.csv, events.csv, summary.json and pictures; made if missing
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Tables and summary only, no pictures
    #[arg(long)]
    tables_only: bool,
    /// euler, ballistic, heun, rk4 (with --dt), bs32, dopri54, tsit54, verner65, verner76, verner87, verner98, dop853,
    /// extrapolation (with --tol or --dt)
    #[arg(long)]
    method: Option<String>,
    /// Largest local error, relative to the perturbation: 1e-15 to 1e-2
    #[arg(long, value_name = "X", conflicts_with = "dt", allow_negative_numbers = true)]
    tol: Option<f64>,
    /// Length of every step, in units of tau
    #[arg(long, value_name = "X", allow_negative_numbers = true)]
    dt: Option<f64>,
    /// Time at which the run ends
    #[arg(long, value_name = "T", allow_negative_numbers = true)]
    t_end: Option<f64>,
    /// Time between samples
    #[arg(long, value_name = "DT", allow_negative_numbers = true)]
    sample: Option<f64>,
    /// File for the final state: n, x, v
    #[arg(long, value_name = "FILE")]
    state: Option<PathBuf>,
    /// The scheme: as the scene says, or the paper's (Heun, steps of 1e-5, positions)
    #[arg(long, value_parser = ["adaptive", "paper"], default_value = "adaptive")]
    scheme: String,
    /// The independent run that estimates the error: another method at a tighter tolerance
    #[arg(long, conflicts_with_all = ["method", "tol", "dt"])]
    check: bool,
    /// Progress and checkpoints.
    #[command(flatten)]
    care: Care,
    /// Print the summary as JSON
    #[arg(long)]
    json: bool,
}

/// Runs the scene and writes what was asked for.
///
/// # Errors
/// A bad scene or option (nothing is written), a failed integration, a file that cannot be written.
pub fn main(arguments: &Arguments) -> Result<(), Failure> {
    let scene = read_scene(arguments)?;
    let ended = arguments.care.run(&scene)?;
    let summary = summary(&scene, &ended);
    let Ended { outcome, seconds, .. } = ended;
    let mut files = Vec::new();
    if let Some(folder) = &arguments.out {
        files.extend(tables(folder, &scene, &outcome));
        files.push((folder.join("summary.json"), pretty(&summary).into_bytes()));
        if !arguments.tables_only {
            files.extend(pictures(folder, &scene, &outcome)?);
        }
        std::fs::create_dir_all(folder).map_err(|error| files::write::with_path(error, folder))?;
    }
    files.extend(arguments.state.iter().map(|file| (file.clone(), state(&outcome).to_csv())));
    atomic_all(&files)?;
    arguments.care.remove()?;
    let words = if arguments.json { summary.to_string() } else { in_words(&scene, &outcome, seconds) };
    print(&words)
}

fn read_scene(arguments: &Arguments) -> Result<Scene, Failure> {
    let recipe = recipe::read(&arguments.scene)?;
    let panel = match &arguments.panel {
        Some(name) => recipe.panel(name)?,
        None if recipe.panels.len() == 1 => &recipe.panels[0],
        None => {
            let names: Vec<&str> = recipe.panels.iter().map(|panel| panel.name.as_str()).collect();
            return Err(Failure::input(format!("{}: choose one with --panel: {}", recipe.file, names.join(", "))));
        }
    };
    if panel.kind != Kind::Run {
        return Err(Failure::input(format!("{}: has no [run]; a map is computed with `map`", recipe.file)));
    }
    let tables = match arguments.scheme.as_str() {
        "paper" => Overrides::paper().apply(&panel.tables),
        _ => panel.tables.clone(),
    };
    let overrides = Overrides {
        method: arguments.method.clone(),
        tolerance: arguments.tol,
        dt: arguments.dt,
        t_end: arguments.t_end,
        sample: arguments.sample,
        state: None,
    };
    let tables = overrides.apply(&tables);
    let scene = scene::run::read(&recipe.file, &tables)?;
    match scene.control {
        Control::Adaptive { tolerance } if arguments.check => {
            Ok(scene::run::read(&recipe.file, &Overrides::check(tolerance).apply(&tables))?)
        }
        _ => Ok(scene),
    }
}

/// Pictures of the standard deviation and, if they are kept, of the trajectories.
fn pictures(folder: &Path, scene: &Scene, outcome: &Outcome) -> Result<Vec<(PathBuf, Vec<u8>)>, Failure> {
    let std = points(&outcome.std, "t", "std")?;
    // a run that a stop ends is drawn up to its last sample
    let last = std.last().map_or(0.0, |&(t, _)| t);
    let times = Axis::linear("$t$", 0.0, if last > 0.0 { last } else { scene.t_end }).steps(4);
    let heights = Axis::around("std of speeds", std.iter().map(|&(_, std)| std));
    let panel = Lines::new(times.clone(), heights).legend(Legend::Hidden).series(Series::line("", std));
    let mut files = rendered(folder, "std", Picture::new(COLUMN_WIDTH, 60.0).panel(panel))?;
    if scene.keeps_trajectories {
        let length = scene.ring.length;
        let speeds = ColorScale::sequential("speed $v_n$", 0.0, scene.model.desired_speed());
        let places = Axis::linear("$x'$", 0.0, length).steps(4);
        let panel = SpaceTime::new(times, places, length, &trajectories(&outcome.trajectories)?);
        files.extend(rendered(folder, "trajectories", Picture::new(COLUMN_WIDTH, 80.0).scale(speeds).panel(panel))?);
    }
    Ok(files)
}

fn rendered(folder: &Path, name: &str, picture: Picture) -> Result<Vec<(PathBuf, Vec<u8>)>, Failure> {
    let rendered = picture.render().map_err(Failure::work)?;
    Ok(vec![(folder.join(format!("{name}.svg")), rendered.svg), (folder.join(format!("{name}.png")), rendered.png)])
}

fn tables(folder: &Path, scene: &Scene, outcome: &Outcome) -> Vec<(PathBuf, Vec<u8>)> {
    let mut files =
        vec![(folder.join("std.csv"), outcome.std.to_csv()), (folder.join("events.csv"), events(outcome).into_bytes())];
    if scene.keeps_trajectories {
        files.push((folder.join("trajectories.csv"), outcome.trajectories.to_csv()));
    }
    files
}

/// `event,t,n`: the first event of each kind.
fn events(outcome: &Outcome) -> String {
    let mut text = "event,t,n\n".to_owned();
    for happening in &outcome.events {
        // writing to a String cannot fail
        let _ = writeln!(text, "{},{:?},{}", happening.event.name(), happening.time, happening.pedestrian);
    }
    text
}

fn state(outcome: &Outcome) -> Table {
    let mut table = Table::new(&["n", "x", "v"]);
    for (n, (x, v)) in outcome.positions.iter().zip(&outcome.speeds).enumerate() {
        table.push(&[n as f64, *x, *v]);
    }
    table
}

fn pretty(summary: &Value) -> String {
    format!("{summary:#}\n")
}

fn summary(scene: &Scene, ended: &Ended) -> Value {
    let Ended { outcome, seconds, resumed_steps, .. } = ended;
    let control = match scene.control {
        Control::Fixed { step } => json!({ "dt": step }),
        Control::Adaptive { tolerance } => json!({ "tolerance": tolerance }),
    };
    let events: Vec<Value> = outcome
        .events
        .iter()
        .map(|happening| {
            json!({
                "event": happening.event.name(),
                "t": happening.time,
                "n": happening.pedestrian,
                "gap": happening.gap,
                "step": happening.step,
            })
        })
        .collect();
    json!({
        "schema_version": 1,
        "law": scene.model.name(),
        "pedestrians": scene.ring.pedestrians,
        "length": scene.ring.length,
        "steady_speed": scene.steady_speed,
        "method": scene.method.name(),
        "control": control,
        "steps": outcome.statistics.steps,
        "resumed_steps": resumed_steps,
        "rejected": outcome.statistics.rejected,
        "right_hand_sides": outcome.statistics.evaluations,
        "seconds": seconds,
        "t": outcome.statistics.time,
        "stop": outcome.stop().map_or("t_end", |happening| happening.event.name()),
        "events": events,
        "jams": scene.keeps_trajectories.then(|| jams(outcome)),
    })
}

fn jams(outcome: &Outcome) -> Value {
    let extents: Vec<f64> = outcome.drift.jams().iter().map(|jam| jam.extent).collect();
    json!({
        "number": extents.len(),
        "extents": extents,
        "speed": outcome.drift.speed().map(|(speed, _)| speed),
        "measured_over": outcome.drift.speed().map(|(_, time)| time),
    })
}

fn in_words(scene: &Scene, outcome: &Outcome, seconds: f64) -> String {
    let statistics = &outcome.statistics;
    let mut text = format!(
        "{} law, {} pedestrians on {}: {} to t = {:?}\n{} steps ({} rejected), {} right-hand sides, {seconds:.3} s",
        scene.model.name(),
        scene.ring.pedestrians,
        scene.ring.length,
        scene.method.name(),
        statistics.time,
        statistics.steps,
        statistics.rejected,
        statistics.evaluations,
    );
    for happening in &outcome.events {
        let _ = write!(
            text,
            "\n{} at t = {:?}, pedestrian {}, gap {:?}, within a step of {:e}",
            happening.event.name(),
            happening.time,
            happening.pedestrian,
            happening.gap,
            happening.step
        );
    }
    if let Some((speed, time)) = outcome.drift.speed() {
        let count = outcome.drift.jams().len();
        let _ = write!(text, "\n{count} jams, travelling at {speed:.4} (mean over the last {time:?})");
    }
    text
}
