//! What the figures' binaries share: the command line and where tables and pictures go ([`job`]), panels that several
//! figures draw ([`panels`], [`precision_panel`]), exit codes ([`failure`]); the two programs for scenes of one's own
//! ([`simulate`] with [`checkpoint`], [`map`]); and the tables of the report of accuracy: error against work
//! ([`precision`]), rounding and growth ([`studies`]), hard cases ([`hard`]). What the jams depend on
//! ([`parameters`]), where stability ends ([`thresholds`]), and published curves beside
//! runs by fixed steps ([`overlay`]).

pub mod checkpoint;
pub mod draw;
pub mod failure;
pub mod hard;
pub mod job;
pub mod map;
pub mod overlay;
pub mod panels;
pub mod parameters;
pub mod precision;
pub mod precision_panel;
pub mod simulate;
pub mod studies;
pub mod thresholds;

pub use failure::Failure;
pub use job::{Job, figure};
