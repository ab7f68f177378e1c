//! Starting a program and waiting for it.

use crate::lock;
use crate::usage::Usage;
use checkout::disk;
use checkout::failure::Failure;
use checkout::process::not_started;
use std::fs::File;
use std::io::{BufRead, BufReader, Read, Write};
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::{Duration, Instant};

/// How long a waiting thread sleeps before it looks again whether its program has ended, at most.
const PATIENCE: Duration = Duration::from_millis(3);

/// And at least. Between the two, the part [`PART`] of the time so far, so that what the program used is known as well.
const IMPATIENCE: Duration = Duration::from_micros(100);

/// See [`IMPATIENCE`].
const PART: u32 = 50;

/// What a program says on stderr of the part of its work that is done, 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Word {
    /// It goes on where another one was killed: `resumed 0.40`.
    Resumed(f64),
    /// It has come so far: `progress 0.42`.
    Progress(f64),
}

impl Word {
    /// Reads a line; `None` when it is about something else.
    pub fn parse(line: &str) -> Option<Word> {
        let (word, number) = line.split_once(' ')?;
        let fraction = number.parse().ok()?;
        match word {
            "resumed" => Some(Word::Resumed(fraction)),
            "progress" => Some(Word::Progress(fraction)),
            _ => None,
        }
    }
}

/// Runs a program with its words in the file `log`, except those about progress, which go to `heard`; kills it when
/// `stop` becomes true.
///
/// # Errors
/// The program is missing (5), cannot be started (4), or ends badly: its own code when that is 2 or 5, else 4, with
/// what it printed.
pub fn run_logged(
    command: Command,
    log: &Path,
    stop: &AtomicBool,
    heard: &(dyn Fn(Word) + Sync),
) -> Result<(), Failure> {
    run_measured(command, log, stop, heard).map(|_| ())
}

/// As [`run_logged`]; tells what the program used.
///
/// # Errors
/// As [`run_logged`].
pub fn run_measured(
    mut command: Command,
    log: &Path,
    stop: &AtomicBool,
    heard: &(dyn Fn(Word) + Sync),
) -> Result<Usage, Failure> {
    let name = command.get_program().to_string_lossy().into_owned();
    if let Some(folder) = log.parent() {
        disk::own_folder(folder)?;
    }
    disk::clear_for_file(log)?;
    let file = File::create(log).map_err(Failure::at(log))?;
    let twin = file.try_clone().map_err(Failure::at(log))?;
    let child = command.stdin(lock::stdin()).stdout(file).stderr(Stdio::piped()).spawn();
    let mut child = child.map_err(|error| not_started(&name, &error))?;
    let words = child.stderr.take();
    let mut usage = Usage::default();
    let status = thread::scope(|scope| {
        scope.spawn(|| words.map(|words| listen(words, twin, heard)));
        wait(&mut child, stop, &mut usage).map_err(|error| Failure::Failed(format!("{name}: {error}")))
    })?;
    if status.success() {
        return Ok(usage);
    }
    let bytes = std::fs::read(log).map_err(Failure::at(log))?;
    Err(ended_badly(&name, status, String::from_utf8_lossy(&bytes).trim_end()))
}

/// Passes lines on to the log until the program closes its stderr.
fn listen(words: impl Read, mut log: File, heard: &(dyn Fn(Word) + Sync)) {
    for line in BufReader::new(words).split(b'\n').map_while(Result::ok) {
        match Word::parse(&String::from_utf8_lossy(&line)) {
            Some(word) => heard(word),
            None => {
                // a log that cannot be written keeps no figure from being made
                let _ = log.write_all(&[&line[..], b"\n"].concat());
            }
        }
    }
}

fn wait(child: &mut Child, stop: &AtomicBool, usage: &mut Usage) -> std::io::Result<ExitStatus> {
    let start = Instant::now();
    loop {
        usage.look(child.id());
        if let Some(status) = child.try_wait()? {
            return Ok(status);
        }
        if stop.load(Ordering::Relaxed) {
            child.kill()?;
        }
        thread::sleep((start.elapsed() / PART).clamp(IMPATIENCE, PATIENCE));
    }
}

fn ended_badly(name: &str, status: ExitStatus, words: &str) -> Failure {
    let text = format!("{words}\n{name}: {status}");
    match status.code() {
        Some(2) => Failure::Usage(text),
        Some(5) => Failure::Unsupported(text),
        _ => Failure::Failed(text),
    }
}
