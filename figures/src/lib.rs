//! What the programs of the figures share: the command line and the output folders ([`job`]), panels used by several
//! figures ([`panels`], [`planes`], [`outcomes`]) and their titles ([`titles`]), exit codes ([`failure`]); the programs
//! for user scenes ([`simulate`] with [`checkpoint`], [`map`]); and the contact sheet of published laws ([`gallery`]).

pub mod checkpoint;
pub mod failure;
pub mod gallery;
pub mod job;
pub mod map;
pub mod outcomes;
pub mod panels;
pub mod planes;
pub mod simulate;
pub mod sweep;
pub mod titles;
pub mod uniform;

pub use failure::Failure;
pub use job::{Job, figure};
