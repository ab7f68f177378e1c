//! The page as plotters sees it: one [`DrawingBackend`] for every kind of surface.
//!
//! plotters counts in whole units; a unit is a micrometre here, far below what a printer can show. A surface fills and
//! strokes paths: [`Svg`](crate::svg::Svg) writes them down, [`Pixels`](crate::pixels::Pixels) paints them, and a pair
//! of surfaces does both at once, so that the two files of a picture come from the same calls.

use crate::error::PlotError;
use crate::label::Label;
use crate::raster::Raster;
use crate::style::Color;
use plotters_backend::text_anchor::{HPos, VPos};
use plotters_backend::{BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingBackend, DrawingErrorKind};
use tiny_skia::{Path, PathBuilder, Rect};

/// Micrometres in a millimetre.
pub(crate) const UNITS: f64 = 1000.0;

/// A length in millimetres as units of the page.
pub(crate) fn units(millimetres: f64) -> i32 {
    (millimetres * UNITS).round() as i32
}

/// How lines are drawn. Lengths are millimetres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pen {
    pub color: Color,
    pub width: f64,
    /// On, off, ...; empty for a solid line.
    pub dash: &'static [f64],
}

impl Pen {
    pub fn solid(color: Color, width: f64) -> Self {
        Self { color, width, dash: &[] }
    }

    pub fn dashed(color: Color, width: f64, dash: &'static [f64]) -> Self {
        Self { color, width, dash }
    }
}

/// Something that shows shapes; coordinates are units from the upper left corner, y downwards.
pub trait Surface {
    /// Fills a path (nonzero winding).
    fn fill(&mut self, path: &Path, color: Color);
    /// Strokes a path, with round joins.
    fn stroke(&mut self, path: &Path, pen: &Pen);
    /// Draws a circle: filled, or as a line of a width in millimetres.
    fn circle(&mut self, (x, y): BackendCoord, radius: u32, color: Color, width: Option<f64>) {
        let Some(path) = PathBuilder::from_circle(x as f32, y as f32, radius as f32) else { return };
        match width {
            Some(width) => self.stroke(&path, &Pen::solid(color, width)),
            None => self.fill(&path, color),
        }
    }

    /// Stretches an image over the box between two corners; its pixels stay sharp.
    fn image(&mut self, image: &Raster, from: BackendCoord, to: BackendCoord) -> Result<(), PlotError>;
}

impl<A: Surface, B: Surface> Surface for (A, B) {
    fn fill(&mut self, path: &Path, color: Color) {
        self.0.fill(path, color);
        self.1.fill(path, color);
    }

    fn stroke(&mut self, path: &Path, pen: &Pen) {
        self.0.stroke(path, pen);
        self.1.stroke(path, pen);
    }

    fn circle(&mut self, at: BackendCoord, radius: u32, color: Color, width: Option<f64>) {
        self.0.circle(at, radius, color, width);
        self.1.circle(at, radius, color, width);
    }

    fn image(&mut self, image: &Raster, from: BackendCoord, to: BackendCoord) -> Result<(), PlotError> {
        self.0.image(image, from, to)?;
        self.1.image(image, from, to)
    }
}

/// A page with a surface.
pub struct Page<S> {
    size: (u32, u32),
    pub surface: S,
}

type Drawn = Result<(), DrawingErrorKind<PlotError>>;

impl<S: Surface> Page<S> {
    /// A page of `size` units.
    pub fn new(size: (u32, u32), surface: S) -> Self {
        Self { size, surface }
    }

    /// Strokes polylines as one path.
    pub fn polylines(&mut self, pieces: &[Vec<BackendCoord>], pen: &Pen) {
        let mut path = PathBuilder::new();
        for piece in pieces {
            trace(&mut path, piece.iter().copied());
        }
        if let Some(path) = path.finish() {
            self.surface.stroke(&path, pen);
        }
    }

    fn paint<St: BackendStyle>(&mut self, path: Option<Path>, style: &St, is_filled: bool) -> Drawn {
        let (Some(path), Some(color)) = (path, visible(style.color())) else { return Ok(()) };
        if is_filled {
            self.surface.fill(&path, color);
        } else {
            self.surface.stroke(&path, &Pen::solid(color, f64::from(style.stroke_width()) / UNITS));
        }
        Ok(())
    }
}

/// The colour of a style; the house style is opaque, and what is wholly transparent is not drawn.
fn visible(color: BackendColor) -> Option<Color> {
    let (red, green, blue) = color.rgb;
    (color.alpha > 0.0).then_some(Color(red, green, blue))
}

fn trace(path: &mut PathBuilder, points: impl Iterator<Item = BackendCoord>) {
    for (index, (x, y)) in points.enumerate() {
        match index {
            0 => path.move_to(x as f32, y as f32),
            _ => path.line_to(x as f32, y as f32),
        }
    }
}

impl<S: Surface> DrawingBackend for Page<S> {
    type ErrorType = PlotError;

    fn get_size(&self) -> (u32, u32) {
        self.size
    }

    fn ensure_prepared(&mut self) -> Drawn {
        Ok(())
    }

    fn present(&mut self) -> Drawn {
        Ok(())
    }

    fn draw_pixel(&mut self, (x, y): BackendCoord, color: BackendColor) -> Drawn {
        self.draw_rect((x, y), (x + 1, y + 1), &color, true)
    }

    fn draw_line<St: BackendStyle>(&mut self, from: BackendCoord, to: BackendCoord, style: &St) -> Drawn {
        self.draw_path([from, to], style)
    }

    fn draw_rect<St: BackendStyle>(&mut self, from: BackendCoord, to: BackendCoord, style: &St, fill: bool) -> Drawn {
        let (left, right) = (from.0.min(to.0) as f32, from.0.max(to.0) as f32);
        let (top, bottom) = (from.1.min(to.1) as f32, from.1.max(to.1) as f32);
        let sides = Rect::from_ltrb(left, top, right, bottom);
        self.paint(sides.map(PathBuilder::from_rect), style, fill)
    }

    fn draw_path<St: BackendStyle, I: IntoIterator<Item = BackendCoord>>(&mut self, points: I, style: &St) -> Drawn {
        let mut path = PathBuilder::new();
        trace(&mut path, points.into_iter());
        self.paint(path.finish(), style, false)
    }

    fn draw_circle<St: BackendStyle>(&mut self, at: BackendCoord, radius: u32, style: &St, fill: bool) -> Drawn {
        let Some(color) = visible(style.color()) else { return Ok(()) };
        self.surface.circle(at, radius, color, (!fill).then(|| f64::from(style.stroke_width()) / UNITS));
        Ok(())
    }

    fn fill_polygon<St: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        corners: I,
        style: &St,
    ) -> Drawn {
        let mut path = PathBuilder::new();
        trace(&mut path, corners.into_iter());
        path.close();
        self.paint(path.finish(), style, true)
    }

    /// Sets a label in the markup of this crate. "Top" is the top of the line, "center" the middle of its digits,
    /// "bottom" its baseline: texts of one row align, whatever accents and indices they have.
    fn draw_text<T: BackendTextStyle>(&mut self, text: &str, style: &T, at: BackendCoord) -> Drawn {
        let Some(color) = visible(style.color()) else { return Ok(()) };
        let label = Label::new(text, style.size()).map_err(DrawingErrorKind::DrawingError)?;
        let along = match style.anchor().h_pos {
            HPos::Left => 0.0,
            HPos::Center => -label.width / 2.0,
            HPos::Right => -label.width,
        };
        let down = match style.anchor().v_pos {
            VPos::Top => label.line_top(),
            VPos::Center => label.middle(),
            VPos::Bottom => 0.0,
        };
        let turn = style.transform();
        let place = |x: f64, y: f64| {
            let (right, below) = turn.transform((along + x).round() as i32, (down + y).round() as i32);
            ((at.0 + right) as f32, (at.1 + below) as f32)
        };
        if let Some(path) = label.outline(place).map_err(DrawingErrorKind::DrawingError)? {
            self.surface.fill(&path, color);
        }
        Ok(())
    }

    fn estimate_text_size<T: BackendTextStyle>(
        &self,
        text: &str,
        style: &T,
    ) -> Result<(u32, u32), DrawingErrorKind<PlotError>> {
        let label = Label::new(text, style.size()).map_err(DrawingErrorKind::DrawingError)?;
        Ok((label.width.ceil() as u32, label.line_top().ceil() as u32))
    }
}
