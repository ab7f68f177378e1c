//! The project's scene files, and scenes derived from them.

use files::scene_file::{self, Kind, SceneFile};
use jam::run::Outcome;
use scene::Overrides;
use scene::run::Scene;
use std::path::PathBuf;
use std::sync::OnceLock;

/// A path from the root of the project.
pub fn root(path: &str) -> PathBuf {
    [env!("CARGO_MANIFEST_DIR"), "..", "..", path].iter().collect()
}

/// The scene files in the folder `figures`, in order.
pub fn figures() -> Vec<SceneFile> {
    let folders = std::fs::read_dir(root("figures")).expect("the folder of the figures");
    let mut files: Vec<PathBuf> = folders
        .map(|entry| entry.expect("a readable entry").path().join("scene.toml"))
        .filter(|file| file.exists())
        .collect();
    files.sort();
    files.iter().map(|file| scene_file::read(file).unwrap_or_else(|error| panic!("{error}"))).collect()
}

/// The scene of the figure whose folder starts so.
pub fn figure(id: &str) -> SceneFile {
    let name =
        |parsed: &SceneFile| parsed.file.split("figures").last().unwrap_or_default().trim_matches('/').to_owned();
    figures().into_iter().find(|parsed| name(parsed).starts_with(id)).unwrap_or_else(|| panic!("no figure {id}"))
}

/// The run of a panel, with other values on top.
pub fn scene(parsed: &SceneFile, panel: &str, overrides: &Overrides) -> Scene {
    let panel = parsed.panel(panel).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(panel.kind, Kind::Run);
    scene::run::read(&parsed.file, &overrides.apply(&panel.tables)).unwrap_or_else(|error| panic!("{error}"))
}

/// The run of a panel as it stands, and the one that checks it.
pub fn with_check(parsed: &SceneFile, panel: &str) -> [Outcome; 2] {
    let plain = scene(parsed, panel, &Overrides::default());
    let ode::Control::Adaptive { tolerance } = plain.control else { panic!("{} is adaptive", parsed.file) };
    let check = scene(parsed, panel, &Overrides::check(tolerance));
    [plain, check].map(|scene| jam::run::run(&scene).unwrap_or_else(|error| panic!("{error}")))
}

/// The run of figures 11 to 13, and its check: made once for all tests.
pub fn jams() -> &'static [Outcome; 2] {
    static JAMS: OnceLock<[Outcome; 2]> = OnceLock::new();
    JAMS.get_or_init(|| with_check(&figure("fig11"), "main"))
}
