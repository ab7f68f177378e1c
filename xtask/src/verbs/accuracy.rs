//! `accuracy`: recomputes the accuracy tables and has them compared with the committed ones.

use super::judge;
use crate::child;
use crate::cli::AccuracyArgs;
use crate::compile::{self, STUDIES};
use crate::lock::Lock;
use crate::pool::{self, Job, Outcome};
use checkout::disk;
use checkout::failure::Failure;
use checkout::paths::Paths;
use std::path::Path;
use std::process::Command;
use std::sync::atomic::AtomicBool;

/// A program that writes tables: `NAME --out DIR [--quick]`.
struct Program {
    name: &'static str,
    /// Parts of its work that can be done apart, with `--only PART`; none: all at once.
    parts: &'static [&'static str],
    /// Whether it knows `--full`.
    has_full: bool,
    /// Whether it knows `--seconds`.
    is_timed: bool,
}

const PROGRAMS: [Program; 3] = [
    Program { name: "precision", parts: &SCENES, has_full: true, is_timed: true },
    Program { name: "hard", parts: &[], has_full: false, is_timed: false },
    Program { name: "studies", parts: &[], has_full: true, is_timed: false },
];

/// The scenes of `precision`, longest first.
const SCENES: [&str; 6] = [
    "logarithmic",
    "logarithmic_small_shift",
    "algebraic_stable",
    "algebraic_unstable",
    "exponential_stable",
    "exponential_unstable",
];

/// Runs the verb.
///
/// # Errors
/// Differs: a table is not as committed. Otherwise what kept the tables from being made.
pub fn run(paths: &Paths, arguments: &AccuracyArgs) -> Result<(), Failure> {
    let _lock = Lock::take(paths)?;
    compile::tools(paths, STUDIES)?;
    let made = paths.xtask().join("accuracy");
    disk::remove(&made)?;
    make(paths, arguments, &made)?;
    let mut verify = judge::program(paths)?;
    verify.arg("accuracy").arg("--made").arg(made);
    let options = [
        ("--quick", arguments.quick),
        ("--full", arguments.full),
        ("--bless", arguments.bless),
        ("--json", arguments.json),
    ];
    verify.args(options.iter().filter(|(_, is_given)| *is_given).map(|(name, _)| name));
    judge::run(&mut verify)
}

/// Starts the programs, two at a time; one, when seconds are measured.
fn make(paths: &Paths, arguments: &AccuracyArgs, made: &Path) -> Result<(), Failure> {
    let mut commands = Vec::new();
    for program in &PROGRAMS {
        let parts = if program.parts.is_empty() { vec![None] } else { program.parts.iter().map(Some).collect() };
        for part in parts {
            let mut words = vec!["--out".into(), made.as_os_str().to_owned()];
            words.extend(part.iter().flat_map(|part| ["--only".into(), part.into()]));
            words.extend(arguments.quick.then(|| "--quick".into()));
            words.extend((program.has_full && arguments.full).then(|| "--full".into()));
            words.extend((program.is_timed && arguments.seconds).then(|| "--seconds".into()));
            let label = part.map_or(program.name.to_owned(), |part| format!("{} {part}", program.name));
            commands.push((label, program.name, words));
        }
    }
    let jobs: Vec<Job> = commands.iter().map(|_| Job::default()).collect();
    let work = |index: usize, stop: &AtomicBool| {
        let (label, program, words) = &commands[index];
        let mut command = Command::new(paths.binary(program));
        command.args(words).current_dir(&paths.root);
        child::run_logged(command, &paths.log(label), stop, &|_| {})
    };
    let mut ended = |index: usize, outcome: &Outcome<()>| {
        let how = match outcome {
            Outcome::Done(()) => "done",
            Outcome::Failed(_) => "failed",
            Outcome::Skipped => "skipped",
        };
        eprintln!("{}: {how}", commands[index].0);
    };
    let threads = if arguments.seconds { 1 } else { 2 };
    let outcomes = pool::run(&jobs, threads, false, &work, &mut ended);
    let failed = outcomes.into_iter().find_map(|outcome| match outcome {
        Outcome::Failed(failure) => Some(failure),
        _ => None,
    });
    failed.map_or(Ok(()), Err)
}
