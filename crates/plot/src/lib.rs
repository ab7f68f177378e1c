//! House style and pictures: data in, the bytes of a PNG and an SVG out.
//!
//! A [`Picture`] is a page in millimetres with panels in a grid: [`Lines`], [`Map`], [`Plane`], [`SpaceTime`], a free
//! [`Drawing`], or a [`Key`] to what the others show. Panels take numbers and labels; this crate knows no physics,
//! opens no file and asks the host for no font. The same data give the same bytes on every machine.
//!
//! Panels are charts of plotters, drawn once for both files: on a page whose surfaces write SVG and paint pixels.
//!
//! ```
//! use plot::{Axis, Lines, Picture, Series};
//!
//! let curve = (0..100).map(|i| (f64::from(i), f64::from(i * i))).collect();
//! let panel = Lines::new(Axis::linear("$t$", 0.0, 100.0), Axis::linear("$x(t)$", 0.0, 10_000.0))
//!     .series(Series::line("$t^2$", curve));
//! let files = Picture::new(86.0, 60.0).panel(panel).render()?;
//! assert!(files.png.starts_with(b"\x89PNG"));
//! # Ok::<(), plot::PlotError>(())
//! ```
//!
//! Labels are plain text with math between dollar signs: `"$\\tilde a_v$"`, `"$\\Delta x'_n$"`, `"$10^{-4}$"`,
//! `"$\\mathrm{Re}\\,z^+$"`.

mod axis;
mod color;
mod color_scale;
mod contour;
mod drawing;
mod elements;
mod error;
mod field;
mod fill;
mod font;
mod frame;
mod geometry;
mod grid;
mod key;
mod label;
mod lines;
mod map;
mod page;
mod picture;
mod pixels;
mod plane;
mod raster;
mod regions;
mod series;
mod space_time;
pub mod style;
mod svg;
#[cfg(test)]
mod vision;

pub use axis::Axis;
pub use color_scale::ColorScale;
pub use drawing::Drawing;
pub use error::PlotError;
pub use fill::Fill;
pub use geometry::Point;
pub use key::Key;
pub use lines::{Corner, Lines};
pub use map::Map;
pub use picture::{Panel, Picture, Rendered};
pub use plane::Plane;
pub use series::{Marker, Series};
pub use space_time::{SpaceTime, Trajectory};
pub use style::Color;
