//! Runs without a scene file: a user-defined law gives what its formula gives, bad input is refused, observers see the
//! run.

use crate::own::pair;
use jam::errors::stated;
use jam::events::EventKind;
use jam::laws::{Exponential, Formula, Model};
use jam::outcome::{Class, Decision};
use jam::ring::{Ring, Start};
use jam::run::{Judging, Run, RunObserver, Sample, run, run_from};
use jam::states::StateVariables;
use ode::{Control, Method, Step};

fn ring(pedestrians: usize, length: f64) -> Ring {
    Ring { pedestrians, length }
}

/// A run of 30 pedestrians at a headway of 2.
fn of(model: &Model) -> Run {
    Run::new(model.clone(), ring(30, 60.0), Start { shift: 0.1 }, 200.0).expect("a run")
}

#[test]
fn a_private_law_gives_the_run_of_its_formula() {
    let outcomes = pair(1.0).map(|model| run_from(&of(&model), None, &mut Judging::Along).expect("it runs"));
    let [own, formula] = &outcomes;
    assert!(own.samples == formula.samples && own.events == formula.events && own.drift == formula.drift);
    assert_eq!((own.statistics, &own.verdict), (formula.statistics, &formula.verdict));
    assert_eq!((own.samples.len(), own.samples.speeds.len()), (201, 201 * 30));
    assert!(own.drift.speed().is_some_and(|(speed, _)| speed < 0.5), "jams travel: {:?}", own.drift);
}

#[test]
fn the_outcome_of_a_private_law_is_told() {
    // V'(2) = 1 is stable for kappa > 2
    let [own, _] = pair(3.0);
    let outcome = run_from(&of(&own), None, &mut Judging::Along).expect("it runs");
    let verdict = outcome.verdict.expect("it was asked for");
    assert_eq!((verdict.class, verdict.decision), (Class::Decays, Decision::Return));
    assert!(run(&of(&own)).expect("it runs").verdict.is_none());
}

#[test]
fn a_private_law_runs_by_every_method_and_form() {
    let [own, _] = pair(1.0);
    let end = |method, form| {
        let control = Control::Adaptive { tolerance: 1e-11 };
        run(&Run { method, control, form, t_end: 30.0, ..of(&own) }).expect("it runs").positions
    };
    let right = end(Method::Verner98, StateVariables::Deviations);
    for method in Method::ALL.into_iter().filter(|method| method.is_adaptive() && method.order() > 5) {
        for form in [StateVariables::Deviations, StateVariables::Spacings] {
            let positions = end(method, form);
            let error = right.iter().zip(&positions).map(|(a, b)| (a - b).abs()).fold(0.0, math::larger);
            assert!(error < 1e-7, "{} {form:?}: {error:e}", method.name());
        }
    }
}

#[test]
fn a_wrong_run_is_refused_with_its_numbers() {
    let [own, _] = pair(1.0);
    let tried = |ring, shift, t_end| Run::new(own.clone(), ring, Start { shift }, t_end).unwrap_err();
    for (error, words) in [
        (tried(ring(1, 10.0), 0.1, 1.0), ["1 pedestrians", "at least 2"]),
        (tried(ring(10, -1.0), 0.1, 1.0), ["-1.0", "above 0"]),
        (tried(ring(10, 10.0), 0.1, f64::NAN), ["NaN", "above 0"]),
        (tried(ring(10, 10.0), 1.5, 1.0), ["1.5", "1.0"]),
        (tried(ring(10, 10.0), f64::NAN, 1.0), ["NaN", "closes a gap"]),
    ] {
        assert!(words.iter().all(|word| error.contains(word)), "{error}");
    }
    let wide = Formula::written(&[("acceleration", "1 - v + 0.1*(s[4] - s)".into()), ("body", 0.0.into())]);
    let wide = Model::Formula(wide.expect("a formula"));
    let error = Run::new(wide, ring(3, 9.0), Start { shift: 0.1 }, 1.0).unwrap_err();
    assert!(error.contains("4 pedestrians away") && error.contains('5'), "{error}");
}

/// Ends a run after a few samples.
#[derive(Default)]
struct Few {
    times: Vec<f64>,
    steps: usize,
}

impl RunObserver for Few {
    fn after(&mut self, _step: &Step<'_>) {
        self.steps += 1;
    }

    fn sampled(&mut self, sample: &Sample<'_>) {
        assert_eq!((sample.positions.len(), sample.speeds.len()), (30, 30));
        self.times.push(sample.time);
    }

    fn is_done(&self) -> bool {
        self.times.len() > 4
    }
}

#[test]
fn an_observer_sees_samples_and_can_end_a_run() {
    let [own, _] = pair(1.0);
    let mut few = Few::default();
    let outcome = run_from(&of(&own), None, &mut few).expect("it runs");
    assert_eq!(few.times, outcome.samples.times);
    assert!((5..50).contains(&few.times.len()) && outcome.statistics.time < 100.0, "{:?}", few.times);
    assert_eq!(few.steps as u64, outcome.statistics.steps);
    let whole = run(&of(&own)).expect("it runs");
    assert_eq!(whole.samples.std[..few.times.len()], outcome.samples.std[..], "the same bits");
}

#[test]
fn events_of_a_private_law_end_its_samples() {
    // so slow to relax that the shifted pedestrian is run into
    let [own, formula] = pair(0.05);
    let tried = |model: &Model| {
        let start = Start { shift: 1.5 };
        run(&Run::new(model.clone(), ring(30, 60.0), start, 400.0).expect("a run")).expect("it runs")
    };
    let [own, formula] = [tried(&own), tried(&formula)];
    assert_eq!(own.events, formula.events);
    let stop = own.stop().expect("an overlap");
    assert_eq!(stop.kind, EventKind::Overlap);
    assert!(own.samples.times.last().is_some_and(|last| *last <= stop.time));
}

/// The end was that of the step in which the last event was found, so it depended on the method.
#[test]
fn a_run_ends_at_its_last_event_by_every_method() {
    let model = Model::Exponential(Exponential { a: 3.0, b: 1.5, c: 0.0, a_v: 0.0, epsilon: 0.1, v0: 3.0 });
    let set = Run::new(model, ring(57, 200.0), Start { shift: 0.1 }, 2000.0).expect("a run");
    let ends = [Method::Taylor, Method::Dop853, Method::Verner98].map(|method| {
        let control = Control::Adaptive { tolerance: 1e-12 };
        let (outcome, errors) = stated(&Run { method, control, ..set.clone() }).expect("it runs");
        let [.., last] = &outcome.events[..] else { panic!("no events") };
        assert_eq!((last.kind, last.time), (EventKind::Exchange, outcome.statistics.time), "{:?}", outcome.events);
        assert!(outcome.ends_at_event() && outcome.last_step > last.time);
        // one has reached the other
        let (n, x) = (last.pedestrian, &outcome.positions);
        let spacing = if n == 56 { x[0] + 200.0 - x[n] } else { x[n + 1] - x[n] };
        assert!(spacing.abs() < 1e-11, "{method:?}: {spacing:e}");
        let [of_x, of_v] = [errors.positions, errors.speeds].map(|error| error.expect("an error of the state"));
        assert!(of_x < 1e-6 && of_v < 1e-6, "{method:?}: {of_x:e}, {of_v:e}");
        (outcome, of_x, of_v)
    });
    let apart = |a: &[f64], b: &[f64]| a.iter().zip(b).fold(0.0, |most, (a, b)| math::larger(most, (a - b).abs()));
    let (first, of_x, of_v) = &ends[0];
    for (other, other_x, other_v) in &ends[1..] {
        let (x, v) = (apart(&first.positions, &other.positions), apart(&first.speeds, &other.speeds));
        assert!(x < of_x + other_x && v < of_v + other_v, "{x:e}, {v:e}: stated {of_x:e}, {of_v:e}");
        assert!(first.last_step != other.last_step);
    }
}
