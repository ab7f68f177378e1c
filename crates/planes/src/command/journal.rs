//! The journal of a shard: each cell is appended as soon as it is known, so that a killed sweep can be resumed.

use super::Task;
use figures::failure::Failure;
use files::write::{atomic, with_path};
use std::fs::File;
use std::io::{ErrorKind, Write as _};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use sweep::tiles::{Found, Tile, of_shard, tiles};
use sweep::{CellOutcome, table};

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

    /// Its tiles.
    pub(super) fn tiles(&self, task: &Task) -> Vec<Tile> {
        of_shard(&tiles(&task.sweep), self.index - 1, self.count)
    }

    /// Its cells, all of them and in order; `None` if it was not computed yet.
    ///
    /// # Errors
    /// The file belongs to another scene, program or split, or is damaged: with the line.
    pub(super) fn read(&self, task: &Task) -> Result<Option<Vec<Found>>, Failure> {
        let path = self.file(task);
        let Some(text) = bytes(&path)? else { return Ok(None) };
        let cells = parse(&path, &text, &self.line(task))?;
        let mut expected: Vec<[usize; 2]> = self.tiles(task).iter().flat_map(Tile::all).collect();
        expected.sort_unstable();
        expected.dedup();
        let count = expected.len();
        let differs = expected.iter().zip(&cells).position(|(expected, (cell, _))| expected != cell);
        let problem = match differs {
            Some(index) => format!("{}: cell {:?}; must be {:?}", index + 3, cells[index].0, expected[index]),
            None if cells.len() != count || !text.ends_with('\n') => {
                format!("{}: {} cells; there must be {count}, each a line", cells.len() + 2, cells.len())
            }
            None => return Ok(Some(cells)),
        };
        Err(Failure::input(format!("{}:{problem}; {REMEDY}", path.display())))
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
    /// The journal of a shard and its cells; `None` if the shard is already complete.
    ///
    /// # Errors
    /// It belongs to another scene or program: nothing is touched.
    pub(super) fn open(task: &Task, shard: &Shard) -> Result<(Option<Journal>, Vec<Found>), Failure> {
        if let Some(cells) = shard.read(task)? {
            return Ok((None, cells.into_iter().filter(|(_, cell)| is_run(cell)).collect()));
        }
        let (path, head) = (shard.file(task), shard.line(task));
        let beside = path.with_extension("part");
        let known = read_journal(&beside, &head)?;
        // written anew: without what a kill has cut off
        let text = text(&head, &known);
        atomic(&beside, text.as_bytes())?;
        let file = File::options().append(true).open(&beside).map_err(|error| with_path(error, &beside))?;
        Ok((Some(Journal { shard: path, head, path: beside, file, flushed: Instant::now() }), known))
    }

    /// Adds a cell.
    pub(super) fn add(&mut self, cell: [usize; 2], found: &CellOutcome) -> Result<(), Failure> {
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
        match std::fs::remove_file(&self.path) {
            // somebody else has computed the same shard at the same time, and was faster
            Err(error) if error.kind() == ErrorKind::NotFound => Ok(()),
            removed => Ok(removed.map_err(|error| with_path(error, &self.path))?),
        }
    }
}

fn is_run(cell: &CellOutcome) -> bool {
    cell.decided_by != sweep::DecidedBy::Neighbours
}

fn text(head: &str, cells: &[Found]) -> String {
    let mut text = format!("{head}\n{}\n", table::shard_header());
    for (cell, found) in cells {
        text += &table::shard_line(*cell, found);
        text.push('\n');
    }
    text
}

/// The cells of a journal: none if there is no journal. What a kill has cut off at its end does not count.
///
/// # Errors
/// It belongs to something else, or is damaged.
fn read_journal(path: &Path, head: &str) -> Result<Vec<Found>, Failure> {
    let Some(text) = bytes(path)? else { return Ok(Vec::new()) };
    let begin = format!("{head}\n{}\n", table::shard_header());
    if begin.starts_with(&text) {
        return Ok(Vec::new());
    }
    let whole = text.rfind('\n').map_or(text.as_str(), |end| &text[..end]);
    parse(path, whole, head)
}

/// A file in whole; `None` if there is none.
fn bytes(path: &Path) -> Result<Option<String>, Failure> {
    match std::fs::read(path) {
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
        Err(error) => Err(with_path(error, path).into()),
        // bytes that are not UTF-8 become an unknown word, which is found below
        Ok(bytes) => {
            Ok(Some(String::from_utf8(bytes).unwrap_or_else(|error| String::from_utf8_lossy(error.as_bytes()).into())))
        }
    }
}

/// The cells that follow the two first lines.
fn parse(path: &Path, text: &str, head: &str) -> Result<Vec<Found>, Failure> {
    let mut lines = text.lines();
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
    let header = table::shard_header();
    let second = lines.next().unwrap_or("");
    if second != header {
        return Err(Failure::input(format!("{shown}:2: {second:?}: must be {header:?}; {REMEDY}")));
    }
    let cell = |(index, line): (usize, &str)| {
        table::parse(line).ok_or_else(|| {
            Failure::input(format!(
                "{shown}:{}: {line:?}: not a cell of a sweep, or its sum is wrong; {REMEDY}",
                index + 3
            ))
        })
    };
    lines.enumerate().map(cell).collect()
}

/// What to do about a damaged file.
const REMEDY: &str = "the file is damaged: remove it, and compute the shard again";
