//! The program `export SCENE.toml --out DIR ...`: runs a scene with one sample for each frame, and writes its
//! trajectories for other programs.

use checkout::failure::Failure;
use checkout::figure;
use checkout::paths::Paths;
use checkout::print;
use clap::{Parser, ValueEnum};
use files::scene_file;
use files::write::{self, Draft, make_folder};
use interchange::frames::Frames;
use interchange::header::{Header, RATES};
use interchange::{sqlite, text};
use std::path::{Path, PathBuf};

/// What the command line asks for.
#[derive(Debug, Parser)]
#[command(
    name = "export",
    about = "Runs a scene or a figure and writes its trajectories as PedPy and JuPedSim read them"
)]
struct Arguments {
    /// A scene file, or a figure: fig11
    #[arg(value_name = "SCENE|FIGURE")]
    scene: String,
    /// The panel of a scene that has several
    #[arg(long)]
    panel: Option<String>,
    /// Folder for trajectories.txt and trajectories.sqlite; made if missing
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// a_0 in metres, half the length of a standing pedestrian; by default such that the desired speed is 1.2 m/s,
    /// which the paper calls typical: 0.6 for figure 11
    #[arg(long, value_name = "METRES", value_parser = positive, allow_negative_numbers = true)]
    a0: Option<f64>,
    /// tau in seconds, the relaxation time; the default is typical according to the paper
    #[arg(long, value_name = "SECONDS", default_value = "0.5", value_parser = positive, allow_negative_numbers = true)]
    tau: f64,
    /// Frames per second, 1 to 1000; decimals are allowed
    #[arg(long, value_name = "N", default_value = "8", value_parser = rate, allow_negative_numbers = true)]
    fps: f64,
    /// Time at which the run ends, in units of tau; by default that of the scene
    #[arg(long, value_name = "T", value_parser = positive, allow_negative_numbers = true)]
    t_end: Option<f64>,
    /// Only the text that PedPy reads, or only JuPedSim's sqlite file
    #[arg(long)]
    format: Option<Format>,
    /// trajectories.csv of a run that was made before, sampled every 1 / (fps * tau)
    #[arg(long, value_name = "FILE", conflicts_with = "t_end")]
    table: Option<PathBuf>,
    /// The program that runs the scene, when it is not beside this one
    #[arg(long, value_name = "FILE", hide = true)]
    simulate: Option<PathBuf>,
    /// The checkout, for the names of figures
    #[arg(long, hide = true)]
    root: Option<PathBuf>,
}

/// A kind of file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    /// `trajectories.txt`
    Pedpy,
    /// `trajectories.sqlite`
    Jupedsim,
}

fn positive(text: &str) -> Result<f64, String> {
    let number = text.parse().ok().filter(|number: &f64| number.is_finite() && *number > 0.0);
    number.ok_or_else(|| format!("{text}: must be a number above 0"))
}

fn rate(text: &str) -> Result<f64, String> {
    let number = text.parse().ok().filter(|number| RATES.contains(number));
    number.ok_or_else(|| format!("{text}: must be a number from {} to {}", RATES.start(), RATES.end()))
}

fn main() {
    std::process::exit(run(&Arguments::parse()).map_or_else(|failure| failure.tell(), |()| 0));
}

fn run(arguments: &Arguments) -> Result<(), Failure> {
    let scene_file = scene_file::read(&scene(arguments)?)?;
    let panel = match &arguments.panel {
        Some(name) => scene_file.panel(name)?,
        None if scene_file.panels.len() == 1 => &scene_file.panels[0],
        None => {
            return Err(Failure::Usage(format!("{}: has several panels: choose one with --panel", scene_file.file)));
        }
    };
    let header = Header::new(&scene_file, panel, arguments.a0, arguments.tau, arguments.fps)?;
    let folder = tempfile::tempdir().map_err(|error| Failure::Failed(error.to_string()))?;
    let table = match &arguments.table {
        Some(table) => table.clone(),
        None => {
            let simulate = arguments.simulate.clone().map_or_else(beside, Ok)?;
            interchange::run::make(&simulate, &scene_file, panel, &header, arguments.t_end, folder.path())?
        }
    };
    let frames = || Frames::open(&table, header.pedestrians, header.interval());
    make_folder(&arguments.out)?;
    let mut drafts = Vec::new();
    if arguments.format != Some(Format::Jupedsim) {
        let draft = Draft::new(&arguments.out.join("trajectories.txt"))?;
        let rows = text::write(&draft, &header, frames()?)?;
        drafts.push((draft, rows));
    }
    if arguments.format != Some(Format::Pedpy) {
        let draft = Draft::new(&arguments.out.join("trajectories.sqlite"))?;
        let rows = sqlite::write(&draft, &header, frames()?)?;
        drafts.push((draft, rows));
    }
    publish(drafts, &header)
}

/// The scene file that is meant: a file, or that of a figure.
fn scene(arguments: &Arguments) -> Result<PathBuf, Failure> {
    let wanted = &arguments.scene;
    if wanted.ends_with(".toml") || Path::new(wanted).is_file() {
        return Ok(PathBuf::from(wanted));
    }
    let paths = Paths::find(arguments.root.clone())?;
    Ok(paths.root.join(Paths::scene(&figure::find(&figure::discover(&paths)?, wanted)?.slug)))
}

/// `simulate` in the folder of this program.
fn beside() -> Result<PathBuf, Failure> {
    Ok(std::env::current_exe()?.with_file_name(format!("simulate{}", std::env::consts::EXE_SUFFIX)))
}

/// All files or none, unless a rename fails half-way; then what was written, on stdout.
fn publish(drafts: Vec<(Draft, u64)>, header: &Header) -> Result<(), Failure> {
    let mut words = String::new();
    for (draft, rows) in &drafts {
        let (file, frames) = (draft.place().display(), rows / u64::from(header.pedestrians));
        words.push_str(&format!("{file}: {frames} frames of {} pedestrians\n", header.pedestrians));
    }
    write::publish(drafts.into_iter().map(|(draft, _)| draft).collect())?;
    let facts = header.facts();
    let is_unit = |name: &str| ["a_0", "a_0_from", "tau", "ring_length", "desired_speed"].contains(&name);
    let units: Vec<String> =
        facts.iter().filter(|(name, _)| is_unit(name)).map(|(name, value)| format!("{name}: {value}")).collect();
    words.push_str(&format!("{} frames a second; {}\n", header.rate, units.join("; ")));
    print::out(&words)
}
