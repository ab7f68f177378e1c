//! Classifies the runs of a plane from the command line: the whole plane, one shard, or the table and picture of all
//! shards.

mod gather;
mod journal;
mod work;

use figures::failure::{Failure, print};
use figures::outputs::can_write;
use files::scene_file::{self, Kind, SceneFile};
use files::write::{make_folder, sha256, sha256_file};
use journal::Shard;
use serde_json::json;
use std::path::PathBuf;
use sweep::Sweep;
use sweep::tiles::tiles;

/// What the command line asks for.
#[derive(Debug, clap::Parser)]
#[command(name = "sweep", about = "Classifies the runs of a plane by outcome; writes a table and its picture")]
pub struct Arguments {
    /// The scene file, with [sweep]
    scene: PathBuf,
    /// The panel of a scene that has several
    #[arg(long)]
    panel: Option<String>,
    /// Folder for cells.csv, sweep.png, sweep.svg, summary.json, SHA256SUMS and shards; made if missing
    #[arg(long, value_name = "DIR", required_unless_present = "dry_run")]
    out: Option<PathBuf>,
    /// Compute only this part of the plane, into DIR/shards/I-of-N.csv
    #[arg(long, value_name = "I/N", value_parser = shard, conflicts_with = "gather")]
    shard: Option<(usize, usize)>,
    /// Gather the shards in DIR: table, picture, sums
    #[arg(long)]
    gather: bool,
    /// Number of threads [default: number of processors]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    jobs: Option<u16>,
    /// Print the number of cells, the time they take, and the command of each shard; compute nothing
    #[arg(long)]
    dry_run: bool,
    /// Table only, no picture
    #[arg(long)]
    tables_only: bool,
    /// Print a summary as JSON
    #[arg(long)]
    json: bool,
    /// What the program was built from; of another one no cell is taken
    #[arg(long, hide = true)]
    program: Option<String>,
}

/// `3/64`, the number of a shard from 1.
fn shard(text: &str) -> Result<(usize, usize), String> {
    let valid = || format!("{text}: must be I/N with 1 <= I <= N, as 3/64");
    let (index, count) = text.split_once('/').ok_or_else(valid)?;
    let number = |text: &str| text.parse::<usize>().map_err(|_| valid());
    let (index, count) = (number(index)?, number(count)?);
    if (1..=count).contains(&index) && count <= 1_000_000 { Ok((index, count)) } else { Err(valid()) }
}

/// A sweep with the hash of what determines it.
pub(crate) struct Task {
    pub(crate) parsed: SceneFile,
    pub(crate) sweep: Sweep,
    /// The SHA-256 of scene and program.
    pub(crate) hash: String,
    pub(crate) out: PathBuf,
}

/// Does what was asked for.
///
/// # Errors
/// A bad scene, or shards of another one (nothing is written); a file that cannot be written; missing shards.
pub fn main(arguments: &Arguments) -> Result<(), Failure> {
    let task = read(arguments)?;
    let jobs = arguments.jobs.map_or_else(|| std::thread::available_parallelism().map_or(1, usize::from), usize::from);
    if arguments.dry_run {
        return dry_run(&task, arguments, jobs);
    }
    let results = gather::OUTPUTS.map(|name| task.out.join(name));
    can_write(&arguments.scene, Some(&task.out), &results)?;
    if arguments.gather {
        return gather::gather(&task, arguments);
    }
    let (index, count) = arguments.shard.unwrap_or((1, 1));
    let tiles = tiles(&task.sweep).len();
    if count > tiles {
        let problem = format!("--shard {index}/{count}: the plane has {tiles} tiles; there must be no more shards");
        return Err(Failure::input(problem));
    }
    let shard = Shard { index, count };
    let shards = task.out.join("shards");
    make_folder(&shards)?;
    let computed = work::run(&task, shard.tiles(&task), jobs, &shard)?;
    match arguments.shard {
        None => gather::gather(&task, arguments),
        Some(_) if arguments.json => {
            print(&json!({ "schema_version": 1, "shard": index, "of": count, "cells": computed }).to_string())
        }
        Some(_) => print(&format!("shard {index} of {count}: {computed} cells")),
    }
}

fn read(arguments: &Arguments) -> Result<Task, Failure> {
    let parsed = scene_file::read(&arguments.scene)?;
    let mut panels = parsed.panels.iter().filter(|panel| panel.kind == Kind::Sweep);
    let panel = match (&arguments.panel, panels.next(), panels.next()) {
        (Some(name), ..) => parsed.panel(name)?,
        (None, Some(panel), None) => panel,
        (None, None, _) => return Err(Failure::input(format!("{}: has no [sweep]", parsed.file))),
        (None, Some(_), Some(_)) => {
            let names: Vec<&str> = parsed.panels.iter().map(|panel| panel.name.as_str()).collect();
            return Err(Failure::input(format!("{}: choose one with --panel: {}", parsed.file, names.join(", "))));
        }
    };
    let sweep = sweep::read(&parsed.file, &panel.tables)?;
    let program = match &arguments.program {
        Some(program) => program.clone(),
        None => sha256_file(&std::env::current_exe()?)?,
    };
    let mut lines = vec![program];
    panel.tables.canonical("", &mut lines);
    let hash = sha256(lines.join("\n").as_bytes());
    let out = arguments.out.clone().unwrap_or_default();
    Ok(Task { parsed, sweep, hash, out })
}

/// Seconds of a shard, at most and of one thread: what an engine adds to each is small beside it.
const OF_A_SHARD: f64 = 600.0;

/// Cells and seconds before anything is computed: some cells are, spread over the plane, and timed.
fn dry_run(task: &Task, arguments: &Arguments, jobs: usize) -> Result<(), Failure> {
    let sweep = &task.sweep;
    let (cells, tiles) = (sweep.cells(), tiles(sweep));
    let borders = work::least_cells(sweep)?;
    let seconds = work::seconds_of_a_cell(sweep)?;
    let [least, most] = [borders, cells].map(|cells| seconds * cells as f64 / jobs as f64);
    let minutes = (most * jobs as f64 / OF_A_SHARD).ceil() as usize;
    let count = arguments.shard.map_or_else(|| minutes.clamp(1, tiles.len()), |(_, count)| count);
    if arguments.json {
        let range = [if sweep.refine { least } else { most }, most];
        let words = json!({ "schema_version": 1, "cells": cells, "computed_at_least": borders, "tiles": tiles.len(), "seconds": range });
        return print(&words.to_string());
    }
    let mut text = format!("{cells} cells in {} tiles; ", tiles.len());
    text += &if sweep.refine {
        format!("at least {borders} are computed: {least:.0} to {most:.0} s with {jobs} threads")
    } else {
        format!("all are computed: about {most:.0} s with {jobs} threads")
    };
    let scene = arguments.scene.display();
    text +=
        &format!("\nshards: for i in $(seq {count}); do cargo xtask sweep {scene} --out DIR --shard $i/{count}; done");
    text += &format!("\nthen: cargo xtask sweep {scene} --out DIR --gather");
    print(&text)
}
