//! Everything that outputs are made from, with a hash for each file, so that a change can be named.

use crate::disk;
use crate::failure::Failure;
use crate::figure::Figure;
use crate::hashing;
use crate::paths::{
    LOCK_FILE, NO_SOURCES, NUMERIC_SOURCES, Paths, SHARED_SOURCES, SINGLE_SOURCES, SOURCE_FOLDERS, SUPPLEMENT_SOURCES,
};
use std::collections::BTreeMap;

/// Named hashes: a file's name relative to the root, or `run PANEL` with the key of a run.
pub type Inputs = BTreeMap<String, String>;

/// The hash of every source of the checkout.
#[derive(Clone, Debug, Default)]
pub struct Sources {
    /// By name relative to the root, with `/`.
    pub files: Inputs,
}

impl Sources {
    /// Reads and hashes the sources: crates, figures (no pictures), reference data, and the files at the root that
    /// determine a build. Tests and documents are left out, they reach no output.
    ///
    /// # Errors
    /// A folder or a file cannot be read.
    pub fn read(paths: &Paths) -> Result<Sources, Failure> {
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
        Ok(Sources { files: named.collect() })
    }

    /// What the binaries are built from.
    pub fn build(&self) -> String {
        hashing::digest(&self.files)
    }

    /// What determines the numbers of a run besides its scene.
    pub fn numeric(&self) -> String {
        hashing::digest(&self.below(&[&NUMERIC_SOURCES[..], &SINGLE_SOURCES].concat()))
    }

    /// What a figure is made from: shared sources, its own folder, and its runs by panel and key.
    pub fn figure(&self, figure: &Figure, runs: &[(String, String)]) -> Inputs {
        let folder = Paths::figure_folder(&figure.slug);
        let supplement = if figure.is_supplement() { &SUPPLEMENT_SOURCES[..] } else { &[] };
        let starts = [&SHARED_SOURCES[..], &SINGLE_SOURCES, supplement, &[folder.as_str()]].concat();
        let mut inputs = self.below(&starts);
        inputs.extend(runs.iter().map(|(panel, key)| (format!("run {panel}"), key.clone())));
        inputs
    }

    /// The hash of the lock file; empty when there is none.
    pub fn lock(&self) -> &str {
        self.files.get(LOCK_FILE).map_or("", String::as_str)
    }

    fn below(&self, starts: &[&str]) -> Inputs {
        let belongs = |name: &str| starts.iter().any(|start| name.starts_with(start));
        self.files.iter().filter(|(name, _)| belongs(name)).map(|(name, hash)| (name.clone(), hash.clone())).collect()
    }
}

/// Pictures and temporary files are outputs; documents, scripts and the crates of [`NO_SOURCES`] reach no output.
fn is_source(name: &str) -> bool {
    let apart = NO_SOURCES.iter().any(|start| name.starts_with(start));
    let output = Paths::is_output(name) || name.split('/').any(Paths::is_temporary);
    let in_figures = name.starts_with("figures/");
    let code = [".rs", ".toml"].iter().any(|end| name.ends_with(end));
    !apart && !output && ![".md", ".py"].iter().any(|end| name.ends_with(end)) && (!in_figures || code)
}
