//! The benchmarks: programs of one or two source trees run in turn, with CPU seconds and instruction counts.

use crate::pairs::{self, Ratio};
use checkout::disk;
use checkout::failure::Failure;
use checkout::paths::Paths;
use checkout::process;
use serde::Serialize;
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::Command;

/// What is measured by `bench`.
const COST_SOURCE: &str = "crates/jam/examples/cost.rs";

/// Seconds of a sample: on a crowded machine shorter ones of the same program differ by several parts in a hundred.
const SAMPLE: f64 = 0.1;
/// How often the work is done to find out how long it takes.
const TRIAL: u64 = 200;
/// The work is not done more often than four times this in a sample.
const MOST: u64 = 10_000_000;
/// The runs measured whole: scene and panel, and how their rows begin.
const RUNS: [(&str, &str, &str); 2] =
    [("run/fig04-stable", "fig04-algebraic-std", "stable"), ("run/fig11-main", "fig11-trajectories", "main")];

/// The programs of a tree.
#[derive(Clone, Debug, PartialEq)]
pub struct Tree {
    /// Where they lie.
    pub folder: PathBuf,
    /// Where the scenes lie: the same for all trees that are compared.
    pub root: PathBuf,
}

/// What was measured of one benchmark.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Measured {
    /// Its name.
    pub name: String,
    /// How often the work is done in a sample.
    pub count: u64,
    /// Right-hand sides of a run.
    pub right_hand_sides: Option<u64>,
    /// Seconds of CPU of each sample.
    pub seconds: Vec<f64>,
    /// Those of the other tree, each taken right after (or right before) the one at the same place.
    pub against_seconds: Vec<f64>,
    /// Instructions of doing the work once, if valgrind can count them.
    pub instructions: Option<f64>,
    /// Those of the other tree.
    pub against_instructions: Option<f64>,
}

impl Measured {
    /// Seconds of doing the work once: the median.
    pub fn once(&self) -> f64 {
        pairs::median(&self.seconds) / self.count as f64
    }

    /// Seconds of this tree by those of the other; `None` with less than two trees or too few samples.
    pub fn ratio(&self) -> Option<Ratio> {
        let pairs: Vec<(f64, f64)> =
            self.against_seconds.iter().zip(&self.seconds).map(|(&before, &after)| (before, after)).collect();
        pairs::ratio(&pairs)
    }

    /// Instructions of this tree by those of the other.
    pub fn instruction_ratio(&self) -> Option<f64> {
        Some(self.instructions? / self.against_instructions?)
    }

    /// Whether this tree is slower by more than the part `allowed`, by its instructions or, for certain, by its
    /// seconds.
    pub fn is_slower(&self, allowed: f64) -> bool {
        let limit = 1.0 + allowed;
        self.ratio().is_some_and(|ratio| ratio.low > limit)
            || self.instruction_ratio().is_some_and(|ratio| ratio > limit)
    }
}

/// Builds the programs of the tree in `sources` and puts them into a folder of their own.
///
/// # Errors
/// Unsupported: no cargo. Failed: they do not build, or cannot be copied.
pub fn build(paths: &Paths, sources: &Path, name: &str) -> Result<Tree, Failure> {
    let target = bench(paths).join("build");
    // by folders: the package of `crates/jam` has another name in older commits
    for (folder, program) in [("crates/jam", ["--example", "cost"]), ("figures", ["--bin", "simulate"])] {
        let mut cargo = process::cargo();
        cargo.args(["build", "--quiet", "--release", "--locked"]).args(program);
        cargo.current_dir(sources.join(folder)).env("CARGO_TARGET_DIR", &target);
        process::run_shown(&mut cargo).map_err(|failure| match failure {
            Failure::Child(code) => Failure::Failed(format!("{name} does not build: cargo ended with {code}")),
            other => other,
        })?;
    }
    let folder = bench(paths).join(name);
    disk::create_folder(&folder)?;
    let suffix = std::env::consts::EXE_SUFFIX;
    for program in ["examples/cost", "simulate"] {
        let from = target.join("release").join(format!("{program}{suffix}"));
        let to = program_of(&folder, program.trim_start_matches("examples/"));
        std::fs::copy(&from, to).map_err(Failure::at(&from))?;
    }
    Ok(Tree { folder, root: paths.root.clone() })
}

/// Unpacks the sources of a commit, with the benchmarks of this tree in place of its own.
///
/// # Errors
/// Unsupported: no git or tar. Failed: the commit cannot be unpacked.
pub fn unpack(paths: &Paths, commit: &str) -> Result<PathBuf, Failure> {
    let folder = bench(paths).join(format!("{commit}-sources"));
    disk::remove(&folder)?;
    disk::create_folder(&folder)?;
    let archive = bench(paths).join(format!("{commit}.tar"));
    let mut git = Command::new("git");
    git.arg("-C").arg(&paths.root).args(["archive", "--format=tar", "-o"]).arg(&archive).arg(commit);
    let mut tar = Command::new("tar");
    tar.arg("-xf").arg(&archive).arg("-C").arg(&folder);
    for (name, command) in [("git archive", &mut git), ("tar", &mut tar)] {
        process::run_shown(command).map_err(|failure| match failure {
            Failure::Child(code) => Failure::Failed(format!("{name} ended with {code}")),
            other => other,
        })?;
    }
    disk::remove(&archive)?;
    let bytes = std::fs::read(paths.root.join(COST_SOURCE)).map_err(Failure::at(Path::new(COST_SOURCE)))?;
    disk::write(&folder.join(COST_SOURCE), &bytes)?;
    Ok(folder)
}

impl Tree {
    /// The names of all benchmarks.
    ///
    /// # Errors
    /// The program cannot be run.
    pub fn names(&self) -> Result<Vec<String>, Failure> {
        let text = output(Command::new(program_of(&self.folder, "cost")))?;
        let runs = RUNS.iter().map(|(name, ..)| (*name).to_owned());
        Ok(text.lines().filter_map(|line| line.split(' ').next()).map(str::to_owned).chain(runs).collect())
    }

    /// Seconds of CPU of one sample, and the right-hand sides if it is a run.
    fn sample(&self, name: &str, count: u64) -> Result<(f64, Option<u64>), Failure> {
        let fail = |text: &str| Failure::Failed(format!("{name}: expected seconds, found {text:?}"));
        if let Some((_, slug, panel)) = RUNS.iter().find(|(run, ..)| *run == name) {
            let (mut sum, mut right_hand_sides) = (0.0, None);
            for _ in 0..count {
                let mut command = Command::new(program_of(&self.folder, "simulate"));
                command.arg(self.root.join(Paths::scene(slug))).args(["--panel", panel, "--json"]);
                let text = output(command)?;
                let summary: Value = serde_json::from_str(&text).map_err(|_| fail(&text))?;
                sum += summary["seconds"].as_f64().ok_or_else(|| fail(&text))?;
                right_hand_sides = summary["right_hand_sides"].as_u64();
            }
            return Ok((sum, right_hand_sides));
        }
        let text = output(self.cost(name, count))?;
        Ok((text.trim().parse().map_err(|_| fail(&text))?, None))
    }

    /// How often the work is done in a sample, so that it takes about [`SAMPLE`]; and the right-hand sides if it is a
    /// run.
    fn calibrate(&self, name: &str) -> Result<(u64, Option<u64>), Failure> {
        let mut count = if is_run(name) { 1 } else { TRIAL };
        loop {
            let (seconds, right_hand_sides) = self.sample(name, count)?;
            // a quarter of a sample tells the rest; the bound ends the search where a clock stands still
            if seconds > 0.25 * SAMPLE || count > MOST {
                let spent = if seconds > 0.25 * SAMPLE { seconds } else { 0.25 * SAMPLE };
                let often = count as f64 * SAMPLE / spent;
                return Ok((often.ceil() as u64, right_hand_sides));
            }
            count *= 4;
        }
    }

    fn cost(&self, name: &str, count: u64) -> Command {
        let mut command = Command::new(program_of(&self.folder, "cost"));
        command.arg(name).arg(count.to_string());
        command
    }

    /// Instructions of doing the work once, counted by valgrind: the difference of two runs leaves out the start of the
    /// program. `None` for whole runs, and where valgrind is missing.
    fn instructions(&self, name: &str) -> Option<f64> {
        let counted = |count: u64| {
            let file = self.folder.join("callgrind.out");
            let mut valgrind = Command::new("valgrind");
            valgrind.arg("--tool=callgrind").arg(format!("--callgrind-out-file={}", file.display()));
            let cost = self.cost(name, count);
            let ended = valgrind.arg(cost.get_program()).args(cost.get_args()).output().ok()?;
            let text = std::fs::read_to_string(&file).ok().filter(|_| ended.status.success())?;
            let line = |start: &str| text.lines().find_map(|line| line.strip_prefix(start)?.trim().parse::<f64>().ok());
            line("summary: ").or_else(|| line("totals: "))
        };
        if is_run(name) { None } else { Some((counted(11 * TRIAL)? - counted(TRIAL)?) / (10 * TRIAL) as f64) }
    }
}

/// Measures one benchmark in this tree and, in turn with it, in the other.
///
/// # Errors
/// A program cannot be run, or ends badly.
pub fn measure(tree: &Tree, against: Option<&Tree>, name: &str, rounds: u16) -> Result<Measured, Failure> {
    let (count, right_hand_sides) = tree.calibrate(name)?;
    let mut measured = Measured { name: name.to_owned(), count, right_hand_sides, ..Measured::default() };
    for round in 0..rounds {
        // the order alternates, so that neither tree always has the warmer machine
        if let Some(other) = against.filter(|_| round % 2 == 0) {
            measured.against_seconds.push(other.sample(name, count)?.0);
        }
        measured.seconds.push(tree.sample(name, count)?.0);
        if let Some(other) = against.filter(|_| round % 2 == 1) {
            measured.against_seconds.push(other.sample(name, count)?.0);
        }
    }
    measured.instructions = tree.instructions(name);
    measured.against_instructions = against.and_then(|other| other.instructions(name));
    Ok(measured)
}

/// Where programs to be measured are built and lie.
fn bench(paths: &Paths) -> PathBuf {
    paths.target.join("bench")
}

fn is_run(name: &str) -> bool {
    RUNS.iter().any(|(run, ..)| *run == name)
}

fn program_of(folder: &Path, name: &str) -> PathBuf {
    folder.join(format!("{name}{}", std::env::consts::EXE_SUFFIX))
}

/// What a program prints.
fn output(mut command: Command) -> Result<String, Failure> {
    let name = command.get_program().to_string_lossy().into_owned();
    let output = command.output().map_err(|error| Failure::Failed(format!("{name}: {error}")))?;
    match output.status.success() {
        true => Ok(String::from_utf8_lossy(&output.stdout).into_owned()),
        false => Err(Failure::Failed(format!("{name}: {}", String::from_utf8_lossy(&output.stderr).trim_end()))),
    }
}
