//! Sweeps: the tiles of a plane, several at a time.

use crate::given::{Given, choose, scene_error};
use crate::watch::{Watch, detached};
use ::sweep::{CellOutcome, DecidedBy, NUMBERS, Pool, Sweep, tiles};
use files::reader::SceneError;
use files::scene_file::Kind;
use jam::outcome::Class;
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::num::NonZero;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::time::Duration;

/// Outcomes of the runs in a plane: centres of the cells along `x` and `y`; and cell by cell, `y` running faster, the
/// index of the outcome in `classes`, of what decided in `deciders`, `backward_flow`, and the `numbers` (NaN: none).
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
    let sweep = ::sweep::read(&chosen.file, &chosen.panel.tables).map_err(|error| scene_error(py, &error))?;
    let found = detached(py, || compute(&sweep, jobs, &Watch::new(progress.as_ref(), 1)))?;
    let cells = found.map_err(|problem| scene_error(py, &SceneError::new(&chosen.file, 0, problem)))?;
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
    let index_of = |cell: &CellOutcome| Class::ALL.iter().position(|class| *class == cell.class).map_or(-1, |i| i as i8);
    let decider_of = |cell: &CellOutcome| DecidedBy::ALL.iter().position(|by| *by == cell.decided_by).map_or(-1, |i| i as i8);
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

/// Between two looks at the work.
const PAUSE: Duration = Duration::from_millis(20);

/// All cells, column by column. This thread looks after those that compute.
fn compute(sweep: &Sweep, jobs: Option<NonZero<usize>>, watch: &Watch<'_>) -> Result<Vec<CellOutcome>, String> {
    let jobs = jobs.map(NonZero::get).or_else(|| std::thread::available_parallelism().ok().map(NonZero::get));
    let pool = Pool::new(sweep, tiles::tiles(sweep), Vec::new());
    let found = std::thread::scope(|scope| {
        let computing = scope.spawn(|| pool.compute(jobs.unwrap_or(1), &|_| Ok::<(), String>(())));
        let watched = catch_unwind(AssertUnwindSafe(|| {
            while !computing.is_finished() {
                std::thread::sleep(PAUSE);
                watch.tell(pool.done() as f64 / pool.tiles() as f64);
            }
        }));
        pool.stop();
        let found = computing.join().unwrap_or_else(|panic| resume_unwind(panic));
        watched.unwrap_or_else(|cause| resume_unwind(cause));
        found
    });
    let found = found?;
    watch.tell(1.0);
    let mut cells = vec![None; sweep.cells()];
    for ([i, j], cell) in found.unwrap_or_default() {
        cells[i * sweep.y.cells + j] = Some(cell);
    }
    cells.into_iter().collect::<Option<Vec<CellOutcome>>>().ok_or_else(|| "cells are missing".to_owned())
}
