//! Samples that a second run does not confirm, and unknown errors.

use jam::errors::stated;
use jam::laws::{Algebraic, Logarithmic, Model};
use jam::ring::{Ring, Start};
use jam::run::{Run, run};
use jam::states::StateVariables;
use ode::{Control, Failure, Method};

/// A dense ring whose uniform flow walks backwards and blows up at t = 0.156, from a shift that spacings lose.
fn lost() -> Run {
    let law = Algebraic { mu: 0.0884, delta: 0.0, q: 3.0, a_v: 0.0, v0: 0.702, epsilon: 0.1 };
    let ring = Ring { pedestrians: 15, length: 30.19042 };
    let run = Run::new(Model::Algebraic(law), ring, Start { shift: -1.49e-33 }, 0.526).expect("a run");
    Run { sample: 0.02, form: StateVariables::Spacings, ..run }
}

#[test]
fn a_shift_that_spacings_lose_is_not_taken_for_a_uniform_flow() {
    let adaptive = Control::Adaptive { tolerance: 1e-9 };
    let ways = [
        (Method::Heun, Control::Fixed { step: 1.77e-5 }),
        (Method::Dop853, adaptive),
        (Method::Taylor, adaptive),
        (Method::Dop853, Control::Adaptive { tolerance: 1e-6 }),
    ];
    for (method, control) in ways {
        let scene = Run { method, control, ..lost() };
        let alone = run(&scene).expect("without a check it sees nothing");
        let broken = stated(&scene).expect_err("the check sees it");
        let outcome = &broken.outcome;
        let Failure::NotConfirmed { time } = broken.failure else { panic!("{method:?}: {broken}") };
        // up to where the perturbation is a small part of the room
        assert!((0.08..0.156).contains(&time), "{method:?} {time}");
        let count = outcome.samples.len();
        assert_eq!(outcome.samples.times.last(), Some(&time), "{method:?}");
        assert_eq!(outcome.samples.times[..], alone.samples.times[..count], "{method:?}");
        // in the last step they are those of a run that ends there, which the errors are of
        let speeds = &outcome.samples.speeds;
        let same = speeds.iter().zip(&alone.samples.speeds).all(|(own, other)| (own - other).abs() <= 1e-4 * own.abs());
        assert!(same && speeds.len() == count * 15 && speeds[(count - 1) * 15..] == outcome.speeds, "{method:?}");
        assert!((outcome.statistics.time - time).abs() < 1e-9, "{method:?} {}", outcome.statistics.time);
        assert!(broken.to_string().contains("deviations"), "{broken}");
    }
    // that form keeps the shift, and the blow-up is an event
    let deviations = Run { form: StateVariables::Deviations, ..lost() };
    let (outcome, errors) = stated(&deviations).expect("it ends well");
    let stop = outcome.stop().expect("an event");
    assert!((stop.time - 0.1564).abs() < 1e-3 && errors.confirmed_until.is_none(), "{stop:?}");
}

/// Waves grow from a small shift until two pedestrians overlap at t = 57.9.
fn growing(method: Method, step: f64) -> Run {
    let law = Logarithmic { v0: 6.04, a_v: 0.00114, epsilon: 0.0314 };
    let ring = Ring { pedestrians: 18, length: 12.34295 };
    let run = Run::new(Model::Logarithmic(law), ring, Start { shift: 8.42e-8 }, 103.0).expect("a run");
    Run { sample: 2.78, method, control: Control::Fixed { step }, ..run }
}

#[test]
fn rows_that_are_off_by_as_much_as_they_are_large_are_left_out() {
    let right =
        Run { method: Method::Dop853, control: Control::Adaptive { tolerance: 1e-10 }, ..growing(Method::Heun, 1.0) };
    let right = run(&right).expect("it ends well");
    for step in [0.0349, 0.05] {
        let scene = growing(Method::Ballistic, step);
        let broken = stated(&scene).expect_err("its waves are early");
        let Failure::NotConfirmed { time } = broken.failure else { panic!("{step}: {broken}") };
        assert!((35.0..57.0).contains(&time) && broken.outcome.events.is_empty(), "{step}: {time}");
        // the rows that are left are not all error, or a flow all but uniform
        for (std, right) in broken.outcome.samples.std.iter().zip(&right.samples.std) {
            assert!((std - right).abs() <= 0.7 * right + 5e-3, "{step}: {std} for {right}");
        }
        assert!(broken.to_string().contains("smaller step"), "{broken}");
    }
    // by steps that do, nothing is left out
    let (outcome, errors) = stated(&growing(Method::Heun, 0.002)).expect("it ends well");
    assert_eq!(outcome.stop().map(|stop| stop.kind.name()), Some("overlap"));
    assert!(errors.std.is_some_and(|error| error < 1e-2), "{errors:?}");
}

#[test]
fn steps_over_a_wall_say_nothing_of_the_time() {
    let start = Start { shift: 1e-5 };
    for method in [Method::Heun, Method::Rk4, Method::Dopri54, Method::Taylor] {
        let scene = Run { start, method, control: Control::Fixed { step: 1e-4 }, sample: 0.01, ..lost() };
        // the blow-up is at 0.01930
        let (outcome, errors) = stated(&scene).expect("an overlap ends it");
        assert!(outcome.stop().is_some_and(|stop| stop.time > 0.0185 && stop.time < 0.0193), "{:?}", outcome.events);
        let at_wall = outcome.events.iter().zip(&errors.events).filter(|(event, _)| event.time > 0.0);
        assert!(at_wall.into_iter().all(|(_, error)| error.is_none()), "{method:?}: {errors:?}");
        assert!(errors.positions.is_none() && errors.speeds.is_none(), "{method:?}: {errors:?}");
    }
}
