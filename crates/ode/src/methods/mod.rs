//! The methods by name.

mod classic;
mod dop853;
mod low;
mod verner65;
mod verner76;
mod verner87;
mod verner98;

pub use classic::{EULER, HEUN, RK4};
pub use dop853::DOP853;
pub use low::{BS32, DOPRI54, TSIT54};
pub use verner65::VERNER65;
pub use verner76::VERNER76;
pub use verner87::VERNER87;
pub use verner98::VERNER98;

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
    /// Order 3 with error estimate, Bogacki and Shampine's.
    Bs32,
    /// Order 5 with error estimate, Dormand and Prince's.
    Dopri54,
    /// Order 5 with error estimate, Tsitouras'.
    Tsit54,
    /// Order 6 with error estimate, Verner's.
    Verner65,
    /// Order 7 with error estimate, Verner's.
    Verner76,
    /// Order 8 with error estimate, Verner's.
    Verner87,
    /// Order 9 with error estimate, Verner's.
    Verner98,
    /// Order 8 with error estimate and interpolant of order 7.
    Dop853,
    /// Order 16: extrapolated midpoint rule, an adaptive method that shares no coefficients with the others.
    Extrapolation,
    /// The Taylor series of the solution, of an order that suits the tolerance; for systems that give theirs.
    Taylor,
}

impl Method {
    /// All methods.
    pub const ALL: [Method; 14] = [
        Method::Euler,
        Method::Ballistic,
        Method::Heun,
        Method::Rk4,
        Method::Bs32,
        Method::Dopri54,
        Method::Tsit54,
        Method::Verner65,
        Method::Verner76,
        Method::Verner87,
        Method::Verner98,
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
            Method::Bs32 => "bs32",
            Method::Dopri54 => "dopri54",
            Method::Tsit54 => "tsit54",
            Method::Verner65 => "verner65",
            Method::Verner76 => "verner76",
            Method::Verner87 => "verner87",
            Method::Verner98 => "verner98",
            Method::Dop853 => "dop853",
            Method::Extrapolation => "extrapolation",
            Method::Taylor => "taylor",
        }
    }

    /// The order of convergence `p`: the error at a given time falls with `h^p`. Of Taylor's method the highest that it
    /// takes.
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

    /// Whether the method works for this system.
    pub fn suits(self, system: &dyn crate::System) -> bool {
        !self.needs_series() || system.has_series()
    }

    /// The coefficients of a Runge-Kutta method; `None` of others.
    pub fn tableau(self) -> Option<&'static Tableau> {
        match self {
            Method::Euler => Some(&EULER),
            Method::Heun => Some(&HEUN),
            Method::Rk4 => Some(&RK4),
            Method::Bs32 => Some(&BS32),
            Method::Dopri54 => Some(&DOPRI54),
            Method::Tsit54 => Some(&TSIT54),
            Method::Verner65 => Some(&VERNER65),
            Method::Verner76 => Some(&VERNER76),
            Method::Verner87 => Some(&VERNER87),
            Method::Verner98 => Some(&VERNER98),
            Method::Dop853 => Some(&DOP853),
            Method::Ballistic | Method::Extrapolation | Method::Taylor => None,
        }
    }
}
