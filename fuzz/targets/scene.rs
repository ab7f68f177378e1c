//! Scene files: any text is accepted, or refused with an existing line and a message that names the key.

use files::reader::SceneError;
use files::scene_file::{self, Kind, Panel, SceneFile};

/// So many points or cells are computed of what is accepted.
const SMALL: usize = 64;

/// Tries one file.
pub fn read(bytes: &[u8]) {
    // a file that is not UTF-8 is refused by the standard library
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    match scene_file::parse("any.toml", text) {
        Ok(scene_file) => accepted(&scene_file, text),
        Err(error) => refused(&error, text),
    }
}

fn accepted(scene_file: &SceneFile, text: &str) {
    let again = scene_file::parse("any.toml", text).expect("what was accepted once");
    assert_eq!(format!("{again:?}"), format!("{scene_file:?}"));
    for panel in &scene_file.panels {
        let tables = match panel.kind {
            Kind::Run => scene::run::read(&scene_file.file, &panel.tables).map(|_| ()),
            Kind::Map => scene::map::read(&scene_file.file, &panel.tables).map(|map| {
                if map.x.cells * map.y.cells <= SMALL
                    && let Ok(computed) = map.compute()
                {
                    assert!(computed.table.rows().flatten().all(|number| number.is_finite()), "{computed:?}");
                }
            }),
            Kind::Curve if points(panel) > SMALL as f64 => Ok(()),
            Kind::Curve => scene::curve::table(&scene_file.file, &panel.tables).map(|table| {
                assert!(table.rows().flatten().all(|number| number.is_finite()), "{table:?}");
            }),
            Kind::Sweep => sweep::read(&scene_file.file, &panel.tables).map(|_| ()),
            Kind::Drawing => Ok(()),
        };
        tables.unwrap_or_else(|error| refused(&error, text));
    }
}

/// What the file says of the points of a curve, 0 when it says nothing that is a number.
fn points(panel: &Panel) -> f64 {
    let value = panel.tables.section("curve").and_then(|curve| curve.entries.get("points"));
    match value.map(|entry| &entry.value) {
        Some(files::reader::Value::Number(points)) => *points,
        _ => 0.0,
    }
}

/// Asserts that a complaint names the file and a line of it.
pub fn refused(error: &SceneError, text: &str) {
    let lines = 1 + text.bytes().filter(|&byte| byte == b'\n').count();
    assert!(error.line <= lines, "line {} of {lines}: {error}", error.line);
    assert!(!error.problem.is_empty() && error.file == "any.toml");
}
