//! Sweeps: the tiles of a plane, several at a time.

use crate::given::{Given, choose, scene_error};
use crate::watch::{Watch, detached};
use files::reader::RecipeError;
use files::recipe::Kind;
use jam::outcome::Class;
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use scene::sweep::tiles::{self, Found, Tile};
use scene::sweep::{Cell, DecidedBy, NUMBERS, Sweep};
use std::collections::BTreeMap;
use std::num::NonZero;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// Says what became of the runs of a plane: centres of the cells along `x` and `y`; and cell by cell, `y` running faster,
/// the index of the outcome in `classes`, of what decided in `deciders`, `backward_flow`, and the `numbers` (NaN: none).
#[pyfunction]
pub fn sweep<'py>(
    py: Python<'py>,
    given: Given<'py>,
    panel: Option<&str>,
    values: &Bound<'py, PyDict>,
    jobs: Option<NonZero<usize>>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let chosen = choose(&given, panel, Kind::Sweep, values)?;
    let sweep = scene::sweep::read(&chosen.file, &chosen.panel.tables).map_err(|error| scene_error(py, &error))?;
    let found = detached(py, || Plane::new(&sweep).compute(jobs, &Watch::new(progress.as_ref(), 1)))?;
    let cells = found.map_err(|problem| scene_error(py, &RecipeError::new(&chosen.file, 0, problem)))?;
    let made = PyDict::new(py);
    made.set_item("title", chosen.title)?;
    made.set_item("law", sweep.model.name())?;
    for (name, axis) in [("x", &sweep.x), ("y", &sweep.y)] {
        made.set_item(name, PyArray1::from_iter(py, (0..axis.cells).map(|i| axis.centre(i))))?;
        made.set_item(format!("{name}_axis"), (&axis.parameter, axis.from, axis.to, axis.is_log))?;
    }
    made.set_item("classes", Class::ALL.map(Class::name))?;
    made.set_item("words", Class::ALL.map(Class::in_words))?;
    made.set_item("deciders", DecidedBy::ALL.map(DecidedBy::name))?;
    let index_of = |cell: &Cell| Class::ALL.iter().position(|class| *class == cell.class).map_or(-1, |i| i as i8);
    let decider_of = |cell: &Cell| DecidedBy::ALL.iter().position(|by| *by == cell.decided_by).map_or(-1, |i| i as i8);
    made.set_item("outcome", PyArray1::from_iter(py, cells.iter().map(index_of)))?;
    made.set_item("decided_by", PyArray1::from_iter(py, cells.iter().map(decider_of)))?;
    made.set_item("backward_flow", PyArray1::from_iter(py, cells.iter().map(|cell| cell.backward_flow)))?;
    let numbers = PyDict::new(py);
    for (index, name) in NUMBERS.into_iter().enumerate() {
        numbers.set_item(name, PyArray1::from_iter(py, cells.iter().map(|cell| cell.numbers[index])))?;
    }
    made.set_item("numbers", numbers)?;
    Ok(made)
}

/// A plane at work.
struct Plane<'a> {
    sweep: &'a Sweep,
    tiles: Vec<Tile>,
    /// Every cell that was run: neighbouring tiles share their borders.
    run: Mutex<BTreeMap<[usize; 2], Cell>>,
    /// All cells of the tiles that are done.
    found: Mutex<Vec<Option<Cell>>>,
    next: AtomicUsize,
    done: AtomicUsize,
    /// Threads that have not ended.
    working: AtomicUsize,
    is_over: AtomicBool,
}

/// Between two looks at the threads.
const PAUSE: Duration = Duration::from_millis(20);

impl<'a> Plane<'a> {
    fn new(sweep: &'a Sweep) -> Plane<'a> {
        Plane {
            sweep,
            tiles: tiles::tiles(sweep),
            run: Mutex::default(),
            found: Mutex::new(vec![None; sweep.cells()]),
            next: AtomicUsize::new(0),
            done: AtomicUsize::new(0),
            working: AtomicUsize::new(0),
            is_over: AtomicBool::new(false),
        }
    }

    /// All cells, column by column. This thread looks after the others.
    fn compute(self, jobs: Option<NonZero<usize>>, watch: &Watch<'_>) -> Result<Vec<Cell>, String> {
        let jobs = jobs.map(NonZero::get).or_else(|| std::thread::available_parallelism().ok().map(NonZero::get));
        let jobs = jobs.unwrap_or(1).min(self.tiles.len());
        self.working.store(jobs, Ordering::Relaxed);
        let ended = std::thread::scope(|scope| {
            let threads: Vec<_> = (0..jobs).map(|_| scope.spawn(|| self.work())).collect();
            let watched = catch_unwind(AssertUnwindSafe(|| self.watch(watch)));
            self.is_over.store(true, Ordering::Relaxed);
            let ended = threads.into_iter().map(|thread| thread.join().unwrap_or_else(|panic| resume_unwind(panic)));
            let ended = ended.collect::<Result<Vec<()>, String>>();
            watched.unwrap_or_else(|cause| resume_unwind(cause));
            ended
        });
        ended?;
        watch.tell(1.0);
        let found = self.found.into_inner().unwrap_or_else(PoisonError::into_inner);
        found.into_iter().collect::<Option<Vec<Cell>>>().ok_or_else(|| "cells are missing".to_owned())
    }

    /// Tells how far it is until all threads have ended.
    fn watch(&self, watch: &Watch<'_>) {
        while self.working.load(Ordering::Relaxed) > 0 {
            std::thread::sleep(PAUSE);
            watch.tell(self.done.load(Ordering::Relaxed) as f64 / self.tiles.len() as f64);
        }
    }

    fn work(&self) -> Result<(), String> {
        let worked = self.tiles_one_by_one();
        if worked.is_err() {
            // the others have no reason to go on
            self.is_over.store(true, Ordering::Relaxed);
        }
        self.working.fetch_sub(1, Ordering::Relaxed);
        worked
    }

    fn tiles_one_by_one(&self) -> Result<(), String> {
        while let Some(tile) = self.tiles.get(self.next.fetch_add(1, Ordering::Relaxed)) {
            let found: Vec<Found> = match tiles::compute(self.sweep, *tile, &mut |cell| self.cell(cell)) {
                Ok(found) => found,
                Err(Ended::Stopped) => return Ok(()),
                Err(Ended::Failed(problem)) => return Err(problem),
            };
            let mut all = lock(&self.found);
            for ([i, j], cell) in found {
                all[i * self.sweep.y.cells + j] = Some(cell);
            }
            self.done.fetch_add(1, Ordering::Relaxed);
        }
        Ok(())
    }

    fn cell(&self, cell: [usize; 2]) -> Result<Cell, Ended> {
        if self.is_over.load(Ordering::Relaxed) {
            return Err(Ended::Stopped);
        }
        if let Some(known) = lock(&self.run).get(&cell) {
            return Ok(*known);
        }
        let found = self.sweep.compute(cell).map_err(|problem| {
            let ([x, y], Sweep { x: across, y: up, .. }) = (self.sweep.at(cell), self.sweep);
            Ended::Failed(format!("at {} = {x:?}, {} = {y:?}: {problem}", across.parameter, up.parameter))
        })?;
        lock(&self.run).insert(cell, found);
        Ok(found)
    }
}

/// Why a tile was not finished.
enum Ended {
    /// Another thread, or who looks on, has ended the work.
    Stopped,
    /// A cell without an outcome: which, and why.
    Failed(String),
}

impl From<String> for Ended {
    fn from(problem: String) -> Ended {
        Ended::Failed(problem)
    }
}

/// What a mutex holds: no thread panics with it.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
