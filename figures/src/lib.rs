//! What the figures' binaries share: the command line and where tables and pictures go ([`job`]), panels that several
//! figures draw ([`panels`], [`precision_panel`]), exit codes ([`failure`]); and the two programs for scenes of one's own
//! ([`simulate`] with [`checkpoint`], [`map`]); the tables of the hard cases ([`hard`]), of error against work
//! ([`precision`]) and of the studies of errors ([`studies`]).

pub mod checkpoint;
pub mod failure;
pub mod hard;
pub mod job;
pub mod map;
pub mod panels;
pub mod precision;
pub mod precision_panel;
pub mod simulate;
pub mod studies;

pub use failure::Failure;
pub use job::{Job, figure};
