//! `figures`: writes tables and pictures, hashes everything, compares with the committed sums.

use super::{judge, summary};
use crate::cli::FiguresArgs;
use crate::compile::{self, Package};
use crate::estimate::Estimate;
use crate::lock::Lock;
use crate::measured;
use crate::plan::{self, Needs, Node, Task};
use crate::pool::Outcome;
use crate::record::{self, FigureState, Record, Records};
use crate::sources::SourceHashes;
use crate::store;
use crate::work::{self, Ends, NodeOutput};
use checkout::disk;
use checkout::failure::Failure;
use checkout::figure::{self, Figure};
use checkout::manifest;
use checkout::paths::{Paths, Scheme};
use checkout::print;
use checkout::print::duration;
use checkout::sums::Committed;
use std::collections::BTreeMap;
use std::fmt::{Display, Formatter};

/// Seconds by the name of the node.
pub type Times = BTreeMap<String, f64>;

/// Runs the verb.
///
/// # Errors
/// Differs: an output is not as committed. Otherwise what kept a figure from being made.
pub fn run(paths: &Paths, arguments: &FiguresArgs) -> Result<(), Failure> {
    let paths = &paths.with_scheme(arguments.scheme);
    let all = figure::discover(paths)?;
    let selected = choose(&all, arguments)?;
    // read before the work, so that a malformed list is told at once
    let committed = Committed::read(paths)?;
    manifest::read(paths)?;
    if arguments.dry_run {
        return dry_run(paths, &all, &selected, arguments);
    }
    let _lock = Lock::take(paths)?;
    work::sweep(paths, &all)?;
    let sources = SourceHashes::read(paths)?;
    compile::ensure(paths, &all, &sources, &Package::of(&selected))?;
    let mut records = Records::read(paths)?;
    let mut surveys = record::survey(paths, &selected, &sources, &records)?;
    let needs = needs(paths, &surveys, &records, arguments);
    let nodes = plan::make(paths, &surveys, &needs, arguments.force)?;
    if arguments.force {
        work::forget(paths, &nodes)?;
    }
    let outcomes = make(paths, &surveys, &nodes, arguments, &mut records)?;
    if !nodes.is_empty() {
        surveys = record::survey(paths, &selected, &sources, &records)?;
    }
    if paths.scheme == Scheme::Adaptive {
        measure(paths, &all, &surveys, &sources, &mut records)?;
    }
    let whole = arguments.selection.ids.is_empty();
    let report = summary::Report::new(paths, &surveys, &records, committed, &Ends::of(&nodes, &outcomes));
    let verdict = work::verdict(&nodes, &outcomes).and_then(|()| report.verdict(paths, whole));
    report.print(paths, arguments.json, whole, verdict.is_ok())?;
    if paths.scheme == Scheme::Paper {
        judge::run(judge::program(paths)?.arg("distances").args(arguments.json.then_some("--json")))?;
    }
    verdict
}

/// The figures meant; for the paper's scheme those with a run.
fn choose<'a>(all: &'a [Figure], arguments: &FiguresArgs) -> Result<Vec<&'a Figure>, Failure> {
    let selected = figure::select(all, &arguments.selection.ids, arguments.selection.all)?;
    if arguments.scheme == Scheme::Adaptive {
        return Ok(selected);
    }
    let (with, without): (Vec<&Figure>, Vec<&Figure>) =
        selected.into_iter().partition(|figure| figure.runs().next().is_some());
    match without.first().filter(|_| !arguments.selection.ids.is_empty()) {
        Some(figure) => {
            let valid: Vec<&str> = all.iter().filter(|one| one.runs().next().is_some()).map(|one| &*one.id).collect();
            let id = &figure.id;
            Err(Failure::Usage(format!("{id} has no run, so a scheme means nothing to it; valid: {}", valid.join(" "))))
        }
        None => Ok(with),
    }
}

fn needs(paths: &Paths, surveys: &[FigureState<'_>], records: &Records, arguments: &FiguresArgs) -> Vec<Needs> {
    let need = |survey: &FigureState<'_>| {
        let draw = arguments.force || !survey.reasons.is_empty();
        let measured = records.get(paths, survey.figure).is_some_and(|record| record.measured.is_some());
        Needs { draw, measure: paths.scheme == Scheme::Adaptive && (draw || !measured) }
    };
    surveys.iter().map(need).collect()
}

/// Carries out the plan. Each figure is recorded as soon as it is made, so an interrupted run loses nothing.
fn make(
    paths: &Paths,
    surveys: &[FigureState<'_>],
    nodes: &[Node],
    arguments: &FiguresArgs,
    records: &mut Records,
) -> Result<Vec<Outcome<NodeOutput>>, Failure> {
    let mut times = read_times(paths)?;
    let mut made = |node: &Node, made: &NodeOutput| {
        if !made.resumed {
            times.insert(paths.times_name(&node.name), made.seconds);
        }
        if let Task::Draw { figure } = node.task {
            let survey = &surveys[figure];
            let report = record::report(paths, survey.figure)?;
            let record = Record::new(survey.inputs.clone(), made.outputs.clone(), report);
            records.figures.insert(paths.tables(&survey.figure.id), record);
            records.write(paths)?;
        }
        Ok(())
    };
    let effort = &arguments.effort;
    let outcomes = work::carry_out(paths, surveys, nodes, effort.threads(), effort.keep_going, &mut made)?;
    if !nodes.is_empty() {
        let text = serde_json::to_string_pretty(&times).map_err(Failure::failed)?;
        disk::write_own(&paths.times(), text.as_bytes())?;
    }
    Ok(outcomes)
}

/// Compares runs with their checks for every figure that is fresh and not measured yet; then writes the manifest.
fn measure(
    paths: &Paths,
    all: &[Figure],
    surveys: &[FigureState<'_>],
    sources: &SourceHashes,
    records: &mut Records,
) -> Result<(), Failure> {
    let scenes = record::scenes(paths, all, &sources.numeric());
    let mut estimates = BTreeMap::new();
    let mut changed = false;
    for survey in surveys.iter().filter(|survey| survey.reasons.is_empty()) {
        let Some(record) = records.figures.get_mut(&paths.tables(&survey.figure.id)) else { continue };
        if record.measured.is_some() || !checks_are_stored(paths, survey) {
            continue;
        }
        for (_, key) in &survey.runs {
            if !estimates.contains_key(key) {
                estimates.insert(key.clone(), Estimate::of(paths, key)?);
            }
        }
        record.measured = Some(measured::measure(paths, survey, &estimates, &scenes)?);
        changed = true;
    }
    if changed {
        records.write(paths)?;
    }
    let fresh = surveys.iter().filter(|survey| survey.reasons.is_empty());
    let measured: Vec<_> = fresh
        .filter_map(|survey| Some((survey.figure, records.get(paths, survey.figure)?.measured.as_ref()?)))
        .collect();
    measured::write(paths, all, &measured)
}

fn checks_are_stored(paths: &Paths, survey: &FigureState<'_>) -> bool {
    survey.runs.iter().all(|(_, key)| store::folder(paths, &store::check_key(key)).is_dir())
}

fn dry_run(paths: &Paths, all: &[Figure], selected: &[&Figure], arguments: &FiguresArgs) -> Result<(), Failure> {
    let sources = SourceHashes::read(paths)?;
    let records = Records::read(paths)?;
    let surveys = record::survey(paths, selected, &sources, &records)?;
    let nodes = plan::make(paths, &surveys, &needs(paths, &surveys, &records, arguments), arguments.force)?;
    let stale = Package::of(selected).into_iter().filter(|package| package.is_stale(paths, all, &sources));
    let builds: Vec<String> = stale.map(Package::command).collect();
    let states: Vec<(&str, &str)> =
        surveys.iter().map(|survey| (&*survey.figure.slug, reason(survey, arguments))).collect();
    let times = read_times(paths)?;
    let last = |node: &Node| times.get(&paths.times_name(&node.name)).copied();
    let forecast = forecast(&nodes, arguments.effort.threads(), &last);
    if arguments.json {
        let steps: Vec<&str> = nodes.iter().map(|node| node.name.as_str()).collect();
        let figures: BTreeMap<&str, &str> = states.into_iter().collect();
        let Forecast { seconds, unknown } = forecast;
        return print::json(serde_json::json!({
            "build": !builds.is_empty(), "figures": figures, "nodes": steps, "seconds": seconds, "nodes_without_time": unknown,
        }));
    }
    let build = builds.join(" && ");
    let mut rows = vec![print::row(&["build", if builds.is_empty() { "fresh" } else { &build }])];
    rows.extend(
        nodes
            .iter()
            .filter(|node| matches!(node.task, Task::Simulate { .. }))
            .map(|node| print::row(&[&node.name, "to run", &last(node).map_or(String::new(), duration)])),
    );
    rows.extend(states.iter().map(|(slug, state)| print::row(&[slug, state])));
    print::out(&format!("{}{forecast}\n", print::table(&rows)))
}

/// How long a plan will take.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Forecast {
    /// Seconds, if the nodes take as long as the last time.
    pub seconds: f64,
    /// Nodes of which no time is known: they are not in the seconds.
    pub unknown: usize,
}

/// The estimated time of the nodes on the given number of threads, from the seconds of their last runs: that of the
/// longest chain, but at least an even share for each thread.
pub fn forecast(nodes: &[Node], threads: usize, last: &dyn Fn(&Node) -> Option<f64>) -> Forecast {
    let seconds: Vec<f64> = nodes.iter().map(|node| last(node).unwrap_or(0.0)).collect();
    // a node needs only earlier ones
    let mut ends: Vec<f64> = Vec::new();
    for (node, own) in nodes.iter().zip(&seconds) {
        let before = node.job.after.iter().map(|&index| ends[index]).max_by(f64::total_cmp);
        ends.push(before.unwrap_or(0.0) + own);
    }
    let chain = ends.into_iter().max_by(f64::total_cmp).unwrap_or(0.0);
    // the sum of no floats is -0
    let share = seconds.iter().fold(0.0, |sum, one| sum + one) / threads.max(1) as f64;
    let unknown = nodes.iter().filter(|node| last(node).is_none()).count();
    Forecast { seconds: if chain > share { chain } else { share }, unknown }
}

impl Display for Forecast {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        write!(f, "about {} judging by the last run", duration(self.seconds))?;
        if self.unknown > 0 {
            write!(f, "; {} nodes not counted because they have not been timed yet", self.unknown)
        } else {
            Ok(())
        }
    }
}

fn reason<'a>(survey: &'a FigureState<'_>, arguments: &FiguresArgs) -> &'a str {
    let forced = if arguments.force { "forced" } else { "fresh" };
    survey.reasons.first().map_or(forced, String::as_str)
}

/// Seconds of the last time each node ran.
///
/// # Errors
/// The file cannot be read.
pub fn read_times(paths: &Paths) -> Result<Times, Failure> {
    let text = disk::read_own(&paths.times());
    Ok(serde_json::from_str(&text).unwrap_or_default())
}
