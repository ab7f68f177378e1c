//! Has `simulate` make the run to export, with one sample for each frame.

use crate::header::Header;
use checkout::failure::Failure;
use files::scene_file::{Panel, SceneFile};
use std::path::{Path, PathBuf};
use std::process::Command;

/// As many rows as a run may have.
const MOST_ROWS: f64 = 2e7;

/// Runs the panel into `folder`; its table of trajectories. `t_end` is in units of `tau`, by default that of the scene.
///
/// # Errors
/// Input: the frames are more rows than a run may have, or `simulate` refuses the scene. Otherwise what kept the run
/// from being made.
pub fn make(
    simulate: &Path,
    scene_file: &SceneFile,
    panel: &Panel,
    header: &Header,
    t_end: Option<f64>,
    folder: &Path,
) -> Result<PathBuf, Failure> {
    let determinants = panel.determinants();
    refuse_too_many(&determinants, header, t_end)?;
    let mut program = Command::new(simulate);
    match with_trajectories(&determinants) {
        Some(text) => {
            let file = folder.join("scene.toml");
            files::write::atomic(&file, text.as_bytes())?;
            program.arg(file);
        }
        None => {
            program.arg(&scene_file.file).args(["--panel", &panel.name]);
        }
    }
    program
        .arg("--tables-only")
        .arg("--no-check")
        .arg("--out")
        .arg(folder)
        .arg("--sample")
        .arg(format!("{:?}", header.interval()));
    program.args(t_end.iter().flat_map(|end| ["--t-end".to_owned(), format!("{end:?}")]));
    let output = program.output().map_err(|error| Failure::Failed(format!("{}: {error}", simulate.display())))?;
    let words = String::from_utf8_lossy(&output.stderr);
    let words = words.trim().trim_start_matches("error: ").to_owned();
    match output.status.code() {
        Some(0) => Ok(folder.join("trajectories.csv")),
        Some(2) => Err(Failure::Usage(words)),
        _ => Err(Failure::Failed(words)),
    }
}

/// A scene of the panel alone that keeps its trajectories; `None` when the scene as it is does so.
fn with_trajectories(determinants: &str) -> Option<String> {
    const STD: &str = "run.record = \"std\"";
    let is_left_out = determinants.lines().any(|line| line == STD);
    is_left_out.then(|| determinants.replace(STD, "run.record = \"trajectories\""))
}

/// Refuses a frame rate that gives more rows than a run may have: the message of `simulate` would speak of samples,
/// which the user did not ask for.
fn refuse_too_many(determinants: &str, header: &Header, t_end: Option<f64>) -> Result<(), Failure> {
    let scenes = determinants.lines().find_map(|line| line.strip_prefix("run.t_end = ")?.parse::<f64>().ok());
    // what is missing is told by `simulate`
    let Some(end) = t_end.or(scenes) else { return Ok(()) };
    let (fps, pedestrians, seconds) = (header.rate, header.pedestrians, end * header.units.time);
    let most = MOST_ROWS / (f64::from(pedestrians) * seconds);
    if fps <= most {
        return Ok(());
    }
    let rows = f64::from(pedestrians) * seconds * fps;
    Err(Failure::Usage(format!(
        "--fps {fps:?}: {pedestrians} pedestrians up to t = {end:?} ({seconds:?} s) are {rows:.3e} rows, more than \
         {MOST_ROWS:e}; at most {most:.4} frames a second, or an earlier end (--t-end)"
    )))
}
