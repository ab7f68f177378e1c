//! Checkpoints: the bytes that a killed run left, whatever they are, belong to the scene or are rejected.

use files::scene_file;
use jam::run::Checkpoint;

/// Three pedestrians; what the corpus was made by.
pub const SCENE: &str = "[law]\nkind = \"exponential\"\na = 8.0\nb = 1.5\nv0 = 3.0\n[ring]\npedestrians = 3\n\
                         length = 10.0\n[start]\nshift = 0.1\n[run]\nt_end = 1.0\nsample = 0.25\n\
                         method = \"heun\"\ndt = 1e-4\nstate = \"positions\"\n";

/// Tries these bytes.
pub fn read(bytes: &[u8]) {
    let scene_file = scene_file::parse("any.toml", SCENE).expect("a scene");
    let scene = scene::run::read("any.toml", &scene_file.panels[0].tables).expect("a run");
    if let Some(checkpoint) = Checkpoint::parse(bytes, &scene) {
        let again = Checkpoint::parse(bytes, &scene).expect("what was taken once");
        assert_eq!(format!("{again:?}"), format!("{checkpoint:?}"));
        assert!(checkpoint.fraction(&scene) >= 0.0);
    }
}
