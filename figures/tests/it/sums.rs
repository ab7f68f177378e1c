//! Every figure from nothing, and once more from its tables alone, has the committed bytes.

use crate::{root, succeed};
use files::scene_file::{self, Kind};
use files::write::sha256_file;
use std::collections::BTreeMap;
use std::path::Path;

/// `path -> sum` of the committed list.
fn committed() -> BTreeMap<String, String> {
    let list = std::fs::read_to_string(root().join("data/SHA256SUMS")).expect("the list of sums");
    let pairs = list.lines().filter_map(|line| line.split_once("  "));
    pairs.map(|(sum, path)| (path.to_owned(), sum.to_owned())).collect()
}

/// The folders of the figures of the paper.
fn slugs() -> Vec<String> {
    let folders = std::fs::read_dir(root().join("figures")).expect("the folder of the figures");
    let names = folders.filter_map(|entry| entry.ok()?.file_name().into_string().ok());
    let mut slugs: Vec<String> = names.filter(|name| name.starts_with("fig")).collect();
    slugs.sort();
    slugs
}

/// Makes the runs of a figure's scene and returns the arguments that name them.
fn runs(slug: &str, scene: &str, scratch: &Path) -> Vec<String> {
    let scene_file = scene_file::read(&root().join(scene)).expect("a scene");
    let mut arguments = Vec::new();
    for panel in scene_file.panels.iter().filter(|panel| panel.kind == Kind::Run) {
        let folder = scratch.join("runs").join(format!("{slug}-{}", panel.name));
        let out = folder.to_str().expect("a path in UTF-8");
        succeed("simulate", &[scene, "--panel", &panel.name, "--out", out, "--tables-only"]);
        arguments.extend(["--run".to_owned(), format!("{}={out}", panel.name)]);
    }
    arguments
}

#[test]
fn figures_and_redrawn_pictures_have_the_committed_sums() {
    let scratch = tempfile::tempdir().expect("a scratch folder");
    let (committed, mut compared) = (committed(), 0);
    let slugs = slugs();
    assert_eq!(slugs.len(), 15);
    for slug in &slugs {
        let id = slug.split('-').next().unwrap_or(slug);
        let scene = format!("figures/{slug}/scene.toml");
        let place = |name: &str| scratch.path().join(name).join(id).to_str().expect("a path in UTF-8").to_owned();
        let (tables, pictures, redrawn) = (place("data"), place("pictures"), place("redrawn"));
        let made_runs = runs(slug, &scene, scratch.path());
        let mut arguments = vec!["--scene", &scene, "--tables", &tables, "--pictures", &pictures];
        arguments.extend(made_runs.iter().map(String::as_str));
        succeed(slug, &arguments);
        succeed(slug, &["--scene", &scene, "--tables", &tables, "--pictures", &redrawn, "--draw-only"]);
        for (path, sum) in committed.iter().filter(|(path, _)| path.contains(&format!("/{id}"))) {
            let name = path.rsplit('/').next().unwrap_or(path);
            let folders: &[&String] = if path.starts_with("data/") { &[&tables] } else { &[&pictures, &redrawn] };
            for folder in folders {
                assert_eq!(&sha256_file(&Path::new(folder).join(name)).expect("an output"), sum, "{path}");
                compared += 1;
            }
        }
    }
    // 33 tables, 30 pictures made twice
    assert_eq!(compared, 33 + 2 * 30);
}
