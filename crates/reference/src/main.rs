//! The program `reference`; `reference --all` remakes data/reference/solutions.

use clap::Parser;
use files::write::atomic;
use math::double_double::{DoubleDouble, decimal};
use reference::events::{EventKind, next};
use reference::growth::{Direction, growth};
use reference::run::{Precision, Run};
use reference::scenes::{NAMES, Parameters, Scene, scene};
use reference::{cascade, table};
use std::error::Error;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, Stdio};

/// The run whose digits are published.
const FIRST: Precision = Precision { tolerance: 1e-26, rows: 12 };
/// The run that confirms them.
const SECOND: Precision = Precision { tolerance: 1e-25, rows: 10 };
/// The runs whose differences are the growth of a perturbation, which needs few digits.
const ROUGH: Precision = Precision { tolerance: 1e-23, rows: 9 };
/// How many processes run at the same time.
const AT_ONCE: usize = 2;

/// What the command line asks for.
#[derive(Debug, Parser)]
#[command(name = "reference", about = "Solutions of the six scenes to 20 digits")]
struct Arguments {
    /// The scene; its tables are written to the folder --out, or those of one run to the file --out
    #[arg(required_unless_present = "all")]
    scene: Option<String>,
    /// All scenes, two at a time
    #[arg(long, conflicts_with = "scene")]
    all: bool,
    /// One run: the largest error estimate of a step
    #[arg(long, value_name = "X", requires = "rows")]
    tolerance: Option<f64>,
    /// One run: rows of the extrapolation
    #[arg(long, value_name = "K", requires = "tolerance")]
    rows: Option<usize>,
    /// Parameters as exact decimal numbers, not as the doubles next to them
    #[arg(long)]
    decimals: bool,
    /// Print the growth of perturbations, and nothing else
    #[arg(long)]
    growth: bool,
    /// A folder; for one run a file
    #[arg(long, default_value = "data/reference/solutions")]
    out: PathBuf,
}

fn main() -> ExitCode {
    match work(&Arguments::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("reference: {error}");
            ExitCode::FAILURE
        }
    }
}

fn work(arguments: &Arguments) -> Result<(), Box<dyn Error>> {
    let Some(name) = &arguments.scene else { return all(&arguments.out) };
    let parameters = if arguments.decimals { Parameters::Decimals } else { Parameters::Doubles };
    let scene = scene(name, parameters).ok_or_else(|| format!("no scene {name}; there are {}", NAMES.join(", ")))?;
    if arguments.growth {
        return print_growth(&scene);
    }
    match (arguments.tolerance, arguments.rows) {
        (Some(tolerance), Some(rows)) => one_run(&scene, Precision { tolerance, rows }, &arguments.out),
        _ => publish(&scene, &arguments.out),
    }
}

/// The states of one run.
fn one_run(scene: &Scene, precision: Precision, file: &Path) -> Result<(), Box<dyn Error>> {
    let mut run = Run::new(scene, precision);
    let mut states = "t,n,gap,speed\n".to_owned();
    for &time in scene.times {
        run.advance_to(f64::from(time))?;
        table::push_state(&mut states, &scene.ring, time, &run.state, &run.state);
    }
    Ok(atomic(file, states.as_bytes())?)
}

/// The tables of a scene, from two runs; prints rows of the tables that all scenes share.
fn publish(scene: &Scene, folder: &Path) -> Result<(), Box<dyn Error>> {
    let (mut first, mut second) = (Run::new(scene, FIRST), Run::new(scene, SECOND));
    let (mut states, mut std) = ("t,n,gap,speed\n".to_owned(), "t,std\n0,0\n".to_owned());
    for time in 1..=scene.times.last().copied().unwrap_or(0) {
        first.advance_to(f64::from(time))?;
        second.advance_to(f64::from(time))?;
        table::push_std(&mut std, &scene.ring, time, &first.state, &second.state);
        if scene.times.contains(&time) {
            table::push_state(&mut states, &scene.ring, time, &first.state, &second.state);
            let (gap, speed) = table::distances(&scene.ring, &first.state, &second.state);
            println!("agreement:{},{time},{gap:.1e},{speed:.1e}", scene.name);
        }
    }
    std::fs::create_dir_all(folder)?;
    atomic(&folder.join(format!("{}.csv", scene.name)), states.as_bytes())?;
    atomic(&folder.join(format!("{}_std.csv", scene.name)), std.as_bytes())?;
    if scene.has_events {
        print_events(scene, &mut first, &mut second)?;
    }
    eprintln!("{}: {} and {} evaluations", scene.name, first.evaluations, second.evaluations);
    Ok(())
}

fn print_events(scene: &Scene, first: &mut Run, second: &mut Run) -> Result<(), Box<dyn Error>> {
    let events: &[EventKind] = if scene.ring.law.is_singular() {
        &[EventKind::NegativeSpeed]
    } else {
        &[EventKind::Overlap, EventKind::NegativeSpeed, EventKind::Exchange]
    };
    for &event in events {
        let (found, confirmed) = (next(first, event)?, next(second, event)?);
        print_event(scene, event.name(), found.time, found.pedestrian, (found.time - confirmed.time).hi.abs());
    }
    if scene.ring.law.is_singular() {
        let (found, confirmed) = (cascade::follow(first)?, cascade::follow(second)?);
        let uncertainty = math::larger((found.time - confirmed.time).hi.abs(), found.change);
        // while one is thrown back, the fastest is the one ahead of it
        let later = found.throws.iter().find(|throw| throw.fastest > BLOW_UP);
        let passes = later.map_or(0, |throw| (throw.pedestrian + 1) % scene.ring.pedestrians);
        print_event(scene, "blow_up", found.time, passes, uncertainty);
    }
    Ok(())
}

/// The speed at which `data/events.csv` names a pedestrian for the blow-up: 1e12 times the desired one.
const BLOW_UP: f64 = 3e12;

fn print_event(scene: &Scene, event: &str, time: DoubleDouble, pedestrian: usize, uncertainty: f64) {
    let text = table::confirmed(time, time + uncertainty);
    println!("events:{},{event},{text},{pedestrian},{uncertainty:.1e}", scene.name);
}

fn print_growth(scene: &Scene) -> Result<(), Box<dyn Error>> {
    for (time, direction, factor) in growth(scene, ROUGH, &[Direction::Shift, Direction::Random])? {
        let factor = decimal::format(DoubleDouble::from(factor), 3);
        println!("growth:{},{},{time},{factor}", scene.name, direction.name());
    }
    Ok(())
}

/// All scenes, as processes of this program; what they print becomes the tables that they share.
fn all(folder: &Path) -> Result<(), Box<dyn Error>> {
    let program = std::env::current_exe()?;
    let jobs: Vec<Vec<&str>> =
        NAMES.iter().map(|&name| vec![name]).chain(NAMES.iter().map(|&name| vec![name, "--growth"])).collect();
    let mut printed = String::new();
    for pair in jobs.chunks(AT_ONCE) {
        let start =
            |job: &Vec<&str>| Command::new(&program).args(job).arg("--out").arg(folder).stdout(Stdio::piped()).spawn();
        let children = pair.iter().map(start).collect::<Result<Vec<_>, _>>()?;
        for (job, child) in pair.iter().zip(children) {
            let output = child.wait_with_output()?;
            if !output.status.success() {
                return Err(format!("{} failed", job.join(" ")).into());
            }
            printed += &String::from_utf8(output.stdout)?;
        }
    }
    for (name, header) in SHARED {
        let mut text = format!("{header}\n");
        let prefix = format!("{name}:");
        for row in printed.lines().filter_map(|line| line.strip_prefix(&prefix)) {
            writeln!(text, "{row}")?;
        }
        atomic(&folder.join(format!("{name}.csv")), text.as_bytes())?;
    }
    Ok(())
}

/// Tables with rows of all scenes, and their columns.
const SHARED: [(&str, &str); 3] = [
    ("events", "scene,event,t,n,uncertainty"),
    ("growth", "scene,direction,t,growth"),
    ("agreement", "scene,t,gap,speed"),
];
