//! `verify`: recomputes into a scratch folder and judges bytes, numbers and claims against what is committed.

use super::summary::{Committed, stray};
use crate::cli::VerifyArgs;
use crate::compile;
use crate::disk;
use crate::estimate;
use crate::events::{self, ByScene, Moved};
use crate::failure::Failure;
use crate::figure::{self, Figure};
use crate::golden::{self, Distances};
use crate::ledger;
use crate::lock::Lock;
use crate::numbers::{Distance, Worst};
use crate::paths::{EVENTS, Paths};
use crate::plan::{self, Wish};
use crate::print;
use crate::record::{self, Records, Survey};
use crate::sources::Sources;
use crate::store;
use crate::sums::State;
use crate::work;
use serde_json::{Value, json};
use std::collections::{BTreeMap, BTreeSet};

/// The judgement of one figure.
struct Verdict {
    id: String,
    label: String,
    bytes: BTreeMap<String, State>,
    numbers: Distances,
    /// Events of its runs that are not as committed.
    events: Vec<Moved>,
}

/// What the figures are judged against.
struct Reference {
    sums: Committed,
    events: ByScene,
    /// The scene of each run, by key.
    scenes: BTreeMap<String, String>,
}

/// Runs the verb.
///
/// # Errors
/// Differs: bytes, numbers or verdicts of claims are not as committed, or nothing is committed. Usage: the ledger is
/// malformed. Otherwise what kept a figure from being made.
pub fn run(paths: &Paths, arguments: &VerifyArgs) -> Result<(), Failure> {
    let all = figure::discover(paths)?;
    let selected = choose(paths, &all, arguments)?;
    let committed = Committed::read(paths)?;
    if let Some(figure) = selected.iter().find(|figure| committed.list(figure.is_supplement()).is_none()) {
        let name = paths.sums(figure.is_supplement());
        return Err(Failure::Differs(format!("{name} does not exist yet: nothing to verify {} against", figure.id)));
    }
    let events = committed_events(paths)?;
    let _lock = Lock::take(paths)?;
    work::sweep(paths, &all)?;
    let sources = Sources::read(paths)?;
    compile::ensure(paths, &all, &sources)?;
    let scratch = paths.scratch();
    disk::remove(&scratch.base)?;
    // what a failed figure has left in the scratch folder says nothing; its words are on stderr
    let surveys = recompute(&scratch, &selected, &sources, arguments).inspect_err(|_| {
        let _ = disk::remove(&scratch.base);
    })?;
    let reference = Reference { sums: committed, events, scenes: record::scenes(paths, &all, &sources.numeric()) };
    let verdicts = judge(paths, &scratch, &surveys, &reference)?;
    let whole = arguments.selection.ids.is_empty();
    let figures: BTreeSet<&str> = selected.iter().map(|figure| &*figure.id).collect();
    let claims = ledger::judge(paths, &scratch, (!whole).then_some(&figures))?;
    let listed: Vec<&Figure> = figure::select(&all, &[], arguments.selection.all)?;
    let strays = if whole { strays(paths, &reference, &listed) } else { Vec::new() };
    show(&verdicts, &claims, &strays, arguments.json)?;
    conclude(&verdicts, &claims, &strays, &scratch)
}

/// The figures meant; without one those of the paper and the supplements that the ledger reads.
fn choose<'a>(paths: &Paths, all: &'a [Figure], arguments: &VerifyArgs) -> Result<Vec<&'a Figure>, Failure> {
    let read = ledger::figures(paths)?;
    let selected = figure::select(all, &arguments.selection.ids, arguments.selection.all)?;
    if !arguments.selection.ids.is_empty() {
        return Ok(selected);
    }
    // a figure that the ledger names and that does not exist is told, with the claim, when the claim is judged
    let read = read.into_iter().filter(|id| all.iter().any(|figure| figure.id == *id));
    let ids: Vec<String> = selected.iter().map(|figure| figure.id.clone()).chain(read).collect();
    figure::select(all, &ids, false)
}

/// Makes everything that the figures need in the scratch folder.
fn recompute<'a>(
    scratch: &Paths,
    selected: &[&'a Figure],
    sources: &Sources,
    arguments: &VerifyArgs,
) -> Result<Vec<Survey<'a>>, Failure> {
    let surveys = record::survey(scratch, selected, sources, &Records::default())?;
    let wishes = vec![Wish { draw: true, measure: false }; surveys.len()];
    let nodes = plan::make(scratch, &surveys, &wishes, true)?;
    let effort = &arguments.effort;
    let outcomes = work::carry_out(scratch, &surveys, &nodes, effort.threads(), effort.keep_going, &mut |_, _| Ok(()))?;
    work::verdict(&nodes, &outcomes)?;
    record::survey(scratch, selected, sources, &Records::default())
}

/// The table of events, before any work.
fn committed_events(paths: &Paths) -> Result<ByScene, Failure> {
    match disk::read_text(&paths.events())? {
        Some(text) => events::parse_all(EVENTS, &text),
        None => Err(Failure::Differs(format!("{EVENTS} does not exist: git restore it, or cargo xtask figures"))),
    }
}

/// Lines of what is committed that belong to no figure.
fn strays(paths: &Paths, reference: &Reference, selected: &[&Figure]) -> Vec<String> {
    let scenes: BTreeSet<&String> = reference.scenes.values().collect();
    let unknown = reference.events.keys().filter(|scene| !scenes.contains(scene));
    let sums = reference.sums.strays(paths, selected.iter().copied());
    sums.into_iter().chain(unknown.map(|scene| format!("{EVENTS}, scene {scene}"))).map(|name| stray(&name)).collect()
}

fn judge(
    paths: &Paths,
    scratch: &Paths,
    surveys: &[Survey<'_>],
    reference: &Reference,
) -> Result<Vec<Verdict>, Failure> {
    let verdict = |survey: &Survey<'_>| {
        Ok(Verdict {
            id: survey.figure.id.clone(),
            label: survey.figure.label().to_owned(),
            bytes: reference.sums.judge(scratch, survey),
            numbers: golden::judge(paths, scratch, survey.figure)?,
            events: moved_events(scratch, survey, reference)?,
        })
    };
    surveys.iter().map(verdict).collect()
}

/// Compares the events of a figure's runs with the committed ones.
fn moved_events(scratch: &Paths, survey: &Survey<'_>, reference: &Reference) -> Result<Vec<Moved>, Failure> {
    let mut moved = Vec::new();
    for (_, key) in &survey.runs {
        let Some(scene) = reference.scenes.get(key) else { continue };
        let committed = reference.events.get(scene).map_or(&[][..], Vec::as_slice);
        moved.extend(events::compare(scene, committed, &estimate::events_of(&store::folder(scratch, key))?));
    }
    Ok(moved)
}

fn conclude(
    verdicts: &[Verdict],
    claims: &ledger::Verdicts,
    strays: &[String],
    scratch: &Paths,
) -> Result<(), Failure> {
    let mut wrong: Vec<&str> = verdicts.iter().filter(|verdict| !verdict.is_same()).map(|one| &*one.id).collect();
    wrong.extend((!strays.is_empty()).then_some("lines that belong to no figure"));
    wrong.extend((!claims.is_same()).then_some("claims"));
    if wrong.is_empty() {
        return disk::remove(&scratch.base);
    }
    let place = scratch.base.display();
    Err(Failure::Differs(format!("not as committed: {}; what was made now lies in {place}", wrong.join(" "))))
}

impl Verdict {
    fn bytes_are_same(&self) -> bool {
        self.bytes.values().all(|&state| state == State::Same) && self.events.is_empty()
    }

    fn numbers_are_same(&self) -> bool {
        let tables = self.numbers.values().all(|distance| distance.as_ref().is_ok_and(|distance| distance.cells == 0));
        tables && self.events.iter().all(|moved| moved.ulp == Some(0))
    }

    fn is_same(&self) -> bool {
        self.bytes_are_same() && self.numbers_are_same()
    }

    fn to_json(&self) -> Value {
        let files: BTreeMap<&str, &str> = self.bytes.iter().map(|(name, state)| (&**name, state.word())).collect();
        let table = |distance: &Result<Distance, String>| match distance {
            Ok(distance) => json!(distance),
            Err(problem) => json!({ "problem": problem }),
        };
        let tables: BTreeMap<&str, Value> =
            self.numbers.iter().map(|(name, distance)| (name.as_str(), table(distance))).collect();
        json!({
            "figure": self.id, "label": self.label,
            "bytes": { "verdict": word(self.bytes_are_same()), "files": files },
            "numbers": { "verdict": word(self.numbers_are_same()), "tables": tables, "events": self.events },
        })
    }

    /// What is not as committed, a line each.
    fn details(&self) -> Vec<String> {
        let files = self.bytes.iter().filter(|(_, state)| **state != State::Same);
        let files = files.map(|(name, state)| format!("  {}: {name}", state.word()));
        let tables = self.numbers.iter().filter_map(|(name, distance)| match distance {
            Ok(distance) if distance.cells == 0 => None,
            Ok(distance) => Some(format!("  {name}: {}", describe(distance))),
            Err(problem) => Some(format!("  {name}: {problem}")),
        });
        files
            .chain(tables)
            .chain(self.events.iter().map(|moved| format!("  {EVENTS}: {}", describe_event(moved))))
            .collect()
    }
}

/// A distance in words.
pub fn describe(distance: &Distance) -> String {
    let at = |worst: &Worst| format!("{:.2e} (row {}, {})", worst.value, worst.row, worst.column);
    format!(
        "{} cells differ; largest absolute {}, relative {}, ulp {}",
        distance.cells,
        at(&distance.absolute),
        at(&distance.relative),
        at(&distance.ulp)
    )
}

fn describe_event(moved: &Moved) -> String {
    let Moved { scene, event, n, committed, found, absolute, ulp } = moved;
    let place = format!("{scene}, {event} at pedestrian {n}");
    match (committed, found, absolute, ulp) {
        (Some(committed), Some(found), Some(absolute), Some(ulp)) => {
            format!("{place}: t = {found} in place of {committed}; absolute {absolute:.2e}, ulp {ulp}")
        }
        (Some(committed), ..) => format!("{place}: did not occur at t = {committed}"),
        (None, found, ..) => format!("{place}: new, at t = {}", found.as_deref().unwrap_or("?")),
    }
}

fn word(same: bool) -> &'static str {
    if same { State::Same.word() } else { State::Differs.word() }
}

fn show(verdicts: &[Verdict], claims: &ledger::Verdicts, strays: &[String], as_json: bool) -> Result<(), Failure> {
    if as_json {
        let figures: Vec<Value> = verdicts.iter().map(Verdict::to_json).collect();
        let ok = strays.is_empty() && verdicts.iter().all(Verdict::is_same) && claims.is_same();
        return print::json(json!({ "figures": figures, "claims": claims.to_json(), "strays": strays, "ok": ok }));
    }
    let mut rows = vec![print::row(&["figure", "label", "bytes", "numbers"])];
    for verdict in verdicts {
        let (bytes, numbers) = (word(verdict.bytes_are_same()), word(verdict.numbers_are_same()));
        let numbers = if verdict.numbers.is_empty() { "no tables" } else { numbers };
        rows.push(print::row(&[&verdict.id, &verdict.label, bytes, numbers]));
    }
    let details = verdicts.iter().flat_map(Verdict::details).chain(claims.details()).chain(strays.iter().cloned());
    let details: Vec<String> = details.map(|line| format!("{line}\n")).collect();
    print::out(&format!("{}{}\n{}", print::table(&rows), claims.line(), details.concat()))
}
