//! Integration of autonomous systems of ordinary differential equations with fixed or adaptive steps, dense output, and
//! event location. This crate knows nothing about pedestrians.
//!
//! A caller describes its equations as a [`System`], picks a [`Method`] and a [`Control`], and hands an [`Observer`] to
//! [`integrate`], which shows it every accepted [`Step`].

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
pub use system::{Batch, Group, Measure, System, Tangent};
pub use vector::largest;
