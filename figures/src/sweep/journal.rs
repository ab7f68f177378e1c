//! A shard on its way: every cell is added to a file as it is found, so that a sweep that was killed goes on.

use super::Task;
use crate::failure::Failure;
use files::write::{atomic, with_path};
use scene::sweep::tiles::Found;
use scene::sweep::{Cell, table};
use std::fs::File;
use std::io::{ErrorKind, Write as _};
use std::path::PathBuf;
use std::time::{Duration, Instant};

/// Which shard, from 1.
pub(super) struct Shard {
    pub(super) index: usize,
    pub(super) count: usize,
}

impl Shard {
    /// The first line: what a shard belongs to.
    pub(super) fn line(&self, task: &Task) -> String {
        format!("# sweep {} shard {} of {}", task.hash, self.index, self.count)
    }

    pub(super) fn file(&self, task: &Task) -> PathBuf {
        task.out.join("shards").join(format!("{}-of-{}.csv", self.index, self.count))
    }
}

/// Cells found so far, in a file beside the shard.
pub(super) struct Journal {
    shard: PathBuf,
    head: String,
    path: PathBuf,
    file: File,
    flushed: Instant,
}

/// At least so often the journal is safe on disk.
const EVERY: Duration = Duration::from_secs(5);

impl Journal {
    /// The journal of a shard and what it knows; none if the shard itself is there and whole.
    ///
    /// # Errors
    /// It belongs to another scene or program: nothing is touched.
    pub(super) fn open(task: &Task, shard: &Shard) -> Result<(Option<Journal>, Vec<Found>), Failure> {
        let (path, head) = (shard.file(task), shard.line(task));
        if let Some(found) = read(&path, &head)? {
            return Ok((None, found.cells.into_iter().filter(|(_, cell)| is_run(cell)).collect()));
        }
        let beside = path.with_extension("part");
        let known = read(&beside, &head)?.map_or(Vec::new(), |found| found.cells);
        // written anew: without what a kill has cut off
        let text = text(&head, &known);
        atomic(&beside, text.as_bytes())?;
        let file = File::options().append(true).open(&beside).map_err(|error| with_path(error, &beside))?;
        Ok((Some(Journal { shard: path, head, path: beside, file, flushed: Instant::now() }), known))
    }

    /// Adds a cell.
    pub(super) fn add(&mut self, cell: [usize; 2], found: &Cell) -> Result<(), Failure> {
        let line = table::shard_line(cell, found) + "\n";
        self.file.write_all(line.as_bytes()).map_err(|error| with_path(error, &self.path))?;
        if self.flushed.elapsed() > EVERY {
            self.file.sync_data().map_err(|error| with_path(error, &self.path))?;
            self.flushed = Instant::now();
        }
        Ok(())
    }

    /// Writes the shard, in the order of its cells, and removes the journal.
    pub(super) fn finish(self, mut found: Vec<Found>) -> Result<(), Failure> {
        found.sort_by_key(|(cell, _)| *cell);
        found.dedup_by_key(|(cell, _)| *cell);
        atomic(&self.shard, text(&self.head, &found).as_bytes())?;
        std::fs::remove_file(&self.path).map_err(|error| with_path(error, &self.path))?;
        Ok(())
    }
}

fn is_run(cell: &Cell) -> bool {
    cell.decided_by != scene::sweep::DecidedBy::Neighbours
}

fn text(head: &str, cells: &[Found]) -> String {
    let mut text = format!("{head}\n{}\n", table::shard_header());
    for (cell, found) in cells {
        text += &table::shard_line(*cell, found);
        text.push('\n');
    }
    text
}

/// The cells of a file.
pub(super) struct Read {
    pub(super) cells: Vec<Found>,
}

/// Reads a shard or a journal; `None` if there is none. A last line that was cut off does not count.
///
/// # Errors
/// It begins with another line than `head`, or is damaged.
pub(super) fn read(path: &PathBuf, head: &str) -> Result<Option<Read>, Failure> {
    let bytes = match std::fs::read(path) {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
        read => read.map_err(|error| with_path(error, path))?,
    };
    let text = String::from_utf8_lossy(&bytes);
    let whole = text.rfind('\n').map_or("", |end| &text[..end]);
    let mut lines = whole.lines();
    let shown = path.display();
    let first = lines.next().unwrap_or("");
    if first != head {
        let problem = if first.starts_with("# sweep ") {
            "of another scene, program or split; choose another folder, or remove it"
        } else {
            "is not a shard of a sweep; choose another folder, or remove it"
        };
        return Err(Failure::input(format!("{shown}:1: {first:?}: {problem}; must be {head:?}")));
    }
    if lines.next() != Some(&table::shard_header()) {
        return Ok(None);
    }
    let parse = |(index, line): (usize, &str)| {
        table::parse(line).ok_or_else(|| {
            Failure::input(format!("{shown}:{}: {line:?}: not a cell of a sweep; remove the file", index + 3))
        })
    };
    Ok(Some(Read { cells: lines.enumerate().map(parse).collect::<Result<Vec<Found>, Failure>>()? }))
}
