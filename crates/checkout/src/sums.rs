//! Lists of checksums in the format of GNU coreutils: 64 hexadecimal digits, two spaces, a name.

use crate::disk;
use crate::failure::Failure;
use crate::figure::Figure;
use crate::outputs::{self, Hashes};
use crate::paths::Paths;
use std::collections::BTreeMap;
use std::path::Path;

/// Hashes by name, sorted.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sums {
    /// SHA-256 in hexadecimal digits, by the name of the file.
    pub by_name: BTreeMap<String, String>,
}

/// Puts a line in a list, in place of the line of that name.
///
/// # Errors
/// The list is malformed, or cannot be read or written.
pub fn record(list: &Path, name: &str, hash: &str) -> Result<(), Failure> {
    let mut sums = Sums::read(list, &list.display().to_string())?.unwrap_or_default();
    sums.by_name.insert(name.to_owned(), hash.to_owned());
    disk::write_if_changed(list, sums.to_text().as_bytes())
}

/// The result of comparing one file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    /// The same bytes.
    Same,
    /// Other bytes.
    Differs,
    /// Made, but not in the list.
    New,
    /// In the list, but not made.
    Missing,
}

impl State {
    /// The word for tables and JSON.
    pub fn word(self) -> &'static str {
        match self {
            State::Same => "same",
            State::Differs => "differs",
            State::New => "new",
            State::Missing => "missing",
        }
    }
}

impl Sums {
    /// Parses a list; `file` is only for messages.
    ///
    /// # Errors
    /// Usage: a line of another form, a name that leaves the root or has control characters, or a repeated name; with
    /// the line number.
    pub fn parse(file: &str, text: &str) -> Result<Sums, Failure> {
        let mut by_name = BTreeMap::new();
        for (index, line) in text.lines().enumerate() {
            let fail = |problem: &str| Failure::Usage(format!("{file}:{}: {problem}: {line:?}", index + 1));
            let (hash, name) = line.split_once("  ").ok_or_else(|| fail("not `hash  name`"))?;
            if hash.len() != 64 || !hash.bytes().all(|byte| matches!(byte, b'0'..=b'9' | b'a'..=b'f')) {
                return Err(fail("not 64 lower-case hexadecimal digits"));
            }
            // a last line without an end keeps its carriage return
            if name.contains(char::is_control) {
                return Err(fail("a control character in the name"));
            }
            if name.is_empty() || name.starts_with('/') || name.split('/').any(|part| part == "..") {
                return Err(fail("not a name relative to the root"));
            }
            if by_name.insert(name.to_owned(), hash.to_owned()).is_some() {
                return Err(fail("this name appears twice"));
            }
        }
        Ok(Sums { by_name })
    }

    /// Reads a list; `None` when there is no such file. `name` is only for messages.
    ///
    /// # Errors
    /// As [`Sums::parse`], or the file cannot be read.
    pub fn read(path: &Path, name: &str) -> Result<Option<Sums>, Failure> {
        disk::read_text(path)?.map(|text| Sums::parse(name, &text)).transpose()
    }

    /// The list as text, sorted by name.
    pub fn to_text(&self) -> String {
        self.by_name.iter().map(|(name, hash)| format!("{hash}  {name}\n")).collect()
    }

    /// The entries whose names begin with one of these.
    pub fn below(&self, starts: &[String]) -> Sums {
        let belongs = |name: &str| starts.iter().any(|start| name.starts_with(start.as_str()));
        let kept = self.by_name.iter().filter(|(name, _)| belongs(name));
        Sums { by_name: kept.map(|(name, hash)| (name.clone(), hash.clone())).collect() }
    }

    /// Judges what was made against this list, a state for each name of either.
    pub fn judge(&self, made: &BTreeMap<String, String>) -> BTreeMap<String, State> {
        let mut states: BTreeMap<String, State> =
            self.by_name.keys().map(|name| (name.clone(), State::Missing)).collect();
        for (name, hash) in made {
            let state = match self.by_name.get(name) {
                None => State::New,
                Some(expected) if expected == hash => State::Same,
                Some(_) => State::Differs,
            };
            states.insert(name.clone(), state);
        }
        states
    }
}

/// The committed lists of sums; `None` if there is none yet.
#[derive(Clone, Debug)]
pub struct Committed {
    paper: Option<Sums>,
    supplements: Option<Sums>,
}

impl Committed {
    /// Reads both lists.
    ///
    /// # Errors
    /// Usage: a list is malformed. Failed: it cannot be read.
    pub fn read(paths: &Paths) -> Result<Committed, Failure> {
        let read = |supplement| {
            let name = paths.sums(supplement);
            Sums::read(&paths.root.join(name), name)
        };
        Ok(Committed { paper: read(false)?, supplements: read(true)? })
    }

    /// The list that a figure belongs to.
    pub fn list(&self, supplement: bool) -> Option<&Sums> {
        if supplement { self.supplements.as_ref() } else { self.paper.as_ref() }
    }

    /// A state for each output that the figure has or should have.
    pub fn judge(&self, paths: &Paths, figure: &Figure, made: &Hashes) -> BTreeMap<String, State> {
        let list = self.list(figure.is_supplement()).cloned().unwrap_or_default();
        list.below(&outputs::beginnings(paths, figure)).judge(made)
    }

    /// Lines of the lists that belong to none of the figures. Only for all figures of a list; a list of which no figure
    /// is given is left alone.
    pub fn strays<'a>(&self, paths: &Paths, figures: impl Iterator<Item = &'a Figure> + Clone) -> Vec<String> {
        let mut strays = Vec::new();
        for supplement in [false, true] {
            let mine = figures.clone().filter(|figure| figure.is_supplement() == supplement);
            let starts: Vec<String> = mine.flat_map(|figure| outputs::beginnings(paths, figure)).collect();
            let Some(list) = self.list(supplement).filter(|_| !starts.is_empty()) else { continue };
            let known = list.below(&starts);
            strays.extend(list.by_name.keys().filter(|name| !known.by_name.contains_key(*name)).cloned());
        }
        strays
    }
}

/// The message about a line that belongs to no figure.
pub fn stray(name: &str) -> String {
    format!("belongs to no figure: {name}")
}
