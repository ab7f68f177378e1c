//! The laws of motion, `dv_n/dt = f(v_n, v_{n+1}, s_n)`: one file each, with the formula as the paper prints it, the
//! same formula as a difference from the uniform flow, and its linearisation.
//!
//! A parameter that is zero names no term. The laws are generic over which terms there are, so that the compiler leaves
//! out the others; [`Model::visit`] is the one place that chooses.

mod algebraic;
mod exponential;
mod logarithmic;
pub mod presets;

pub use algebraic::{Algebraic, AlgebraicLaw};
pub use exponential::{Exponential, ExponentialLaw};
pub use logarithmic::{C, Logarithmic, LogarithmicLaw};

use crate::ramp::Bend;
use crate::series::Block;
use crate::stability::Linear;
use math::row::{LENGTH, Room};

/// A law of motion, all terms known at compile time. Functions are small and free of branches: loops over them
/// vectorise.
pub trait Law: Copy + Send {
    /// What the uniform flow at one instant contributes to every pedestrian: computed once, used N times.
    type Base: Copy + std::fmt::Debug;

    /// Whether the force is infinite where the room ends.
    const SINGULAR: bool;

    /// The gap at which two standing pedestrians touch; *clearance* means the gap minus this.
    const CONTACT: f64;

    /// `dv/dt` of a pedestrian with the given clearance to the one ahead, its own speed and the speed ahead.
    fn acceleration(&self, clearance: f64, speed: f64, ahead: f64) -> f64;

    /// The uniform flow with this clearance and speed of everybody.
    fn base(&self, clearance: f64, speed: f64) -> Self::Base;

    /// `dv/dt` minus that of the uniform flow, for deviations of gap and speeds from it. Its relative error is of the
    /// order of rounding however small the deviations are.
    fn deviation(&self, base: &Self::Base, gap: f64, speed: f64, ahead: f64) -> f64;

    /// Whether the law is so long that a row of pedestrians is faster in several short loops ([`math::row`]).
    const IN_ROWS: bool;

    /// Replaces the clearances of a row of pedestrians, at most [`math::row::LENGTH`], by their
    /// [`Law::acceleration`]s, with the same bits. Of laws that are [`Law::IN_ROWS`].
    fn accelerations(&self, row: &mut [f64], speeds: &[f64], ahead: &[f64], work: &mut Work);

    /// Replaces the deviations of the gaps of such a row by its [`Law::deviation`]s, with the same bits.
    fn deviations(&self, base: &Self::Base, row: &mut [f64], speeds: &[f64], ahead: &[f64], work: &mut Work);

    /// Whether the force depends on the gap alone: then there are recurrences for its Taylor coefficients along a motion
    /// (see [`crate::series`]).
    const HAS_SERIES: bool;

    /// What the recurrences keep of each order.
    type Terms: Copy + Default + std::fmt::Debug;

    /// Fills the terms of order 0 from the clearances.
    fn start_terms(&self, clearance: &Block, terms: &mut Self::Terms);

    /// The coefficient of the force, the drive included, of an order >= 1: from that of the clearance and the terms of all
    /// earlier orders. Fills the terms of this order.
    fn next_terms(&self, earlier: &[Self::Terms], clearance: &Block, terms: &mut Self::Terms) -> Block;

    /// What must stay positive for the run to go on: `d_n` of eq:effDistn, or the gap for the logarithmic law.
    fn room(&self, clearance: f64, speed: f64, ahead: f64) -> f64;

    /// How much room a unit of speed, own or ahead, takes away.
    fn room_per_speed(&self) -> f64;

    /// Where the smooth ramp bends, if the law has one; where its argument is a quotient, its numerator.
    fn bend(&self) -> Option<Bend>;
}

/// Room for a row of a law at work.
#[derive(Clone, Debug)]
pub struct Work {
    room: Room,
    /// Another row, for a law with two terms.
    row: [f64; LENGTH],
}

impl Default for Work {
    fn default() -> Work {
        Work { room: Room::default(), row: [0.0; LENGTH] }
    }
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

/// Something to do with a law once its type is known.
pub trait Visitor {
    /// What comes out.
    type Output;
    /// Does it.
    fn visit<L: Law + 'static>(self, law: L) -> Self::Output;
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
        match self {
            Model::Algebraic(law) => law.desired_speed,
            Model::Exponential(law) => law.desired_speed,
            Model::Logarithmic(law) => law.desired_speed,
        }
    }

    /// Chooses the variant of the law with just the terms that the parameters name.
    pub fn visit<V: Visitor>(&self, visitor: V) -> V::Output {
        match self {
            Model::Algebraic(law) => law.visit(visitor),
            Model::Exponential(law) => law.visit(visitor),
            Model::Logarithmic(law) => law.visit(visitor),
        }
    }

    /// The acceleration as the paper prints it, evaluated once; for many, see [`Model::visit`].
    pub fn acceleration(&self, gap: f64, speed: f64, ahead: f64) -> f64 {
        self.visit(Acceleration { gap, speed, ahead })
    }

    /// The gap at which two standing pedestrians touch (see [`Law::CONTACT`]).
    pub fn contact(&self) -> f64 {
        match self {
            Model::Logarithmic(_) => 0.0,
            _ => 2.0,
        }
    }

    /// Whether the force is infinite where the room ends (see [`Law::SINGULAR`]).
    pub fn is_singular(&self) -> bool {
        matches!(self, Model::Algebraic(_))
    }

    /// The room of a pedestrian (see [`Law::room`]).
    pub fn room(&self, gap: f64, speed: f64, ahead: f64) -> f64 {
        gap - self.room_per_speed() * (speed + ahead) - self.contact()
    }

    /// How much room a unit of speed, own or ahead, takes away.
    pub fn room_per_speed(&self) -> f64 {
        self.visit(RoomPerSpeed)
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

struct RoomPerSpeed;

impl Visitor for RoomPerSpeed {
    type Output = f64;
    fn visit<L: Law>(self, law: L) -> f64 {
        law.room_per_speed()
    }
}

struct Acceleration {
    gap: f64,
    speed: f64,
    ahead: f64,
}

impl Visitor for Acceleration {
    type Output = f64;
    fn visit<L: Law>(self, law: L) -> f64 {
        law.acceleration(self.gap - L::CONTACT, self.speed, self.ahead)
    }
}
