//! Progress of a long run, and a checkpoint file from which it is resumed after a kill.
//!
//! The file: a line `checkpoint 4 PROGRAM SCENE SUM`, then the seconds of CPU so far and the run, as 64-bit words.
//! These are SHA-256, `SUM` that of everything behind the line. What is damaged, cut off or of another program is of no
//! use to this one: the run starts over, and replaces it. What this program would resume with another scene is refused,
//! since it would be replaced too, and it is of use.

use crate::failure::{Failure, say};
use cpu_time::{ProcessTime, ThreadTime};
use files::write::{atomic, sha256, sha256_file};
use jam::errors::Propagated;
use jam::run::{Checkpoint, Judging, PartialRun, RunObserver, Sight, run_from};
use ode::Step;
use scene::run::Scene;
use scene::summary::FinishedRun;
use std::fs::File;
use std::io::{IsTerminal as _, Read as _, Write as _};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// How a long run is looked after.
#[derive(Debug, clap::Args)]
pub struct CheckpointOptions {
    /// Resume from FILE if it exists; updated while the run progresses, removed at its end
    #[arg(long, value_name = "FILE")]
    checkpoint: Option<PathBuf>,
    /// Least time between two updates of that file; longer where updates would take more than a hundredth of the run
    #[arg(long, value_name = "SECONDS", default_value = "5", value_parser = seconds)]
    checkpoint_every: Duration,
    /// Report progress on stderr, a line a second: `progress 0.42 left 17` (part done, seconds left), or `resumed 0.40`
    /// at the start
    #[arg(long)]
    progress: bool,
    /// Do not classify the outcome of the run
    #[arg(long)]
    no_outcome: bool,
}

fn seconds(text: &str) -> Result<Duration, String> {
    let seconds: f64 = text.parse().map_err(|_| format!("{text}: must be a number of seconds"))?;
    Duration::try_from_secs_f64(seconds).map_err(|error| error.to_string())
}

/// Errors that are carried along, and the time that this takes.
struct Timed {
    propagated: Option<Propagated>,
    spent: Duration,
}

impl RunObserver for Timed {
    fn seen(&mut self, step: &mut Step<'_>, sight: &mut Sight<'_, '_>) {
        if let Some(propagated) = &mut self.propagated {
            // taken off seconds of CPU: on a crowded machine the clock on the wall runs ahead of those
            let begin = ThreadTime::now();
            propagated.seen(step, sight);
            self.spent += begin.elapsed();
        }
    }
}

/// The beginning of every checkpoint.
const MARK: &str = "checkpoint ";
/// Writings take less than this part of the time.
const WRITING: u32 = 100;
/// Between two words about progress.
const SILENCE: Duration = Duration::from_secs(1);

impl CheckpointOptions {
    /// Runs the scene, from the checkpoint if there is one; if it is to be checked, its steps are asked for their
    /// errors.
    ///
    /// # Errors
    /// The program cannot be read; its hash identifies the checkpoint. The checkpoint is that of another scene.
    pub fn run(&self, scene: &Scene, is_checked: bool) -> Result<FinishedRun, Failure> {
        let clock = ProcessTime::now();
        let mut keeper = CheckpointWriter::new(self, scene)?;
        let (from, before) = keeper.load(scene)?.unzip();
        let (steps, done) = from.as_ref().map_or((0, 0.0), |from| (from.steps(), from.fraction(scene)));
        keeper.start(done, before.unwrap_or(0.0));
        // a checkpoint does not keep the errors before it
        let is_whole = from.is_none() || !scene.method.needs_series();
        let propagated = (is_checked && is_whole).then(|| Propagated::new(scene));
        let mut timed = Timed { propagated, spent: Duration::ZERO };
        let (outcome, broken) = match run_from(scene, from, &mut (&mut keeper, &mut timed)) {
            Ok(outcome) => (outcome, None),
            Err(broken) => (*broken.outcome.clone(), Some(broken)),
        };
        keeper.end();
        let own = clock.elapsed().saturating_sub(timed.spent).as_secs_f64();
        let (seconds, propagated) = (before.unwrap_or(0.0) + own, timed.propagated);
        Ok(FinishedRun { outcome, broken, seconds, resumed_steps: steps, propagated })
    }

    /// The file of the checkpoint.
    pub fn file(&self) -> Option<&Path> {
        self.checkpoint.as_deref()
    }

    /// Whether the file of the checkpoint may be replaced and removed.
    ///
    /// # Errors
    /// It is there and is no checkpoint: somebody else's data, by a slip of the pen.
    pub fn is_spare(&self) -> Result<(), Failure> {
        let Some(file) = self.file().filter(|file| file.exists()) else { return Ok(()) };
        let mut first = Vec::new();
        File::open(file).and_then(|file| file.take(MARK.len() as u64).read_to_end(&mut first)).map_err(|error| {
            let problem = format!("{}: {error}", file.display());
            if file.is_dir() { Failure::input(problem) } else { Failure::work(problem) }
        })?;
        if first.is_empty() || first == MARK.as_bytes() {
            return Ok(());
        }
        let problem = "is no checkpoint, and would be replaced and removed; choose another file";
        Err(Failure::input(format!("{}: {problem}", file.display())))
    }

    /// Whether the outcome of the run is judged.
    pub fn judging(&self) -> Judging {
        if self.no_outcome { Judging::No } else { Judging::Along }
    }

    /// Removes the checkpoint of a run whose results are safe.
    ///
    /// # Errors
    /// It is there and cannot be removed.
    pub fn remove(&self) -> Result<(), Failure> {
        match self.checkpoint.as_ref().map(std::fs::remove_file) {
            Some(Err(error)) if error.kind() != std::io::ErrorKind::NotFound => Err(Failure::work(error)),
            _ => Ok(()),
        }
    }
}

/// The first line of a checkpoint of this program and scene.
fn head([program, scene]: [&str; 2], body: &[u8]) -> String {
    format!("{MARK}4 {program} {scene} {}\n", sha256(body))
}

/// Looks at a run now and then.
struct CheckpointWriter<'a> {
    care: &'a CheckpointOptions,
    /// The SHA-256 of the program and of the scene; empty when nothing is kept.
    run: [String; 2],
    /// Seconds of CPU before this process.
    before: f64,
    clock: ProcessTime,
    started: Instant,
    /// The part that was done at the start.
    done: f64,
    next_word: Instant,
    next_writing: Instant,
    is_bar_shown: bool,
}

impl<'a> CheckpointWriter<'a> {
    fn new(care: &'a CheckpointOptions, scene: &Scene) -> Result<CheckpointWriter<'a>, Failure> {
        let is_kept = care.checkpoint.is_some();
        let run = if is_kept {
            [sha256_file(&std::env::current_exe()?)?, sha256(format!("{scene:?}").as_bytes())]
        } else {
            [String::new(), String::new()]
        };
        let (clock, now) = (ProcessTime::now(), Instant::now());
        let (next_word, next_writing) = (now + SILENCE, now + care.checkpoint_every);
        let (before, done, started) = (0.0, 0.0, now);
        Ok(CheckpointWriter { care, run, before, clock, started, done, next_word, next_writing, is_bar_shown: false })
    }

    /// The checkpoint and the seconds before it; `None` without a valid one.
    ///
    /// # Errors
    /// It is one of another scene.
    fn load(&self, scene: &Scene) -> Result<Option<(Checkpoint, f64)>, Failure> {
        let Some(file) = &self.care.checkpoint else { return Ok(None) };
        let Ok(bytes) = std::fs::read(file) else { return Ok(None) };
        let (line, body) = bytes.split_at(bytes.iter().position(|&byte| byte == b'\n').map_or(0, |end| end + 1));
        let [program, own] = &self.run;
        let of = String::from_utf8_lossy(line).split(' ').nth(3).unwrap_or_default().to_owned();
        if of != *own && line == head([program, &of], body).as_bytes() {
            let problem =
                "is the checkpoint of another scene, whose run would be lost; choose another file, or remove it";
            return Err(Failure::input(format!("{}: {problem}", file.display())));
        }
        let found = (line == head([program, own], body).as_bytes())
            .then(|| body.split_first_chunk())
            .flatten()
            .and_then(|(seconds, words)| Some((Checkpoint::parse(words, scene)?, f64::from_le_bytes(*seconds))));
        if found.is_none() && !bytes.is_empty() {
            say(&format!("{}: damaged, or from another program; the run starts over", file.display()));
        }
        Ok(found)
    }

    fn start(&mut self, done: f64, before: f64) {
        (self.done, self.before) = (done, before);
        if self.care.progress && done > 0.0 {
            say(&format!("resumed {done:.4}"));
        }
    }

    /// A checkpoint that cannot be written is reported; the run continues.
    fn write(&self, underway: &PartialRun<'_>) {
        let Some(file) = &self.care.checkpoint else { return };
        let seconds = self.before + self.clock.elapsed().as_secs_f64();
        let body = [&seconds.to_le_bytes()[..], &underway.to_bytes()].concat();
        let bytes = [head(self.run.each_ref().map(String::as_str), &body).as_bytes(), &body].concat();
        if let Err(error) = atomic(file, &bytes) {
            say(&format!("no checkpoint: {error}"));
        }
    }

    fn tell(&mut self, fraction: f64) {
        let mut stderr = std::io::stderr();
        let left = self.started.elapsed().as_secs_f64() * (1.0 - fraction) / (fraction - self.done);
        if self.care.progress {
            say(&format!("progress {fraction:.4} left {left:.0}"));
        } else if stderr.is_terminal() {
            // a word about progress that cannot be shown is no reason to stop
            let _ = write!(stderr, "\r\x1b[K{:.0} %, about {left:.0} s left", 100.0 * fraction);
            self.is_bar_shown = true;
        }
    }

    /// Leaves an empty line on the terminal.
    fn end(&self) {
        if self.is_bar_shown {
            let _ = write!(std::io::stderr(), "\r\x1b[K");
        }
    }
}

impl RunObserver for CheckpointWriter<'_> {
    fn judging(&self) -> Judging {
        self.care.judging()
    }

    fn between(&mut self, underway: &PartialRun<'_>) {
        let now = Instant::now();
        if now >= self.next_word {
            self.next_word = now + SILENCE;
            self.tell(underway.fraction());
        }
        if now >= self.next_writing && self.care.checkpoint.is_some() {
            self.write(underway);
            let wait = now.elapsed() * WRITING;
            self.next_writing =
                Instant::now() + if wait > self.care.checkpoint_every { wait } else { self.care.checkpoint_every };
        }
    }
}
