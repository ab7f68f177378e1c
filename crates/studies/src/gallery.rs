//! The gallery's contact sheet: one run of every law, position over time, coloured by speed.

use clap::Parser;
use figures::failure::{Failure, print};
use figures::panels::trajectories;
use files::scene_file;
use files::write::atomic_all;
use jam::run::{Outcome, run};
use plot::style::FULL_WIDTH;
use plot::{Axis, ColorScale, Picture, SpaceTime, Trajectory};
use scene::tables;
use std::path::{Path, PathBuf};

/// What the command line asks for.
#[derive(Debug, Parser)]
#[command(name = "gallery", about = "Runs the scenes of the gallery and draws their contact sheet")]
pub struct Arguments {
    /// Folder of the scenes; sheet.png and sheet.svg are written there, too
    #[arg(default_value = "scenes/gallery")]
    folder: PathBuf,
}

/// File, panel, a title short enough for a third of the page, and the part of the run after which it is drawn: waves
/// that grow from very little are seen late.
pub const RUNS: [(&str, &str, &str, f64); 12] = [
    ("optimal-velocity", "two-phases", "Optimal velocity", 0.0),
    ("full-velocity-difference", "main", "Full velocity difference", 0.0),
    ("follow-the-leader", "main", "Follow the leader", 0.0),
    ("intelligent-driver", "calm", "Intelligent driver", 0.2),
    ("mean-spacing", "main", "Mean spacing of three", 0.2),
    ("summed-force", "main", "Fifteen summed forces", 0.75),
    ("predecessor-and-follower", "main", "Predecessor and follower", 0.4),
    ("seyfried", "n15", "Seyfried, Steffen, Lippert", 0.2),
    ("social-force", "main", "Social force", 0.3),
    ("algebraic", "plain", "Algebraic", 0.85),
    ("exponential", "plain", "Exponential", 0.7),
    ("logarithmic", "plain", "Logarithmic", 0.0),
];

/// Draws the sheet.
///
/// # Errors
/// A scene that is missing or does not run, or a folder that cannot be written to.
pub fn main(arguments: &Arguments) -> Result<(), Failure> {
    let scale = ColorScale::sequential("speed, slow (0) to fast (1) in each run", [0.0, 1.0]);
    let mut picture = Picture::new(FULL_WIDTH, 190.0).columns(3).scale(scale);
    for (file, panel, title, part) in RUNS {
        picture = picture.titled(title, space_time(&arguments.folder.join(format!("{file}.toml")), panel, part)?);
    }
    let rendered = picture.render().map_err(Failure::work)?;
    let place = |extension: &str| arguments.folder.join(format!("sheet.{extension}"));
    atomic_all(&[(place("png"), rendered.png), (place("svg"), rendered.svg)])?;
    print(&format!("{}, {}", place("png").display(), place("svg").display()))
}

fn space_time(file: &Path, panel: &str, part: f64) -> Result<SpaceTime, Failure> {
    let parsed = scene_file::read(file)?;
    let mut scene = scene::run::read(&parsed.file, &parsed.panel(panel)?.tables)?;
    scene.keeps_trajectories = true;
    let outcome = run(&scene).map_err(Failure::work)?;
    let end = outcome.samples.last().map_or(scene.t_end, |sample| sample.time);
    let times = Axis::linear("$t$", part * end, end).steps(3);
    let places = Axis::linear("$x$", 0.0, scene.ring.length).steps(2);
    let shaded = shaded(&outcome, part * end, end)?;
    Ok(SpaceTime::new(times, places, scene.ring.length, &shaded).field())
}

/// The trajectories with speeds from 0 to 1: nearly the least and nearly the largest that are drawn, but for the start,
/// when all stand.
fn shaded(outcome: &Outcome, begin: f64, end: f64) -> Result<Vec<Trajectory>, Failure> {
    const START: f64 = 0.2;
    const RARE: f64 = 0.01;
    let mut all = trajectories(&tables::trajectories(&outcome.samples))?;
    let from = if begin > START * end { begin } else { START * end };
    let drawn = all.iter().flatten().filter(|[t, ..]| *t >= from).map(|[.., v]| *v);
    let mut drawn: Vec<f64> = drawn.collect();
    drawn.sort_unstable_by(f64::total_cmp);
    let at = |part: f64| drawn[(part * (drawn.len() - 1) as f64) as usize];
    let (least, largest) = (at(RARE), at(1.0 - RARE));
    for [.., v] in all.iter_mut().flatten() {
        *v = ((*v - least) / (largest - least)).clamp(0.0, 1.0);
    }
    Ok(all)
}
