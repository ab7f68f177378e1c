//! The committed reference: sums, events, samples, tolerances, and whole tables and pictures where they are available.

use crate::moved::{self, Moved};
use crate::tolerances::Tolerances;
use checkout::disk;
use checkout::events::{self, ByScene};
use checkout::failure::Failure;
use checkout::figure::Figure;
use checkout::outputs;
use checkout::paths::{EVENTS, Paths};
use checkout::process;
use checkout::request::{MadeFigure, Request};
use checkout::sums::{Committed, stray};
use std::collections::{BTreeMap, BTreeSet};
use std::process::Command;

/// What the figures are judged against.
#[derive(Clone, Debug)]
pub struct Reference {
    /// The lists of sums.
    pub sums: Committed,
    /// The table of events.
    pub events: ByScene,
    /// The scene of each run, by key.
    pub scenes: BTreeMap<String, String>,
    /// How far numbers may be from the committed ones.
    pub tolerances: Tolerances,
}

impl Reference {
    /// Reads it.
    ///
    /// # Errors
    /// Usage: a committed file is malformed. Differs: the table of events is missing.
    pub fn read(paths: &Paths, request: &Request) -> Result<Reference, Failure> {
        let missing = || Failure::Differs(format!("{EVENTS} does not exist: git restore it, or cargo xtask figures"));
        let events = disk::read_text(&paths.root.join(EVENTS))?.ok_or_else(missing)?;
        Reference::with_events(paths, request, &events)
    }

    /// As [`Reference::read`], with the events of the last commit: those in the checkout are written as figures are
    /// made.
    ///
    /// # Errors
    /// As [`Reference::read`].
    pub fn of_last_commit(paths: &Paths, request: &Request) -> Result<Reference, Failure> {
        match in_git(paths, EVENTS).and_then(|bytes| String::from_utf8(bytes).ok()) {
            Some(events) => Reference::with_events(paths, request, &events),
            None => Reference::read(paths, request),
        }
    }

    fn with_events(paths: &Paths, request: &Request, events: &str) -> Result<Reference, Failure> {
        Ok(Reference {
            events: events::parse_all(EVENTS, events)?,
            sums: Committed::read(&paths.with_scheme(request.scheme))?,
            scenes: request.scenes.clone(),
            tolerances: Tolerances::read(paths)?,
        })
    }

    /// Compares the events of a figure's runs with the committed ones.
    ///
    /// # Errors
    /// The events of a run cannot be read.
    pub fn moved_events(&self, made: &Paths, survey: &MadeFigure<'_>) -> Result<Vec<Moved>, Failure> {
        let mut moved = Vec::new();
        for (_, key) in &survey.runs {
            let Some(scene) = self.scenes.get(key) else { continue };
            let committed = self.events.get(scene).map_or(&[][..], Vec::as_slice);
            let found = events::of_run(&made.store().join(key))?;
            moved.extend(moved::compare(scene, committed, &found, self.tolerances.event(scene)));
        }
        Ok(moved)
    }

    /// Lines of what is committed that belong to no figure.
    pub fn strays(&self, paths: &Paths, selected: &[&Figure]) -> Vec<String> {
        let scenes: BTreeSet<&String> = self.scenes.values().collect();
        let unknown = self.events.keys().filter(|scene| !scenes.contains(scene));
        let sums = self.sums.strays(paths, selected.iter().copied());
        let unknown = unknown.map(|scene| format!("{EVENTS}, scene {scene}"));
        sums.into_iter().chain(unknown).map(|name| stray(&name)).collect()
    }

    /// The committed bytes of an output: those of the file in the checkout if it has the committed sum, else those that
    /// git has of the last commit, else none.
    ///
    /// # Errors
    /// The file is there and cannot be read.
    pub fn bytes(&self, paths: &Paths, figure: &Figure, name: &str) -> Result<Option<Vec<u8>>, Failure> {
        let list = self.sums.list(figure.is_supplement());
        let Some(sum) = list.and_then(|list| list.by_name.get(name)) else { return Ok(None) };
        let is_committed = |bytes: &Vec<u8>| files::write::sha256(bytes) == *sum;
        let here = disk::read_bytes(&paths.root.join(name))?.filter(is_committed);
        Ok(here.or_else(|| in_git(paths, name).filter(is_committed)))
    }
}

/// A file as the last commit has it.
fn in_git(paths: &Paths, name: &str) -> Option<Vec<u8>> {
    let mut git = Command::new("git");
    git.arg("-C").arg(&paths.root).arg("show").arg(format!("HEAD:./{name}"));
    process::output(&mut git)
}

/// The names of the tables that a figure has below `made`, by file name.
///
/// # Errors
/// The folder cannot be read.
pub fn tables(made: &Paths, figure: &Figure) -> Result<BTreeMap<String, String>, Failure> {
    let named = outputs::tables(made, figure)?.into_iter();
    Ok(named.map(|name| (name.rsplit('/').next().unwrap_or(&name).to_owned(), name)).collect())
}
