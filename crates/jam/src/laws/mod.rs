//! The laws of motion, `dv_n/dt = f(s_n, v_n, v_{n+1})`: one file each, with its parameters and the formula as the paper
//! prints it. Everything else follows from the formula, by what numbers it is carried out with ([`math::number`]).
//!
//! A parameter that is zero names no term: the formula leaves it out.

mod algebraic;
mod exponential;
mod logarithmic;
pub mod presets;

pub use algebraic::Algebraic;
pub use exponential::Exponential;
pub use logarithmic::{C, Logarithmic};

use crate::force::{Compiled, Force};
use crate::stability::Linear;
use math::number::Number;

/// A law of motion as a formula.
pub trait Law: Copy + Send + Sync + std::fmt::Debug + 'static {
    /// The spacing at which two standing pedestrians touch; the *net gap* is the spacing less this.
    const CONTACT: f64;

    /// Whether the force is infinite where the effective gap closes.
    const SINGULAR: bool;

    /// `dv/dt` of a pedestrian with this net gap and speed, and the speed ahead. Branches may depend on parameters only.
    fn acceleration<X: Number>(&self, net_gap: X, speed: X, ahead: X) -> X;

    /// What must stay positive for the run to go on: `d_n` of eq:effDistn, or the spacing for the logarithmic law.
    fn effective_gap<X: Number>(&self, net_gap: X, speed: X, ahead: X) -> X;

    /// Whether the force, the relaxation of one's own speed apart, depends on speeds.
    fn uses_speeds(&self) -> bool;

    /// The law with the terms of the paper's runs and no others, if these are all that it has: the same law, with the
    /// parameters that leave a term out as constants, so that the compiler leaves it out as well.
    fn plain(&self) -> Option<Self>;
}

/// A law with its parameters, as data.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Model {
    /// eq:invd.
    Algebraic(Algebraic),
    /// eq:sfm.
    Exponential(Exponential),
    /// eq:modlog.
    Logarithmic(Logarithmic),
}

/// Does something with whatever law it is.
macro_rules! each {
    ($model:expr, $law:ident => $action:expr) => {
        match $model {
            Model::Algebraic($law) => $action,
            Model::Exponential($law) => $action,
            Model::Logarithmic($law) => $action,
        }
    };
}

/// The spacing at which two touch.
fn contact_of<L: Law>(_law: &L) -> f64 {
    L::CONTACT
}

/// Whether the force is infinite at a wall.
fn is_singular<L: Law>(_law: &L) -> bool {
    L::SINGULAR
}

impl Model {
    /// The name of the law in scene files.
    pub fn name(&self) -> &'static str {
        match self {
            Model::Algebraic(_) => "algebraic",
            Model::Exponential(_) => "exponential",
            Model::Logarithmic(_) => "logarithmic",
        }
    }

    /// The desired speed `v_0'`.
    pub fn desired_speed(&self) -> f64 {
        each!(self, law => law.desired_speed)
    }

    /// The force on all pedestrians of a ring.
    pub fn force(&self) -> Box<dyn Force> {
        each!(*self, law => Box::new(Compiled::new(law)))
    }

    /// The acceleration as the paper prints it.
    pub fn acceleration(&self, gap: f64, speed: f64, ahead: f64) -> f64 {
        each!(self, law => law.acceleration(gap - self.contact(), speed, ahead))
    }

    /// The gap at which two standing pedestrians touch (see [`Law::CONTACT`]).
    pub fn contact(&self) -> f64 {
        each!(self, law => contact_of(law))
    }

    /// Whether the force is infinite where the room ends (see [`Law::SINGULAR`]).
    pub fn is_singular(&self) -> bool {
        each!(self, law => is_singular(law))
    }

    /// The room of a pedestrian (see [`Law::effective_gap`]).
    pub fn room(&self, gap: f64, speed: f64, ahead: f64) -> f64 {
        each!(self, law => law.effective_gap(gap - self.contact(), speed, ahead))
    }

    /// How much room a unit of speed, own or ahead, takes away.
    pub fn room_per_speed(&self) -> f64 {
        -each!(self, law => law.effective_gap(0.0, 1.0, 0.0))
    }

    /// The coefficients of the linearised law about the uniform flow with this headway and speed.
    pub fn linearise(&self, headway: f64, speed: f64) -> Linear {
        match self {
            Model::Algebraic(law) => law.linearise(law.gap(headway, speed)),
            Model::Exponential(law) => law.linearise(law.gap(headway, speed)),
            Model::Logarithmic(law) => law.linearise(headway, speed),
        }
    }
}
