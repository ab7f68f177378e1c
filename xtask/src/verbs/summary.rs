//! The summary of `figures`: a line for each figure, and whether everything is as committed.

use crate::measured::Measured;
use crate::record::{FigureState, Records};
use crate::work::Ends;
use checkout::failure::Failure;
use checkout::figure::Figure;
use checkout::manifest::FLAGGED_ABOVE;
use checkout::outputs;
use checkout::paths::{Paths, Scheme};
use checkout::print;
use checkout::sums::{Committed, State, stray};
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// What to look at when every figure is as committed.
const OPEN_ALL: &str = "open README.md for the table of figures, figures/*/fig*.png for the pictures";

/// One line of the summary.
#[derive(Clone, Debug)]
struct Line<'a> {
    figure: &'a Figure,
    /// Seconds of the figure's own program, if it ran now.
    seconds: Option<f64>,
    tables: usize,
    /// `failed` or `skipped`: it could not be made, so the files are not the requested ones.
    lost: Option<&'static str>,
    states: BTreeMap<String, State>,
    error: Option<f64>,
    /// Errors above the bound, in words.
    flags: Vec<String>,
}

impl<'a> Line<'a> {
    fn new(paths: &Paths, survey: &FigureState<'a>, records: &Records, committed: &Committed, ends: &Ends) -> Line<'a> {
        let figure = survey.figure;
        let lost = match () {
            () if ends.failed.contains(&figure.slug) => Some("failed"),
            () if ends.skipped.contains(&figure.slug) => Some("skipped"),
            () => Some("failed").filter(|_| !survey.reasons.is_empty()),
        };
        let record = records.get(paths, figure).filter(|_| lost.is_none());
        let measured = record.and_then(|record| record.measured.as_ref());
        Line {
            figure,
            seconds: ends.seconds.get(&figure.slug).copied(),
            tables: survey.outputs.keys().filter(|name| name.ends_with(".csv")).count(),
            lost,
            states: committed.judge(paths, survey.figure, &survey.outputs),
            error: measured.and_then(Measured::largest_error),
            flags: measured.map(Measured::flags).unwrap_or_default(),
        }
    }

    fn state(&self) -> &'static str {
        let has = |state: State| self.states.values().any(|&other| other == state);
        let worst = [State::Missing, State::Differs, State::New].into_iter().find(|&state| has(state));
        self.lost.unwrap_or(worst.unwrap_or(State::Same).word())
    }

    fn to_json(&self) -> Value {
        let outputs: BTreeMap<&str, &str> =
            self.states.iter().map(|(name, state)| (name.as_str(), state.word())).collect();
        json!({
            "figure": self.figure.id, "label": self.figure.label(), "binary": self.figure.slug, "seconds": self.seconds,
            "cached": self.seconds.is_none() && self.lost.is_none(), "tables": self.tables, "state": self.state(),
            "error": self.error.filter(|error| error.is_finite()), "flagged": self.flags, "outputs": outputs,
        })
    }

    fn to_row(&self) -> Vec<String> {
        let cached = if self.lost.is_some() { "-" } else { "cached" };
        let seconds = self.seconds.map_or(cached.to_owned(), |seconds| format!("{seconds:.2}"));
        let error = self.error.map_or("-".to_owned(), |error| format!("{error:.1e}"));
        let flag = if self.error.is_some_and(|error| error > FLAGGED_ABOVE) { " !" } else { "" };
        let tables = self.tables.to_string();
        print::row(&[&self.figure.id, self.figure.label(), &seconds, &tables, self.state(), &format!("{error}{flag}")])
    }
}

/// The summary of all figures that were asked for.
#[derive(Clone, Debug)]
pub struct Report<'a> {
    lines: Vec<Line<'a>>,
    committed: Committed,
    ends: Ends,
}

impl<'a> Report<'a> {
    /// Judges the figures; `ends` are those of the nodes of this run.
    pub fn new(
        paths: &Paths,
        surveys: &[FigureState<'a>],
        records: &Records,
        committed: Committed,
        ends: &Ends,
    ) -> Report<'a> {
        let lines = surveys.iter().map(|survey| Line::new(paths, survey, records, &committed, ends)).collect();
        Report { lines, committed, ends: ends.clone() }
    }

    /// Prints the summary as a table or as JSON; `ok` is whether the verb ends well, `whole` whether no figure was
    /// picked.
    ///
    /// # Errors
    /// stdout cannot be written.
    pub fn print(&self, paths: &Paths, as_json: bool, whole: bool, ok: bool) -> Result<(), Failure> {
        if as_json {
            let figures: Vec<Value> = self.lines.iter().map(Line::to_json).collect();
            let (failed, skipped) = (&self.ends.failed, &self.ends.skipped);
            return print::json(json!({ "figures": figures, "ok": ok, "failed": failed, "skipped": skipped }));
        }
        let mut rows = vec![print::row(&["figure", "label", "seconds", "tables", "state", "error"])];
        rows.extend(self.lines.iter().map(Line::to_row));
        print::out(&format!("{}{}", print::table(&rows), self.open(paths, whole)))
    }

    /// What to look at: everything when all figures are as committed; else the first figure that is not, else the first
    /// that was made now, else the last.
    fn open(&self, paths: &Paths, whole: bool) -> String {
        let same = |line: &Line<'_>| line.state() == State::Same.word();
        if whole && paths.scheme == Scheme::Adaptive && self.lines.iter().all(same) {
            return format!("{OPEN_ALL}\n");
        }
        let made: Vec<&Line<'_>> = self.lines.iter().filter(|line| line.lost.is_none()).collect();
        let differs = made.iter().find(|line| !same(line));
        let first = differs.or_else(|| made.iter().find(|line| line.seconds.is_some())).or(made.last());
        let [picture, _] = first.map(|line| outputs::pictures(paths, line.figure)).unwrap_or_default();
        if picture.is_empty() { picture } else { format!("open {picture}\n") }
    }

    /// Whether every output is as committed and every error below the bound. With `whole`, lines of the lists that
    /// belong to no figure count too.
    ///
    /// # Errors
    /// Differs, with the files that are not, and the tables, columns and errors.
    pub fn verdict(&self, paths: &Paths, whole: bool) -> Result<(), Failure> {
        let mut said: Vec<String> = self.lines.iter().flat_map(|line| line.flags.clone()).collect();
        if !said.is_empty() {
            said.push(format!("errors above {FLAGGED_ABOVE:e} of the data range, or unknown: {}", said.len()));
        }
        let absent = |line: &&Line<'_>| self.committed.list(line.figure.is_supplement()).is_none();
        if let Some(line) = self.lines.iter().find(absent) {
            let name = paths.sums(line.figure.is_supplement());
            said.push(format!("{name} does not exist yet; cargo xtask bless writes it"));
        } else {
            said.extend(self.not_as_committed(paths, whole));
        }
        if said.is_empty() { Ok(()) } else { Err(Failure::Differs(said.join("\n"))) }
    }

    /// A line for each output that is not, and their number.
    fn not_as_committed(&self, paths: &Paths, whole: bool) -> Vec<String> {
        let states = self.lines.iter().flat_map(|line| &line.states).filter(|(_, state)| **state != State::Same);
        let mut wrong: Vec<String> = states.map(|(name, state)| format!("{}: {name}", state.word())).collect();
        if whole {
            let strays = self.committed.strays(paths, self.lines.iter().map(|line| line.figure));
            wrong.extend(strays.iter().map(|name| stray(name)));
        }
        if !wrong.is_empty() {
            wrong.push(format!("{} of the outputs not as committed", wrong.len()));
        }
        wrong
    }
}
