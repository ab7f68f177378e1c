//! Builds programs: those of the figures only when a source has changed, the others when a verb needs them.

use crate::sources::{Inputs, SourceHashes};
use checkout::disk;
use checkout::failure::Failure;
use checkout::figure::{self, Figure};
use checkout::hashing;
use checkout::paths::Paths;
use checkout::process;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;
use std::time::{SystemTime, UNIX_EPOCH};

/// The fonts that the pictures embed, each with its SHA-256: a damaged one would be compiled in, and every picture
/// would fail or differ.
pub const FONT_SUMS: [(&str, &str); 2] = [
    ("LibertinusSerif-Italic.otf", "9a393d63d6e05f620d3dc0190dfd35a8ede58c0808cf0fc9de7fcb9c723e4c24"),
    ("LibertinusSerif-Regular.otf", "fcf06307a77367394fcb0ccb241e59eea70dba3d732be309647611224679c733"),
];
/// How to get the fonts back.
pub const FONTS_REMEDY: &str = "part of the checkout: git restore crates/plot/fonts";

/// A package with programs that the plan starts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Package {
    /// Its name.
    pub name: &'static str,
    /// Programs beside those of figures.
    pub tools: &'static [&'static str],
    /// Whether its figures are the supplements; `None` if it makes no figure.
    pub supplements: Option<bool>,
}

/// The figures of the paper, and what runs scenes.
pub const FIGURES: Package = Package { name: "figures", tools: &["simulate", "map"], supplements: Some(false) };
/// Planes of outcomes.
pub const PLANES: Package = Package { name: "planes", tools: &["sweep"], supplements: None };
/// The supplements, and the tables of accuracy.
pub const STUDIES: Package =
    Package { name: "studies", tools: &["precision", "hard", "studies"], supplements: Some(true) };

/// Removes what is built of our own sources.
const CLEAN: &str = "clean --quiet --release --locked -p jamming-math -p jamming-ode -p jamming -p files -p scene -p sweep -p plot -p reference -p figures -p planes -p studies";

/// What was built: the hashes of the sources, and size and date of each program, so that one that was built by hand
/// since then is not taken for ours.
#[derive(Debug, Default, PartialEq, Serialize, Deserialize)]
struct Built {
    sources: Inputs,
    programs: BTreeMap<String, (u64, u128)>,
}

impl Package {
    /// The packages that figures need; that of the paper always, since it runs the scenes.
    pub fn of(figures: &[&Figure]) -> Vec<Package> {
        match figures.iter().any(|figure| figure.is_supplement()) {
            true => vec![FIGURES, STUDIES],
            false => vec![FIGURES],
        }
    }

    /// The command that builds it, as a user would type it.
    pub fn command(self) -> String {
        format!("cargo build --release --locked -p {}", self.name)
    }

    fn programs(self, all: &[Figure]) -> impl Iterator<Item = &str> {
        let figures = all.iter().filter(move |figure| Some(figure.is_supplement()) == self.supplements);
        self.tools.iter().copied().chain(figures.map(|figure| figure.slug.as_str()))
    }

    fn current(self, paths: &Paths, all: &[Figure], sources: &SourceHashes) -> Built {
        let programs = self.programs(all).filter_map(|name| Some((name.to_owned(), stamp(&paths.binary(name))?)));
        Built { sources: sources.files.clone(), programs: programs.collect() }
    }

    fn recorded(self, paths: &Paths) -> Built {
        serde_json::from_str(&disk::read_own(&paths.build_record(self.name))).unwrap_or_default()
    }

    /// Whether its programs are older than their sources, or missing.
    pub fn is_stale(self, paths: &Paths, all: &[Figure], sources: &SourceHashes) -> bool {
        let recorded = self.recorded(paths);
        recorded != self.current(paths, all, sources) || recorded.programs.len() != self.programs(all).count()
    }

    /// Cargo compares dates: whether a source that has changed since the last build is older than what was built then
    /// (the clock was set back, an archive has kept its dates, it was saved during the build), so that cargo would
    /// leave the program as it was.
    fn is_hidden_from_cargo(self, paths: &Paths, all: &[Figure], sources: &SourceHashes) -> bool {
        let newest = self.programs(all).filter_map(|name| date(&paths.binary(name))).max();
        let built_from = self.recorded(paths).sources;
        let changed = |(name, hash): &(&String, &String)| built_from.get(*name) != Some(*hash);
        let mut changed = sources.files.iter().filter(|_| !built_from.is_empty()).filter(changed);
        changed.any(|(name, _)| date(&paths.root.join(name)) <= newest)
    }
}

/// Builds packages if needed; cargo's words go to stderr.
///
/// # Errors
/// Unsupported: no cargo, or a font is missing or damaged. Failed: the build fails, or leaves a program unmade.
pub fn ensure(paths: &Paths, all: &[Figure], sources: &SourceHashes, packages: &[Package]) -> Result<(), Failure> {
    let stale = |package: &&Package| package.is_stale(paths, all, sources);
    if packages.iter().filter(stale).any(|package| package.is_hidden_from_cargo(paths, all, sources)) {
        // what they share goes for all of them
        cargo(paths, CLEAN)?;
    }
    for package in packages.iter().filter(stale) {
        check_fonts(paths)?;
        disk::remove(&paths.build_record(package.name))?;
        cargo(paths, package.command().trim_start_matches("cargo "))?;
        let built = package.current(paths, all, sources);
        if let Some(name) = package.programs(all).find(|name| !built.programs.contains_key(*name)) {
            return Err(Failure::Failed(format!("{} made no program {name}", package.command())));
        }
        let text = serde_json::to_string_pretty(&built).map_err(Failure::failed)?;
        disk::write_own(&paths.build_record(package.name), text.as_bytes())?;
    }
    Ok(())
}

/// As [`ensure`], for verbs that start one of the tools of a package.
///
/// # Errors
/// As [`ensure`].
pub fn tools(paths: &Paths, package: Package) -> Result<(), Failure> {
    let all = figure::discover(paths)?;
    ensure(paths, &all, &SourceHashes::read(paths)?, &[package])
}

/// Builds a program that no figure is made by (`verify`, `publish`, ...) and gives the command that starts it on this
/// checkout. Cargo finds out when there is nothing to do.
///
/// # Errors
/// Unsupported: no cargo. Failed: the build fails.
pub fn program(paths: &Paths, package: &str, name: &str) -> Result<Command, Failure> {
    cargo(paths, &format!("build --quiet --release --locked -p {package}"))?;
    let mut command = Command::new(paths.binary(name));
    command.arg(format!("--root={}", paths.root.display())).env("CARGO_TARGET_DIR", &paths.target);
    Ok(command)
}

fn cargo(paths: &Paths, words: &str) -> Result<(), Failure> {
    let mut cargo = process::cargo();
    cargo.args(words.split(' ')).current_dir(&paths.root).env("CARGO_TARGET_DIR", &paths.target);
    process::run_shown(&mut cargo).map_err(|failure| match failure {
        Failure::Child(code) => Failure::Failed(format!("cargo {words}: exit code {code}")),
        other => other,
    })
}

/// Whether the fonts of the pictures exist with the expected bytes.
///
/// # Errors
/// Unsupported: one is missing or damaged, with its name. Failed: one cannot be read.
pub fn check_fonts(paths: &Paths) -> Result<(), Failure> {
    let files = FONT_SUMS.map(|(name, _)| paths.fonts().join(name));
    for ((file, hash), (_, expected)) in files.iter().zip(hashing::hash_all(&files)?).zip(FONT_SUMS) {
        let problem = match hash {
            None => "no such font".to_owned(),
            Some(hash) if hash != expected => format!("damaged font: expected the SHA-256 {expected}, found {hash}"),
            Some(_) => continue,
        };
        let file = file.display();
        return Err(Failure::Unsupported(format!("{file}: {problem}; {FONTS_REMEDY}")));
    }
    Ok(())
}

/// Bytes, and nanoseconds since 1970.
fn stamp(path: &Path) -> Option<(u64, u128)> {
    let date = date(path)?.duration_since(UNIX_EPOCH).ok()?;
    Some((path.metadata().ok()?.len(), date.as_nanos()))
}

fn date(path: &Path) -> Option<SystemTime> {
    path.metadata().and_then(|data| data.modified()).ok()
}
