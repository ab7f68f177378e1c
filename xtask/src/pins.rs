//! Inputs of a build from outside: the compiler, and the crates of the lock file. They are stored as named texts, so
//! that a change can be reported with both versions.

use crate::sources::Inputs;
use checkout::disk;
use checkout::failure::Failure;
use checkout::paths::{LOCK_FILE, Paths};
use checkout::process;
use serde::Deserialize;
use std::collections::{BTreeMap, BTreeSet};

/// The name of the compiler among inputs.
pub const RUSTC: &str = "rustc";
/// How the names of crates begin among inputs.
pub const CRATE: &str = "crate ";
/// The package whose programs make the figures.
const PACKAGE: &str = "figures";

#[derive(Debug, Default, Deserialize)]
struct Lock {
    #[serde(default)]
    package: Vec<Package>,
}

#[derive(Debug, Deserialize)]
struct Package {
    name: String,
    version: String,
    checksum: Option<String>,
    #[serde(default)]
    dependencies: Vec<String>,
}

/// The compiler that builds the figures (`rustc --version` in the checkout), and every crate from outside that they
/// need, with version and checksum. Crates that only the runner needs are left out: they reach no figure.
///
/// # Errors
/// Usage: the lock file is malformed.
pub fn read(paths: &Paths) -> Result<Inputs, Failure> {
    let text = disk::read_text(&paths.root.join(LOCK_FILE))?.unwrap_or_default();
    let mut pins = crates(&text).map_err(|error| Failure::Usage(format!("{LOCK_FILE}: {error}")))?;
    // the file that pins the toolchain counts in the folder where cargo is started
    let version = process::first_line_in(&paths.root, RUSTC, &["--version"]);
    pins.insert(RUSTC.to_owned(), version.unwrap_or_else(|| "unknown".to_owned()));
    Ok(pins)
}

/// The crates of a lock file that the figures need, by `crate NAME`. All of them in a file without that package.
///
/// # Errors
/// The parser's words.
pub fn crates(lock: &str) -> Result<Inputs, String> {
    let lock: Lock = toml::from_str(lock).map_err(|error| error.to_string())?;
    let mut needed: BTreeSet<usize> = BTreeSet::new();
    let mut waiting: Vec<usize> = (0..lock.package.len()).filter(|&at| lock.package[at].name == PACKAGE).collect();
    if waiting.is_empty() {
        waiting = (0..lock.package.len()).collect();
    }
    while let Some(at) = waiting.pop() {
        if needed.insert(at) {
            let wanted = &lock.package[at].dependencies;
            waiting
                .extend((0..lock.package.len()).filter(|&other| wanted.iter().any(|one| lock.package[other].is(one))));
        }
    }
    let mut found: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for package in needed.into_iter().map(|at| &lock.package[at]).filter(|package| package.name != PACKAGE) {
        // a crate of the checkout has no checksum: its sources are inputs themselves
        let sum = package.checksum.as_deref().map_or("", |sum| sum.get(..8).unwrap_or(sum));
        found.entry(format!("{CRATE}{}", package.name)).or_default().push(format!("{} {sum}", package.version));
    }
    Ok(found.into_iter().map(|(name, versions)| (name, versions.join(", ").trim_end().to_owned())).collect())
}

impl Package {
    /// Whether a dependency means this one: by name, and by version where there are several.
    fn is(&self, dependency: &str) -> bool {
        let mut words = dependency.split(' ');
        words.next() == Some(self.name.as_str()) && words.next().is_none_or(|version| version == self.version)
    }
}
