//! Errors decrease with the step or follow the tolerance, as each method's order requires.

use crate::problems::{
    Equations, distance, driven, driven_solution, general_methods, kepler, oscillation, oscillator, planet, power,
    solve,
};
use ode::tableau::{Row, Tableau};
use ode::{Control, Method};
use std::ops::Range;

/// Error at the end with `steps` steps.
fn error(system: &Equations, start: &[f64], end: f64, truth: &[f64], method: Method, steps: u32) -> f64 {
    let control = Control::Fixed { step: end / f64::from(steps) };
    distance(&solve(system, start, end, method, control).state, truth)
}

/// By how much an observed order may differ from the method's.
const CLOSE: Range<f64> = -0.2..0.2;

/// The same for Verner's pairs with so small a leading term of the error that the next ones exceed it down to where
/// rounding does: on smooth problems they look like methods one order higher.
const OR_ONE_HIGHER: Range<f64> = -0.2..1.2;

/// The order between two numbers of steps, of which the second is larger by half.
fn assert_order(case: (&Equations, &[f64], f64, &[f64]), method: Method, steps: u32, allowed: Range<f64>) {
    let (system, start, end, truth) = case;
    let more = steps + steps / 2;
    let coarse = error(system, start, end, truth, method, steps);
    let fine = error(system, start, end, truth, method, more);
    let order = power(coarse, fine, f64::from(more) / f64::from(steps));
    println!("{}: errors {coarse:e}, {fine:e}: order {order:.3}", method.name());
    assert!(
        allowed.contains(&(order - method.order() as f64)),
        "{}: {coarse:e}, {fine:e}: order {order}",
        method.name()
    );
}

#[test]
fn orders_on_the_oscillator() {
    // numbers of steps for which the leading term of the error dominates and rounding lies far below it; the ballistic
    // scheme has Euler's speeds, and so its order
    let truth = oscillation(10.0);
    let case = (&oscillator(), &[1.0, 0.0][..], 10.0, &truth[..]);
    for (method, steps) in [(Method::Euler, 4000), (Method::Ballistic, 4000), (Method::Heun, 1000), (Method::Rk4, 200)]
    {
        assert_order(case, method, steps, CLOSE);
    }
    for (method, steps, allowed) in [
        (Method::Bs32, 400, CLOSE),
        (Method::Dopri54, 120, CLOSE),
        (Method::Tsit54, 200, CLOSE),
        (Method::Verner65, 30, OR_ONE_HIGHER),
        (Method::Verner76, 24, CLOSE),
        (Method::Verner87, 20, CLOSE),
        (Method::Verner98, 30, CLOSE),
        (Method::Dop853, 16, CLOSE),
    ] {
        assert_order(case, method, steps, allowed);
    }
    // order 16 shows only in steps so long (2.5, 1.7) that the next term of the error counts as well
    assert_order(case, Method::Extrapolation, 4, -0.5..0.5);
}

#[test]
fn orders_on_a_nonlinear_problem() {
    let truth = driven_solution(3.0);
    let case = (&driven(), &[1.0, 0.0, 1.0][..], 3.0, &truth[..]);
    for (method, steps) in [(Method::Euler, 4000), (Method::Ballistic, 4000), (Method::Heun, 1000), (Method::Rk4, 100)]
    {
        assert_order(case, method, steps, CLOSE);
    }
    for (method, steps, allowed) in [
        (Method::Bs32, 200, CLOSE),
        (Method::Dopri54, 60, CLOSE),
        (Method::Tsit54, 60, CLOSE),
        (Method::Verner65, 16, OR_ONE_HIGHER),
        (Method::Verner76, 16, CLOSE),
        (Method::Verner87, 8, OR_ONE_HIGHER),
        (Method::Verner98, 12, CLOSE),
        (Method::Dop853, 8, CLOSE),
    ] {
        assert_order(case, method, steps, allowed);
    }
}

#[test]
fn orders_on_a_planet() {
    let (start, truth) = (planet(0.0), planet(3.0));
    let case = (&kepler(), &start[..], 3.0, &truth[..]);
    for (method, steps) in
        [(Method::Euler, 40_000), (Method::Ballistic, 40_000), (Method::Heun, 1000), (Method::Rk4, 200)]
    {
        assert_order(case, method, steps, CLOSE);
    }
}

/// `y_k' = y_{k + 1}`, the last constant: one step of length 1 from `y_k = 1` leaves in `y_0` the coefficient of `z^k`
/// in the stability polynomial, which is `1 / k!` up to the order.
fn chain() -> Equations {
    Equations {
        dimension: 18,
        positions: 0,
        dynamics: |state, rates| {
            rates[..17].copy_from_slice(&state[1..]);
            rates[17] = 0.0;
        },
        ..oscillator()
    }
}

/// `|w| |A|^(k - 1) (1, 1, ...)`, which bounds the terms of the coefficient of `z^k`, times the roundings in each:
/// those of `k` coefficients, products and sums of a term a stage.
fn tall_tree_size(tableau: &Tableau, k: usize) -> f64 {
    let stages = tableau.stages();
    let size = |row: Row, of: &[f64]| row.iter().map(|&(stage, weight)| weight.abs() * of[stage]).sum::<f64>();
    let mut sizes = vec![1.0; stages];
    for _ in 1..k {
        sizes = (0..stages).map(|i| if i == 0 { 0.0 } else { size(tableau.rows[i - 1], &sizes) }).collect();
    }
    ((stages + 2) * k) as f64 * size(tableau.weights, &sizes)
}

#[test]
fn stability_polynomials_are_exponentials_up_to_the_order() {
    for method in general_methods().filter(|&method| method != Method::Ballistic) {
        let mut factorial = 1.0;
        for k in 1..=method.order() + 1 {
            factorial *= k as f64;
            let mut start = [0.0; 18];
            start[k] = 1.0;
            let coefficient = solve(&chain(), &start, 1.0, method, Control::Fixed { step: 1.0 }).state[0];
            let error = (coefficient * factorial - 1.0).abs();
            // for the extrapolation, a sum of rows whose weights reach some hundreds, each to a few units
            let size = method.tableau().map_or(1000.0, |tableau| tall_tree_size(tableau, k) * factorial);
            if k <= method.order() {
                assert!(error < size * f64::EPSILON, "{}: z^{k}: {error:e}", method.name());
            } else {
                assert!(error > 1e3 * size * f64::EPSILON, "{}: z^{k} is right as well", method.name());
            }
        }
    }
}

#[test]
fn extrapolation_integrates_powers_up_to_its_order() {
    type Rates = fn(&[f64], &mut [f64]);
    // y' = k t^(k - 1) from 0: y(1) = 1; t is the first component
    let rates: [Rates; 3] = [
        |state, rates| (rates[0], rates[1]) = (1.0, 15.0 * power_of(state[0], 14)),
        |state, rates| (rates[0], rates[1]) = (1.0, 16.0 * power_of(state[0], 15)),
        |state, rates| (rates[0], rates[1]) = (1.0, 17.0 * power_of(state[0], 16)),
    ];
    for (k, dynamics) in (15..).zip(rates) {
        let system = Equations { dimension: 2, positions: 0, dynamics, kinematics: |_, _| {}, ..oscillator() };
        let method = Method::Extrapolation;
        let end = solve(&system, &[0.0, 0.0], 1.0, method, Control::Fixed { step: 1.0 }).state[1];
        let error = (end - 1.0).abs();
        println!("y' = {k} t^{}: error {error:e}", k - 1);
        assert_eq!(error < 1000.0 * f64::EPSILON, k <= method.order(), "y' = {k} t^{}: {error:e}", k - 1);
    }
}

fn power_of(base: f64, exponent: u32) -> f64 {
    (0..exponent).fold(1.0, |power, _| power * base)
}

#[test]
fn adaptive_errors_follow_the_tolerance() {
    // DOP853 controls an estimate that falls as step^8, as the global error does; the estimate of the extrapolation
    // falls as step^15, its global error as step^16
    for (method, slope) in [(Method::Dop853, 1.0), (Method::Extrapolation, 16.0 / 15.0)] {
        let error = |tolerance: f64| {
            let control = Control::Adaptive { tolerance };
            distance(&solve(&kepler(), &planet(0.0), 20.0, method, control).state, &planet(20.0))
        };
        // a step more or less that is rejected changes the error of one run by a factor of three: the geometric mean
        let near = [0.5, 0.7, 1.0, 1.4, 2.0];
        let at = |tolerance: f64| {
            let product: f64 = near.iter().map(|factor| error(factor * tolerance)).product();
            math::pow(product, 1.0 / near.len() as f64)
        };
        let (coarse, fine) = (at(1e-5), at(1e-11));
        let measured = power(coarse, fine, 1e6);
        println!("{}: errors {coarse:e}, {fine:e}: slope {measured:.3}, expected {slope:.3}", method.name());
        assert!((measured - slope).abs() < 0.15, "{}: slope {measured}", method.name());
        // at most as many times the tolerance as there are steps, times the growth of an error along the orbit (20 / 1)
        assert!(fine < 1e-11 * 1000.0, "{}: {fine:e}", method.name());
    }
}

#[test]
fn dop853_and_extrapolation_agree() {
    let control = Control::Adaptive { tolerance: 1e-14 };
    let one = solve(&kepler(), &planet(0.0), 10.0, Method::Dop853, control);
    let other = solve(&kepler(), &planet(0.0), 10.0, Method::Extrapolation, control);
    let difference = distance(&one.state, &other.state);
    println!("difference {difference:e}");
    assert!(difference < 2e-13, "{difference:e}");
}
