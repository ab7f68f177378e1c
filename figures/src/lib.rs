//! What the programs of the figures share: the command line and the output folders ([`job`]), panels used by several
//! figures ([`panels`]) and their titles ([`titles`]), exit codes ([`failure`]), whether results can be written
//! ([`outputs`]); the programs for user scenes ([`simulate`] with [`checkpoint`], [`map`]).

pub mod checkpoint;
pub mod failure;
pub mod job;
pub mod map;
pub mod outputs;
pub mod panels;
pub mod simulate;
pub mod titles;
pub mod uniform;

pub use failure::Failure;
pub use job::{Job, figure};
