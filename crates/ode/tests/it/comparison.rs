//! Comparison with the solver of another crate.

use crate::problems::{distance, kepler, planet, solve};
use differential_equations::ode::ODE;
use differential_equations::prelude::{ExplicitRungeKutta, IVP};
use ode::{Control, Method};

/// The planet of [`crate::problems::kepler`], written once more.
struct Kepler;

impl ODE<f64, [f64; 4]> for Kepler {
    fn diff(&self, _t: f64, y: &[f64; 4], rates: &mut [f64; 4]) {
        let square = y[0] * y[0] + y[1] * y[1];
        let cube = square * square.sqrt();
        *rates = [y[2], y[3], -y[0] / cube, -y[1] / cube];
    }
}

/// The other crate's state at `end` by one of its methods.
macro_rules! theirs {
    ($method:ident, $start:expr, $end:expr, $tolerance:expr) => {{
        let method = ExplicitRungeKutta::$method().rtol($tolerance).atol($tolerance);
        let solution = IVP::ode(&Kepler, 0.0, $end, $start).method(method).solve().expect("the other crate solves it");
        *solution.y.last().expect("a last state")
    }};
}

#[test]
fn another_crate_finds_the_same() {
    let start = planet(0.0);
    let (end, tolerance) = (6.0, 1e-14);
    let theirs = [
        (Method::Dopri54, theirs!(dopri5, start, end, tolerance)),
        (Method::Verner65, theirs!(rkv655e, start, end, tolerance)),
        (Method::Verner76, theirs!(rkv766e, start, end, tolerance)),
        (Method::Verner98, theirs!(rkv988e, start, end, tolerance)),
        (Method::Dop853, theirs!(dop853, start, end, tolerance)),
    ];
    for (method, theirs) in theirs {
        let ours = solve(&kepler(), &start, end, method, Control::Adaptive { tolerance });
        let difference = distance(&ours.state, &theirs);
        let (mine, other) = (distance(&ours.state, &planet(end)), distance(&theirs, &planet(end)));
        println!("{}: {difference:e} apart, from the exact {mine:e} and {other:e}", method.name());
        // rounding of coefficients of some hundreds, which almost cancel, sets the end to what these two can reach
        let cancels = matches!(method, Method::Verner65 | Method::Verner76);
        assert!(difference < if cancels { 1e-11 } else { 1e-12 }, "{}: {difference:e}", method.name());
    }
}
