//! Edges of the domain of a formula: every method ends there, by name and in time.

use jam::events::EventKind;
use jam::laws::{Formula, Model};
use jam::ring::{Ring, Start};
use jam::run::{Outcome, Run, run};
use ode::{Control, Method};

fn made(law: &str, ring: Ring, method: Method, control: Control) -> Outcome {
    let model = Model::Formula(Formula::written(&[("acceleration", law.into()), ("body", 0.4.into())]).expect("a law"));
    let set = Run::new(model, ring, Start { shift: 0.1 }, 40.0).expect("a run");
    // enough for every one of them, and the end of one that creeps
    let most_steps = 20_000;
    run(&Run { method, control, most_steps, keeps_trajectories: false, ..set }).expect("it ends by an event")
}

/// Speeds grow evenly to 3: the integral of `1/(1 + 0.001 ln u)` over `u` from 0 to 3, by its series.
#[test]
fn taylor_does_not_creep_along_an_edge() {
    let right = 2.999_707_197_441_688;
    let (law, ring) = ("1 + 0.001*ln(3 - v)", Ring { pedestrians: 8, length: 8.0 });
    for tolerance in [1e-3, 1e-6, 1e-8, 1e-10, 1e-13] {
        let outcome = made(law, ring, Method::Taylor, Control::Adaptive { tolerance });
        let [event] = outcome.events[..] else { panic!("{tolerance:e}: {:?}", outcome.events) };
        assert_eq!(event.kind, EventKind::Undefined, "{tolerance:e}");
        let steps = outcome.statistics.steps as f64;
        assert!(steps < 1000.0, "{tolerance:e}: {steps}");
        // each step may be wrong by the tolerance, of speeds up to 3
        assert!((event.time - right).abs() < 3.0 * tolerance * steps, "{tolerance:e}: {:?}", event.time);
    }
}

/// A root without a value below a spacing of 0.42, before the overlap at 0.4. The time is that of verner98 and dop853
/// at 1e-13, which agree to 1e-11.
#[test]
fn a_step_of_fixed_length_over_an_edge_ends_on_it() {
    let (law, ring) = ("2*(2*s - v) + 0.1*sqrt(s - 0.42)", Ring { pedestrians: 20, length: 14.0 });
    let right = 19.900_670_786;
    for (method, step) in [(Method::Taylor, 0.1), (Method::Taylor, 0.01), (Method::Rk4, 0.01), (Method::Heun, 0.001)] {
        let outcome = made(law, ring, method, Control::Fixed { step });
        let last = outcome.events.last().expect("an event");
        assert_eq!(last.kind, EventKind::Undefined, "{method:?} {step}: {:?}", outcome.events);
        assert_eq!(outcome.events.len(), 1, "{method:?} {step}: {:?}", outcome.events);
        assert!((last.time - right).abs() < 1.1 * step && last.step == step, "{method:?} {step}: {last:?}");
        let found = outcome.samples.times.last().expect("samples");
        assert!(*found <= last.time, "{method:?} {step}: a sample at {found}");
    }
}

/// Where the gap itself has no logarithm, the event is the overlap, as before.
#[test]
fn an_edge_that_is_the_overlap_is_named_overlap() {
    let (law, ring) = ("2*(2*s - v) + 0.01*ln(s - 0.4)", Ring { pedestrians: 20, length: 14.0 });
    let outcome = made(law, ring, Method::Taylor, Control::Fixed { step: 0.01 });
    let kinds: Vec<EventKind> = outcome.events.iter().map(|event| event.kind).collect();
    assert_eq!(kinds, [EventKind::Overlap]);
}
