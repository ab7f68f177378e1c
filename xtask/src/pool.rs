//! Runs nodes in parallel: the longest first, and none before its inputs.

use checkout::failure::Failure;
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError, mpsc};
use std::thread;

/// What the pool has to know of a node.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Job {
    /// Indices of the nodes that must end well before this one starts; each smaller than its own index.
    pub after: Vec<usize>,
    /// A guess of its duration, in any unit.
    pub weight: f64,
}

/// How a node ended.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome<T> {
    /// Success, with its result.
    Done(T),
    /// Badly.
    Failed(Failure),
    /// It was not started, or was stopped, because another one failed.
    Skipped,
}

#[derive(Clone, Copy, PartialEq)]
enum Phase {
    Waiting,
    Running,
    Done,
    Lost,
}

/// Runs every job on at most `threads` threads. `work` gets the index of the job and a flag that becomes true when
/// everything is to stop; `ended` is called on the calling thread as each job ends. Without `keep_going` the first
/// failure stops all; with it only what needs the failed job is skipped. A job that panics has failed.
pub fn run<T: Send>(
    jobs: &[Job],
    threads: usize,
    keep_going: bool,
    work: &(dyn Fn(usize, &AtomicBool) -> Result<T, Failure> + Sync),
    ended: &mut dyn FnMut(usize, &Outcome<T>),
) -> Vec<Outcome<T>> {
    let phases = Mutex::new(vec![Phase::Waiting; jobs.len()]);
    let (changed, stop) = (Condvar::new(), AtomicBool::new(false));
    let (sender, receiver) = mpsc::channel();
    let mut outcomes: Vec<Outcome<T>> = jobs.iter().map(|_| Outcome::Skipped).collect();
    let worker = |sender: mpsc::Sender<(usize, Result<T, Failure>)>| {
        while let Some(index) = take(jobs, &phases, &changed, &stop) {
            let result = catch_unwind(AssertUnwindSafe(|| work(index, &stop)))
                .unwrap_or_else(|panic| Err(Failure::Failed(format!("a defect of the runner: {}", words_of(&*panic)))));
            let failed = result.is_err();
            // before the others are stopped, so that the cause arrives first; the receiver outlives every sender
            let _ = sender.send((index, result));
            stop.fetch_or(failed && !keep_going, Ordering::Relaxed);
            guard(&phases)[index] = if failed { Phase::Lost } else { Phase::Done };
            changed.notify_all();
        }
    };
    thread::scope(|scope| {
        for _ in 0..threads.clamp(1, jobs.len().max(1)) {
            let sender = sender.clone();
            scope.spawn(|| worker(sender));
        }
        drop(sender);
        let mut failed = false;
        for (index, result) in receiver {
            let outcome = match result {
                Ok(made) => Outcome::Done(made),
                // a node that was killed because another one failed has not failed itself
                Err(_) if failed && !keep_going => Outcome::Skipped,
                Err(failure) => Outcome::Failed(failure),
            };
            failed |= matches!(outcome, Outcome::Failed(_));
            ended(index, &outcome);
            outcomes[index] = outcome;
        }
    });
    outcomes
}

/// Waits for the heaviest job that may start; `None` if no job is left.
fn take(jobs: &[Job], phases: &Mutex<Vec<Phase>>, changed: &Condvar, stop: &AtomicBool) -> Option<usize> {
    let mut phases = guard(phases);
    loop {
        lose_dependents(jobs, &mut phases);
        let waiting = |index: &usize| phases[*index] == Phase::Waiting;
        if stop.load(Ordering::Relaxed) || !(0..jobs.len()).any(|index| waiting(&index)) {
            return None;
        }
        let ready = |index: &usize| jobs[*index].after.iter().all(|&before| phases[before] == Phase::Done);
        // ties go to the first
        let heaviest = (0..jobs.len())
            .rev()
            .filter(waiting)
            .filter(ready)
            .max_by(|&a, &b| jobs[a].weight.total_cmp(&jobs[b].weight));
        if let Some(index) = heaviest {
            phases[index] = Phase::Running;
            return Some(index);
        }
        phases = changed.wait(phases).unwrap_or_else(PoisonError::into_inner);
    }
}

/// One sweep is enough: a job needs only earlier ones.
fn lose_dependents(jobs: &[Job], phases: &mut [Phase]) {
    for index in 0..jobs.len() {
        if phases[index] == Phase::Waiting && jobs[index].after.iter().any(|&before| phases[before] == Phase::Lost) {
            phases[index] = Phase::Lost;
        }
    }
}

/// The message of a panic.
fn words_of(panic: &(dyn Any + Send)) -> &str {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    text.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("a panic without a message")
}

/// A thread that panicked leaves the phases as they were before its change: they stay usable.
fn guard(phases: &Mutex<Vec<Phase>>) -> MutexGuard<'_, Vec<Phase>> {
    phases.lock().unwrap_or_else(PoisonError::into_inner)
}
