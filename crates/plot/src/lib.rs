//! House style and pictures: data in, the bytes of a PNG and an SVG out.
//!
//! A [`Picture`] is a page in millimetres with panels in a grid: [`Lines`], [`Map`], [`SpaceTime`]
//! or a free [`Drawing`]. Panels take numbers and labels; this crate knows no physics, opens no
//! file and asks the host for no font. The same data give the same bytes on every machine.
//!
//! plotters draws an SVG, resvg turns it into pixels and into an SVG with outlines for text.
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
//! Labels are plain text with math between dollar signs: `"$\\tilde a_v$"`, `"$\\Delta x'_n$"`,
//! `"$10^{-4}$"`, `"$\\mathrm{Re}\\,z^+$"`.

mod axes;
mod axis;
mod canvas;
mod color;
mod color_scale;
mod contour;
mod drawing;
mod error;
mod field;
mod font;
mod geometry;
mod grid;
mod label;
mod lines;
mod map;
mod markup;
mod picture;
mod raster;
mod render;
mod series;
mod space_time;
pub mod style;
#[cfg(test)]
mod vision;

pub use axis::Axis;
pub use color::Color;
pub use color_scale::ColorScale;
pub use drawing::Drawing;
pub use error::PlotError;
pub use geometry::Point;
pub use lines::{Corner, Legend, Lines};
pub use map::Map;
pub use picture::{Panel, Picture};
pub use raster::{Pixels, decode};
pub use render::Rendered;
pub use series::{Marker, Series};
pub use space_time::{SpaceTime, Trajectory};
