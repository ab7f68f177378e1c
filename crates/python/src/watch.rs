//! Monitoring of a computation that runs without the interpreter's lock: Ctrl-C ends it, and a callback receives its
//! progress.

use jam::run::{Judging, PartialRun, RunObserver};
use pyo3::prelude::*;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::time::{Duration, Instant};

/// Between two looks: short for who presses Ctrl-C, long beside what a look takes.
const PAUSE: Duration = Duration::from_millis(50);
/// The clock is read once in so much work, counted in accelerations; they take some microseconds.
const WORK: usize = 500;

/// Looks after a computation.
pub struct Watch<'a> {
    progress: Option<&'a Py<PyAny>>,
    next: Instant,
    work: usize,
    /// The work of one step or cell.
    each: usize,
    t_end: f64,
    /// What part of the whole is looked at: where it begins, and how long it is.
    part: (f64, f64),
    /// Whether the outcome of the run is judged.
    pub judging: Judging,
}

impl<'a> Watch<'a> {
    /// Of a computation in steps of the work `each`.
    pub fn new(progress: Option<&'a Py<PyAny>>, each: usize) -> Watch<'a> {
        Watch {
            progress,
            next: Instant::now() + PAUSE,
            work: 0,
            each,
            t_end: 1.0,
            part: (0.0, 1.0),
            judging: Judging::No,
        }
    }

    /// From here on a run to `t_end` is seen, the part of the whole that begins at `begin` and is `length` long.
    pub fn turn_to(&mut self, t_end: f64, begin: f64, length: f64) {
        (self.t_end, self.part) = (t_end, (begin, length));
    }

    /// Called as often as one likes.
    pub fn look(&mut self, fraction: f64) {
        self.work += self.each;
        if self.work < WORK {
            return;
        }
        self.work = 0;
        let now = Instant::now();
        if now < self.next {
            return;
        }
        self.next = now + PAUSE;
        let (begin, length) = self.part;
        self.tell(begin + length * fraction);
    }

    /// Tells the callback; what Ctrl-C or the callback raise leaves the computation.
    pub fn tell(&self, fraction: f64) {
        let told = Python::attach(|py| {
            py.check_signals()?;
            self.progress.map_or(Ok(()), |progress| progress.call1(py, (fraction,)).map(drop))
        });
        if let Err(error) = told {
            resume_unwind(Box::new(error));
        }
    }
}

impl RunObserver for Watch<'_> {
    fn after(&mut self, step: &ode::Step<'_>) {
        self.look(step.end / self.t_end);
    }

    fn between(&mut self, underway: &PartialRun<'_>) {
        self.work = WORK;
        self.look(underway.fraction());
    }

    fn judging(&self) -> Judging {
        self.judging
    }
}

/// Computes without the interpreter's lock.
///
/// # Errors
/// What Ctrl-C or a callback raised meanwhile.
pub fn detached<T: Send>(py: Python<'_>, compute: impl FnOnce() -> T + Send) -> PyResult<T> {
    let made = py.detach(|| catch_unwind(AssertUnwindSafe(compute)));
    made.or_else(|cause| match cause.downcast::<PyErr>() {
        Ok(error) => Err(*error),
        Err(cause) => resume_unwind(cause),
    })
}
