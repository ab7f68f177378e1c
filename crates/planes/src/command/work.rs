//! Computes the tiles of a shard, several at a time, and appends the cells to its journal.

use super::Task;
use super::journal::{Journal, Shard};
use figures::failure::Failure;
use std::io::{IsTerminal as _, Write as _};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};
use sweep::tiles::{self, Tile};
use sweep::{Pool, Sweep};

/// Between two words about progress.
const SILENCE: Duration = Duration::from_secs(1);

/// Computes what the journal of a shard, of these tiles, does not know, and writes the shard. Returns the number of its
/// cells that were run, now or before.
pub(super) fn run(task: &Task, tiles: Vec<Tile>, jobs: usize, shard: &Shard) -> Result<usize, Failure> {
    let (journal, known) = Journal::open(task, shard)?;
    let cells = known.len();
    let Some(journal) = journal else {
        // the shard is there and whole
        return Ok(cells);
    };
    let pool = Pool::new(&task.sweep, tiles, known);
    let now = Instant::now();
    let desk = Mutex::new(Desk { journal, cells, started: now, told: now });
    let found = pool.compute(jobs, &|(cell, found)| {
        let mut desk = desk.lock().unwrap_or_else(PoisonError::into_inner);
        desk.journal.add(*cell, found)?;
        desk.cells += 1;
        desk.tell(&pool);
        Ok::<(), Failure>(())
    });
    if std::io::stderr().is_terminal() {
        let _ = write!(std::io::stderr(), "\r\x1b[K");
    }
    let Desk { journal, cells, .. } = desk.into_inner().unwrap_or_else(PoisonError::into_inner);
    // nobody stops it
    journal.finish(found?.unwrap_or_default())?;
    Ok(cells)
}

/// What one thread at a time has to do with.
struct Desk {
    journal: Journal,
    /// Cells that were run, now or before.
    cells: usize,
    started: Instant,
    told: Instant,
}

impl Desk {
    /// How far it is, on a terminal a line that is written again and again, else a line every ten seconds.
    fn tell(&mut self, pool: &Pool<'_>) {
        let is_terminal = std::io::stderr().is_terminal();
        let silence = if is_terminal { SILENCE } else { 10 * SILENCE };
        if self.told.elapsed() < silence {
            return;
        }
        self.told = Instant::now();
        let (tiles, all) = (pool.done(), pool.tiles());
        let share = (tiles as f64 + 0.5) / all as f64;
        let left = self.started.elapsed().as_secs_f64() * (1.0 - share) / share;
        let (start, end) = if is_terminal { ("\r\x1b[K", "") } else { ("", "\n") };
        let _ = write!(
            std::io::stderr(),
            "{start}{tiles} of {all} tiles, {} cells run, about {left:.0} s left{end}",
            self.cells
        );
    }
}

/// The least number of cells computed: the borders of the tiles, and the cells beside known lines.
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
        sweep.compute(cell)?;
        count += 1;
        if started.elapsed() > PATIENCE {
            break;
        }
    }
    Ok(started.elapsed().as_secs_f64() / f64::from(count))
}
