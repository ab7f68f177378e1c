//! Resuming from a mark gives the same bits and counts as an uninterrupted run.

use crate::problems::{general_methods, oscillator, solve};
use ode::{
    Control, Failure, Group, Measure, Method, Observer, Pace, Problem, ResumePoint, Statistics, Step, StepPosition,
    System, integrate, resume,
};
use std::ops::{ControlFlow, Range};

/// Keeps every mark it is shown.
#[derive(Default)]
struct Keeper(Vec<(StepPosition, Statistics, Vec<f64>)>);

impl Observer for Keeper {
    fn after(&mut self, _: &mut Step<'_>) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    fn between(&mut self, mark: &ResumePoint<'_>) {
        self.0.push((mark.position, mark.statistics.clone(), mark.state.to_vec()));
    }
}

#[test]
fn a_run_resumed_from_any_mark_has_the_same_bits_and_counts() {
    let system = oscillator();
    for method in general_methods() {
        let control = Control::Fixed { step: 1e-3 };
        let problem = Problem { system: &system, start: &[1.0, 0.0], begin: 0.0, end: 20.0005, method, control };
        let mut keeper = Keeper::default();
        let whole = integrate(&problem, &mut keeper).expect("nothing stands in the way");
        assert_eq!(whole, solve(&system, &[1.0, 0.0], 20.0005, method, control), "marks change nothing");
        assert_eq!(keeper.0.len(), 20_001 / 4096, "{}", method.name());
        for (position, statistics, state) in &keeper.0 {
            let mark = ResumePoint { position: *position, statistics, state, pace: None };
            let resumed = resume(&problem, &mark, &mut Keeper::default()).expect("nothing stands in the way");
            assert_eq!(resumed, whole, "{} from {position:?}", method.name());
        }
    }
}

/// A mark of adaptive steps that outlives them.
struct Kept {
    position: StepPosition,
    statistics: Statistics,
    state: Vec<f64>,
    rates: Vec<f64>,
    compensation: Vec<f64>,
    /// Time and its compensation, the next step, the last error, the unit.
    numbers: ([f64; 2], f64, f64, f64),
}

/// Keeps every mark of adaptive steps.
#[derive(Default)]
struct PaceKeeper(Vec<Kept>);

impl Observer for PaceKeeper {
    fn after(&mut self, _: &mut Step<'_>) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    fn between(&mut self, mark: &ResumePoint<'_>) {
        let pace = mark.pace.expect("adaptive steps");
        self.0.push(Kept {
            position: mark.position,
            statistics: mark.statistics.clone(),
            state: mark.state.to_vec(),
            rates: pace.rates.to_vec(),
            compensation: pace.compensation.to_vec(),
            numbers: (pace.time, pace.step, pace.error, pace.unit),
        });
    }
}

#[test]
fn adaptive_steps_resumed_from_any_mark_have_the_same_bits_and_counts() {
    let system = Wide(oscillator());
    let start: Vec<f64> = (0..WIDTH).map(|i| if i % 2 == 0 { 1.0 } else { 0.0 }).collect();
    for method in general_methods().filter(|method| method.is_adaptive()) {
        let control = Control::Adaptive { tolerance: if method == Method::Bs32 { 1e-7 } else { 1e-9 } };
        // marks are evaluations apart, of which a step of extrapolation takes many
        let end = if method == Method::Extrapolation { 100.0 } else { 30.0 };
        let problem = Problem { system: &system, start: &start, begin: 0.0, end, method, control };
        let mut keeper = PaceKeeper::default();
        let whole = integrate(&problem, &mut keeper).expect("nothing stands in the way");
        assert!(keeper.0.len() > 2, "{}: {} marks", method.name(), keeper.0.len());
        // a few of the many marks: each run from one of them goes on to the end
        for kept in keeper.0.iter().step_by(keeper.0.len().div_ceil(8)).chain(keeper.0.last()) {
            let (time, step, error, unit) = kept.numbers;
            let pace = Pace { rates: &kept.rates, compensation: &kept.compensation, time, step, error, unit };
            let mark = ResumePoint {
                position: kept.position,
                statistics: &kept.statistics,
                state: &kept.state,
                pace: Some(pace),
            };
            let resumed = resume(&problem, &mark, &mut PaceKeeper::default()).expect("nothing stands in the way");
            assert_eq!(resumed, whole, "{} from {time:?}", method.name());
        }
    }
}

/// Components enough for marks every few steps.
const WIDTH: usize = 1 << 14;

/// The same system many times.
struct Wide<S>(S);

impl<S: System> System for Wide<S> {
    fn dimension(&self) -> usize {
        WIDTH
    }

    fn kinematics(&self, state: &[f64], rates: &mut [f64]) {
        state.chunks(2).zip(rates.chunks_mut(2)).for_each(|(state, rates)| self.0.kinematics(state, rates));
    }

    fn dynamics(&self, state: &[f64], rates: &mut [f64]) {
        state.chunks(2).zip(rates.chunks_mut(2)).for_each(|(state, rates)| self.0.dynamics(state, rates));
    }

    fn positions(&self) -> Vec<Range<usize>> {
        Vec::new()
    }

    fn groups(&self) -> Vec<Group> {
        vec![Group { range: 0..WIDTH, measure: Measure::Largest, floor: 1.0 }]
    }
}

#[test]
fn steps_are_resumed_from_marks_of_their_own_kind_alone() {
    let (system, state) = (oscillator(), [1.0, 0.0]);
    let pace = Pace { rates: &[0.0, -1.0], compensation: &[0.0; 2], time: [0.0; 2], step: 0.1, error: 1.0, unit: 1.0 };
    for (control, pace) in [(Control::Adaptive { tolerance: 1e-9 }, None), (Control::Fixed { step: 0.1 }, Some(pace))] {
        let problem = Problem { system: &system, start: &state, begin: 0.0, end: 1.0, method: Method::Dop853, control };
        let mark =
            ResumePoint { position: StepPosition::default(), statistics: &Statistics::default(), state: &state, pace };
        assert_eq!(resume(&problem, &mark, &mut Keeper::default()), Err(Failure::NotResumable));
    }
}
