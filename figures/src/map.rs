//! The stability map of a user's scene: table and picture.

use crate::failure::{Failure, print, say};
use crate::outputs;
use crate::panels::{Labels, map_panel};
use crate::uniform;
use clap::Parser;
use files::scene_file::{self, Kind, SceneFile};
use files::write::{atomic_all, make_folder};
use plot::style::COLUMN_WIDTH;
use plot::{ColorScale, Picture};
use scene::map::{Computed, Value};
use scene::summary;
use scene::uniform::stability;
use serde_json::json;
use std::path::PathBuf;

/// What the command line asks for.
#[derive(Debug, Parser)]
#[command(name = "map", about = "Computes the stability maps of a scene and writes tables and pictures")]
pub struct Arguments {
    /// The scene file
    scene: PathBuf,
    /// Folder for PANEL.csv, PANEL.png, PANEL.svg; made if missing
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Tables only, no pictures
    #[arg(long)]
    tables_only: bool,
    /// Print a summary as JSON
    #[arg(long)]
    json: bool,
}

/// The files of a panel.
const ENDINGS: [&str; 3] = ["csv", "svg", "png"];

/// Computes the maps and writes what was asked for.
///
/// # Errors
/// A bad scene (nothing is written), or a file that cannot be written.
pub fn main(arguments: &Arguments) -> Result<(), Failure> {
    let parsed = scene_file::read(&arguments.scene)?;
    let panels: Vec<_> = parsed.panels.iter().filter(|panel| panel.kind == Kind::Map).collect();
    let files_of = |folder: &PathBuf, name: &str| ENDINGS.map(|ending| folder.join(format!("{name}.{ending}")));
    let in_folder = |folder| panels.iter().flat_map(move |panel| files_of(folder, &panel.name));
    let results: Vec<PathBuf> = arguments.out.iter().flat_map(in_folder).collect();
    outputs::can_write(&arguments.scene, arguments.out.as_deref(), &results)?;
    if panels.is_empty() {
        return points(&parsed, arguments);
    }
    let mut computed = Vec::new();
    for panel in panels {
        let map = scene::map::read(&parsed.file, &panel.tables)?;
        let numbers = map.compute().map_err(|problem| Failure::input(format!("{}: {problem}", parsed.file)))?;
        computed.push((panel.name.as_str(), map, numbers));
    }
    let (mut files, mut summaries, mut words) = (Vec::new(), Vec::new(), Vec::new());
    for (name, map, numbers) in &computed {
        let [_, _, value] = map.columns();
        let values = numbers.table.column(value)?;
        let unstable = numbers.unstable_share();
        let (cells, error) = (values.len() + numbers.blank.len(), numbers.error);
        summaries.push(summary::of_map(name, map, numbers));
        let note = numbers.blank_reason().map_or(String::new(), |reason| format!("; {reason}"));
        words.push(format!("{name}: {cells} cells, {:.1} % unstable, error {error:.1e}{note}", 100.0 * unstable));
        let Some(folder) = &arguments.out else { continue };
        files.push((folder.join(format!("{name}.csv")), numbers.to_csv(map)));
        if !arguments.tables_only {
            let rendered = picture(map, numbers, &values)?.render().map_err(Failure::work)?;
            files.push((folder.join(format!("{name}.svg")), rendered.svg));
            files.push((folder.join(format!("{name}.png")), rendered.png));
        }
    }
    if let Some(folder) = &arguments.out {
        make_folder(folder)?;
        atomic_all(&files)?;
    }
    print(&if arguments.json {
        json!({ "schema_version": 1, "maps": summaries }).to_string()
    } else {
        words.join("\n")
    })
}

/// Of a scene that is run, the stability of its uniform flow: a map of one point. Nothing is written.
fn points(parsed: &SceneFile, arguments: &Arguments) -> Result<(), Failure> {
    let (mut summaries, mut words) = (Vec::new(), Vec::new());
    for panel in parsed.panels.iter().filter(|panel| panel.kind == Kind::Run) {
        let scene = scene::run::read_unrun(&parsed.file, &panel.tables)?;
        let (speed, flow) = (scene.steady_speed, stability(&scene));
        summaries.push(
            json!({ "panel": panel.name, "steady_speed": speed, "uniform_flow": summary::of_flow(flow.as_ref()) }),
        );
        words.push(format!("{}: {}", panel.name, uniform::in_words(flow.as_ref(), scene.ring.pedestrians)));
    }
    if words.is_empty() {
        return Err(Failure::input(format!("{}: has neither [map] nor [run]", parsed.file)));
    }
    if let Some(folder) = &arguments.out {
        say(&format!("{}: has no [map]; nothing is written to {}", parsed.file, folder.display()));
    }
    print(&if arguments.json {
        json!({ "schema_version": 1, "points": summaries }).to_string()
    } else {
        words.join("\n")
    })
}

fn picture(map: &scene::map::Map, numbers: &Computed, values: &[f64]) -> Result<Picture, Failure> {
    let symbol = match map.value {
        Value::Margin => "margin",
        Value::Criterion => "$\\Phi$",
        Value::GrowthRate => "$\\mathrm{Re}\\,z^+$",
    };
    let panel = map_panel(map, &numbers.values(), Labels { horizontal: true, vertical: true })?;
    let picture = Picture::new(COLUMN_WIDTH, 70.0).scale(ColorScale::diverging(symbol, values.iter().copied()));
    Ok(match title(numbers) {
        None => picture.panel(panel),
        Some(title) => picture.titled(&title, panel),
    })
}

/// What grey cells are, if there are any; short enough for the width of a picture.
fn title(numbers: &Computed) -> Option<String> {
    let inexact = numbers.blank.len() - numbers.undefined;
    let percent = |count: usize| format!("{:.1} %", 100.0 * numbers.share(count));
    match (inexact, numbers.undefined) {
        (0, 0) => None,
        (0, undefined) => Some(format!("grey, {}: no uniform flow, or no value", percent(undefined))),
        (inexact, 0) => Some(format!("grey, {}: criterion not exact to 0.1 %", percent(inexact))),
        (inexact, undefined) => Some(format!("grey: {} inexact, {} no value", percent(inexact), percent(undefined))),
    }
}
