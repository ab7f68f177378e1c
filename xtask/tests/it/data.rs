//! The description of the tables against the committed samples.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

fn data() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../data")
}

/// The header of every committed sample, by the path of its table in the description.
fn headers() -> BTreeMap<String, String> {
    let mut headers = BTreeMap::new();
    for folder in std::fs::read_dir(data().join("golden")).expect("data/golden").flatten() {
        for file in std::fs::read_dir(folder.path()).expect("a folder of samples").flatten() {
            let text = std::fs::read_to_string(file.path()).expect("a sample");
            let path = format!("{}/{}", folder.file_name().to_string_lossy(), file.file_name().to_string_lossy());
            headers.insert(path, text.lines().next().unwrap_or("").to_owned());
        }
    }
    headers
}

#[test]
fn every_table_and_column_is_described() {
    let headers = headers();
    assert!(headers.len() > 30, "samples are missing: git restore data/golden");
    let text = std::fs::read_to_string(data().join("datapackage.json")).expect("data/datapackage.json");
    let package: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let mut described = BTreeMap::new();
    for resource in package["resources"].as_array().expect("resources") {
        let fields = resource["schema"]["fields"].as_array().expect("fields");
        let names: Vec<&str> = fields.iter().filter_map(|field| field["name"].as_str()).collect();
        described.insert(resource["path"].as_str().unwrap_or("").to_owned(), names.join(","));
    }
    for (path, header) in headers {
        assert_eq!(described.get(&path), Some(&header), "{path} in data/datapackage.json");
    }
}

#[test]
fn every_run_has_hashes_of_its_states() {
    let paths = xtask::paths::Paths::find(Some(data().join(".."))).expect("the checkout");
    let all = xtask::figure::discover(&paths).expect("figures");
    let scenes: Vec<String> = xtask::record::scenes(&paths, &all, "").into_values().collect();
    let mut expected: Vec<String> = scenes.iter().map(|scene| format!("{scene}.csv")).collect();
    expected.sort();
    assert_eq!(xtask::disk::names(&data().join("states")).expect("a folder"), expected);
    for scene in scenes {
        let name = xtask::paths::Paths::states(&scene);
        let text = std::fs::read_to_string(paths.root.join(&name)).expect("hashes");
        assert!(xtask::judging::states::parse(&name, &text).expect("hashes").len() > 10, "{name}");
    }
}

#[test]
fn every_run_has_prints_of_all_its_steps() {
    let paths = xtask::paths::Paths::find(Some(data().join(".."))).expect("the checkout");
    let manifest = std::fs::read_to_string(paths.manifest()).expect("the manifest");
    let manifest: serde_json::Value = serde_json::from_str(&manifest).expect("JSON");
    let steps_of = |start: &str| -> Vec<u64> {
        let outputs = manifest["outputs"].as_object().expect("outputs").iter();
        outputs.filter(|(name, _)| name.starts_with(start)).filter_map(|(_, one)| one["steps"].as_u64()).collect()
    };
    let names = xtask::disk::names(&data().join("steps")).expect("a folder");
    assert_eq!(names, xtask::disk::names(&data().join("states")).expect("a folder"));
    for name in names {
        let text = std::fs::read_to_string(data().join("steps").join(&name)).expect("prints");
        let taken = files::steps::parse(&text).expect("prints").len() as u64 - 1;
        let figure = name.split('-').next().unwrap_or("");
        // supplement 10 makes a run of figure 13 once more, and the manifest counts no steps for what it draws of it
        let counted = steps_of(&format!("data/{}/", if figure == "s10" { "fig13" } else { figure }));
        assert!(counted.contains(&taken), "{name}: {taken} steps, the manifest has {counted:?}");
    }
}

#[test]
fn the_costs_in_the_document_are_those_measured() {
    let paths = xtask::paths::Paths::find(Some(data().join(".."))).expect("the checkout");
    let all = xtask::figure::discover(&paths).expect("figures");
    let text = std::fs::read_to_string(paths.root.join(xtask::paths::REPRODUCING)).expect("the document");
    let (_, between, _) = xtask::costs::parts(&text).expect("marks around the tables");
    let measured = xtask::costs::markdown(&paths, &all).expect("costs");
    assert!(between == measured, "the tables are others: cargo xtask list --costs mends them");
    let costs = xtask::costs::read(&paths).expect("costs");
    let known = xtask::costs::of_figures(&all, &costs);
    let missing: Vec<&str> =
        all.iter().map(|one| &*one.id).filter(|id| known.iter().all(|(one, _)| one.id != *id)).collect();
    assert!(missing.is_empty(), "not measured: {missing:?}; cargo xtask verify --all --costs");
}
