//! The solution inside the steps.

use crate::problems::{Equations, distance, general_methods, oscillation, oscillator, power, watched};
use ode::tableau::{Interpolant, Tableau};
use ode::{Control, Method, Step};

/// The largest error at the ends of the steps and inside them.
fn errors(method: Method, steps: u32) -> (f64, f64) {
    let control = Control::Fixed { step: 10.0 / f64::from(steps) };
    let (mut ends, mut inside): (f64, f64) = (0.0, 0.0);
    let mut state = [0.0; 2];
    watched(&oscillator(), &[1.0, 0.0], 10.0, method, control, &mut |step| {
        ends = math::larger(ends, distance(step.after(), &oscillation(step.end)));
        for theta in [0.1, 0.3, 0.5, 0.7, 0.9] {
            step.at_fraction(theta, &mut state);
            inside = math::larger(inside, distance(&state, &oscillation(step.start + theta * step.length())));
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
                ends = math::larger(ends, distance(step.after(), &oscillation(step.end)));
                for part in 1..8 {
                    let t = step.start + step.length() * f64::from(part) / 8.0;
                    step.at(t, &mut state);
                    inside = math::larger(inside, distance(&state, &oscillation(t)));
                }
            })
            .expect("nothing stands in the way");
            println!("{} at {tolerance:e}: ends {ends:e}, inside {inside:e}", method.name());
            // what the tolerance allows in a step, or what was gathered until its end
            assert!(
                inside < 3.0 * math::larger(ends, tolerance) + 4.0 * f64::EPSILON,
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
fn next_to_an_end_the_state_is_that_of_the_end() {
    let mut state = [0.0; 2];
    watched(&oscillator(), &[1.0, 0.5], 1.0, Method::Dop853, Control::Fixed { step: 0.5 }, &mut |step| {
        let ends = [step.before().to_vec(), step.after().to_vec()];
        for (theta, end) in [(-5e-14, 0), (5e-14, 0), (1.0 - 5e-14, 1), (1.0 + 5e-14, 1)] {
            step.at_fraction(theta, &mut state);
            assert_eq!(state, *ends[end], "{theta}");
        }
        // a change of 1e-12 of such a step shows in either component
        for (theta, end) in [(2e-12, 0), (1e-9, 0), (1.0 - 2e-12, 1)] {
            step.at_fraction(theta, &mut state);
            assert!(distance(&state, &ends[end]) > 1e-13, "{theta}");
        }
    })
    .expect("nothing stands in the way");
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

/// Whether a method's interpolant is the cubic through both ends.
fn has_cubic(method: Method) -> bool {
    let of_tableau = |tableau: &Tableau| matches!(tableau.interpolant, Interpolant::Cubic);
    method.tableau().map_or(method == Method::Ballistic, of_tableau)
}

/// Thrown straight up with speed 3, a unit of acceleration downwards: methods of order 2, and the ballistic scheme,
/// have no error, and neither has a cubic through both ends, which costs no evaluation.
#[test]
fn inside_a_step_a_throw_is_a_parabola() {
    let throw = Equations { dynamics: |_, rates| rates[1] = -1.0, ..oscillator() };
    for method in general_methods().filter(|&method| method != Method::Euler && has_cubic(method)) {
        let mut state = [0.0; 2];
        let run = |look: &mut dyn FnMut(&mut Step<'_>)| {
            watched(&throw, &[0.5, 3.0], 3.0, method, Control::Fixed { step: 0.5 }, look).expect("it runs")
        };
        let plain = run(&mut |_| {});
        let looked = run(&mut |step| {
            for theta in [0.125, 0.5, 0.75] {
                step.at_fraction(theta, &mut state);
                let t = step.start + theta * step.length();
                let expected = [0.5 + 3.0 * t - 0.5 * t * t, 3.0 - t];
                assert!(distance(&state, &expected) < 8.0 * f64::EPSILON, "{}: {state:?}", method.name());
            }
        });
        assert_eq!(looked.evaluations, plain.evaluations, "{}", method.name());
    }
}

#[test]
fn where_a_step_ends_with_rates_that_are_no_numbers_the_chord_is_taken() {
    // the rate of the first is infinite from 1 on, which it reaches with the first step; the second bends
    let system = Equations {
        dimension: 2,
        positions: 0,
        dynamics: |state, rates| {
            rates[0] = if state[0] < 1.0 { 1.0 } else { f64::INFINITY };
            rates[1] = state[1];
        },
        kinematics: |_, _| {},
        ..oscillator()
    };
    let mut inside = Vec::new();
    let result = watched(&system, &[0.5, 1.0], 1.0, Method::Euler, Control::Fixed { step: 0.5 }, &mut |step| {
        for theta in [0.25, 0.5] {
            let mut state = [0.0; 2];
            step.at_fraction(theta, &mut state);
            inside.push(state);
        }
    });
    assert!(result.is_err(), "the next step ends nowhere");
    // the second from 1 to 3/2 with rates 1 and 3/2: 1 + theta / 2 + theta (1 - theta) (0 (1 - theta) - theta / 4)
    let second = |theta: f64| 1.0 + 0.5 * theta - 0.25 * theta * theta * (1.0 - theta);
    assert_eq!(inside, [[0.625, second(0.25)], [0.75, second(0.5)]]);
}

#[test]
fn a_time_near_an_end_of_a_step_is_not_taken_for_the_end() {
    let control = Control::Fixed { step: 0.5 };
    let (mut near, mut seen) = ([0.0; 2], 0);
    watched(&oscillator(), &[1.0, 0.0], 4.0, Method::Extrapolation, control, &mut |step| {
        for t in [step.start + 2e-10, step.end - 2e-10] {
            step.at(t, &mut near);
            // 2e-10 times a speed of up to 1 would be missing
            assert!(distance(&near, &oscillation(t)) < 1e-13, "{t}: {near:?}");
            seen += 1;
        }
    })
    .expect("nothing stands in the way");
    assert_eq!(seen, 16);
}
