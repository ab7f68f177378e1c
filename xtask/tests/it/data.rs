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
    let paths = checkout::paths::Paths::find(Some(data().join(".."))).expect("the checkout");
    let all = checkout::figure::discover(&paths).expect("figures");
    let scenes: Vec<String> = xtask::record::scenes(&paths, &all, "").into_values().collect();
    let mut expected: Vec<String> = scenes.iter().map(|scene| format!("{scene}.csv")).collect();
    expected.sort();
    assert_eq!(checkout::disk::names(&data().join("states")).expect("a folder"), expected);
    for scene in scenes {
        let name = checkout::paths::Paths::states(&scene);
        let text = std::fs::read_to_string(paths.root.join(&name)).expect("hashes");
        assert!(verify::states::parse(&name, &text).expect("hashes").len() > 10, "{name}");
    }
}
