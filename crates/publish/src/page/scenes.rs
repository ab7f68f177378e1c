//! The parameters of a figure, read from its scene.

use super::html::symbol;
use files::scene_file::{Panel, SceneFile};
use std::collections::BTreeMap;

/// Keys that say how a scene is computed or drawn, not what is.
const TECHNICAL: [&str; 4] = ["run.record", "run.method", "map.value", "curve.value"];

/// The values of a panel by dotted key, as text.
pub fn values(panel: &Panel) -> BTreeMap<String, String> {
    let text = panel.determinants();
    let pairs = text.lines().filter_map(|line| line.split_once(" = "));
    pairs.map(|(key, value)| (key.to_owned(), plain(value))).collect()
}

/// `3.0` as `3`, `"taylor"` as `taylor`.
fn plain(value: &str) -> String {
    let value = value.trim_matches('"');
    value.strip_suffix(".0").unwrap_or(value).to_owned()
}

/// The values that all panels share.
pub fn shared(scene_file: &SceneFile) -> BTreeMap<String, String> {
    let mut panels = scene_file.panels.iter().map(values);
    let mut shared = panels.next().unwrap_or_default();
    for other in panels {
        shared.retain(|key, value| other.get(key) == Some(value));
    }
    shared
}

/// What distinguishes a panel from the others: `μ = 0.45`; empty for a single panel.
pub fn difference(scene_file: &SceneFile, panel: &Panel) -> String {
    let shared = shared(scene_file);
    let mine = values(panel);
    let own = mine.iter().filter(|(key, _)| !shared.contains_key(*key) && is_parameter(key));
    own.map(|(key, value)| equation(key, value)).collect::<Vec<_>>().join(", ")
}

/// `μ = 0.45`, in one piece.
pub fn equation(key: &str, value: &str) -> String {
    format!("{}\u{a0}=\u{a0}{value}", name(key))
}

/// Whether a key belongs to the model, not to axes or to the method.
fn is_parameter(key: &str) -> bool {
    !key.starts_with("map.") && !TECHNICAL.contains(&key)
}

/// The symbol of a dotted key.
pub fn name(key: &str) -> String {
    let last = key.rsplit('.').next().unwrap_or(key);
    match key {
        "law.kind" => "law".to_owned(),
        "run.t_end" => "end of the run".to_owned(),
        "run.sample" => "time between samples".to_owned(),
        "run.record" => "what is recorded".to_owned(),
        _ if key.starts_with("map.x.") => format!("horizontal axis: {last}"),
        _ if key.starts_with("map.y.") => format!("vertical axis: {last}"),
        _ if last.len() <= 2 || symbol(last) != last => symbol(last),
        _ => last.to_owned(),
    }
}

/// A row for each value: symbol, value, panel, key, origin.
pub fn rows(scene_file: &SceneFile) -> Vec<[String; 5]> {
    let shared = shared(scene_file);
    let origin = |key: &str| {
        let found = scene_file.origin.iter().find(|(name, _)| name == key);
        found.map_or(String::new(), |(_, origin)| origin.clone())
    };
    let row = |panel: &str, (key, value): (&String, &String)| {
        [name(key), value.clone(), panel.to_owned(), key.clone(), origin(key)]
    };
    let mut rows: Vec<[String; 5]> = shared.iter().map(|pair| row("all", pair)).collect();
    for panel in &scene_file.panels {
        let mine = values(panel);
        let own = mine.iter().filter(|(key, _)| !shared.contains_key(*key));
        rows.extend(own.map(|pair| row(&panel.name.replace('_', " "), pair)));
    }
    rows
}
