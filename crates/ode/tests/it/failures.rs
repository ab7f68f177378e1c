//! Integrations that cannot continue.

use crate::problems::{Equations, general_methods, oscillator, solve, watched};
use ode::{Control, Failure, Method};
use std::cell::Cell;

#[test]
fn methods_without_an_estimate_ask_for_a_step() {
    for method in Method::ALL.into_iter().filter(|method| !method.is_adaptive()) {
        let control = Control::Adaptive { tolerance: 1e-6 };
        let failure = watched(&oscillator(), &[1.0, 0.0], 1.0, method, control, &mut |_| {}).expect_err("no estimate");
        assert_eq!(failure, Failure::NoErrorEstimate(method));
        let words = "has no error estimate: give it a step, or choose one of";
        let names = "bs32, dopri54, tsit54, verner65, verner76, verner87, verner98, dop853, extrapolation, taylor";
        assert_eq!(failure.to_string(), format!("{} {words} {names}", method.name()));
    }
}

#[test]
fn a_blow_up_ends_at_its_time() {
    // y' = y^2 from 1: y = 1 / (1 - t)
    let square = Equations::scalar(|state, rates| rates[0] = state[0] * state[0]);
    for method in [Method::Dop853, Method::Extrapolation] {
        let control = Control::Adaptive { tolerance: 1e-12 };
        let failure = watched(&square, &[1.0], 2.0, method, control, &mut |_| {}).expect_err("no solution at t = 2");
        let Failure::StepTooSmall { time, step } = failure else { panic!("{failure:?}") };
        println!("{}: blow-up off by {:e}", method.name(), time - 1.0);
        // a relative error of the state is one of the time that is left
        assert!((time - 1.0).abs() < 1e-11 && step < 1e-60, "{failure:?}");
        let text = failure.to_string();
        let start = format!("at t = {time:?} the tolerance asks for a step of {step:e}, too small to continue");
        assert_eq!(text, start, "raising the tolerance would not help");
    }
}

#[test]
fn fixed_steps_end_with_the_last_finite_state() {
    let square = Equations::scalar(|state, rates| rates[0] = state[0] * state[0]);
    let mut last = (0.0, 0.0);
    let control = Control::Fixed { step: 0.125 };
    let failure = watched(&square, &[1.0], 9.0, Method::Euler, control, &mut |step| {
        last = (step.end, step.after()[0]);
    })
    .expect_err("the state overflows");
    assert_eq!(failure, Failure::NotFinite { time: last.0, step: 0.125 });
    assert!(last.1.is_finite() && last.1 > 1e100, "{}", last.1);
    let words = "the state is no longer finite";
    assert_eq!(failure.to_string(), format!("in the step of 1.25e-1 from t = {:?} {words}", last.0));
}

thread_local! {
    /// How many states were refused.
    static REFUSED: Cell<u32> = const { Cell::new(0) };
}

#[test]
fn steps_outside_the_domain_are_made_again_shorter() {
    // y = 1 + t, where no error limits the steps, but there is nothing from y = 5 on
    let bounded = Equations {
        domain: |state| {
            REFUSED.set(REFUSED.get() + u32::from(state[0] >= 5.0));
            state[0] < 5.0
        },
        ..Equations::scalar(|state, rates| rates[0] = if state[0] < 5.0 { 1.0 } else { f64::NAN })
    };
    for method in general_methods().filter(|method| method.is_adaptive()) {
        REFUSED.set(0);
        let control = Control::Adaptive { tolerance: 1e-2 };
        let inside = solve(&bounded, &[1.0], 3.75, method, control);
        // the weights of the extrapolation multiply the rounding of its rows by some hundred
        assert!((inside.state[0] - 4.75).abs() < 1000.0 * f64::EPSILON, "{inside:?}");
        let failure = watched(&bounded, &[1.0], 10.0, method, control, &mut |step| {
            // the state that is checked lacks the carry of its sum, half a unit at most
            assert!(step.after()[0] <= 5.0);
        });
        let Err(Failure::StepTooSmall { time, .. }) = failure else { panic!("{failure:?}") };
        assert!((time - 4.0).abs() < 1000.0 * f64::EPSILON, "{time:?}");
        assert!(REFUSED.get() > 10, "{} refused", REFUSED.get());
    }
}

/// `y' = -1 / y` from 1, `y = sqrt(1 - 2 t)`: defined for `y > 0` only.
fn falling() -> Equations {
    Equations { domain: |state| state[0] > 0.0, ..Equations::scalar(|state, rates| rates[0] = -1.0 / state[0]) }
}

#[test]
fn the_end_of_the_domain_is_a_failure_at_its_time() {
    let control = Control::Adaptive { tolerance: 1e-12 };
    let failure = watched(&falling(), &[1.0], 1.0, Method::Dop853, control, &mut |_| {}).expect_err("y = 0 at t = 0.5");
    let Failure::StepTooSmall { time, .. } = failure else { panic!("{failure:?}") };
    println!("end of the domain off by {:e}", time - 0.5);
    assert!((time - 0.5).abs() < 1e-11, "{failure:?}");
}

#[test]
fn a_start_at_the_end_is_no_failure() {
    use ode::{Problem, Step, integrate};
    let system = oscillator();
    for control in [Control::Fixed { step: 0.1 }, Control::Adaptive { tolerance: 1e-9 }] {
        let problem =
            Problem { system: &system, start: &[1.0, 0.0], begin: 3.0, end: 3.0, method: Method::Dop853, control };
        let mut observer = |_: &mut Step<'_>| -> std::ops::ControlFlow<()> { panic!("there is no step") };
        let statistics = integrate(&problem, &mut observer).expect("nothing to do");
        assert_eq!((statistics.steps, statistics.time, statistics.state), (0, 3.0, vec![1.0, 0.0]));
    }
}

#[test]
fn more_steps_than_are_allowed_are_a_failure() {
    use ode::{MOST_STEPS, Observer, Problem, Step, integrate};
    struct Patience(u64, u64);
    impl Observer for Patience {
        fn after(&mut self, _: &mut Step<'_>) -> std::ops::ControlFlow<()> {
            self.1 += 1;
            std::ops::ControlFlow::Continue(())
        }

        fn most_steps(&self) -> u64 {
            self.0
        }
    }
    let (system, control) = (oscillator(), Control::Adaptive { tolerance: 1e-10 });
    let problem =
        Problem { system: &system, start: &[1.0, 0.0], begin: 0.0, end: 20.0, method: Method::Dopri54, control };
    let mut observer = Patience(MOST_STEPS, 0);
    let whole = integrate(&problem, &mut observer).expect("nothing stands in the way");
    let tried = whole.steps + whole.rejected;
    assert_eq!(integrate(&problem, &mut Patience(tried, 0)), Ok(whole), "just enough");
    let mut observer = Patience(tried - 1, 0);
    let failure = integrate(&problem, &mut observer);
    let Err(Failure::TooManySteps { time, steps }) = failure else { panic!("{failure:?}") };
    assert!(steps == tried - 1 && time > 0.0 && time < 20.0 && observer.1 > 0, "{time} {steps}");
}

#[test]
fn a_time_before_zero_is_a_time_like_others() {
    use ode::{Problem, Step, integrate};
    let system = oscillator();
    for control in [Control::Fixed { step: 0.125 }, Control::Adaptive { tolerance: 1e-9 }] {
        let run = |begin: f64, end: f64| {
            let problem = Problem { system: &system, start: &[1.0, 0.0], begin, end, method: Method::Dop853, control };
            let mut observer = |_: &mut Step<'_>| std::ops::ControlFlow::Continue(());
            integrate(&problem, &mut observer).expect("nothing stands in the way")
        };
        let (shifted, plain) = (run(-5.0, 5.0), run(0.0, 10.0));
        // the last step differs by the rounding of the time
        assert!((shifted.state[0] - plain.state[0]).abs() < 1e-13, "{shifted:?} {plain:?}");
        assert_eq!((shifted.steps, shifted.time), (plain.steps, 5.0));
    }
}

#[test]
fn a_state_at_rest_stays() {
    // no size and no rate to choose the first step from
    for method in general_methods().filter(|method| method.is_adaptive()) {
        let statistics = solve(&oscillator(), &[0.0, 0.0], 100.0, method, Control::Adaptive { tolerance: 1e-12 });
        assert_eq!(statistics.state, [0.0, 0.0]);
        assert_eq!(statistics.time, 100.0);
    }
}

#[test]
fn without_a_size_or_a_rate_the_first_step_is_a_thousandth() {
    let growing = Equations::scalar(|_, rates| rates[0] = 1.0);
    let resting = Equations::scalar(|_, rates| rates[0] = 0.0);
    for (system, start) in [(&growing, 0.0), (&resting, 1.0), (&resting, 0.0)] {
        let mut lengths = Vec::new();
        let control = Control::Adaptive { tolerance: 1e-6 };
        watched(system, &[start], 2.0, Method::Dop853, control, &mut |step| lengths.push(step.length()))
            .expect("nothing stands in the way");
        assert_eq!(lengths[0], 1e-3, "from {start}");
    }
    // with both it is the time to change by a hundredth
    let mut lengths = Vec::new();
    let control = Control::Adaptive { tolerance: 1e-2 };
    watched(&growing, &[3.0], 2.0, Method::Dop853, control, &mut |step| lengths.push(step.length()))
        .expect("nothing stands in the way");
    assert!((lengths[0] - 0.03).abs() < 1e-16, "{}", lengths[0]);
}

#[test]
fn steps_and_tolerances_that_are_not_above_0_are_refused() {
    let fixed = [0.0, -0.1, f64::NAN, f64::INFINITY].map(|step| (Method::Rk4, Control::Fixed { step }, "the step is"));
    let adaptive = [0.0, -1.0, f64::NAN, f64::INFINITY]
        .map(|tolerance| (Method::Dop853, Control::Adaptive { tolerance }, "the tolerance is"));
    for (method, control, said) in fixed.into_iter().chain(adaptive) {
        let solve = || solve(&oscillator(), &[1.0, 0.0], 1.0, method, control);
        let panic = std::panic::catch_unwind(solve).expect_err("refused");
        let message = panic.downcast_ref::<String>().expect("a message");
        assert!(message.contains(said) && message.contains("above 0"), "{message}");
    }
}
