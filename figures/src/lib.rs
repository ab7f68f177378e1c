//! What the figures' binaries share: the command line and where tables and pictures go ([`job`]), panels that several
//! figures draw ([`panels`]) and their titles ([`titles`]), exit codes ([`failure`]); and the programs `simulate` ([`simulate`] with
//! [`checkpoint`]) and `map` ([`map`]).

pub mod checkpoint;
pub mod failure;
pub mod job;
pub mod map;
pub mod panels;
pub mod simulate;
pub mod titles;
pub mod uniform;

pub use failure::Failure;
pub use job::{Job, figure};
