//! Writes the table of a run for other programs: `export --scene SCENE.toml --table trajectories.csv --out DIR ...`;
//! `cargo xtask export` makes the table first.

use clap::{Parser, ValueEnum};
use files::recipe;
use files::write::{self, Draft, with_path};
use interchange::Problem;
use interchange::frames::Frames;
use interchange::header::{Header, RATES};
use interchange::{sqlite, text};
use std::io::Write as _;
use std::path::PathBuf;
use std::process::ExitCode;

/// What the command line asks for.
#[derive(Debug, Parser)]
#[command(name = "export", about = "Writes the trajectories of a run as PedPy and JuPedSim read them")]
struct Arguments {
    /// The scene file of the run
    #[arg(long, value_name = "FILE")]
    scene: PathBuf,
    /// The panel of a scene that has several
    #[arg(long)]
    panel: Option<String>,
    /// trajectories.csv of the run, sampled every 1 / (fps * tau)
    #[arg(long, value_name = "FILE")]
    table: PathBuf,
    /// Folder for trajectories.txt and trajectories.sqlite; made if missing
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// a_0 in metres; by default such that the desired speed is 1.2 m/s, which the paper calls typical
    #[arg(long, value_name = "METRES", value_parser = positive, allow_negative_numbers = true)]
    a0: Option<f64>,
    /// tau in seconds
    #[arg(long, value_name = "SECONDS", value_parser = positive, allow_negative_numbers = true)]
    tau: f64,
    /// Frames a second
    #[arg(long, value_name = "N", value_parser = rate, allow_negative_numbers = true)]
    fps: f64,
    /// Only the text that PedPy reads, or only JuPedSim's sqlite file
    #[arg(long)]
    format: Option<Format>,
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

fn main() -> ExitCode {
    match run(&Arguments::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(problem) => {
            eprintln!("error: {problem}");
            ExitCode::from(problem.code())
        }
    }
}

fn run(arguments: &Arguments) -> Result<(), Problem> {
    let recipe = recipe::read(&arguments.scene)?;
    let panel = match &arguments.panel {
        Some(name) => recipe.panel(name)?,
        None if recipe.panels.len() == 1 => &recipe.panels[0],
        None => return Err(Problem::Input(format!("{}: has several panels: choose one with --panel", recipe.file))),
    };
    let header = Header::new(&recipe, panel, arguments.a0, arguments.tau, arguments.fps)?;
    let frames = || Frames::open(&arguments.table, header.pedestrians, header.interval());
    std::fs::create_dir_all(&arguments.out).map_err(|error| with_path(error, &arguments.out))?;
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

/// All files or none, unless a rename fails half-way; then what was written, on stdout.
fn publish(drafts: Vec<(Draft, u64)>, header: &Header) -> Result<(), Problem> {
    let mut words = String::new();
    for (draft, rows) in &drafts {
        let (file, frames) = (draft.place().display(), rows / u64::from(header.pedestrians));
        words.push_str(&format!("{file}: {frames} frames of {} pedestrians\n", header.pedestrians));
    }
    write::publish(drafts.into_iter().map(|(draft, _)| draft).collect())?;
    let facts = header.facts();
    let fact = |name| facts.iter().find(|(known, _)| *known == name).map_or("", |(_, value)| value);
    let units =
        ["a_0", "a_0_from", "tau", "ring_length", "desired_speed"].map(|name| format!("{name}: {}", fact(name)));
    words.push_str(&format!("{} frames a second; {}\n", header.rate, units.join("; ")));
    match std::io::stdout().write_all(words.as_bytes()) {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => Err(Problem::Work(format!("stdout: {error}"))),
        _ => Ok(()),
    }
}
