//! The order in which nodes run, and what a failure stops.

use checkout::failure::Failure;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};
use xtask::pool::{Job, Outcome, run};

fn job(after: &[usize], weight: f64) -> Job {
    Job { after: after.to_vec(), weight }
}

/// The order in which jobs start on so many threads; `bad` fail.
fn order(jobs: &[Job], threads: usize, keep_going: bool, bad: &[usize]) -> (Vec<usize>, Vec<Outcome<usize>>) {
    let started = Mutex::new(Vec::new());
    let work = |index: usize, _: &AtomicBool| {
        started.lock().expect("a lock").push(index);
        if bad.contains(&index) { Err(Failure::Failed(format!("job {index}"))) } else { Ok(index) }
    };
    let outcomes = run(jobs, threads, keep_going, &work, &mut |_, _| {});
    (started.into_inner().expect("a lock"), outcomes)
}

#[test]
fn the_longest_goes_first_but_not_before_what_it_needs() {
    let jobs = [job(&[], 1.0), job(&[], 5.0), job(&[0], 9.0), job(&[], 3.0)];
    assert_eq!(order(&jobs, 1, false, &[]).0, [1, 3, 0, 2]);
}

#[test]
fn equal_jobs_keep_their_order() {
    assert_eq!(order(&vec![job(&[], 1.0); 5], 1, false, &[]).0, [0, 1, 2, 3, 4]);
}

#[test]
fn the_first_failure_stops_all() {
    let jobs = [job(&[], 3.0), job(&[], 2.0), job(&[], 1.0)];
    let (started, outcomes) = order(&jobs, 1, false, &[1]);
    assert_eq!(started, [0, 1]);
    assert_eq!(outcomes, [Outcome::Done(0), Outcome::Failed(Failure::Failed("job 1".to_owned())), Outcome::Skipped]);
}

#[test]
fn keep_going_skips_only_what_needs_the_failed_one() {
    let jobs = [job(&[], 3.0), job(&[0], 2.0), job(&[1], 2.0), job(&[], 1.0)];
    let (started, outcomes) = order(&jobs, 2, true, &[0]);
    assert!(started.contains(&3) && started.len() == 2, "{started:?}");
    assert_eq!(outcomes[1..], [Outcome::Skipped, Outcome::Skipped, Outcome::Done(3)]);
}

#[test]
fn a_running_job_is_told_to_stop_and_does_not_count_as_failed() {
    let work = |index: usize, stop: &AtomicBool| {
        let start = Instant::now();
        while index == 0 && !stop.load(Ordering::Relaxed) && start.elapsed() < Duration::from_secs(20) {
            std::thread::sleep(Duration::from_millis(1));
        }
        Err::<(), _>(Failure::Failed(index.to_string()))
    };
    let outcomes = run(&[job(&[], 2.0), job(&[], 1.0)], 2, false, &work, &mut |_, _| {});
    assert_eq!(outcomes, [Outcome::Skipped, Outcome::Failed(Failure::Failed("1".to_owned()))]);
}

#[test]
fn no_more_than_so_many_at_a_time() {
    let (now, most) = (Mutex::new(0), Mutex::new(0));
    let work = |_: usize, _: &AtomicBool| {
        let count = {
            let mut now = now.lock().expect("a lock");
            *now += 1;
            *now
        };
        let mut largest = most.lock().expect("a lock");
        *largest = count.max(*largest);
        drop(largest);
        std::thread::sleep(Duration::from_millis(2));
        *now.lock().expect("a lock") -= 1;
        Ok(())
    };
    let outcomes = run(&vec![job(&[], 1.0); 12], 3, false, &work, &mut |_, _| {});
    assert_eq!(outcomes.len(), 12);
    let most: i32 = most.into_inner().expect("a lock");
    assert!((1..=3).contains(&most), "{most} at a time");
}

#[test]
fn no_jobs_no_outcomes() {
    assert!(order(&[], 2, false, &[]).1.is_empty());
}

#[test]
fn a_job_that_panics_has_failed_and_keeps_nobody_waiting() {
    let work = |index: usize, _: &AtomicBool| match index {
        0 => panic!("job {index} on purpose"),
        _ => Ok(index),
    };
    let jobs = [job(&[], 2.0), job(&[0], 1.0), job(&[], 1.0)];
    let outcomes = run(&jobs, 2, true, &work, &mut |_, _| {});
    let Outcome::Failed(failure) = &outcomes[0] else { panic!("{outcomes:?}") };
    assert!(failure.code() == 4 && failure.text().contains("job 0 on purpose"), "{failure:?}");
    assert_eq!(outcomes[1..], [Outcome::Skipped, Outcome::Done(2)]);
    assert!(matches!(
        run(&jobs, 1, false, &work, &mut |_, _| {})[..],
        [Outcome::Failed(_), Outcome::Skipped, Outcome::Skipped]
    ));
}
