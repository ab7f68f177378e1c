//! Integration of autonomous systems of ordinary differential equations with fixed or adaptive steps, dense output, and
//! event location. This crate knows nothing about pedestrians.
//!
//! A caller describes its equations as a [`System`], picks a [`Method`] and a [`Control`], and hands an [`Observer`] to
//! [`integrate`], which shows it every accepted [`Step`].
//!
//! ```
//! use ode::{Control, Group, Measure, Method, Problem, Step, System, first_crossing, integrate};
//! use std::ops::{ControlFlow, Range};
//!
//! /// `x'' = -x`, with the state `[x, x']`.
//! struct Oscillator;
//! impl System for Oscillator {
//!     fn dimension(&self) -> usize {
//!         2
//!     }
//!     fn positions(&self) -> Vec<Range<usize>> {
//!         vec![0..1]
//!     }
//!     fn kinematics(&self, state: &[f64], rates: &mut [f64]) {
//!         rates[0] = state[1];
//!     }
//!     fn dynamics(&self, state: &[f64], rates: &mut [f64]) {
//!         rates[1] = -state[0];
//!     }
//!     fn groups(&self) -> Vec<Group> {
//!         vec![Group { range: 0..2, measure: Measure::Largest, floor: 0.0 }]
//!     }
//! }
//! let (method, control) = (Method::Dop853, Control::Adaptive { tolerance: 1e-12 });
//! let problem = Problem { system: &Oscillator, start: &[1.0, 0.0], begin: 0.0, end: 10.0, method, control };
//! // until x falls through 0
//! let mut zero = None;
//! let end = integrate(&problem, &mut |step: &mut Step<'_>| {
//!     match first_crossing(step, 4, &mut |state| state[0]) {
//!         Some(theta) => {
//!             zero = Some(step.start + theta * step.length());
//!             ControlFlow::Break(())
//!         }
//!         None => ControlFlow::Continue(()),
//!     }
//! })?;
//! assert!((zero.expect("a quarter of a period") - std::f64::consts::FRAC_PI_2).abs() < 1e-10);
//! assert!(end.time < 10.0);
//! # Ok::<(), ode::Failure>(())
//! ```
//!
//! # Units, shapes, ranges, NaN
//!
//! A state has [`System::dimension`] components, and so have its rates. Each component has a unit of its own, and there
//! is one unit of time, which steps share; a rate has the unit of its component over that of time. A tolerance is
//! dimensionless: an error is compared with the size of a [`Group`], whose components and whose floor share a unit.
//! Fractions of a step (`theta`) are dimensionless, 0 to 1. Times may have either sign; they go up.
//!
//! Slices are as long as is said; with another length a call panics, or its result has no meaning. A component that
//! becomes NaN or infinite makes a step of adaptive length shorter until the integration ends as
//! [`Failure::StepTooSmall`], and ends one of fixed length as [`Failure::NotFinite`]: no observer is shown such a
//! state.
//!
//! The error of a result is not stated by [`integrate`]: compare two methods or tolerances, or carry the error along
//! with a [`Shadow`] (Taylor's method).

mod ballistic;
mod bends;
mod control;
mod dense;
mod extrapolation;
mod failure;
mod inside;
mod integrate;
mod kinks;
mod linear;
pub mod methods;
mod observe;
mod rows;
mod runge_kutta;
mod shadow;
mod system;
pub mod tableau;
mod taylor;
mod vector;

pub use control::Control;
pub use dense::Step;
pub use failure::Failure;
pub use integrate::{Problem, SHORTEST, Statistics, integrate, resume};
pub use methods::Method;
pub use observe::{MOST_STEPS, Observer, Pace, ResumePoint, Sampler, StepPosition, crossing_between, first_crossing};
pub use shadow::Shadow;
pub use system::{Batch, Group, MeanTangent, Measure, System, Tangent, TangentEnds};
pub use vector::largest;
