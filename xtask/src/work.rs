//! Carries out a plan: starts programs, moves their outputs into place, and shows progress on stderr.

use crate::child::{self, Message, Usage};
use crate::plan::{Node, Task};
use crate::pool::{self, Job, Outcome};
use crate::progress::ProgressDisplay;
use crate::record::FigureState;
use crate::store;
use checkout::disk;
use checkout::failure::Failure;
use checkout::figure::Figure;
use checkout::outputs::{self, Hashes};
use checkout::paths::{Paths, Scheme};
use std::collections::{BTreeMap, BTreeSet};
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

/// What a node has made.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NodeOutput {
    /// Seconds of the wall clock.
    pub seconds: f64,
    /// Whether a part of it was made before, by a run that was killed: the seconds are those of the rest.
    pub resumed: bool,
    /// For a figure, the hashes of its outputs.
    pub outputs: Hashes,
    /// What its program used.
    pub usage: Usage,
    /// Bytes that it left on the disk.
    pub bytes: u64,
}

/// Carries out the nodes on at most `threads` threads; `made` is called for each that succeeds, as it ends. Failures
/// are reported on stderr at once.
///
/// # Errors
/// Those of `made`; the failures of nodes are in the outcomes.
pub fn carry_out(
    paths: &Paths,
    surveys: &[FigureState<'_>],
    nodes: &[Node],
    threads: usize,
    keep_going: bool,
    made: &mut dyn FnMut(&Node, &NodeOutput) -> Result<(), Failure>,
) -> Result<Vec<Outcome<NodeOutput>>, Failure> {
    let jobs: Vec<Job> = nodes.iter().map(|node| node.job.clone()).collect();
    let board = ProgressDisplay::new();
    let work = |index: usize, stop: &AtomicBool| {
        // seconds are shown, and kept below target; they reach no output
        let start = Instant::now();
        let node = &nodes[index];
        board.start(&node.name);
        let made = perform(paths, surveys, node, stop, &|word| board.hear(&node.name, word));
        let resumed = board.end(&node.name);
        Ok(NodeOutput { seconds: start.elapsed().as_secs_f64(), resumed, ..made? })
    };
    let (mut count, mut trouble) = (0, Ok(()));
    let mut ended = |index: usize, outcome: &Outcome<NodeOutput>| {
        let node = &nodes[index];
        count += 1;
        match outcome {
            Outcome::Done(result) => {
                let rest = if result.resumed { ", the rest of a run that was killed" } else { "" };
                let (all, name, seconds) = (nodes.len(), &node.name, result.seconds);
                board.line(&format!("{count:>3}/{all}  {name:<38} {seconds:>8.2} s{rest}"));
                if trouble.is_ok() {
                    trouble = made(node, result);
                }
            }
            Outcome::Failed(failure) => {
                board.line(&format!("{count:>3}/{}  {:<38}   FAILED\n{}", nodes.len(), node.name, failure.text()));
            }
            Outcome::Skipped => {}
        }
    };
    let outcomes = pool::run(&jobs, threads, keep_going, &work, &mut ended);
    trouble.map(|()| outcomes)
}

fn perform(
    paths: &Paths,
    surveys: &[FigureState<'_>],
    node: &Node,
    stop: &AtomicBool,
    heard: &(dyn Fn(Message) + Sync),
) -> Result<NodeOutput, Failure> {
    let log = paths.log(&node.name);
    match &node.task {
        Task::Simulate { scene, panel, key, check } => {
            let mut command = simulate(paths, scene, panel, *check);
            command.arg("--checkpoint").arg(paths.checkpoint(key));
            let fresh = store::fresh(paths, key);
            command.arg("--out").arg(&fresh);
            disk::remove(&fresh)?;
            let stored = disk::create_folder(&fresh)
                .and_then(|()| child::run_measured(command, &log, stop, heard))
                .and_then(|usage| store::adopt(&fresh, &store::folder(paths, key)).map(|()| usage));
            let usage = stored.inspect_err(|_| discard(&fresh))?;
            Ok(NodeOutput {
                usage,
                bytes: bytes(&disk::walk(&store::folder(paths, key), &|_| true)?),
                ..NodeOutput::default()
            })
        }
        Task::Draw { figure } => {
            let fresh = paths.output(&files::write::draft_name(&paths.tables(&surveys[*figure].figure.id)));
            disk::remove(&fresh)?;
            draw(paths, &surveys[*figure], &fresh, &log, stop).inspect_err(|_| discard(&fresh))
        }
    }
}

/// Removes what a failed node has made so far.
fn discard(fresh: &Path) {
    // what cannot be removed is removed by the next run; the failure that is on its way says more
    let _ = disk::remove(fresh);
}

fn simulate(paths: &Paths, scene: &str, panel: &str, check: bool) -> Command {
    let mut command = Command::new(paths.binary("simulate"));
    command.current_dir(&paths.root).arg(scene).args(["--panel", panel, "--tables-only", "--progress", "--no-outcome"]);
    // the check of a run is a node of its own
    command.arg(if check { "--check" } else { "--no-check" });
    if paths.scheme == Scheme::Paper {
        command.args(["--scheme", "paper"]);
    }
    command
}

/// The tables are written into a folder of their own that then takes the place of the old one: no table of an earlier
/// run stays behind.
fn draw(
    paths: &Paths,
    survey: &FigureState<'_>,
    fresh: &Path,
    log: &Path,
    stop: &AtomicBool,
) -> Result<NodeOutput, Failure> {
    let figure = survey.figure;
    let report = paths.report(&figure.id);
    let pictures = match paths.scheme {
        Scheme::Adaptive => paths.output(&paths.pictures(&figure.slug, &figure.id)),
        Scheme::Paper => fresh.to_path_buf(),
    };
    report.parent().map_or(Ok(()), disk::own_folder)?;
    disk::remove(&report)?;
    for folder in [fresh, &pictures] {
        disk::create_folder(folder)?;
    }
    for picture in outputs::pictures(paths, figure) {
        disk::clear_for_file(&paths.output(&picture))?;
    }
    let mut command = Command::new(paths.binary(&figure.slug));
    command.current_dir(&paths.root).arg("--scene").arg(Paths::scene(&figure.slug));
    command.arg("--tables").arg(fresh).arg("--pictures").arg(pictures).arg("--report").arg(report);
    for (panel, key) in &survey.runs {
        let mut run = OsString::from(format!("{panel}="));
        run.push(store::folder(paths, key));
        command.arg("--run").arg(run);
    }
    let usage = child::run_measured(command, log, stop, &|_| {})?;
    let outputs = put_in_place(paths, survey, fresh)?;
    let files: Vec<PathBuf> = outputs.keys().map(|name| paths.output(name)).collect();
    Ok(NodeOutput { usage, bytes: bytes(&files), outputs, ..NodeOutput::default() })
}

/// Bytes of files; one that is gone counts nothing.
fn bytes(files: &[PathBuf]) -> u64 {
    files.iter().filter_map(|file| file.metadata().ok()).map(|data| data.len()).sum()
}

fn put_in_place(paths: &Paths, survey: &FigureState<'_>, fresh: &Path) -> Result<Hashes, Failure> {
    let tables = paths.output(&paths.tables(&survey.figure.id));
    if disk::names(fresh)?.is_empty() {
        disk::remove(fresh)?;
        disk::remove(&tables)?;
    } else {
        disk::replace_folder(fresh, &tables)?;
    }
    let hashes = outputs::hash(paths, &[survey.figure])?.swap_remove(0);
    match outputs::pictures(paths, survey.figure).into_iter().find(|name| !hashes.contains_key(name)) {
        Some(name) => Err(Failure::Failed(format!("{} wrote no {name}", survey.figure.slug))),
        None => Ok(hashes),
    }
}

/// Removes what a run that was broken off has left behind. Only under the lock.
///
/// # Errors
/// A folder cannot be read or removed.
pub fn sweep(paths: &Paths, all: &[Figure]) -> Result<(), Failure> {
    disk::own_folder(&paths.store())?;
    leftovers(paths, all)?.iter().try_for_each(|path| disk::remove(path))
}

/// Removes the checkpoints of the nodes, so that they begin anew.
///
/// # Errors
/// One cannot be removed.
pub fn forget(paths: &Paths, nodes: &[Node]) -> Result<(), Failure> {
    nodes.iter().try_for_each(|node| match &node.task {
        Task::Simulate { key, .. } => disk::remove(&paths.checkpoint(key)),
        Task::Draw { .. } => Ok(()),
    })
}

/// Temporary files and folders in the store, among the records and reports, among the data of both schemes, and beside
/// the pictures.
///
/// # Errors
/// A folder cannot be read.
pub fn leftovers(paths: &Paths, all: &[Figure]) -> Result<Vec<PathBuf>, Failure> {
    let paper = paths.with_scheme(Scheme::Paper).scheme_data();
    let mut folders = vec![paths.store(), paths.xtask(), paths.own().join("report"), paths.data(), paper];
    folders.extend(all.iter().map(|figure| paths.output(&Paths::figure_folder(&figure.slug))));
    let mut found = Vec::new();
    for folder in folders {
        let names = disk::names(&folder)?.into_iter().filter(|name| files::write::is_draft_name(name));
        found.extend(names.map(|name| folder.join(name)));
    }
    Ok(found)
}

/// How the nodes of a plan ended, by name.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ends {
    /// Seconds of those that ended well.
    pub seconds: BTreeMap<String, f64>,
    /// Those that ended badly.
    pub failed: BTreeSet<String>,
    /// Those that were not started, or were stopped.
    pub skipped: BTreeSet<String>,
}

impl Ends {
    /// Sorts the outcomes of the nodes.
    pub fn of(nodes: &[Node], outcomes: &[Outcome<NodeOutput>]) -> Ends {
        let mut ends = Ends::default();
        for (node, outcome) in nodes.iter().zip(outcomes) {
            let name = node.name.clone();
            match outcome {
                Outcome::Done(made) => {
                    ends.seconds.insert(name, made.seconds);
                }
                Outcome::Failed(_) => {
                    ends.failed.insert(name);
                }
                Outcome::Skipped => {
                    ends.skipped.insert(name);
                }
            }
        }
        ends
    }
}

/// The code to end with when nodes have failed: that of the first.
///
/// # Errors
/// The failure of the first node that failed; its text has already been reported.
pub fn verdict<T>(nodes: &[Node], outcomes: &[Outcome<T>]) -> Result<(), Failure> {
    let failed = nodes.iter().zip(outcomes).find_map(|(node, outcome)| match outcome {
        Outcome::Failed(failure) => Some((node, failure)),
        _ => None,
    });
    let Some((node, failure)) = failed else { return Ok(()) };
    let skipped = outcomes.iter().filter(|outcome| matches!(outcome, Outcome::Skipped)).count();
    let text = format!("{} failed; {skipped} not done", node.name);
    Err(match failure {
        Failure::Usage(_) => Failure::Usage(text),
        Failure::Unsupported(_) => Failure::Unsupported(text),
        _ => Failure::Failed(text),
    })
}
