//! What the figures' binaries share: the command line and where tables and pictures go ([`job`]), panels that several
//! figures draw ([`panels`], [`planes`], [`outcomes`]) and their titles ([`titles`]), exit codes ([`failure`]); and the programs for scenes of
//! one's own ([`simulate`] with [`checkpoint`], [`map`]); the contact sheet of published laws ([`gallery`]).

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
