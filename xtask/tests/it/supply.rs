//! External dependencies: each has a purpose, build scripts are known, no font of the machine is used, `unsafe`
//! occurs only where ARCHITECTURE.md says, and comments are no wider than code. Licences and sources: `deny.toml`.

use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn text(name: &str) -> String {
    fs::read_to_string(root().join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// Names of all files with this ending, relative to the root, outside of what is built.
fn files(ending: &str) -> Vec<String> {
    let enter = |name: &str| !["target", "vendor"].contains(&name) && !name.starts_with('.');
    let found = checkout::disk::walk(&root(), &enter).expect("folders");
    let names = found.iter().filter_map(|path| path.strip_prefix(root()).ok());
    names.map(|path| path.to_string_lossy().into_owned()).filter(|name| name.ends_with(ending)).collect()
}

/// The formatter leaves comments as wide as they are.
#[test]
fn comments_are_at_most_as_wide_as_code() {
    let is_wide = |line: &str| line.trim_start().starts_with("//") && line.chars().count() > 120;
    for name in files(".rs") {
        let wide = text(&name).lines().position(is_wide).map(|index| index + 1);
        assert_eq!(wide, None, "{name}: a comment is wider than 120 columns");
    }
}

/// Name and source of the build script of every crate that the lock file names and that has one.
fn build_scripts() -> BTreeMap<String, PathBuf> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut command = Command::new(cargo);
    command.args(["metadata", "--locked", "--format-version", "1"]).current_dir(root());
    let output = command.output().expect("cargo");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let metadata: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let mut scripts = BTreeMap::new();
    for package in metadata["packages"].as_array().expect("packages") {
        for target in package["targets"].as_array().expect("targets") {
            if target["kind"].as_array().is_some_and(|kinds| kinds.iter().any(|kind| kind == "custom-build")) {
                let word = |value: &Value| value.as_str().expect("a text").to_owned();
                scripts.insert(word(&package["name"]), word(&target["src_path"]).into());
            }
        }
    }
    scripts
}

#[test]
fn build_scripts_are_known_and_reach_no_network() {
    let known = text("checks/build-scripts.csv");
    let known = known.lines().skip(1).map(|line| line.split_once(',').expect("crate,what it does"));
    let known: BTreeSet<&str> = known.filter(|(_, what)| !what.is_empty()).map(|(name, _)| name).collect();
    let found = build_scripts();
    let names: BTreeSet<&str> = found.keys().map(String::as_str).collect();
    // those of the package for Python alone are looked for by its own tests
    let python = text("crates/python/Cargo.lock");
    let is_of_python = |name: &&str| !names.contains(name) && python.contains(&format!("name = \"{name}\"\n"));
    let known: BTreeSet<&str> = known.into_iter().filter(|name| !is_of_python(name)).collect();
    assert_eq!(names, known, "read the new script, then say in checks/build-scripts.csv what it does");
    for (name, file) in &found {
        let text = fs::read_to_string(file).unwrap_or_else(|error| panic!("{}: {error}", file.display()));
        for word in ["std::net", "TcpStream", "UdpSocket", "ureq", "reqwest", "curl", "wget"] {
            assert!(!text.contains(word), "the build script of {name} has {word}");
        }
    }
}

/// `unsafe` is denied by a lint of the workspace; where it is allowed stands in the sources.
#[test]
fn unsafe_is_allowed_where_the_processor_or_the_page_is_asked() {
    let manifest = text("Cargo.toml");
    assert!(manifest.contains("unsafe_code = \"deny\""));
    let allows = |name: &String| text(name).contains(concat!("allow(", "unsafe_code"));
    let mut found: Vec<String> = files(".rs").into_iter().filter(allows).collect();
    // programs around libraries in C, built only to be measured against, are a workspace of their own
    found.retain(|name| !name.starts_with("bench/"));
    assert_eq!(found, ["crates/browser/src/exports.rs", "crates/browser/src/page.rs", "crates/math/src/simd.rs"]);
    for name in files("Cargo.toml").iter().filter(|name| !["Cargo.toml", "fuzz/Cargo.toml"].contains(&name.as_str())) {
        if !name.starts_with("bench/") {
            assert!(
                text(name).contains("[lints]\nworkspace = true"),
                "{name} does not take the lints of the workspace"
            );
        }
    }
}

#[test]
fn pictures_ask_the_machine_for_no_fonts() {
    let lock = text("Cargo.lock");
    assert!(lock.contains("name = \"plotters\""));
    for name in ["font-kit", "fontconfig-parser", "yeslogic-fontconfig-sys", "freetype-sys"] {
        assert!(!lock.contains(&format!("name = \"{name}\"")), "{name} is in the lock file");
    }
}
