//! The physics of the paper: three laws of motion, the ring of pedestrians, its uniform flow and the stability of it,
//! and what is observed in a run. Pure: no files, no clock.
//!
//! All quantities are dimensionless: lengths in units of `a_0`, times in units of `tau` (eq-rescale of the paper).

pub mod criteria;
pub mod events;
pub mod force;
pub mod jams;
pub mod laws;
pub mod observe;
pub mod outcome;
pub mod precise;
pub mod ramp;
pub mod ring;
pub mod stability;
pub mod states;
pub mod uniform;
pub mod waves;
