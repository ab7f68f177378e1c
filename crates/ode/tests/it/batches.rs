//! Batches of Heun steps by a system: when they are used, and that they have the bits of single steps.

use crate::problems::{Equations, oscillator, solve};
use ode::{Batch, Control, Group, Method, Observer, Problem, ResumePoint, Statistics, Step, System, integrate};
use std::cell::{Cell, RefCell};
use std::ops::{ControlFlow, Range};

/// The oscillator, which makes batches; its first few are eventful.
struct Batched {
    oscillator: Equations,
    offers: bool,
    eventful: Cell<u32>,
    /// Counts of the batches it was asked for.
    asked: RefCell<Vec<u64>>,
}

impl Batched {
    fn new(offers: bool, eventful: u32) -> Batched {
        Batched { oscillator: oscillator(), offers, eventful: Cell::new(eventful), asked: RefCell::default() }
    }
}

impl System for Batched {
    fn dimension(&self) -> usize {
        2
    }
    fn kinematics(&self, state: &[f64], rates: &mut [f64]) {
        self.oscillator.kinematics(state, rates);
    }
    fn dynamics(&self, state: &[f64], rates: &mut [f64]) {
        self.oscillator.dynamics(state, rates);
    }
    fn positions(&self) -> Vec<Range<usize>> {
        self.oscillator.positions()
    }
    fn groups(&self) -> Vec<Group> {
        self.oscillator.groups()
    }
    fn heun(&self, state: &mut [f64], h: f64, count: u64) -> Batch {
        self.asked.borrow_mut().push(count);
        if !self.offers {
            return Batch::Unsupported;
        }
        if self.eventful.get() > 0 {
            self.eventful.set(self.eventful.get() - 1);
            return Batch::NeedsInspection;
        }
        let (mut first, mut second, mut guess) = ([0.0; 2], [0.0; 2], [0.0; 2]);
        for _ in 0..count {
            self.rates(state, &mut first);
            (0..2).for_each(|i| guess[i] = state[i] + h * first[i]);
            self.rates(&guess, &mut second);
            (0..2).for_each(|i| state[i] += h * (0.5 * first[i] + 0.5 * second[i]));
        }
        Batch::Done
    }
}

/// Wants samples at some times; counts the steps it is shown, and keeps the marks.
struct Looking {
    samples: Vec<f64>,
    shown: Vec<f64>,
    marks: Vec<u64>,
}

impl Observer for Looking {
    fn after(&mut self, step: &mut Step<'_>) -> ControlFlow<()> {
        self.shown.push(step.end);
        self.samples.retain(|&t| t > step.end);
        ControlFlow::Continue(())
    }
    fn next_sample(&self) -> f64 {
        self.samples.first().copied().unwrap_or(f64::INFINITY)
    }
    fn between(&mut self, mark: &ResumePoint<'_>) {
        self.marks.push(mark.position.step);
    }
}

/// Steps of 1/1024 from the time 2, until so many are made, with samples after so many.
fn run(system: &Batched, method: Method, steps: u32, samples: &[u32]) -> (Statistics, Looking) {
    let after = |steps: u32| 2.0 + f64::from(steps) / 1024.0;
    let control = Control::Fixed { step: 1.0 / 1024.0 };
    let problem = Problem { system, start: &[1.0, 0.0], begin: 2.0, end: after(steps), method, control };
    let samples = samples.iter().map(|&sample| after(sample)).collect();
    let mut looking = Looking { samples, shown: Vec::new(), marks: Vec::new() };
    let statistics = integrate(&problem, &mut looking).expect("nothing stands in the way");
    (statistics, looking)
}

/// The same run without batches.
fn plain(method: Method, steps: u32) -> Statistics {
    let run =
        solve(&oscillator(), &[1.0, 0.0], f64::from(steps) / 1024.0, method, Control::Fixed { step: 1.0 / 1024.0 });
    Statistics { time: run.time + 2.0, ..run }
}

#[test]
fn bursts_reach_to_the_last_step_and_have_its_bits_and_counts() {
    let system = Batched::new(true, 0);
    let (statistics, looking) = run(&system, Method::Heun, 10_000, &[]);
    assert_eq!(statistics, plain(Method::Heun, 10_000));
    // as many as there may be, then all but the last
    assert_eq!(*system.asked.borrow(), [4096, 4096, 1807]);
    assert_eq!(looking.marks, [4096, 8192]);
    assert_eq!(looking.shown, [2.0 + 10_000.0 / 1024.0]);
}

#[test]
fn the_step_to_a_sample_is_shown() {
    let system = Batched::new(true, 0);
    let (statistics, looking) = run(&system, Method::Heun, 3000, &[700, 701, 2000]);
    assert_eq!(statistics, plain(Method::Heun, 3000));
    assert_eq!(looking.shown, [700.0, 701.0, 2000.0, 3000.0].map(|steps| 2.0 + steps / 1024.0));
    assert_eq!(*system.asked.borrow(), [699, 1298, 999]);
}

#[test]
fn an_eventful_burst_is_made_again_one_by_one() {
    let system = Batched::new(true, 1);
    let (statistics, looking) = run(&system, Method::Heun, 6000, &[1000]);
    assert_eq!(statistics, plain(Method::Heun, 6000));
    // the first 999, which are made one by one, and the one after them; then in batches
    let expected = (1..=1000).chain([6000]).map(|steps| 2.0 + f64::from(steps) / 1024.0);
    assert_eq!(looking.shown, expected.collect::<Vec<_>>());
    assert_eq!(*system.asked.borrow(), [999, 4096, 903]);
}

#[test]
fn who_offers_none_is_asked_once() {
    let system = Batched::new(false, 0);
    let (statistics, looking) = run(&system, Method::Heun, 9000, &[]);
    assert_eq!(statistics, plain(Method::Heun, 9000));
    assert_eq!((looking.shown.len(), system.asked.borrow().len()), (9000, 1));
}

#[test]
fn other_methods_are_never_made_in_bursts() {
    for method in [Method::Euler, Method::Ballistic, Method::Rk4] {
        let system = Batched::new(true, 0);
        let (statistics, looking) = run(&system, method, 5000, &[]);
        assert_eq!(statistics, plain(method, 5000), "{}", method.name());
        assert_eq!((looking.shown.len(), system.asked.borrow().len()), (5000, 0), "{}", method.name());
    }
}

#[test]
fn who_wants_to_see_every_step_sees_it_before_time_0_too() {
    let system = Batched::new(true, 0);
    let control = Control::Fixed { step: 1.0 / 1024.0 };
    let problem = Problem { system: &system, start: &[1.0, 0.0], begin: -2.0, end: 3.0, method: Method::Heun, control };
    let mut shown = 0;
    integrate(&problem, &mut |_: &mut Step<'_>| {
        shown += 1;
        ControlFlow::Continue(())
    })
    .expect("nothing stands in the way");
    assert_eq!((shown, system.asked.borrow().len()), (5 * 1024, 0));
}
