//! The scene that the page passes in: the text of a scene file with `[run]`, or the reason why it is invalid.

use files::reader::SceneError;
use files::scene_file::{self, Kind};
use serde_json::{Value, json};

/// What messages call the scene of a page.
pub const FILE: &str = "scene.toml";

/// The tables of the one run that a text asks for.
///
/// # Errors
/// The text is no scene, or has not one run; as JSON, see [`complaint`].
pub fn panel(text: &str) -> Result<scene_file::Panel, Value> {
    let mut parsed = scene_file::parse(FILE, text).map_err(|error| complaint(&error))?;
    match (parsed.panels.pop(), parsed.panels.len()) {
        (Some(panel), 0) if panel.kind == Kind::Run => Ok(panel),
        _ => Err(complaint(&SceneError::new(FILE, 0, "must have one [run], and no panels".to_owned()))),
    }
}

/// What is wrong, as JSON: `problem` in words, `line` (null: the whole file), `key` and `allowed` where they are known.
pub fn complaint(error: &SceneError) -> Value {
    let about = error.about.as_deref();
    json!({
        "problem": error.problem,
        "line": (error.line > 0).then_some(error.line),
        "key": about.map(|about| about.key.as_str()),
        "allowed": about.and_then(|about| about.allowed.as_deref()),
    })
}
