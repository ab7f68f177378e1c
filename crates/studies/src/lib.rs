//! What the supplements are computed by: the tables of the report of accuracy, which are error against work
//! ([`precision`], drawn by [`precision_panel`]), rounding and growth ([`studies`]) and hard cases ([`hard`]); what the jams
//! depend on ([`parameters`]), where stability ends ([`thresholds`]), published curves beside runs by fixed steps
//! ([`overlay`]), the laws as optimal-velocity models ([`optimal_velocity`]), waves without runs ([`travelling`]),
//! irregular ones ([`irregular`]), the contact sheet of published laws ([`gallery`]). No figure of the paper is built with it.

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
