//! Dependencies between crates (the table in ARCHITECTURE.md against manifests and sources), and where clocks may be
//! read.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn read(name: &str) -> String {
    fs::read_to_string(root().join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// What the table says of a crate.
struct Crate {
    level: u32,
    uses: BTreeSet<String>,
}

/// The rows of the table.
fn table(text: &str) -> BTreeMap<String, Crate> {
    let mut crates = BTreeMap::new();
    for line in text.lines().skip_while(|line| !line.starts_with("| crate | level |")).skip(2) {
        let cells: Vec<&str> = line.split('|').map(str::trim).collect();
        let [_, name, level, purpose, uses, _] = cells[..] else { break };
        assert!(!purpose.is_empty(), "{name} has no purpose");
        let uses = uses.split(", ").filter(|name| !name.is_empty()).map(str::to_owned).collect();
        crates.insert(name.trim_matches('`').to_owned(), Crate { level: level.parse().expect("a level"), uses });
    }
    crates
}

/// The manifest of every package of the workspace, by its folder, which is also the name that sources use.
fn manifests() -> BTreeMap<String, toml::Table> {
    let crates = fs::read_dir(root().join("crates")).expect("crates").flatten().map(|entry| entry.path());
    let folders = crates.chain(["figures", "xtask"].map(|name| root().join(name)));
    let read = |folder: PathBuf| {
        let text = fs::read_to_string(folder.join("Cargo.toml")).expect("a manifest");
        (folder.file_name().expect("a name").to_string_lossy().into_owned(), text.parse().expect("TOML"))
    };
    folders.map(read).collect()
}

/// The packages of the workspace that one of them is built with; tests may use more.
fn used(manifest: &toml::Table, all: &BTreeMap<String, toml::Table>) -> BTreeSet<String> {
    let dependencies = manifest.get("dependencies").and_then(toml::Value::as_table);
    dependencies.into_iter().flat_map(|table| table.keys()).filter(|name| all.contains_key(*name)).cloned().collect()
}

#[test]
fn crates_use_what_the_table_says_and_only_lower_levels() {
    let (table, manifests) = (table(&read("ARCHITECTURE.md")), manifests());
    let names = |keys: Vec<&String>| keys.into_iter().cloned().collect::<Vec<_>>();
    assert_eq!(names(table.keys().collect()), names(manifests.keys().collect()));
    for (name, manifest) in &manifests {
        let known = &table[name];
        assert_eq!(used(manifest, &manifests), known.uses, "{name}");
        for other in &known.uses {
            assert!(table[other].level < known.level, "{name} uses {other}, which is no lower");
        }
    }
}

/// What a package is built with, directly or not.
fn reached(name: &str, table: &BTreeMap<String, Crate>) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    let mut waiting = vec![name.to_owned()];
    while let Some(next) = waiting.pop() {
        waiting.extend(table[&next].uses.iter().filter(|name| found.insert((*name).clone())).cloned());
    }
    found
}

#[test]
fn the_runner_links_no_physics_and_the_figures_nothing_about_the_result() {
    let table = table(&read("ARCHITECTURE.md"));
    assert_eq!(reached("xtask", &table).into_iter().collect::<Vec<_>>(), ["checkout", "files"]);
    let figures = reached("figures", &table);
    for name in
        ["checkout", "claims", "verify", "publish", "measure", "hunt", "studies", "planes", "sweep", "reference"]
    {
        assert!(!figures.contains(name), "{name}");
    }
}

/// SourceHashes below a folder.
fn sources(folder: &str) -> Vec<(String, String)> {
    let found = checkout::disk::walk(&root().join(folder), &|_| true).expect("a folder");
    let sources = found.into_iter().filter(|path| path.extension().is_some_and(|ending| ending == "rs"));
    sources.map(|path| (path.display().to_string(), fs::read_to_string(&path).expect("a source"))).collect()
}

#[test]
fn what_makes_numbers_and_pictures_reads_no_clock_and_no_environment() {
    const WORDS: [&str; 6] =
        ["SystemTime", "Instant::now", "ProcessTime::now", "env::var", "thread::current", "available_parallelism"];
    let mut looked_at = 0;
    for folder in ["math", "formula", "ode", "jam", "files", "scene", "plot", "reference"] {
        for (name, text) in sources(&format!("crates/{folder}/src")) {
            looked_at += 1;
            let found: Vec<&str> = WORDS.into_iter().filter(|word| text.contains(word)).collect();
            // a very large ring is cut into parts for threads, with the same bits for any cut; reference solutions are
            // printed with the time that they took
            let is_known = (found == ["available_parallelism"] && name.contains("/jam/"))
                || (found.iter().all(|word| word.ends_with("now")) && name.ends_with("reference/src/main.rs"));
            assert!(found.is_empty() || is_known, "{name}: {found:?}");
        }
    }
    assert!(looked_at > 80, "{looked_at}");
}

#[test]
fn transcendental_functions_of_the_standard_library_are_forbidden_by_lints() {
    let lints: toml::Table = read("clippy.toml").parse().expect("TOML");
    let methods: BTreeSet<&str> =
        lints["disallowed-methods"].as_array().expect("a list").iter().filter_map(|one| one["path"].as_str()).collect();
    for name in ["exp", "ln", "powf", "powi", "sin", "cos", "tanh", "mul_add", "cbrt", "hypot", "ln_1p", "exp_m1"] {
        assert!(methods.contains(&*format!("f64::{name}")), "{name}");
    }
    let manifest: toml::Table = read("Cargo.toml").parse().expect("TOML");
    assert_eq!(manifest["workspace"]["lints"]["clippy"]["disallowed_methods"].as_str(), Some("deny"));
}

#[test]
fn a_library_whose_tests_are_not_built_has_none() {
    let mut asked = 0;
    for (name, manifest) in manifests() {
        let folder = if ["figures", "xtask"].contains(&name.as_str()) { name } else { format!("crates/{name}") };
        let is_off = |key| manifest.get("lib").and_then(|lib| lib.get(key)) == Some(&toml::Value::Boolean(false));
        let is_example = |line: &str| line.trim_start().strip_prefix("//").is_some_and(|doc| doc.contains("```"));
        for (file, text) in sources(&format!("{folder}/src")) {
            for (key, has) in [("test", text.contains("#[test]")), ("doctest", text.lines().any(is_example))] {
                asked += usize::from(is_off(key));
                assert!(!is_off(key) || !has, "{file}: {key} = false in the manifest of {folder}");
            }
        }
    }
    assert!(asked > 0, "no library to look at");
}
