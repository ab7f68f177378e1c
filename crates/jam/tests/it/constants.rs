//! Stated errors hold what the rounding of constants does to a run.

use jam::errors::stated;
use jam::laws::{Algebraic, Model};
use jam::ring::{Ring, Start};
use jam::run::{Outcome, Run, run};
use ode::{Control, Method};

/// The unstable run of figure 4 by this method, with this strength of the force and this length of the ring.
fn unstable(method: Method, mu: f64, length: f64) -> Run {
    let law = Algebraic { mu, delta: 0.0, q: 2.0, a_v: 0.0, v0: 3.0, epsilon: 0.1 };
    let ring = Ring { pedestrians: 67, length };
    let run = Run::new(Model::Algebraic(law), ring, Start { shift: 1e-4 }, 2000.0).expect("a run");
    Run { method, control: Control::Adaptive { tolerance: 1e-14 }, keeps_trajectories: false, ..run }
}

/// The largest change of the standard deviation, and those of the times of events.
fn changes(one: &Outcome, other: &Outcome) -> (f64, Vec<f64>) {
    let std = one.samples.std.iter().zip(&other.samples.std).map(|(one, other)| (one - other).abs());
    assert_eq!(one.samples.len(), other.samples.len());
    assert!(one.events.iter().map(|event| event.kind).eq(other.events.iter().map(|event| event.kind)));
    let times = one.events.iter().zip(&other.events).map(|(one, other)| (one.time - other.time).abs());
    (std.fold(0.0, jam::math::larger), times.collect())
}

#[test]
fn a_constant_off_by_a_rounding_changes_numbers_by_less_than_their_stated_errors() {
    let (mu, length) = (0.55_f64, 200.0_f64);
    for method in [Method::Taylor, Method::Dop853] {
        let (outcome, errors) = stated(&unstable(method, mu, length)).expect("a run");
        assert!(!outcome.events.is_empty(), "{method:?}");
        for (mu, length) in [(mu.next_up(), length), (mu, length.next_up())] {
            let (std, times) = changes(&outcome, &run(&unstable(method, mu, length)).expect("a run"));
            let error = errors.std.expect("an estimate");
            // roundings alone make this change: it is far above that of a number
            assert!(std > 1e-12 && std < error && error < 100.0 * std, "{method:?} std {std:e} of {error:e}");
            for (time, error) in times.iter().zip(&errors.events) {
                let error = error.expect("an estimate");
                assert!(*time < error && error < 100.0 * time, "{method:?} event {time:e} of {error:e}");
            }
        }
    }
}
