//! `test` and `ci`: run the checks in order and list those that could not be run.

use super::{figures, publish, verify};
use crate::cli::{BundleArgs, CiArgs, FiguresArgs, Selection};
use crate::gate;
use checkout::failure::Failure;
use checkout::figure;
use checkout::paths::Paths;
use checkout::print;
use checkout::process;
use std::io::{BufRead, BufReader};
use std::panic::resume_unwind;
use std::process::{Command, Stdio};
use std::time::Instant;

/// A script that needs more than Rust. It ends with 0 if it passes, with 5 if it cannot be tried here (the last line on
/// stderr says why), and with another code if it fails.
#[derive(Clone, Copy)]
struct Script {
    /// What it checks.
    what: &'static str,
    /// The script and its arguments.
    command: &'static [&'static str],
}

/// Run by `test` where the tools exist; `ci` installs them. The scripts of a stage run at the same time, since most of
/// them keep one processor busy. The page has a stage of its own because it is timed.
const STAGES: [&[Script]; 3] = [
    &[Script { what: "values by NumPy", command: &["checks/spot.sh"] }],
    &[
        Script { what: "trajectories as PedPy reads them", command: &["checks/pedpy/run.sh"] },
        Script { what: "the package for Python", command: &["checks/python-door.sh"] },
    ],
    &[Script { what: "the page in a browser", command: &["checks/browser/run.sh"] }],
];

/// Run by `ci --full` alone. The article needs the tables of all supplements.
const SLOW: [Script; 9] = [
    Script { what: "the article and its PDF", command: &["checks/article.sh"] },
    Script { what: "random scenes by SciPy", command: &["checks/hunt.sh"] },
    Script { what: "a plane of outcomes", command: &["checks/outcomes.sh"] },
    Script { what: "other machines", command: &["checks/other-machines.sh"] },
    Script { what: "a sweep by every engine", command: &["checks/sweep-engines.sh"] },
    Script { what: "instruction counts", command: &["checks/cost.sh"] },
    Script { what: "licences and sources of crates", command: &["checks/deny.sh"] },
    Script { what: "kept inputs of the fuzzer", command: &["checks/fuzz.sh", "--regress"] },
    Script { what: "20000 inputs for each reader", command: &["checks/fuzz.sh", "20000"] },
];

/// Supplements that take seconds to minutes each. `ci --full` alone makes them, and judges the claims that read them.
const SLOW_SUPPLEMENTS: [&str; 6] = ["s10", "s13", "s14", "s20", "s24", "s26"];

/// Why a script was not tried: what it looks at, and the reason.
type Untried = (String, String);

/// `test`.
///
/// # Errors
/// Differs: a test fails.
pub fn test(paths: &Paths) -> Result<(), Failure> {
    let mut untried = tests(paths, false)?;
    untried.extend(SLOW.iter().map(|script| (script.what.to_owned(), "only in cargo xtask ci --full".to_owned())));
    tell(&untried)
}

/// `ci`; stops at the first step that fails.
///
/// # Errors
/// Differs: a step fails, or, on a machine that says it is one for CI (`CI` is set), could not be tried.
pub fn ci(paths: &Paths, arguments: &CiArgs) -> Result<(), Failure> {
    cargo(paths, &["fmt", "--all", "--check"])?;
    // in release mode, so that what macros and build scripts need is compiled once
    cargo(paths, &["clippy", "--release", "--locked", "--workspace", "--all-targets", "--", "-D", "warnings"])?;
    // before the scripts, which read the tables
    let quick = if arguments.full { Vec::new() } else { quick_figures(paths)? };
    make(paths, &quick, true)?;
    let mut untried = tests(paths, true)?;
    timed("verify", || verify::made(paths, &quick))?;
    if arguments.full {
        // its warnings are errors by the lints of the workspace
        cargo(paths, &["doc", "--locked", "--workspace", "--no-deps"])?;
        cargo(paths, &["test", "--release", "--locked", "--workspace", "--", "--ignored"])?;
        for script in &SLOW {
            untried.extend(attempt(paths, script, true)?);
        }
        untried.extend(archive(paths)?);
    } else {
        let supplements = "supplements, and the claims that read them: only with --full".to_owned();
        untried.push((SLOW_SUPPLEMENTS.join(", "), supplements));
        untried.extend(SLOW.iter().map(|script| (script.what.to_owned(), "only with --full".to_owned())));
    }
    tell(&untried)?;
    let is_ci = std::env::var_os("CI").is_some();
    match untried.iter().find(|(what, _)| is_ci && STAGES.concat().iter().any(|script| script.what == what)) {
        Some((what, why)) => Err(Failure::Differs(format!("not tried: {what}: {why}"))),
        None => Ok(()),
    }
}

/// All figures and supplements but the slow ones.
fn quick_figures(paths: &Paths) -> Result<Vec<String>, Failure> {
    let ids = figure::discover(paths)?.into_iter().map(|figure| figure.id);
    Ok(ids.filter(|id| !SLOW_SUPPLEMENTS.contains(&id.as_str())).collect())
}

fn tests(paths: &Paths, install: bool) -> Result<Vec<Untried>, Failure> {
    cargo(paths, &["test", "--release", "--locked", "--workspace"])?;
    let mut untried = Vec::new();
    for stage in STAGES {
        untried.extend(at_once(paths, stage, install)?);
    }
    Ok(untried)
}

fn tell(untried: &[Untried]) -> Result<(), Failure> {
    let lines: String = untried.iter().map(|(what, why)| format!("  {what}: {why}\n")).collect();
    match untried.len() {
        0 => print::out("everything was tried\n"),
        count => print::out(&format!("{count} not tried here:\n{lines}")),
    }
}

/// Runs scripts at the same time; those that could not be tried.
fn at_once(paths: &Paths, scripts: &[Script], install: bool) -> Result<Vec<Untried>, Failure> {
    std::thread::scope(|scope| {
        let threads: Vec<_> =
            scripts.iter().map(|script| scope.spawn(move || attempt(paths, script, install))).collect();
        let ended = threads.into_iter().map(|thread| thread.join().unwrap_or_else(|panic| resume_unwind(panic)));
        let ended = ended.collect::<Result<Vec<_>, _>>()?;
        Ok(ended.into_iter().flatten().collect())
    })
}

/// Runs a script; why it could not be tried, if so.
fn attempt(paths: &Paths, script: &Script, install: bool) -> Result<Option<Untried>, Failure> {
    let name = script.command.join(" ");
    timed(&name, || run(paths, script, &name, install))
}

fn run(paths: &Paths, script: &Script, name: &str, install: bool) -> Result<Option<Untried>, Failure> {
    let mut command = Command::new("bash");
    command.args(script.command).current_dir(&paths.root).env("CARGO_TARGET_DIR", &paths.target);
    if install {
        command.env("CHECKS_INSTALL", "1");
    }
    if let Ok(runner) = std::env::current_exe() {
        command.env("XTASK", runner);
    }
    let mut child = match command.stderr(Stdio::piped()).spawn() {
        Ok(child) => child,
        Err(error) => return Ok(Some((script.what.to_owned(), format!("bash: {error}")))),
    };
    let mut last = name.to_owned();
    if let Some(words) = child.stderr.take() {
        for line in BufReader::new(words).lines().map_while(Result::ok) {
            eprintln!("{line}");
            last = line;
        }
    }
    let status = child.wait().map_err(|error| Failure::Failed(format!("{name}: {error}")))?;
    match status.code() {
        Some(0) => Ok(None),
        Some(5) => Ok(Some((script.what.to_owned(), last))),
        _ => Err(Failure::Differs(format!("{name} failed ({status})"))),
    }
}

/// The archive, unpacked and tried; only of a commit.
fn archive(paths: &Paths) -> Result<Option<Untried>, Failure> {
    if gate::modified(paths)?.is_none_or(|names| !names.is_empty()) {
        let why = "needs a commit, and no tracked file that differs from it";
        return Ok(Some(("bundle --check".to_owned(), why.to_owned())));
    }
    make(paths, &[], false)?;
    eprintln!("ci: bundle --check");
    publish::bundle(paths, &BundleArgs { out: None, check: true }).map(|()| None)
}

/// Makes these figures and supplements; all if none is named.
fn make(paths: &Paths, ids: &[String], force: bool) -> Result<(), Failure> {
    let selection = Selection { ids: ids.to_vec(), all: ids.is_empty() };
    let what = if ids.is_empty() { "figures --all".to_owned() } else { format!("figures {}", ids.join(" ")) };
    timed(&what, || figures::run(paths, &FiguresArgs { selection, force, ..FiguresArgs::default() }))
}

fn cargo(paths: &Paths, arguments: &[&str]) -> Result<(), Failure> {
    let mut command = process::cargo();
    command.args(arguments).current_dir(&paths.root).env("CARGO_TARGET_DIR", &paths.target);
    timed(&format!("cargo {}", arguments.join(" ")), || step(&mut command))
}

/// Names a step before it starts, and its seconds when it has ended.
fn timed<T>(name: &str, step: impl FnOnce() -> Result<T, Failure>) -> Result<T, Failure> {
    eprintln!("{name}");
    let start = Instant::now();
    let ended = step()?;
    eprintln!("{name}: {:.0} s", start.elapsed().as_secs_f64());
    Ok(ended)
}

/// Runs one step, which shares our stdout and stderr.
///
/// # Errors
/// Differs: it fails. Unsupported: the program is missing.
pub fn step(command: &mut Command) -> Result<(), Failure> {
    let name: Vec<String> = std::iter::once(command.get_program())
        .chain(command.get_args())
        .map(|word| word.to_string_lossy().into_owned())
        .collect();
    process::run_shown(command).map_err(|failure| match failure {
        Failure::Child(code) => Failure::Differs(format!("{} failed (exit code {code})", name.join(" "))),
        other => other,
    })
}
