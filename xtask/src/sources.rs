//! The sources of the outputs, with a hash for each file, so that a change can be named.

use crate::pins;
use checkout::disk;
use checkout::failure::Failure;
use checkout::figure::Figure;
use checkout::hashing;
use checkout::paths::{LOCK_FILE, Paths, TOOLCHAIN};
use std::collections::BTreeMap;

/// Single files that determine what the binaries do.
const SINGLE_SOURCES: [&str; 4] = ["Cargo.toml", LOCK_FILE, TOOLCHAIN, ".cargo/config.toml"];
/// Crates that determine the numbers of a run; pictures hang on them, too.
const NUMERIC_SOURCES: [&str; 8] = [
    "crates/formula/",
    "crates/math/",
    "crates/ode/",
    "crates/jam/",
    "crates/files/",
    "crates/scene/",
    "figures/src/",
    "figures/Cargo.toml",
];
/// SourceHashes that supplements share: no figure of the paper reads them.
const SUPPLEMENT_SOURCES: [&str; 4] = ["crates/planes/", "crates/reference/", "crates/studies/", "crates/sweep/"];
/// Folders that are searched for sources.
const SOURCE_FOLDERS: [&str; 6] =
    ["crates", "figures", "data/accuracy", "data/outcomes", "data/reference", "data/timing"];
/// Below the folders searched, what reaches no figure: the doors for browsers and for Python, the programs about the
/// result, solutions to compare with, archived benchmarks.
const NO_SOURCES: [&str; 10] = [
    "crates/browser/",
    "crates/checkout/",
    "crates/claims/",
    "crates/interchange/",
    "crates/measure/",
    "crates/publish/",
    "crates/python/",
    "crates/verify/",
    "data/reference/solutions/",
    "data/timing/bench/",
];

/// Named hashes: of a file by its name relative to the root, or `run PANEL` with the key of a run. If a change is
/// reported with both values, these replace the hash: `rustc`, `crate NAME`, `key PANEL.TABLE.KEY` of the scene.
pub type Inputs = BTreeMap<String, String>;

/// How the names of a scene's keys begin among inputs.
pub const KEY: &str = "key ";

/// The hash of every source of the checkout, and what a build takes from outside.
#[derive(Clone, Debug, Default)]
pub struct SourceHashes {
    /// By name relative to the root, with `/`.
    pub files: Inputs,
    /// The compiler and the crates that figures are built from ([`pins`]).
    pub pins: Inputs,
    /// The keys of each figure's scene with their values, by the figure's slug.
    pub keys: BTreeMap<String, Inputs>,
}

impl SourceHashes {
    /// Reads and hashes the sources: crates, figures (no pictures), reference data, and the files at the root that
    /// determine a build. Tests and documents are left out, they reach no output.
    ///
    /// # Errors
    /// A folder or a file cannot be read.
    pub fn read(paths: &Paths) -> Result<SourceHashes, Failure> {
        let enter = |name: &str| !["tests", "benches", "examples", "target"].contains(&name) && !name.starts_with('.');
        let mut found = SINGLE_SOURCES.map(|name| paths.root.join(name)).to_vec();
        for folder in SOURCE_FOLDERS {
            found.extend(disk::walk(&paths.root.join(folder), &enter)?);
        }
        let name = |path: &std::path::Path| {
            let parts = path.strip_prefix(&paths.root).unwrap_or(path).iter();
            parts.map(|part| part.to_string_lossy()).collect::<Vec<_>>().join("/")
        };
        found.retain(|path| is_source(&name(path)));
        let hashes = hashing::hash_all(&found)?;
        let named = found.iter().zip(hashes).filter_map(|(path, hash)| Some((name(path), hash?)));
        let files: Inputs = named.collect();
        Ok(SourceHashes { keys: keys(paths, &files)?, files, pins: pins::read(paths)? })
    }

    /// What the binaries are built from.
    pub fn build(&self) -> String {
        hashing::digest(&self.files)
    }

    /// What determines the numbers of a run besides its scene.
    pub fn numeric(&self) -> String {
        hashing::digest(&self.numbers_from(&[]))
    }

    /// What determines the numbers of a plane besides its scene.
    pub fn sweep(&self) -> String {
        hashing::digest(&self.numbers_from(&["crates/sweep/"]))
    }

    /// What a figure is made from: shared sources, its own folder, the committed tables that its scene names, and its
    /// runs by panel and key.
    pub fn figure(&self, figure: &Figure, runs: &[(String, String)]) -> Inputs {
        let folder = Paths::figure_folder(&figure.slug);
        let supplement = if figure.is_supplement() { &SUPPLEMENT_SOURCES[..] } else { &[] };
        let mut inputs = self.numbers_from(&[&["crates/plot/", folder.as_str()], supplement].concat());
        let reads = figure.scene_file.iter().flat_map(|scene_file| &scene_file.reads).map(|name| Paths::table(name));
        inputs.extend(reads.filter_map(|name| Some((name.clone(), self.files.get(&name)?.clone()))));
        inputs.extend(self.keys.get(&figure.slug).cloned().unwrap_or_default());
        inputs.extend(runs.iter().map(|(panel, key)| (format!("run {panel}"), key.clone())));
        inputs
    }

    fn numbers_from(&self, more: &[&str]) -> Inputs {
        let mut inputs = self.below(&[&NUMERIC_SOURCES[..], &SINGLE_SOURCES, more].concat());
        inputs.extend(self.pins.clone());
        inputs
    }

    fn below(&self, starts: &[&str]) -> Inputs {
        // the lock file is read by crates
        let belongs = |name: &str| name != LOCK_FILE && starts.iter().any(|start| name.starts_with(start));
        self.files.iter().filter(|(name, _)| belongs(name)).map(|(name, hash)| (name.clone(), hash.clone())).collect()
    }
}

/// The keys of every scene among the files. One that cannot be parsed has none: its figure says what is wrong with it.
fn keys(paths: &Paths, files: &Inputs) -> Result<BTreeMap<String, Inputs>, Failure> {
    let mut keys = BTreeMap::new();
    for name in files.keys() {
        let Some(slug) = name.strip_prefix("figures/").and_then(|rest| rest.strip_suffix("/scene.toml")) else {
            continue;
        };
        let text = disk::read_text(&paths.root.join(name))?.unwrap_or_default();
        let mut flat = Inputs::new();
        flatten(&mut flat, "", &text.parse().unwrap_or_default());
        keys.insert(slug.to_owned(), flat);
    }
    Ok(keys)
}

/// Each value of a table under the names that lead to it.
fn flatten(flat: &mut Inputs, path: &str, table: &toml::Table) {
    for (name, value) in table {
        let path = if path.is_empty() { name.clone() } else { format!("{path}.{name}") };
        match value {
            toml::Value::Table(inner) => flatten(flat, &path, inner),
            other => {
                flat.insert(format!("{KEY}{path}"), other.to_string());
            }
        }
    }
}

/// Pictures and temporary files are outputs; documents, scripts and the crates of [`NO_SOURCES`] reach no output.
fn is_source(name: &str) -> bool {
    let apart = NO_SOURCES.iter().any(|start| name.starts_with(start));
    let output = Paths::is_output(name) || name.split('/').any(files::write::is_draft_name);
    let in_figures = name.starts_with("figures/");
    let code = [".rs", ".toml"].iter().any(|end| name.ends_with(end));
    let document = [".md", ".py", "/LICENSE-MIT", "/LICENSE-APACHE"].iter().any(|end| name.ends_with(end));
    !apart && !output && !document && (!in_figures || code)
}
