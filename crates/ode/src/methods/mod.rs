//! The methods by name.

mod classic;
mod dop853;

pub use classic::{EULER, HEUN, RK4};
pub use dop853::DOP853;

use crate::tableau::Tableau;

/// A method of integration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// Order 1.
    Euler,
    /// Speeds as Euler, positions with the mean of the old and the new speeds; order 1 where forces depend on speeds.
    Ballistic,
    /// Order 2: the mean of the rates at both ends, the scheme of the paper.
    Heun,
    /// Order 4, Kutta's.
    Rk4,
    /// Order 8 with error estimate and interpolant of order 7.
    Dop853,
    /// Order 16: extrapolated midpoint rule, an adaptive method that shares no coefficients with the others.
    Extrapolation,
    /// The Taylor series of the solution, of an order that suits the tolerance; for systems that give theirs.
    Taylor,
}

impl Method {
    /// All methods.
    pub const ALL: [Method; 7] = [
        Method::Euler,
        Method::Ballistic,
        Method::Heun,
        Method::Rk4,
        Method::Dop853,
        Method::Extrapolation,
        Method::Taylor,
    ];

    /// The name in scene files.
    pub fn name(self) -> &'static str {
        match self {
            Method::Euler => "euler",
            Method::Ballistic => "ballistic",
            Method::Heun => "heun",
            Method::Rk4 => "rk4",
            Method::Dop853 => "dop853",
            Method::Extrapolation => "extrapolation",
            Method::Taylor => "taylor",
        }
    }

    /// The order of convergence.
    pub fn order(self) -> usize {
        match self {
            Method::Ballistic => 1,
            Method::Extrapolation => crate::extrapolation::ORDER,
            Method::Taylor => crate::taylor::HIGHEST,
            _ => self.tableau().map_or(0, |tableau| tableau.order),
        }
    }

    /// Whether the method estimates its error and so can choose its steps.
    pub fn is_adaptive(self) -> bool {
        match self {
            Method::Extrapolation | Method::Taylor => true,
            _ => self.tableau().is_some_and(|tableau| !tableau.errors.is_empty()),
        }
    }

    /// Whether the method works only for systems that give their Taylor series ([`crate::System::series`]).
    pub fn needs_series(self) -> bool {
        self == Method::Taylor
    }

    /// The coefficients of a Runge-Kutta method.
    pub fn tableau(self) -> Option<&'static Tableau> {
        match self {
            Method::Euler => Some(&EULER),
            Method::Heun => Some(&HEUN),
            Method::Rk4 => Some(&RK4),
            Method::Dop853 => Some(&DOP853),
            Method::Ballistic | Method::Extrapolation | Method::Taylor => None,
        }
    }
}
