//! The scene files of the figures and the examples.

use crate::project::{figure, figures, root};
use files::reader::{Section, Value};
use files::scene_file::{self, Kind, SceneFile};

/// Reads every panel as the figure's program does.
fn read(parsed: &SceneFile) {
    for panel in &parsed.panels {
        match panel.kind {
            Kind::Run => drop(scene::run::read(&parsed.file, &panel.tables).unwrap_or_else(|error| panic!("{error}"))),
            Kind::Map => drop(scene::map::read(&parsed.file, &panel.tables).unwrap_or_else(|error| panic!("{error}"))),
            Kind::Sweep => drop(sweep::read(&parsed.file, &panel.tables).unwrap_or_else(|error| panic!("{error}"))),
            Kind::Curve => {
                drop(scene::curve::table(&parsed.file, &panel.tables).unwrap_or_else(|error| panic!("{error}")));
            }
            Kind::Drawing => {}
        }
    }
}

#[test]
fn all_scenes_can_be_read() {
    let figures = figures();
    assert!(figures.len() >= 15, "{} figures", figures.len());
    for parsed in &figures {
        assert!(!parsed.title.is_empty() && !parsed.source.is_empty(), "{}", parsed.file);
        read(parsed);
    }
    let examples = std::fs::read_dir(root("scenes")).expect("the folder of the examples");
    let mut kinds = Vec::new();
    let gallery = std::fs::read_dir(root("scenes/gallery")).expect("the folder of published laws");
    for entry in examples.chain(gallery) {
        let path = entry.expect("a readable entry").path();
        if path.extension().is_none_or(|extension| extension != "toml") {
            continue;
        }
        let parsed = scene_file::read(&path).unwrap_or_else(|error| panic!("{error}"));
        read(&parsed);
        kinds.extend(parsed.panels.iter().map(|panel| panel.kind));
    }
    assert!(kinds.contains(&Kind::Run) && kinds.contains(&Kind::Map), "an example of each kind");
}

/// The dotted keys of all numbers.
fn numbers(section: &Section, prefix: &str, keys: &mut Vec<String>) {
    for (key, entry) in &section.entries {
        match &entry.value {
            Value::Number(_) => keys.push(format!("{prefix}{key}")),
            Value::Section(inner) => numbers(inner, &format!("{prefix}{key}."), keys),
            Value::Text(_) | Value::Flag(_) | Value::Other(_) => {}
        }
    }
}

#[test]
fn every_number_of_a_figure_has_an_origin_and_the_other_way_round() {
    let mut count = 0;
    for parsed in figures() {
        let mut keys = Vec::new();
        for panel in &parsed.panels {
            numbers(&panel.tables, "", &mut keys);
        }
        for key in &keys {
            let origin = parsed.origin.iter().find(|(named, _)| named == key);
            assert!(origin.is_some_and(|(_, from)| !from.trim().is_empty()), "{}: {key} has no origin", parsed.file);
        }
        for (key, _) in &parsed.origin {
            assert!(keys.contains(key), "{}: origin of {key}, which is not a number of the scene", parsed.file);
        }
        count += keys.len();
    }
    assert!(count > 100, "{count} numbers");
}

#[test]
fn figures_11_to_13_share_one_run() {
    let determinants = |id: &str, panel: &str| figure(id).panel(panel).expect("the panel").determinants();
    let eleven = determinants("fig11", "main");
    assert_eq!(eleven, determinants("fig12", "main"));
    assert_eq!(eleven, determinants("fig13", "std"));
    assert_ne!(eleven, determinants("fig13", "std_small_shift"));
    assert!(eleven.contains("start.shift = 0.1\n") || eleven.ends_with("start.shift = 0.1"), "{eleven}");
}
