//! Drawing on one page in millimetres, on top of plotters' SVG backend.
//!
//! The backend counts in whole units; a unit is 0.01 mm here, below what a printer can show.
//! What the backend cannot say (dashes, paths of many pieces, images) is written as a piece of
//! SVG and stands behind a half-transparent placeholder, the only thing drawn that way.

use crate::color::Color;
use crate::error::PlotError;
use crate::font;
use crate::geometry::{Point, Rect};
use crate::label::Label;
use crate::raster::Raster;
use plotters::backend::{DrawingBackend, SVGBackend};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{FontStyle, FontTransform, IntoFont, RGBAColor, RGBColor, ShapeStyle, TextStyle};
use std::fmt::Write as _;

/// Units of the drawing in a millimetre.
pub(crate) const UNITS: f64 = 100.0;
/// plotters writes its font sizes divided by this.
const PLOTTERS_FONT_FACTOR: f64 = 1.24;
/// plotters moves a text of vertical position "top" down by this share of the font size.
const PLOTTERS_TOP: f64 = 0.76;

/// How a line is drawn.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Stroke {
    pub color: Color,
    /// Width in millimetres.
    pub width: f64,
    /// On, off, ... in millimetres; empty for a solid line.
    pub dash: &'static [f64],
}

impl Stroke {
    pub fn solid(color: Color, width: f64) -> Self {
        Self { color, width, dash: &[] }
    }

    pub fn dashed(color: Color, width: f64, dash: &'static [f64]) -> Self {
        Self { color, width, dash }
    }
}

/// Where a label's left, middle or right goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Align {
    Left,
    Center,
    Right,
}

/// The backend's own idea of a style: an opaque colour and a whole width.
fn pen(color: Color, width: f64) -> ShapeStyle {
    let color = RGBAColor(color.0, color.1, color.2, 1.0);
    ShapeStyle { color, filled: false, stroke_width: units(width).unsigned_abs() }
}

/// The style of placeholders.
const PLACEHOLDER: ShapeStyle = ShapeStyle { color: RGBAColor(0, 0, 0, 0.5), filled: true, stroke_width: 0 };

/// A page being drawn. Lengths are millimetres, the origin is the upper left corner.
pub(crate) struct Canvas<'a> {
    backend: SVGBackend<'a>,
    /// Pieces of SVG in the order of their placeholders.
    inserts: Vec<String>,
    /// The first thing that went wrong; reported by [`Canvas::finish`].
    failure: Option<String>,
}

fn units(length: f64) -> i32 {
    (length * UNITS).round() as i32
}

fn place((x, y): Point) -> (i32, i32) {
    (units(x), units(y))
}

impl<'a> Canvas<'a> {
    /// A white page that is written into `text`.
    pub fn new(text: &'a mut String, width: f64, height: f64) -> Self {
        let size = (units(width).unsigned_abs(), units(height).unsigned_abs());
        let backend = SVGBackend::with_string(text, size);
        let mut canvas = Self { backend, inserts: Vec::new(), failure: None };
        canvas.fill_rect(&Rect { left: 0.0, top: 0.0, width, height }, crate::style::PAPER);
        canvas
    }

    /// Ends the page; the pieces of SVG replace the placeholders, in order.
    ///
    /// # Errors
    /// [`PlotError::Backend`] if the backend reported anything on the way.
    pub fn finish(mut self) -> Result<Vec<String>, PlotError> {
        let end = self.backend.present();
        self.note(end);
        match self.failure {
            Some(reason) => Err(PlotError::Backend(reason)),
            None => Ok(self.inserts),
        }
    }

    fn note<E: std::fmt::Debug>(&mut self, result: Result<(), E>) {
        if let Err(reason) = result {
            self.failure.get_or_insert(format!("{reason:?}"));
        }
    }

    /// A polyline.
    pub fn line(&mut self, points: &[Point], stroke: &Stroke) {
        if stroke.dash.is_empty() {
            let pen = pen(stroke.color, stroke.width);
            let result = self.backend.draw_path(points.iter().map(|point| place(*point)), &pen);
            self.note(result);
        } else {
            self.lines(&[points.to_vec()], stroke);
        }
    }

    /// Many polylines of one stroke as one path.
    pub fn lines(&mut self, pieces: &[Vec<Point>], stroke: &Stroke) {
        let mut path = String::new();
        for piece in pieces {
            for (index, point) in piece.iter().enumerate() {
                let (x, y) = place(*point);
                let command = if index == 0 { 'M' } else { 'L' };
                path.push_str(&format!("{command}{x} {y}"));
            }
        }
        if path.is_empty() {
            return;
        }
        let dash: Vec<String> = stroke.dash.iter().map(|length| units(*length).to_string()).collect();
        let dash = if dash.is_empty() { String::new() } else { format!(" stroke-dasharray=\"{}\"", dash.join(" ")) };
        let (color, width) = (stroke.color.hex(), units(stroke.width));
        self.insert(format!("<path fill=\"none\" stroke=\"{color}\" stroke-width=\"{width}\"{dash} d=\"{path}\"/>"));
    }

    /// A filled polygon.
    pub fn polygon(&mut self, points: &[Point], color: Color) {
        let result = self.backend.fill_polygon(points.iter().map(|point| place(*point)), &pen(color, 0.0));
        self.note(result);
    }

    /// A filled box.
    pub fn fill_rect(&mut self, rect: &Rect, color: Color) {
        let (from, to) = (place((rect.left, rect.top)), place((rect.right(), rect.bottom())));
        let result = self.backend.draw_rect(from, to, &pen(color, 0.0), true);
        self.note(result);
    }

    /// The outline of a box.
    pub fn outline(&mut self, rect: &Rect, stroke: &Stroke) {
        self.closed(&rect.corners(), stroke);
    }

    /// The outline of a polygon.
    pub fn closed(&mut self, corners: &[Point], stroke: &Stroke) {
        // Starting in the middle of a side gives the first corner a join like the others.
        let Some((first, rest)) = corners.split_first() else { return };
        let Some(second) = rest.first() else { return };
        let middle = ((first.0 + second.0) / 2.0, (first.1 + second.1) / 2.0);
        let mut ring = vec![middle];
        ring.extend(rest);
        ring.extend([*first, middle]);
        self.line(&ring, stroke);
    }

    /// A circle, filled or as an outline of the given width in millimetres.
    pub fn circle(&mut self, center: Point, radius: f64, color: Color, width: Option<f64>) {
        let pen = pen(color, width.unwrap_or(0.0));
        let radius = units(radius).unsigned_abs();
        let result = self.backend.draw_circle(place(center), radius, &pen, width.is_none());
        self.note(result);
    }

    /// A label whose baseline starts, is centred or ends at a point.
    pub fn text(&mut self, label: &Label, at: Point, align: Align, color: Color) {
        let start = at.0 - before(label, align);
        for run in &label.runs {
            let down = run.y + PLOTTERS_TOP * run.size;
            self.run(&run.text, run.italic, run.size, (start + run.x, at.1 - down), FontTransform::None, color);
        }
    }

    /// A label that reads upwards, centred at a point of its baseline.
    pub fn text_upwards(&mut self, label: &Label, at: Point, color: Color) {
        let start = at.1 + before(label, Align::Center);
        for run in &label.runs {
            let aside = run.y + PLOTTERS_TOP * run.size;
            self.run(&run.text, run.italic, run.size, (at.0 - aside, start - run.x), FontTransform::Rotate270, color);
        }
    }

    fn run(&mut self, text: &str, italic: bool, size: f64, at: Point, turn: FontTransform, color: Color) {
        let face = if italic { FontStyle::Italic } else { FontStyle::Normal };
        let font = (font::FAMILY, size * UNITS * PLOTTERS_FONT_FACTOR).into_font().style(face).transform(turn);
        let ink = RGBColor(color.0, color.1, color.2);
        let style = TextStyle::from(font).color(&ink).pos(Pos::new(HPos::Left, VPos::Top));
        let result = self.backend.draw_text(text, &style, place(at));
        self.note(result);
    }

    /// An image stretched over a box; its pixels stay sharp squares.
    pub fn image(&mut self, raster: &Raster, rect: &Rect) -> Result<(), PlotError> {
        let mut image = String::new();
        let (left, top) = place((rect.left, rect.top));
        let (right, bottom) = place((rect.right(), rect.bottom()));
        let data = raster.data_url()?;
        write!(
            image,
            "<image x=\"{left}\" y=\"{top}\" width=\"{}\" height=\"{}\" preserveAspectRatio=\"none\" \
             image-rendering=\"optimizeSpeed\" style=\"image-rendering:pixelated\" href=\"{data}\"/>",
            right - left,
            bottom - top,
        )
        .map_err(|reason| PlotError::Backend(reason.to_string()))?;
        self.insert(image);
        Ok(())
    }

    fn insert(&mut self, svg: String) {
        let result = self.backend.draw_rect((0, 0), (1, 1), &PLACEHOLDER, true);
        self.note(result);
        self.inserts.push(svg);
    }
}

/// The part of a label that lies before its point.
fn before(label: &Label, align: Align) -> f64 {
    match align {
        Align::Left => 0.0,
        Align::Center => label.width / 2.0,
        Align::Right => label.width,
    }
}
