//! `export`: runs a scene with a sample for each frame, then writes the trajectories for other programs.

use super::forward;
use crate::child;
use crate::cli::{ExportArgs, Format};
use crate::disk;
use crate::failure::Failure;
use crate::figure;
use crate::lock::Lock;
use crate::paths::{Paths, RUN_TABLES};
use files::recipe::{self, Panel};
use std::path::{Path, PathBuf};
use std::process::Command;

/// The command that builds the program that writes the files: in no other build, since it compiles SQLite.
const BUILD: &str = "build --quiet --release --locked -p interchange";

/// Runs the verb; paths among the arguments are relative to the current folder.
///
/// # Errors
/// Usage: no such scene, figure or panel; no run in it. Failed: a program cannot be built, a file not be
/// written.
pub fn run(paths: &Paths, arguments: &ExportArgs) -> Result<(), Failure> {
    let scene = scene(paths, &arguments.scene)?;
    refuse_too_many(&scene, arguments)?;
    build(paths)?;
    let folder = paths.exported();
    let result = simulate(paths, &scene, arguments, &folder).and_then(|table| write(paths, &scene, arguments, &table));
    disk::remove(&folder)?;
    result
}

/// The scene file that is meant: a file, or that of a figure.
///
/// # Errors
/// Usage: no such figure.
pub fn scene(paths: &Paths, wanted: &str) -> Result<PathBuf, Failure> {
    let is_file = wanted.ends_with(".toml") || Path::new(wanted).is_file();
    if is_file {
        return Ok(PathBuf::from(wanted));
    }
    let all = figure::discover(paths)?;
    Ok(paths.root.join(Paths::scene(&figure::find(&all, wanted)?.slug)))
}

/// As many rows as a run may have.
const MOST_ROWS: f64 = 2e7;

/// Refuses a frame rate that gives more rows than a run may have: `simulate` would speak of samples, which nobody asked for.
fn refuse_too_many(scene: &Path, arguments: &ExportArgs) -> Result<(), Failure> {
    let Some(determinants) = meant(scene, arguments)? else { return Ok(()) };
    let number = |key: &str| {
        let value = determinants.lines().find_map(|line| line.strip_prefix(key)?.strip_prefix(" = "));
        value.and_then(|value| value.parse::<f64>().ok())
    };
    let end = arguments.t_end.or_else(|| number("run.t_end"));
    // what is missing is told by `simulate`
    let (Some(pedestrians), Some(end)) = (number("ring.pedestrians"), end) else { return Ok(()) };
    let (fps, tau) = (arguments.fps, arguments.tau);
    let most = MOST_ROWS / (pedestrians * end * tau);
    if fps <= most {
        return Ok(());
    }
    let rows = pedestrians * end * tau * fps;
    Err(Failure::Usage(format!(
        "--fps {fps:?}: {pedestrians} pedestrians up to t = {end:?} ({:?} s) are {rows:.3e} rows, more than {MOST_ROWS:e}; \
         at most {most:.4} frames a second, or an earlier end (--t-end)",
        end * tau
    )))
}

/// What determines the numbers of the panel that is meant; nothing where none is, which `simulate` says.
fn meant(scene: &Path, arguments: &ExportArgs) -> Result<Option<String>, Failure> {
    let recipe = recipe::read(scene).map_err(|error| Failure::Usage(error.to_string()))?;
    let is_meant =
        |panel: &&Panel| arguments.panel.as_ref().map_or(recipe.panels.len() == 1, |name| *name == panel.name);
    Ok(recipe.panels.iter().find(is_meant).map(Panel::determinants))
}

/// Builds what runs scenes and what writes the files.
///
/// # Errors
/// A program cannot be built.
pub fn build(paths: &Paths) -> Result<(), Failure> {
    forward::build(paths)?;
    let _lock = Lock::take(paths)?;
    let mut cargo = child::cargo();
    cargo.args(BUILD.split(' ')).current_dir(&paths.root).env("CARGO_TARGET_DIR", &paths.target);
    child::run_shown(&mut cargo).map_err(|failure| match failure {
        Failure::Child(code) => Failure::Failed(format!("cargo {BUILD}: exit code {code}")),
        other => other,
    })
}

/// Runs the scene into `folder`; its table of trajectories, with a sample every `1 / (fps tau)`: the frames fall on
/// whole multiples of `1 / fps` seconds.
///
/// # Errors
/// The run fails.
pub fn simulate(paths: &Paths, scene: &Path, arguments: &ExportArgs, folder: &Path) -> Result<PathBuf, Failure> {
    let interval = 1.0 / (arguments.fps * arguments.tau);
    let mut program = Command::new(paths.binary("simulate"));
    match with_trajectories(scene, arguments)? {
        Some(text) => {
            let file = folder.join("scene.toml");
            disk::write(&file, text.as_bytes())?;
            program.arg(file);
        }
        None => {
            program.arg(scene).args(arguments.panel.iter().flat_map(|panel| ["--panel", panel]));
        }
    }
    program.arg("--tables-only").arg("--out").arg(folder).arg("--sample").arg(format!("{interval:?}"));
    program.args(arguments.t_end.iter().flat_map(|end| ["--t-end".to_owned(), format!("{end:?}")]));
    child::run_shown(&mut program)?;
    Ok(folder.join(RUN_TABLES[1]))
}

/// A scene of the chosen panel alone that keeps its trajectories; `None` when the scene as it is does so (or has no
/// panel that is meant, which `simulate` will say).
fn with_trajectories(scene: &Path, arguments: &ExportArgs) -> Result<Option<String>, Failure> {
    const STD: &str = "run.record = \"std\"";
    let determinants = meant(scene, arguments)?.unwrap_or_default();
    let is_left_out = determinants.lines().any(|line| line == STD);
    Ok(is_left_out.then(|| determinants.replace(STD, "run.record = \"trajectories\"")))
}

/// Writes the files from the table of a run.
///
/// # Errors
/// They cannot be written.
pub fn write(paths: &Paths, scene: &Path, arguments: &ExportArgs, table: &Path) -> Result<(), Failure> {
    let mut program = Command::new(paths.binary("export"));
    program.arg("--scene").arg(scene).arg("--table").arg(table).arg("--out").arg(&arguments.out);
    program.args(["--tau", &format!("{:?}", arguments.tau), "--fps", &format!("{:?}", arguments.fps)]);
    program.args(arguments.a0.iter().flat_map(|a0| ["--a0".to_owned(), format!("{a0:?}")]));
    program.args(arguments.panel.iter().flat_map(|panel| ["--panel", panel]));
    program.args(arguments.format.iter().flat_map(|format| {
        let name = match format {
            Format::Pedpy => "pedpy",
            Format::Jupedsim => "jupedsim",
        };
        ["--format", name]
    }));
    child::run_shown(&mut program)
}
