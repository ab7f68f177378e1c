//! Starts a program and waits for it.

use crate::lock;
use checkout::disk;
use checkout::failure::Failure;
use checkout::process::not_started;
use std::fs::File;
use std::io::{BufRead, BufReader, Read, Write};
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;
use wait4::Wait4 as _;

/// How long a waiting thread sleeps before it looks again whether its program has ended.
const PATIENCE: Duration = Duration::from_millis(2);

/// What a program used.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Usage {
    /// Seconds on a processor.
    pub cpu: f64,
    /// Largest resident memory, in bytes; 0 where the system does not report it.
    pub memory: u64,
}

/// The progress that a program reports on stderr, 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Message {
    /// It continues where a killed program stopped: `resumed 0.40`.
    Resumed(f64),
    /// It has come so far: `progress 0.42`, perhaps with the seconds that are left: `progress 0.42 left 17`.
    Progress(f64),
}

impl Message {
    /// Reads a line; `None` when it is about something else.
    pub fn parse(line: &str) -> Option<Message> {
        let (word, number) = line.split_once(' ')?;
        let fraction = number.split(' ').next()?.parse().ok()?;
        match word {
            "resumed" => Some(Message::Resumed(fraction)),
            "progress" => Some(Message::Progress(fraction)),
            _ => None,
        }
    }
}

/// Runs a program with its output in the file `log`, except for progress reports, which go to `heard`; kills it when
/// `stop` becomes true.
///
/// # Errors
/// The program is missing (5), cannot be started (4), or ends badly: its own code when that is 2 or 5, else 4, with
/// what it printed.
pub fn run_logged(
    command: Command,
    log: &Path,
    stop: &AtomicBool,
    heard: &(dyn Fn(Message) + Sync),
) -> Result<(), Failure> {
    run_measured(command, log, stop, heard).map(|_| ())
}

/// As [`run_logged`]; also returns the resources that the program used.
///
/// # Errors
/// As [`run_logged`].
pub fn run_measured(
    mut command: Command,
    log: &Path,
    stop: &AtomicBool,
    heard: &(dyn Fn(Message) + Sync),
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
    let (status, usage) = thread::scope(|scope| {
        scope.spawn(|| words.map(|words| listen(words, twin, heard)));
        wait(&mut child, stop).map_err(|error| Failure::Failed(format!("{name}: {error}")))
    })?;
    if status.success() {
        return Ok(usage);
    }
    let bytes = std::fs::read(log).map_err(Failure::at(log))?;
    Err(ended_badly(&name, status, String::from_utf8_lossy(&bytes).trim_end()))
}

/// Passes lines on to the log until the program closes its stderr.
fn listen(words: impl Read, mut log: File, heard: &(dyn Fn(Message) + Sync)) {
    for line in BufReader::new(words).split(b'\n').map_while(Result::ok) {
        match Message::parse(&String::from_utf8_lossy(&line)) {
            Some(word) => heard(word),
            None => {
                // a log that cannot be written keeps no figure from being made
                let _ = log.write_all(&[&line[..], b"\n"].concat());
            }
        }
    }
}

/// Waits for the end of a program; kills it when `stop` becomes true.
fn wait(child: &mut Child, stop: &AtomicBool) -> std::io::Result<(ExitStatus, Usage)> {
    loop {
        if let Some(ended) = child.try_wait4()? {
            let used = ended.rusage;
            let cpu = (used.utime + used.stime).as_secs_f64();
            return Ok((ended.status, Usage { cpu, memory: used.maxrss }));
        }
        if stop.load(Ordering::Relaxed) {
            child.kill()?;
        }
        thread::sleep(PATIENCE);
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
