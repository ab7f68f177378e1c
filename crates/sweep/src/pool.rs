//! Computes several tiles at a time, each cell once.

use super::tiles::{self, Found, Tile};
use super::{CellOutcome, Sweep};
use std::collections::BTreeMap;
use std::panic::resume_unwind;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Tiles at work.
#[derive(Debug)]
pub struct Pool<'a> {
    sweep: &'a Sweep,
    tiles: Vec<Tile>,
    /// Every cell that was run: neighbouring tiles share their borders.
    run: Mutex<BTreeMap<[usize; 2], CellOutcome>>,
    /// The tile to be taken next.
    next: AtomicUsize,
    done: AtomicUsize,
    is_over: AtomicBool,
}

/// Why a tile was not finished.
enum Halt<E> {
    /// The work is over.
    Stopped,
    /// A cell without an outcome, or a failure of the receiver.
    Failed(E),
}

impl<E: From<String>> From<String> for Halt<E> {
    fn from(problem: String) -> Halt<E> {
        Halt::Failed(problem.into())
    }
}

impl<'a> Pool<'a> {
    /// These tiles of a sweep, of which these cells are known.
    pub fn new(sweep: &'a Sweep, tiles: Vec<Tile>, known: Vec<Found>) -> Pool<'a> {
        let run = Mutex::new(known.into_iter().collect());
        let [next, done] = [0, 0].map(AtomicUsize::new);
        Pool { sweep, tiles, run, next, done, is_over: AtomicBool::new(false) }
    }

    /// The number of tiles.
    pub fn tiles(&self) -> usize {
        self.tiles.len()
    }

    /// How many of them are done.
    pub fn done(&self) -> usize {
        self.done.load(Ordering::Relaxed)
    }

    /// No further cell is begun.
    pub fn stop(&self) {
        self.is_over.store(true, Ordering::Relaxed);
    }

    /// Computes the tiles on the given number of threads; `hear` is called once for each cell that is run. Returns the
    /// cells of all tiles, tile by tile; `None` if it was stopped.
    ///
    /// # Errors
    /// The first error of a cell or of `hear`; the other threads end after their current cell.
    pub fn compute<E: From<String> + Send>(
        &self,
        jobs: usize,
        hear: &(impl Fn(&Found) -> Result<(), E> + Sync),
    ) -> Result<Option<Vec<Found>>, E> {
        let all: Mutex<Vec<Option<Vec<Found>>>> = Mutex::new(vec![None; self.tiles.len()]);
        std::thread::scope(|scope| {
            let work = || self.tiles_one_by_one(hear, &all).inspect_err(|_| self.stop());
            let threads: Vec<_> = (0..jobs.min(self.tiles.len())).map(|_| scope.spawn(work)).collect();
            let ended = threads.into_iter().map(|thread| thread.join().unwrap_or_else(|panic| resume_unwind(panic)));
            ended.collect::<Vec<Result<(), E>>>().into_iter().collect::<Result<(), E>>()
        })?;
        let all = all.into_inner().unwrap_or_else(PoisonError::into_inner);
        Ok(all.into_iter().collect::<Option<Vec<_>>>().map(|tiles| tiles.concat()))
    }

    fn tiles_one_by_one<E: From<String>>(
        &self,
        hear: &impl Fn(&Found) -> Result<(), E>,
        all: &Mutex<Vec<Option<Vec<Found>>>>,
    ) -> Result<(), E> {
        loop {
            let index = self.next.fetch_add(1, Ordering::Relaxed);
            let Some(tile) = self.tiles.get(index) else { return Ok(()) };
            match tiles::compute(self.sweep, *tile, &mut |cell| self.cell(cell, hear)) {
                Ok(found) => lock(all)[index] = Some(found),
                Err(Halt::Stopped) => return Ok(()),
                Err(Halt::Failed(error)) => return Err(error),
            }
            self.done.fetch_add(1, Ordering::Relaxed);
        }
    }

    fn cell<E: From<String>>(
        &self,
        cell: [usize; 2],
        hear: &impl Fn(&Found) -> Result<(), E>,
    ) -> Result<CellOutcome, Halt<E>> {
        if self.is_over.load(Ordering::Relaxed) {
            return Err(Halt::Stopped);
        }
        if let Some(known) = lock(&self.run).get(&cell) {
            return Ok(*known);
        }
        let found = self.sweep.compute(cell)?;
        // two threads may have met at a border: both found the same
        if lock(&self.run).insert(cell, found).is_none() {
            hear(&(cell, found)).map_err(Halt::Failed)?;
        }
        Ok(found)
    }
}

/// What a mutex holds: no thread panics with it.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
