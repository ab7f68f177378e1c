//! The solution inside the steps.

use crate::problems::{distance, general_methods, oscillation, oscillator, power, watched};
use ode::tableau::Interpolant;
use ode::{Control, Method};

/// The largest error at the ends of the steps and inside them.
fn errors(method: Method, steps: u32) -> (f64, f64) {
    let control = Control::Fixed { step: 10.0 / f64::from(steps) };
    let (mut ends, mut inside): (f64, f64) = (0.0, 0.0);
    let mut state = [0.0; 2];
    watched(&oscillator(), &[1.0, 0.0], 10.0, method, control, &mut |step| {
        ends = ends.max(distance(step.after(), &oscillation(step.end)));
        for theta in [0.1, 0.3, 0.5, 0.7, 0.9] {
            step.at_fraction(theta, &mut state);
            inside = inside.max(distance(&state, &oscillation(step.start + theta * step.length())));
        }
    })
    .expect("nothing stands in the way");
    (ends, inside)
}

#[test]
fn inside_a_step_the_order_is_that_of_the_method() {
    // an interpolant of order p - 1 errs by step^p within one step, as the solution does over all of them
    let cases = [
        (Method::Euler, 4000),
        (Method::Heun, 1000),
        (Method::Rk4, 200),
        (Method::Bs32, 400),
        (Method::Dopri54, 100),
        (Method::Tsit54, 100),
        (Method::Verner65, 40),
        (Method::Verner76, 24),
        (Method::Verner87, 16),
        (Method::Verner98, 12),
        (Method::Dop853, 16),
        (Method::Extrapolation, 4),
    ];
    for (method, steps) in cases {
        let more = steps + steps / 2;
        let (coarse, fine) = (errors(method, steps).1, errors(method, more).1);
        let order = power(coarse, fine, f64::from(more) / f64::from(steps));
        println!("{}: inside {coarse:e}, {fine:e}: order {order:.3}", method.name());
        let lowest = method.order() as f64 - if method == Method::Extrapolation { 2.0 } else { 0.3 };
        assert!(order > lowest, "{}: {coarse:e}, {fine:e}: order {order}", method.name());
    }
}

#[test]
fn inside_a_step_the_error_is_of_the_size_at_its_ends() {
    for tolerance in [1e-6, 1e-9, 1e-12] {
        for method in general_methods().filter(|method| method.is_adaptive()) {
            let (mut ends, mut inside): (f64, f64) = (0.0, 0.0);
            let mut state = [0.0; 2];
            let control = Control::Adaptive { tolerance };
            watched(&oscillator(), &[1.0, 0.0], 10.0, method, control, &mut |step| {
                ends = ends.max(distance(step.after(), &oscillation(step.end)));
                for part in 1..8 {
                    let t = step.start + step.length() * f64::from(part) / 8.0;
                    step.at(t, &mut state);
                    inside = inside.max(distance(&state, &oscillation(t)));
                }
            })
            .expect("nothing stands in the way");
            println!("{} at {tolerance:e}: ends {ends:e}, inside {inside:e}", method.name());
            // what the tolerance allows in a step, or what was gathered until its end
            assert!(
                inside < 3.0 * ends.max(tolerance) + 4.0 * f64::EPSILON,
                "{}: {ends:e}, inside {inside:e}",
                method.name()
            );
        }
    }
}

#[test]
fn at_the_ends_the_states_are_those_of_the_step() {
    for method in general_methods() {
        let mut state = [0.0; 2];
        watched(&oscillator(), &[1.0, 0.0], 1.0, method, Control::Fixed { step: 0.25 }, &mut |step| {
            step.at(step.start, &mut state);
            assert_eq!(state, step.before());
            step.at(step.end, &mut state);
            assert_eq!(state, step.after());
        })
        .expect("nothing stands in the way");
    }
}

#[test]
fn looking_inside_changes_nothing() {
    // the extrapolation uses its own working space to look inside: the next step must not notice
    for method in general_methods().filter(|method| method.is_adaptive()) {
        let control = Control::Adaptive { tolerance: 1e-8 };
        let mut state = [0.0; 2];
        let plain = watched(&oscillator(), &[1.0, 0.0], 30.0, method, control, &mut |_| {}).expect("it runs");
        let looked = watched(&oscillator(), &[1.0, 0.0], 30.0, method, control, &mut |step| {
            step.at_fraction(0.7, &mut state);
            step.at_fraction(0.2, &mut state);
        })
        .expect("it runs");
        assert_eq!((plain.steps, plain.rejected, &plain.state), (looked.steps, looked.rejected, &looked.state));
        let has_further_stages = method.tableau().is_none_or(|tableau| match tableau.interpolant {
            Interpolant::Cubic => false,
            Interpolant::Nested { stages, .. } => !stages.is_empty(),
        });
        assert_eq!(looked.evaluations > plain.evaluations, has_further_stages, "{}", method.name());
    }
}
