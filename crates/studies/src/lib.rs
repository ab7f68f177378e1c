//! Computations for the supplements. Accuracy tables: error against work ([`precision`], drawn by [`precision_panel`]),
//! rounding and growth ([`studies`]), hard cases ([`hard`]). Evidence for claims: what the jams depend on
//! ([`parameters`]), where stability ends ([`thresholds`]), published curves beside fixed-step runs ([`overlay`]), the
//! laws as optimal-velocity models ([`optimal_velocity`]), travelling waves computed without runs ([`travelling`]),
//! irregular waves ([`irregular`]), the contact sheet of published laws ([`gallery`]). No figure of the paper depends
//! on this crate.

pub mod draw;
pub mod gallery;
pub mod hard;
pub mod irregular;
pub mod optimal_velocity;
pub mod overlay;
pub mod parameters;
pub mod precision;
pub mod precision_panel;
pub mod studies;
pub mod thresholds;
pub mod travelling;
