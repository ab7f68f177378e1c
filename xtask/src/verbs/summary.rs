//! What `figures` says at its end: a line for each figure, and whether everything is as committed.

use super::figures::Times;
use crate::failure::Failure;
use crate::manifest::FLAGGED_ABOVE;
use crate::outputs;
use crate::paths::Paths;
use crate::print;
use crate::record::{Records, Survey};
use crate::sums::{State, Sums};
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// The committed lists of sums; `None` where there is none yet.
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
    pub fn judge(&self, paths: &Paths, survey: &Survey<'_>) -> BTreeMap<String, State> {
        let list = self.list(survey.figure.is_supplement()).cloned().unwrap_or_default();
        list.below(&outputs::beginnings(paths, survey.figure)).judge(&survey.outputs)
    }
}

/// One line of the summary.
#[derive(Clone, Debug)]
struct Line {
    id: String,
    label: String,
    slug: String,
    supplement: bool,
    /// Seconds of the figure's own program, if it ran now.
    seconds: Option<f64>,
    tables: usize,
    /// It could not be made.
    failed: bool,
    states: BTreeMap<String, State>,
    error: Option<f64>,
}

impl Line {
    fn state(&self) -> &'static str {
        let has = |state: State| self.states.values().any(|&other| other == state);
        match [State::Missing, State::Differs, State::New].into_iter().find(|&state| has(state)) {
            _ if self.failed => "failed",
            Some(state) => state.word(),
            None => State::Same.word(),
        }
    }

    fn to_json(&self) -> Value {
        let outputs: BTreeMap<&str, &str> =
            self.states.iter().map(|(name, state)| (name.as_str(), state.word())).collect();
        json!({
            "figure": self.id, "label": self.label, "binary": self.slug, "seconds": self.seconds,
            "cached": self.seconds.is_none() && !self.failed, "tables": self.tables, "state": self.state(),
            "error": self.error.filter(|error| error.is_finite()), "outputs": outputs,
        })
    }

    fn to_row(&self) -> Vec<String> {
        let cached = if self.failed { "-" } else { "cached" };
        let seconds = self.seconds.map_or(cached.to_owned(), |seconds| format!("{seconds:.2}"));
        let error = self.error.map_or("-".to_owned(), |error| format!("{error:.1e}"));
        let flag = if self.error.is_some_and(|error| error > FLAGGED_ABOVE) { " !" } else { "" };
        let tables = self.tables.to_string();
        print::row(&[&self.id, &self.label, &seconds, &tables, self.state(), &format!("{error}{flag}")])
    }
}

/// The summary of all figures that were asked for.
#[derive(Clone, Debug)]
pub struct Report {
    lines: Vec<Line>,
}

impl Report {
    /// Judges the figures; `seconds` are those of the nodes that ran now.
    pub fn new(
        paths: &Paths,
        surveys: &[Survey<'_>],
        records: &Records,
        committed: &Committed,
        seconds: Times,
    ) -> Report {
        let line = |survey: &Survey<'_>| Line {
            id: survey.figure.id.clone(),
            label: survey.figure.label().to_owned(),
            slug: survey.figure.slug.clone(),
            supplement: survey.figure.is_supplement(),
            seconds: seconds.get(&survey.figure.slug).copied(),
            tables: survey.outputs.keys().filter(|name| name.ends_with(".csv")).count(),
            failed: !survey.reasons.is_empty(),
            states: committed.judge(paths, survey),
            error: records.get(paths, survey.figure).and_then(|record| record.measured.as_ref()?.largest_error()),
        };
        Report { lines: surveys.iter().map(line).collect() }
    }

    /// Prints the summary as a table or as JSON.
    ///
    /// # Errors
    /// stdout cannot be written.
    pub fn print(&self, paths: &Paths, as_json: bool) -> Result<(), Failure> {
        if as_json {
            let figures: Vec<Value> = self.lines.iter().map(Line::to_json).collect();
            let ok = self.lines.iter().all(|line| line.state() == State::Same.word());
            return print::json(json!({ "figures": figures, "ok": ok }));
        }
        let mut rows = vec![print::row(&["figure", "label", "seconds", "tables", "state", "error"])];
        rows.extend(self.lines.iter().map(Line::to_row));
        print::out(&format!("{}{}", print::table(&rows), self.open(paths)))
    }

    /// What to look at: the first figure that is not as committed, else the first that was made now, else the last.
    fn open(&self, paths: &Paths) -> String {
        let made: Vec<&Line> = self.lines.iter().filter(|line| !line.failed).collect();
        let differs = made.iter().find(|line| line.state() != State::Same.word());
        let first = differs.or_else(|| made.iter().find(|line| line.seconds.is_some())).or(made.last());
        first.map_or(String::new(), |line| format!("open {}/{}.png\n", paths.pictures(&line.slug, &line.id), line.id))
    }

    /// Whether every output is as committed. With `whole`, entries of the list that belong to no figure count too.
    ///
    /// # Errors
    /// Differs, with the files that are not.
    pub fn verdict(&self, paths: &Paths, committed: &Committed, whole: bool) -> Result<(), Failure> {
        let absent = |line: &&Line| committed.list(line.supplement).is_none();
        if let Some(line) = self.lines.iter().find(absent) {
            let name = paths.sums(line.supplement);
            return Err(Failure::Differs(format!("{name} does not exist yet; cargo xtask bless writes it")));
        }
        let states = self.lines.iter().flat_map(|line| &line.states).filter(|(_, state)| **state != State::Same);
        let mut wrong: Vec<String> = states.map(|(name, state)| format!("{}: {name}", state.word())).collect();
        let known = |name: &str| self.lines.iter().any(|line| line.states.contains_key(name));
        if whole && let Some(list) = committed.list(false) {
            let strays = list.by_name.keys().filter(|name| !known(name));
            wrong.extend(strays.map(|name| format!("belongs to no figure: {name}")));
        }
        match wrong.len() {
            0 => Ok(()),
            count => Err(Failure::Differs(format!("{}\n{count} of the outputs not as committed", wrong.join("\n")))),
        }
    }
}
