//! Computing the tiles of a shard, several at a time.

use super::Task;
use super::journal::{Journal, Shard};
use crate::failure::Failure;
use scene::sweep::tiles::{self, Tile};
use scene::sweep::{Cell, Sweep};
use std::collections::BTreeMap;
use std::io::{IsTerminal as _, Write as _};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard, OnceLock, PoisonError};
use std::time::{Duration, Instant};

/// The tiles of a shard, and what is known of their cells.
pub(super) struct Work<'a> {
    task: &'a Task,
    tiles: Vec<Tile>,
    jobs: usize,
    /// Every cell found: neighbouring tiles share their borders.
    cells: Mutex<BTreeMap<[usize; 2], Cell>>,
    journal: Mutex<Option<Journal>>,
    next: AtomicUsize,
    /// Tiles and cells that are done.
    done: [AtomicUsize; 2],
    /// Cells that were computed before.
    kept: usize,
    started: Instant,
    told: Mutex<Instant>,
}

/// Between two words about progress.
const SILENCE: Duration = Duration::from_secs(1);

impl<'a> Work<'a> {
    pub(super) fn new(task: &'a Task, tiles: Vec<Tile>, jobs: usize) -> Work<'a> {
        let now = Instant::now();
        Work {
            task,
            tiles,
            jobs,
            cells: Mutex::default(),
            journal: Mutex::new(None),
            next: AtomicUsize::new(0),
            done: [AtomicUsize::new(0), AtomicUsize::new(0)],
            kept: 0,
            started: now,
            told: Mutex::new(now),
        }
    }

    /// Computes what the journal of the shard does not know, and writes the shard. Returns the number of its cells that were
    /// run, now or before.
    pub(super) fn run(mut self, shard: &Shard) -> Result<usize, Failure> {
        let (journal, known) = Journal::open(self.task, shard)?;
        let Some(journal) = journal else {
            // the shard is there and whole
            return Ok(known.len());
        };
        self.kept = known.len();
        *self.cells.get_mut().unwrap_or_else(PoisonError::into_inner) = known.into_iter().collect();
        *self.journal.get_mut().unwrap_or_else(PoisonError::into_inner) = Some(journal);
        let tables: Vec<OnceLock<Vec<tiles::Found>>> = (0..self.tiles.len()).map(|_| OnceLock::new()).collect();
        let worked = std::thread::scope(|scope| {
            let threads: Vec<_> = (0..self.jobs).map(|_| scope.spawn(|| self.tiles_one_by_one(&tables))).collect();
            threads
                .into_iter()
                .map(|thread| thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)))
                .collect::<Result<Vec<()>, Failure>>()
        });
        if std::io::stderr().is_terminal() {
            let _ = write!(std::io::stderr(), "\r\x1b[K");
        }
        worked?;
        let found: Vec<tiles::Found> = tables.into_iter().filter_map(OnceLock::into_inner).flatten().collect();
        let journal = self.journal.get_mut().unwrap_or_else(PoisonError::into_inner).take();
        if let Some(journal) = journal {
            journal.finish(found)?;
        }
        Ok(self.kept + self.done[1].load(Ordering::Relaxed))
    }

    fn tiles_one_by_one(&self, tables: &[OnceLock<Vec<tiles::Found>>]) -> Result<(), Failure> {
        loop {
            let index = self.next.fetch_add(1, Ordering::Relaxed);
            let Some(tile) = self.tiles.get(index) else { return Ok(()) };
            match tiles::compute(&self.task.sweep, *tile, &mut |cell| self.cell(cell)) {
                Ok(found) => {
                    let _ = tables[index].set(found);
                    self.done[0].fetch_add(1, Ordering::Relaxed);
                }
                Err(failure) => {
                    // the others have no reason to go on
                    self.next.store(self.tiles.len(), Ordering::Relaxed);
                    return Err(failure);
                }
            }
        }
    }

    fn cell(&self, cell: [usize; 2]) -> Result<Cell, Failure> {
        if let Some(known) = lock(&self.cells).get(&cell) {
            return Ok(*known);
        }
        let found = self.task.sweep.compute(cell).map_err(|problem| at(&self.task.sweep, cell, &problem))?;
        // two threads may have met at a border: both found the same
        if lock(&self.cells).insert(cell, found).is_none() {
            if let Some(journal) = lock(&self.journal).as_mut() {
                journal.add(cell, &found)?;
            }
            self.done[1].fetch_add(1, Ordering::Relaxed);
        }
        self.tell();
        Ok(found)
    }

    /// How far it is, on a terminal a line that is written again and again, else a line every ten seconds.
    fn tell(&self) {
        let Ok(mut told) = self.told.try_lock() else { return };
        let is_terminal = std::io::stderr().is_terminal();
        let silence = if is_terminal { SILENCE } else { 10 * SILENCE };
        if told.elapsed() < silence {
            return;
        }
        *told = Instant::now();
        let [tiles, cells] = [0, 1].map(|index| self.done[index].load(Ordering::Relaxed));
        let share = (tiles as f64 + 0.5) / self.tiles.len() as f64;
        let left = self.started.elapsed().as_secs_f64() * (1.0 - share) / share;
        let (start, end) = if is_terminal { ("\r\x1b[K", "") } else { ("", "\n") };
        let all = self.tiles.len();
        let _ = write!(
            std::io::stderr(),
            "{start}{tiles} of {all} tiles, {} cells run, about {left:.0} s left{end}",
            self.kept + cells
        );
    }
}

/// What a mutex holds: no thread panics with it.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

fn at(sweep: &Sweep, cell: [usize; 2], problem: &str) -> Failure {
    let [x, y] = sweep.at(cell);
    Failure::input(format!("at {} = {x:?}, {} = {y:?}: {problem}", sweep.x.parameter, sweep.y.parameter))
}

/// As many cells are computed at least: the borders of the tiles, and what lies beside lines that are known.
pub(super) fn least_cells(sweep: &Sweep) -> Result<usize, Failure> {
    let mut is_computed = vec![!sweep.refine; sweep.cells()];
    for tile in tiles::tiles(sweep) {
        for cell in tiles::least(sweep, tile).map_err(Failure::input)? {
            is_computed[cell[0] * sweep.y.cells + cell[1]] = true;
        }
    }
    Ok(is_computed.iter().filter(|is| **is).count())
}

/// The mean time of a cell, from some that are spread over the plane.
pub(super) fn seconds_of_a_cell(sweep: &Sweep) -> Result<f64, Failure> {
    /// So many in each direction, and so much time at most.
    const EACH: usize = 6;
    const PATIENCE: Duration = Duration::from_secs(20);
    let started = Instant::now();
    let mut count = 0;
    // not row by row, so that half of them are spread as well
    for index in 0..EACH * EACH {
        let spread = (index * 7) % (EACH * EACH);
        let part = |index: usize, cells: usize| (2 * index + 1) * cells / (2 * EACH);
        let cell = [part(spread / EACH, sweep.x.cells), part(spread % EACH, sweep.y.cells)];
        sweep.compute(cell).map_err(|problem| at(sweep, cell, &problem))?;
        count += 1;
        if started.elapsed() > PATIENCE {
            break;
        }
    }
    Ok(started.elapsed().as_secs_f64() / f64::from(count))
}
