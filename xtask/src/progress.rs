//! Shows progress on stderr: one changing line on a terminal, plain lines elsewhere.

use crate::child::Message;
use checkout::print::duration;
use std::collections::BTreeMap;
use std::io::{IsTerminal, Write};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Between two lines where stderr is no terminal.
const PLAIN: Duration = Duration::from_secs(30);
/// Between two looks of the line on a terminal.
const LIVELY: Duration = Duration::from_secs(1);
/// Takes the line on a terminal away.
const ERASE: &str = "\r\x1b[K";

/// What is known of a node at work.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Track {
    /// The part that was done when it started, 0 to 1.
    pub from: f64,
    /// The part that is done.
    pub done: f64,
    /// Seconds since it started.
    pub seconds: f64,
}

impl Track {
    /// Estimated remaining seconds at the present rate; `None` before any progress.
    pub fn left(&self) -> Option<f64> {
        (self.done > self.from).then(|| self.seconds * (1.0 - self.done) / (self.done - self.from))
    }

    /// `42 %, about 3 min left`.
    pub fn words(&self) -> String {
        let left = self.left().map_or(String::new(), |left| format!(", about {} left", duration(left)));
        format!("{:.0} %{left}", 100.0 * self.done)
    }
}

/// The nodes at work, by name.
pub struct ProgressDisplay {
    inner: Mutex<Inner>,
    is_terminal: bool,
}

struct Inner {
    nodes: BTreeMap<String, (Instant, Track)>,
    shown: Instant,
}

impl ProgressDisplay {
    /// An empty board for stderr.
    pub fn new() -> ProgressDisplay {
        let inner = Inner { nodes: BTreeMap::new(), shown: Instant::now() };
        ProgressDisplay { inner: Mutex::new(inner), is_terminal: std::io::stderr().is_terminal() }
    }

    /// Records the progress of a node, and shows it when an update is due. Returns at once.
    pub fn hear(&self, node: &str, word: Message) {
        let mut inner = self.inner.lock().unwrap_or_else(PoisonError::into_inner);
        let now = Instant::now();
        let unknown = || (now, Track { from: 0.0, done: 0.0, seconds: 0.0 });
        let (start, track) = inner.nodes.entry(node.to_owned()).or_insert_with(unknown);
        match word {
            Message::Resumed(done) => *track = Track { from: done, done, seconds: 0.0 },
            Message::Progress(done) => *track = Track { done, seconds: start.elapsed().as_secs_f64(), ..*track },
        }
        let silence = if self.is_terminal { LIVELY } else { PLAIN };
        if track.done > 0.0 && inner.shown.elapsed() >= silence {
            inner.shown = now;
            let known = inner.nodes.iter().filter(|(_, (_, track))| track.done > 0.0);
            let words: Vec<String> = known.map(|(name, (_, track))| format!("{name} {}", track.words())).collect();
            let (before, after) = if self.is_terminal { (ERASE, "") } else { ("", "\n") };
            say(&format!("{before}{}{after}", words.join("; ")));
        }
    }

    /// Takes the word of a node that starts.
    pub fn start(&self, node: &str) {
        self.hear(node, Message::Resumed(0.0));
    }

    /// Takes a node off that has ended; whether it had been resumed.
    pub fn end(&self, node: &str) -> bool {
        let mut inner = self.inner.lock().unwrap_or_else(PoisonError::into_inner);
        inner.nodes.remove(node).is_some_and(|(_, track)| track.from > 0.0)
    }

    /// A line that stays, above the one that changes.
    pub fn line(&self, text: &str) {
        say(&format!("{}{text}\n", if self.is_terminal { ERASE } else { "" }));
    }
}

impl Default for ProgressDisplay {
    fn default() -> ProgressDisplay {
        ProgressDisplay::new()
    }
}

/// An error on stderr, as when its reader is gone, is ignored.
fn say(text: &str) {
    let _ = std::io::stderr().write_all(text.as_bytes());
}
