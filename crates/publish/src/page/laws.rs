//! The scenes offered as starting points: those of the gallery, and the runs of the figures.

use super::figures::name;
use super::source::Source;
use checkout::failure::Failure;
use files::reader::{Section, Value as Toml};
use files::scene_file::{self, Kind, Panel, SceneFile};
use serde_json::{Value, json};

/// The folder of the gallery.
const GALLERY: &str = "scenes/gallery";

/// Every run, one for each panel: `name`, `source`, `origin` (of a run of the paper: figure and panel), and the tables
/// `law`, `ring`, `start`, `uniform`, `run` as lists of key and value in the order of the file.
///
/// # Errors
/// A scene of the gallery is missing or malformed.
pub fn presets(source: &Source<'_>) -> Result<Value, Failure> {
    let mut groups = Vec::new();
    let of_paper = source.figures.iter().filter(|figure| !figure.is_supplement()).filter_map(|figure| {
        let scene_file = figure.scene_file.as_ref().ok()?;
        Some(runs(scene_file, &format!("{}: {}", name(figure), scene_file.title), Some(&figure.id)))
    });
    groups.push(json!({ "name": "Runs of the paper", "scenes": of_paper.flatten().collect::<Vec<Value>>() }));
    let mut files: Vec<_> = std::fs::read_dir(source.paths.root.join(GALLERY))
        .map_err(Failure::at(&source.paths.root.join(GALLERY)))?
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| path.extension().is_some_and(|ending| ending == "toml"))
        .collect();
    files.sort();
    let mut gallery = Vec::new();
    for file in files {
        let scene_file = scene_file::read(&file).map_err(|error| Failure::failed(error.to_string()))?;
        gallery.extend(runs(&scene_file, &scene_file.title, None));
    }
    groups.push(json!({ "name": "Gallery of published laws", "scenes": gallery }));
    Ok(Value::Array(groups))
}

/// `figure`: the figure of the paper to which the run belongs.
fn runs(scene_file: &SceneFile, title: &str, figure: Option<&str>) -> Vec<Value> {
    let panels: Vec<&Panel> = scene_file.panels.iter().filter(|panel| panel.kind == Kind::Run).collect();
    let one = |panel: &&Panel| {
        let name = match panels.len() {
            1 => title.to_owned(),
            _ => format!("{title} ({})", panel.name.replace(['_', '-'], " ")),
        };
        let table = |key: &str| panel.tables.section(key).map_or_else(Vec::new, entries);
        json!({
            "name": name, "title": scene_file.title, "source": scene_file.source, "law": table("law"), "ring": table("ring"),
            "start": table("start"), "uniform": table("uniform"), "run": table("run"),
            "origin": figure.map(|figure| format!("{figure} {}", panel.name)),
        })
    };
    panels.iter().map(one).collect()
}

/// Key and value of each entry that is a number or a text, in the order of the file.
fn entries(section: &Section) -> Vec<(String, Value)> {
    let mut entries: Vec<_> = section.entries.iter().collect();
    entries.sort_by_key(|(_, entry)| entry.place);
    let value = |value: &Toml| match value {
        Toml::Number(number) => Some(json!(number)),
        Toml::Text(text) => Some(json!(text)),
        Toml::Flag(_) | Toml::Section(_) | Toml::Other(_) => None,
    };
    entries.into_iter().filter_map(|(key, entry)| Some((key.clone(), value(&entry.value)?))).collect()
}
