//! The force on all pedestrians of a ring, as the forms of the state request it from a law.

pub(crate) mod blocks;
mod compiled;
mod formula;
mod heun;
mod series;

pub use compiled::Compiled;
pub use formula::{Interpreted, Prepared, Source};
pub use heun::{Cut, heun_steps};
pub use series::Motion;

use crate::ramp::Bend;
use math::simd::Width;
use ode::Batch;

/// The force on the pedestrians of a ring, of whom each follows the next and the last the first. Rows hold a number for
/// each of the `N` of them, all of the same length: spacings and gaps in units of `a_0`, speeds in `a_0 / tau`,
/// accelerations in `a_0 / tau^2`. An acceleration without a value is NaN or infinite; nothing panics for it.
pub trait Force: std::fmt::Debug + Send {
    /// The spacing at which two standing pedestrians touch; the net gap is the spacing less this.
    fn contact(&self) -> f64;

    /// Whether the force is infinite where the effective gap closes.
    fn is_singular(&self) -> bool;

    /// Writes the accelerations at these net gaps and speeds.
    fn accelerations(&self, net_gaps: &[f64], speeds: &[f64], accelerations: &mut [f64]);

    /// Writes the accelerations less that of the uniform flow, for deviations of spacings and speeds from it, and
    /// returns that of the uniform flow. Their error is relative to the deviations, however small these are.
    fn deviations(&self, flow: Flow, spacings: &[f64], speeds: &[f64], accelerations: &mut [f64]) -> f64;

    /// Writes the effective gaps at these net gaps and speeds.
    fn effective_gaps(&self, net_gaps: &[f64], speeds: &[f64], gaps: &mut [f64]);

    /// Writes the rates of the effective gaps, for these rates of net gaps and speeds.
    fn effective_gap_rates(&self, now: Rows<'_>, rates: Rows<'_>, gap_rates: &mut [f64]);

    /// Whether every effective gap is open, for such deviations. At once true where the force is not singular.
    fn is_open(&self, flow: Flow, spacings: &[f64], speeds: &[f64]) -> bool;

    /// Whether the acceleration depends on speeds in another way than linearly, with the same slopes everywhere.
    fn uses_speeds(&self) -> bool;

    /// How the acceleration of a uniform flow answers to its speed, in units of one over time: -1 for the laws of the
    /// paper. Has a meaning only where [`Force::uses_speeds`] is false.
    fn relaxation(&self, flow: Flow) -> f64;

    /// What the acceleration depends on.
    fn dependence(&self) -> Dependence {
        Dependence::Unknown
    }

    /// Writes how the accelerations answer to what they depend on, for deviations of spacings and speeds from this
    /// flow: one row for the own spacings, for [`Dependence::Speeds`] two more for the own speeds and those ahead.
    /// Nothing for [`Dependence::Unknown`].
    fn slopes(&self, _flow: Flow, _now: Rows<'_>, _slopes: &mut [f64]) {}

    /// Where the force bends sharply, if it does.
    fn bend(&self) -> Option<Bend> {
        None
    }

    /// Writes the Taylor coefficients of a motion.
    fn series(&self, motion: Motion<'_>);

    /// How many operations of the force have kinks, if their arguments have series.
    fn kinks(&self) -> usize {
        0
    }

    /// Whether Taylor's method does not suit some of them; see
    /// [`Model::has_unsuited_kinks`](crate::laws::Model::has_unsuited_kinks).
    fn has_unsuited_kinks(&self) -> bool {
        false
    }

    /// Writes the arguments of the kinks in the series written last: `order` rows of one number for each kink of each
    /// of so many pedestrians.
    fn kink_arguments(&self, _pedestrians: usize, _order: usize, _arguments: &mut [f64]) {}

    /// Makes steps of Heun's scheme of the state `[x_0 .. x_{N-1}, v_0 .. v_{N-1}]`, in one piece or cut. A batch in
    /// which something happens leaves the state untouched.
    fn heun(&self, steps: Steps, cut: Option<Cut>, state: &mut [f64]) -> Batch;
}

/// What the acceleration of a pedestrian depends on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dependence {
    /// The own spacing alone, but for the relaxation of the own speed at rate 1.
    Spacing,
    /// The own spacing, the own speed and that ahead.
    Speeds,
    /// Other pedestrians as well, or it is not known.
    Unknown,
}

/// A number for each spacing and each speed.
#[derive(Clone, Copy, Debug)]
pub struct Rows<'a> {
    /// Of spacings: net gaps, or their rates.
    pub spacings: &'a [f64],
    /// Of speeds.
    pub speeds: &'a [f64],
}

/// A uniform flow: all pedestrians have the same net gap and speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flow {
    /// The net gap, headway less contact, in units of `a_0`.
    pub net_gap: f64,
    /// The speed.
    pub speed: f64,
}

/// What added to any number leaves it as it is, a zero with its sign.
pub(crate) const NOTHING: Flow = Flow { net_gap: -0.0, speed: -0.0 };

/// Steps to be made: the length of the ring, the length of a step, their number, and the widest registers to use, on
/// which the bits do not depend.
#[derive(Clone, Copy, Debug)]
pub struct Steps {
    /// Length of the ring, in units of `a_0`.
    pub length: f64,
    /// Length of a step, in units of `tau`.
    pub h: f64,
    /// Number of steps.
    pub count: u64,
    /// The widest registers.
    pub limit: Width,
}
