//! `verify`: recomputes into a scratch folder and judges bytes and numbers against what is committed.

use super::summary::Committed;
use crate::cli::VerifyArgs;
use crate::compile;
use crate::disk;
use crate::failure::Failure;
use crate::figure;
use crate::golden::{self, Distances};
use crate::lock::Lock;
use crate::numbers::{Distance, Worst};
use crate::paths::Paths;
use crate::plan::{self, Wish};
use crate::print;
use crate::record::{self, Records, Survey};
use crate::sources::Sources;
use crate::sums::State;
use crate::work;
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// The judgement of one figure.
struct Verdict {
    id: String,
    label: String,
    bytes: BTreeMap<String, State>,
    numbers: Distances,
}

/// Runs the verb.
///
/// # Errors
/// Differs: bytes or numbers are not as committed, or nothing is committed. Otherwise what kept a figure from being
/// made.
pub fn run(paths: &Paths, arguments: &VerifyArgs) -> Result<(), Failure> {
    let all = figure::discover(paths)?;
    let selected = figure::select(&all, &arguments.selection.ids, arguments.selection.all)?;
    let committed = Committed::read(paths)?;
    if let Some(figure) = selected.iter().find(|figure| committed.list(figure.is_supplement()).is_none()) {
        let name = paths.sums(figure.is_supplement());
        return Err(Failure::Differs(format!("{name} does not exist yet: nothing to verify {} against", figure.id)));
    }
    let _lock = Lock::take(paths)?;
    let sources = Sources::read(paths)?;
    compile::ensure(paths, &all, &sources)?;
    let scratch = paths.scratch();
    disk::remove(&scratch.base)?;
    let surveys = record::survey(&scratch, &selected, &sources, &Records::default())?;
    let wishes = vec![Wish { draw: true, measure: false }; surveys.len()];
    let nodes = plan::make(&scratch, &surveys, &wishes, true)?;
    let effort = &arguments.effort;
    let outcomes =
        work::carry_out(&scratch, &surveys, &nodes, effort.threads(), effort.keep_going, &mut |_, _| Ok(()))?;
    work::verdict(&nodes, &outcomes)?;
    let surveys = record::survey(&scratch, &selected, &sources, &Records::default())?;
    let verdicts = judge(paths, &scratch, &surveys, &committed)?;
    show(&verdicts, arguments.json)?;
    conclude(&verdicts, &scratch)
}

fn judge(
    paths: &Paths,
    scratch: &Paths,
    surveys: &[Survey<'_>],
    committed: &Committed,
) -> Result<Vec<Verdict>, Failure> {
    let verdict = |survey: &Survey<'_>| {
        Ok(Verdict {
            id: survey.figure.id.clone(),
            label: survey.figure.label().to_owned(),
            bytes: committed.judge(scratch, survey),
            numbers: golden::judge(paths, scratch, survey.figure)?,
        })
    };
    surveys.iter().map(verdict).collect()
}

fn conclude(verdicts: &[Verdict], scratch: &Paths) -> Result<(), Failure> {
    let wrong: Vec<&str> = verdicts.iter().filter(|verdict| !verdict.is_same()).map(|verdict| &*verdict.id).collect();
    if wrong.is_empty() {
        return disk::remove(&scratch.base);
    }
    let place = scratch.base.display();
    Err(Failure::Differs(format!("not as committed: {}; what was made now lies in {place}", wrong.join(" "))))
}

impl Verdict {
    fn bytes_are_same(&self) -> bool {
        self.bytes.values().all(|&state| state == State::Same)
    }

    fn numbers_are_same(&self) -> bool {
        self.numbers.values().all(|distance| distance.as_ref().is_ok_and(|distance| distance.cells == 0))
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
            "numbers": { "verdict": word(self.numbers_are_same()), "tables": tables },
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
        files.chain(tables).collect()
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

fn word(same: bool) -> &'static str {
    if same { State::Same.word() } else { State::Differs.word() }
}

fn show(verdicts: &[Verdict], as_json: bool) -> Result<(), Failure> {
    if as_json {
        let figures: Vec<Value> = verdicts.iter().map(Verdict::to_json).collect();
        return print::json(json!({ "figures": figures, "ok": verdicts.iter().all(Verdict::is_same) }));
    }
    let mut rows = vec![print::row(&["figure", "label", "bytes", "numbers"])];
    for verdict in verdicts {
        let (bytes, numbers) = (word(verdict.bytes_are_same()), word(verdict.numbers_are_same()));
        let numbers = if verdict.numbers.is_empty() { "no tables" } else { numbers };
        rows.push(print::row(&[&verdict.id, &verdict.label, bytes, numbers]));
    }
    let details: Vec<String> = verdicts.iter().flat_map(Verdict::details).map(|line| format!("{line}\n")).collect();
    print::out(&format!("{}{}", print::table(&rows), details.concat()))
}
