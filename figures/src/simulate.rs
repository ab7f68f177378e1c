//! Runs a scene from the command line: tables, events and a summary.

use crate::checkpoint::CheckpointOptions;
use crate::failure::{Failure, print, say};
use crate::outputs;
use crate::panels::trajectories;
use crate::uniform;
use files::reader::Section;
use files::scene_file::{self, Kind};
use files::table::Table;
use files::write::{atomic_all, resolved};
use jam::errors::Errors;
use jam::events::Event;
use jam::outcome::{AGREEMENT, Decision, Verdict};
use jam::run::Outcome;
use ode::{Control, Method};
use plot::style::COLUMN_WIDTH;
use plot::{Axis, ColorScale, Lines, Picture, Series, SpaceTime};
use scene::run::Scene;
use scene::summary::{self, FinishedRun};
use scene::tables;
use scene::uniform::{Stability, stability};
use scene::{Overrides, SceneError};
use serde_json::Value;
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
    /// Write tables and summary, no pictures
    #[arg(long)]
    tables_only: bool,
    #[arg(long, help = methods())]
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
    /// The scheme of the scene, or the paper's (Heun, steps of 1e-5, positions)
    #[arg(long, value_parser = ["adaptive", "paper"], default_value = "adaptive")]
    scheme: String,
    /// Run by another method at a tighter tolerance, to estimate the error
    #[arg(long, conflicts_with_all = ["method", "tol", "dt"])]
    check: bool,
    /// Do not estimate the errors of the numbers
    #[arg(long)]
    no_check: bool,
    /// Progress and checkpoints.
    #[command(flatten)]
    care: CheckpointOptions,
    /// Print the summary as JSON
    #[arg(long)]
    json: bool,
}

/// The files that may be written to the folder of a run.
const OUTPUTS: [&str; 8] = [
    "std.csv",
    "events.csv",
    "trajectories.csv",
    "summary.json",
    "std.svg",
    "std.png",
    "trajectories.svg",
    "trajectories.png",
];

/// The methods in words.
fn methods() -> String {
    let names = |is_meant: fn(&Method) -> bool| Method::ALL.into_iter().filter(is_meant).map(Method::name);
    let list = |names: Vec<&str>| names.join(", ");
    format!(
        "{} (with --dt); {} (with --tol or --dt); taylor has no state = \"positions\"",
        list(names(|method| !method.is_adaptive()).collect()),
        list(names(|method| method.is_adaptive()).collect())
    )
}

/// Runs the scene and writes what was asked for.
///
/// # Errors
/// A bad scene or option (nothing is written); a run that cannot continue (its tables are written); a file that cannot
/// be written.
pub fn main(arguments: &Arguments) -> Result<(), Failure> {
    let scene = read_scene(arguments)?;
    can_write(arguments)?;
    let is_checked = !(arguments.no_check || arguments.check);
    let mut ended = arguments.care.run(&scene, is_checked)?;
    let errors = is_checked.then(|| ended.checked(&scene, &mut (), &mut arguments.care.judging()));
    let errors = errors.as_ref();
    let flow = stability(&scene);
    let summary = summary::of_run(&scene, &ended, flow.as_ref(), errors);
    let FinishedRun { outcome, broken, seconds, .. } = ended;
    let mut files = Vec::new();
    if let Some(folder) = &arguments.out {
        files.extend(written(folder, &scene, &outcome, errors));
        files.push((folder.join("summary.json"), pretty(&summary).into_bytes()));
        if !arguments.tables_only {
            files.extend(pictures(folder, &scene, &outcome, errors)?);
        }
        files::write::make_folder(folder)?;
    }
    files.extend(arguments.state.iter().map(|file| (file.clone(), state(&outcome).to_csv())));
    atomic_all(&files)?;
    arguments.care.remove()?;
    if let Some(folder) = &arguments.out {
        tell_left_over(folder, &files);
    }
    let words =
        if arguments.json { summary.to_string() } else { in_words(&scene, &outcome, flow.as_ref(), errors, seconds) };
    print(&words)?;
    broken.map_or(Ok(()), |broken| Err(Failure::work(broken)))
}

/// Whether the files can be written, asked before a long run: none of them may be the scene, and the checkpoint, which
/// is removed at the end, none of the others.
fn can_write(arguments: &Arguments) -> Result<(), Failure> {
    let in_folder = arguments.out.iter().flat_map(|folder| OUTPUTS.map(|name| folder.join(name)));
    let results: Vec<PathBuf> = in_folder.chain(arguments.state.clone()).collect();
    let checkpoint = arguments.care.file();
    outputs::can_write(&arguments.scene, arguments.out.as_deref(), &results)?;
    checkpoint.map_or(Ok(()), |file| outputs::is_not_scene(file, &arguments.scene))?;
    match checkpoint.filter(|file| results.iter().any(|place| resolved(place) == resolved(file))) {
        Some(file) => Err(Failure::input(format!(
            "{}: the checkpoint is removed at the end of the run; choose a file that holds no results",
            file.display()
        ))),
        None => arguments
            .care
            .is_spare()
            .and_then(|()| checkpoint.map_or(Ok(()), |file| outputs::can_write_one(file, None))),
    }
}

/// Names what an earlier run has left in the folder and this one has not written: it does not belong to these results.
fn tell_left_over(folder: &Path, written: &[(PathBuf, Vec<u8>)]) {
    let is_old = |place: &PathBuf| place.exists() && !written.iter().any(|(path, _)| path == place);
    for place in OUTPUTS.map(|name| folder.join(name)).iter().filter(|place| is_old(place)) {
        say(&format!("{}: not of this run, which does not write it", place.display()));
    }
}

fn read_scene(arguments: &Arguments) -> Result<Scene, Failure> {
    let parsed = scene_file::read(&arguments.scene)?;
    let panel = match &arguments.panel {
        Some(name) => parsed.panel(name)?,
        None if parsed.panels.len() == 1 => &parsed.panels[0],
        None => {
            let names: Vec<&str> = parsed.panels.iter().map(|panel| panel.name.as_str()).collect();
            return Err(Failure::input(format!("{}: choose one with --panel: {}", parsed.file, names.join(", "))));
        }
    };
    if panel.kind != Kind::Run {
        return Err(Failure::input(format!("{}: has no [run]; a map is computed with `map`", parsed.file)));
    }
    let read = |tables: &Section| scene::run::read(&parsed.file, tables);
    let of_scheme = match arguments.scheme.as_str() {
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
    let tables = overrides.apply(&of_scheme);
    let scene = read(&tables).map_err(|error| match read(&of_scheme) {
        // no line of the scene is wrong
        Ok(_) => SceneError { file: format!("{} with these options", error.file), line: 0, ..error },
        Err(_) => error,
    })?;
    match scene.control {
        Control::Adaptive { tolerance } if arguments.check => Ok(read(&Overrides::check(tolerance).apply(&tables))?),
        _ => Ok(scene),
    }
}

/// Pictures of the standard deviation and, if they are kept, of the trajectories.
fn pictures(
    folder: &Path,
    scene: &Scene,
    outcome: &Outcome,
    errors: Option<&Errors>,
) -> Result<Vec<(PathBuf, Vec<u8>)>, Failure> {
    let std = outcome.samples.iter().map(|sample| (sample.time, sample.std)).collect::<Vec<(f64, f64)>>();
    // a run that a stop ends is drawn up to its last sample
    let last = std.last().map_or(0.0, |&(t, _)| t);
    let times = Axis::linear("$t$", 0.0, if last > 0.0 { last } else { scene.t_end }).steps(4);
    let heights = Axis::from_zero("std of speeds", std.iter().map(|&(_, std)| std));
    let panel = Lines::new(times.clone(), heights).series(Series::line("", std));
    let picture = Picture::new(COLUMN_WIDTH, 60.0);
    let picture = match errors.and_then(|errors| errors.std) {
        Some(error) => picture.titled(&format!("error of the std: about {error:.0e}"), panel),
        None => picture.panel(panel),
    };
    let mut files = rendered(folder, "std", picture)?;
    if scene.keeps_trajectories {
        let length = scene.ring.length;
        let speeds = ColorScale::sequential("speed $v_n$", outcome.samples.speeds.iter().copied());
        let places = Axis::linear("$x'$", 0.0, length).steps(4);
        let panel = SpaceTime::new(times, places, length, &trajectories(&tables::trajectories(&outcome.samples))?);
        files.extend(rendered(folder, "trajectories", Picture::new(COLUMN_WIDTH, 80.0).scale(speeds).panel(panel))?);
    }
    Ok(files)
}

fn rendered(folder: &Path, name: &str, picture: Picture) -> Result<Vec<(PathBuf, Vec<u8>)>, Failure> {
    let rendered = picture.render().map_err(Failure::work)?;
    Ok(vec![(folder.join(format!("{name}.svg")), rendered.svg), (folder.join(format!("{name}.png")), rendered.png)])
}

fn written(folder: &Path, scene: &Scene, outcome: &Outcome, errors: Option<&Errors>) -> Vec<(PathBuf, Vec<u8>)> {
    let events = events(outcome, errors).into_bytes();
    let mut files =
        vec![(folder.join("std.csv"), tables::std(&outcome.samples).to_csv()), (folder.join("events.csv"), events)];
    if scene.keeps_trajectories {
        files.push((folder.join("trajectories.csv"), tables::trajectories(&outcome.samples).to_csv()));
    }
    files
}

/// `event,t,n`: the first event of each kind, a line for each pedestrian to whom it happens; and `error` of its time,
/// if it is estimated, empty where the second run has no such event.
fn events(outcome: &Outcome, errors: Option<&Errors>) -> String {
    let mut text = if errors.is_some() { "event,t,n,error\n" } else { "event,t,n\n" }.to_owned();
    for (index, event) in outcome.events.iter().enumerate() {
        // writing to a String cannot fail
        let _ = write!(text, "{},{:?},{}", event.kind.name(), event.time, event.pedestrian);
        if let Some(errors) = errors {
            let _ = write!(text, ",{}", errors.events[index].map_or(String::new(), |error| format!("{error:?}")));
        }
        text.push('\n');
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

/// A number to the digits that are sure, with its error.
fn sure(number: f64, error: Option<f64>) -> String {
    match error {
        Some(error) if error > 0.0 && error < 1.0 => {
            let digits = (-math::log10(error)).ceil() as usize;
            if digits > 17 {
                format!("{number:?} (± {error:.0e})")
            } else {
                format!("{number:.digits$} (± {error:.0e})")
            }
        }
        Some(error) if error > 0.0 => format!("{number:?} (± {error:.0e})"),
        _ => format!("{number:?}"),
    }
}

/// A time in words, to a thousandth.
fn rounded(time: f64) -> f64 {
    (1e3 * time).round() / 1e3
}

fn in_words(
    scene: &Scene,
    outcome: &Outcome,
    flow: Option<&Stability>,
    errors: Option<&Errors>,
    seconds: f64,
) -> String {
    let statistics = &outcome.statistics;
    let length = scene.ring.length;
    let length = if length < uniform::LONG { length.to_string() } else { format!("{length:e}") };
    let mut text = format!(
        "{} law, {} pedestrians on {length}: {} to t = {:?}\n\
         {} steps ({} rejected), {} right-hand sides, {seconds:.3} s",
        scene.model.name(),
        scene.ring.pedestrians,
        scene.method.name(),
        statistics.time,
        statistics.steps,
        statistics.rejected,
        statistics.evaluations,
    );
    let _ = write!(text, "\n{}", uniform::in_words(flow, scene.ring.pedestrians));
    for (index, event) in outcome.events.iter().enumerate() {
        let (kind, time) = (event.kind, event.time);
        let is_same = |other: &Event| (other.kind, other.time) == (kind, time);
        if index > 0 && is_same(&outcome.events[index - 1]) {
            continue;
        }
        let at_once = outcome.events[index + 1..].iter().take_while(|other| is_same(other)).count();
        let others = if at_once > 0 { format!(" and {at_once} more") } else { String::new() };
        let _ = write!(
            text,
            "\n{} at t = {}, pedestrian {}{others}, spacing {:?}",
            kind.name(),
            sure(time, errors.and_then(|errors| errors.events[index])),
            event.pedestrian,
            event.gap,
        );
        // at the start and after the last step there is none around the event
        if event.step > 0.0 {
            let _ = write!(text, ", within a step of {:.1e}", event.step);
        }
        if event.is_at_wall() {
            let _ = write!(text, "; followed to here: the next throw is at a gap below every double");
        }
    }
    if let Some(errors) = errors {
        let number = |error: Option<f64>| error.map_or("unknown".to_owned(), |error| format!("{error:.0e}"));
        let (std, x, v) = (number(errors.std), number(errors.positions), number(errors.speeds));
        let _ = write!(text, "\nestimated errors: std {std}; at the end x {x}, v {v}");
    }
    if let Some(verdict) = &outcome.verdict {
        let _ = write!(text, "\n{}", fate(verdict));
    }
    if let Some((speed, time)) = outcome.drift.speed() {
        let count = outcome.drift.jams().len();
        let jams = if count == 1 { "jam" } else { "jams" };
        let speed = sure(speed, outcome.drift.speed_error(scene.ring.headway()));
        let _ = write!(text, "\n{count} {jams}, travelling at {speed} (mean over the last {})", rounded(time));
    }
    text
}

/// The outcome of the run, in one line.
fn fate(verdict: &Verdict) -> String {
    let Verdict { class, time, decision, .. } = verdict;
    match decision {
        Decision::Missing(missing) => format!("outcome: undecided; needs {missing}"),
        decided => {
            let in_words = |speed: f64| match decided {
                // windows agree to a part of their numbers
                Decision::Windows => sure(speed, Some(AGREEMENT * speed.abs())),
                _ => format!("{speed:.4}"),
            };
            let speed =
                verdict.wave_speed.map_or(String::new(), |speed| format!(", travelling at {}", in_words(speed)));
            format!("outcome: {}{speed} ({} at t = {time:.1})", class.in_words(), decided.name())
        }
    }
}
