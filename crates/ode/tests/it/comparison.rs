//! Against the solver of another crate.

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

#[test]
fn another_crate_finds_the_same() {
    let start = planet(0.0);
    let end = 6.0;
    let tolerance = 1e-14;
    let theirs = IVP::ode(&Kepler, 0.0, end, [start[0], start[1], start[2], start[3]])
        .method(ExplicitRungeKutta::dop853().rtol(tolerance).atol(tolerance))
        .solve()
        .expect("the other crate solves it");
    let ours = solve(&kepler(), &start, end, Method::Dop853, Control::Adaptive { tolerance });
    let last = theirs.y.last().expect("a last state");
    let difference = distance(&ours.state, last);
    println!(
        "difference from the other crate {difference:e}, from the exact {:e}",
        distance(&ours.state, &planet(end))
    );
    assert!(difference < 1e-12, "{difference:e}");
}
