//! Euler's and Heun's methods, and the classical method of order 4.
//!
//! Coefficients: E. Hairer, S. P. Norsett, G. Wanner, *Solving Ordinary Differential Equations I*, section II.1.

use crate::tableau::{Interpolant, Tableau};

/// Order 1.
pub static EULER: Tableau =
    Tableau { name: "euler", order: 1, rows: &[], weights: &[(0, 1.0)], errors: &[], interpolant: Interpolant::Cubic };

/// Order 2.
pub static HEUN: Tableau = Tableau {
    name: "heun",
    order: 2,
    rows: &[&[(0, 1.0)]],
    weights: &[(0, 0.5), (1, 0.5)],
    errors: &[],
    interpolant: Interpolant::Cubic,
};

/// Order 4.
pub static RK4: Tableau = Tableau {
    name: "rk4",
    order: 4,
    rows: &[&[(0, 0.5)], &[(1, 0.5)], &[(2, 1.0)]],
    weights: &[(0, 1.0 / 6.0), (1, 1.0 / 3.0), (2, 1.0 / 3.0), (3, 1.0 / 6.0)],
    errors: &[],
    interpolant: Interpolant::Cubic,
};
