//! Going on from a mark: the same bits and counts as without a break.

use crate::problems::{general_methods, oscillator, solve};
use ode::{Control, Failure, Mark, Method, Observer, Place, Problem, Statistics, Step, integrate, resume};
use std::ops::ControlFlow;

/// Keeps every mark it is shown.
#[derive(Default)]
struct Keeper(Vec<(Place, Statistics, Vec<f64>)>);

impl Observer for Keeper {
    fn after(&mut self, _: &mut Step<'_>) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    fn between(&mut self, mark: &Mark<'_>) {
        self.0.push((mark.place, mark.statistics.clone(), mark.state.to_vec()));
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
        for (place, statistics, state) in &keeper.0 {
            let mark = Mark { place: *place, statistics, state };
            let resumed = resume(&problem, &mark, &mut Keeper::default()).expect("nothing stands in the way");
            assert_eq!(resumed, whole, "{} from {place:?}", method.name());
        }
    }
}

#[test]
fn adaptive_steps_are_not_resumed() {
    let (system, state) = (oscillator(), [1.0, 0.0]);
    let control = Control::Adaptive { tolerance: 1e-9 };
    let problem = Problem { system: &system, start: &state, begin: 0.0, end: 1.0, method: Method::Dop853, control };
    let mark = Mark { place: Place::default(), statistics: &Statistics::default(), state: &state };
    assert_eq!(resume(&problem, &mark, &mut Keeper::default()), Err(Failure::NotResumable));
}
