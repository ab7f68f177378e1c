//! Carrying out a plan: programs are started, their outputs put in place, progress goes to stderr.

use crate::child;
use crate::disk;
use crate::failure::Failure;
use crate::outputs::{self, Hashes};
use crate::paths::{Paths, Scheme};
use crate::plan::{Node, Step};
use crate::pool::{self, Job, Outcome};
use crate::record::Survey;
use crate::store;
use std::ffi::OsString;
use std::path::Path;
use std::process::Command;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

/// What a node has made.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Made {
    /// Seconds of the wall clock.
    pub seconds: f64,
    /// For a figure, the hashes of its outputs.
    pub outputs: Hashes,
}

/// Carries out the nodes on at most `threads` at a time; `made` is called for each that ends well, as it ends. Failures
/// are told on stderr at once.
///
/// # Errors
/// Those of `made`; the failures of nodes are in the outcomes.
pub fn carry_out(
    paths: &Paths,
    surveys: &[Survey<'_>],
    nodes: &[Node],
    threads: usize,
    keep_going: bool,
    made: &mut dyn FnMut(&Node, &Made) -> Result<(), Failure>,
) -> Result<Vec<Outcome<Made>>, Failure> {
    let jobs: Vec<Job> = nodes.iter().map(|node| node.job.clone()).collect();
    let work = |index: usize, stop: &AtomicBool| {
        // seconds are shown, and kept below target; they reach no output
        let start = Instant::now();
        let outputs = perform(paths, surveys, &nodes[index], stop)?;
        Ok(Made { seconds: start.elapsed().as_secs_f64(), outputs })
    };
    let (mut count, mut trouble) = (0, Ok(()));
    let mut ended = |index: usize, outcome: &Outcome<Made>| {
        let node = &nodes[index];
        count += 1;
        match outcome {
            Outcome::Done(result) => {
                eprintln!("{count:>3}/{}  {:<38} {:>8.2} s", nodes.len(), node.name, result.seconds);
                if trouble.is_ok() {
                    trouble = made(node, result);
                }
            }
            Outcome::Failed(failure) => {
                eprintln!("{count:>3}/{}  {:<38}   FAILED\n{}", nodes.len(), node.name, failure.text());
            }
            Outcome::Skipped => {}
        }
    };
    let outcomes = pool::run(&jobs, threads, keep_going, &work, &mut ended);
    trouble.map(|()| outcomes)
}

fn perform(paths: &Paths, surveys: &[Survey<'_>], node: &Node, stop: &AtomicBool) -> Result<Hashes, Failure> {
    let log = paths.log(&node.name);
    match &node.step {
        Step::Simulate { scene, panel, key, check } => {
            let fresh = store::fresh(paths, key);
            disk::remove(&fresh)?;
            disk::create_folder(&fresh)?;
            child::run_logged(simulate(paths, scene, panel, &fresh, *check), &log, stop)?;
            store::adopt(&fresh, &store::folder(paths, key)).map(|()| Hashes::new())
        }
        Step::Draw { figure } => draw(paths, &surveys[*figure], &log, stop),
    }
}

fn simulate(paths: &Paths, scene: &str, panel: &str, out: &Path, check: bool) -> Command {
    let mut command = Command::new(paths.binary("simulate"));
    command.current_dir(&paths.root).arg(scene).args(["--panel", panel, "--tables-only", "--out"]).arg(out);
    if check {
        command.arg("--check");
    }
    if paths.scheme == Scheme::Paper {
        command.args(["--scheme", "paper"]);
    }
    command
}

/// The tables are written into a folder of their own that then takes the place of the old one: no table of an earlier
/// run stays behind.
fn draw(paths: &Paths, survey: &Survey<'_>, log: &Path, stop: &AtomicBool) -> Result<Hashes, Failure> {
    let figure = survey.figure;
    let fresh = paths.output(&paths.fresh_tables(&figure.id));
    let report = paths.report(&figure.id);
    let pictures = match paths.scheme {
        Scheme::Adaptive => paths.output(&paths.pictures(&figure.slug, &figure.id)),
        Scheme::Paper => fresh.clone(),
    };
    disk::remove(&report)?;
    disk::remove(&fresh)?;
    for folder in [Some(fresh.as_path()), Some(&pictures), report.parent()].into_iter().flatten() {
        disk::create_folder(folder)?;
    }
    let mut command = Command::new(paths.binary(&figure.slug));
    command.current_dir(&paths.root).arg("--scene").arg(Paths::scene(&figure.slug));
    command.arg("--tables").arg(&fresh).arg("--pictures").arg(pictures).arg("--report").arg(report);
    for (panel, key) in &survey.runs {
        let mut run = OsString::from(format!("{panel}="));
        run.push(store::folder(paths, key));
        command.arg("--run").arg(run);
    }
    child::run_logged(command, log, stop)?;
    put_in_place(paths, survey, &fresh)
}

fn put_in_place(paths: &Paths, survey: &Survey<'_>, fresh: &Path) -> Result<Hashes, Failure> {
    let tables = paths.output(&paths.tables(&survey.figure.id));
    if disk::names(fresh)?.is_empty() {
        disk::remove(fresh)?;
        disk::remove(&tables)?;
    } else {
        disk::replace(fresh, &tables)?;
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
pub fn sweep(paths: &Paths) -> Result<(), Failure> {
    for folder in [paths.store(), paths.data(), paths.scheme_data()] {
        for name in disk::names(&folder)?.iter().filter(|name| name.contains(".tmp-")) {
            disk::remove(&folder.join(name))?;
        }
    }
    Ok(())
}

/// The code to end with when nodes have failed: that of the first.
///
/// # Errors
/// The failure of the first node that failed, its text told already.
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
