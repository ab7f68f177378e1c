//! Free sketches from a few primitives: lines, arrows, dimensions, boxes, discs, circles and labels.

use crate::canvas::{Align, Canvas, Stroke};
use crate::color::Color;
use crate::error::PlotError;
use crate::font::X_HEIGHT;
use crate::geometry::{Point, Rect};
use crate::label::Label;
use crate::style::{AXIS_WIDTH, INK, NOTE, PANEL, REFERENCE_DASH};

/// Length of an arrow's head.
const HEAD_LENGTH: f64 = 1.9;
/// Half the width of an arrow's head at its base.
const HEAD_HALF_WIDTH: f64 = 0.62;

/// One thing in a sketch; the order is the order of drawing.
#[derive(Debug, Clone)]
enum Item {
    Line { points: Vec<Point>, width: f64, dashed: bool, color: Color },
    Arrow { from: Point, to: Point, both: bool, width: f64 },
    Polygon { corners: Vec<Point>, fill: Option<Color>, outlined: bool },
    Circle { center: Point, radius: f64, fill: Option<Color>, outlined: bool },
    Text { text: String, at: Point, align: Align, size: f64 },
}

/// A sketch. Points are (x, y) in millimetres from the panel's lower left corner, y upwards.
#[derive(Debug, Clone, Default)]
pub struct Drawing {
    items: Vec<Item>,
}

impl Drawing {
    /// An empty sketch.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// A solid polyline; `points` is its width in typographic points.
    #[must_use]
    pub fn line(self, path: &[Point], points: f64) -> Self {
        self.add(Item::Line { points: path.to_vec(), width: points * crate::style::POINT, dashed: false, color: INK })
    }

    /// A thin dashed polyline.
    #[must_use]
    pub fn dashed(self, path: &[Point]) -> Self {
        self.add(Item::Line { points: path.to_vec(), width: AXIS_WIDTH, dashed: true, color: INK })
    }

    /// An arrow with its head at `to`; `points` is its width in typographic points.
    #[must_use]
    pub fn arrow(self, from: Point, to: Point, points: f64) -> Self {
        self.add(Item::Arrow { from, to, both: false, width: points * crate::style::POINT })
    }

    /// A thin arrow with heads at both ends, as for a length.
    #[must_use]
    pub fn dimension(self, from: Point, to: Point) -> Self {
        self.add(Item::Arrow { from, to, both: true, width: AXIS_WIDTH })
    }

    /// A box between two opposite corners, with a thin outline and, if wanted, a fill.
    #[must_use]
    pub fn rectangle(self, corner: Point, opposite: Point, fill: Option<Color>) -> Self {
        let corners = vec![corner, (opposite.0, corner.1), opposite, (corner.0, opposite.1)];
        self.add(Item::Polygon { corners, fill, outlined: true })
    }

    /// A filled polygon without outline.
    #[must_use]
    pub fn polygon(self, corners: &[Point], fill: Color) -> Self {
        self.add(Item::Polygon { corners: corners.to_vec(), fill: Some(fill), outlined: false })
    }

    /// A circle with a thin outline and, if wanted, a fill.
    #[must_use]
    pub fn circle(self, center: Point, radius: f64, fill: Option<Color>) -> Self {
        self.add(Item::Circle { center, radius, fill, outlined: true })
    }

    /// A small black disc.
    #[must_use]
    pub fn dot(self, center: Point, radius: f64) -> Self {
        self.add(Item::Circle { center, radius, fill: Some(INK), outlined: false })
    }

    /// A label (markup, 8.5 pt) centred at a point, in both directions.
    #[must_use]
    pub fn label(self, text: &str, at: Point) -> Self {
        self.add(Item::Text { text: text.to_owned(), at, align: Align::Center, size: PANEL.label })
    }

    /// A smaller label (markup, 7.5 pt) that starts at a point.
    #[must_use]
    pub fn note(self, text: &str, at: Point) -> Self {
        self.add(Item::Text { text: text.to_owned(), at, align: Align::Left, size: NOTE })
    }

    fn add(mut self, item: Item) -> Self {
        self.items.push(item);
        self
    }

    pub(crate) fn draw(&self, canvas: &mut Canvas, rect: Rect) -> Result<(), PlotError> {
        let on_page = |(x, y): Point| (rect.left + x, rect.bottom() - y);
        for item in &self.items {
            match item {
                Item::Line { points, width, dashed, color } => {
                    let dash = if *dashed { REFERENCE_DASH } else { &[] };
                    let points: Vec<Point> = points.iter().map(|point| on_page(*point)).collect();
                    canvas.line(&points, &Stroke::dashed(*color, *width, dash));
                }
                Item::Arrow { from, to, both, width } => arrow(canvas, on_page(*from), on_page(*to), *both, *width),
                Item::Polygon { corners, fill, outlined } => {
                    let corners: Vec<Point> = corners.iter().map(|corner| on_page(*corner)).collect();
                    if let Some(fill) = fill {
                        canvas.polygon(&corners, *fill);
                    }
                    if *outlined {
                        canvas.closed(&corners, &Stroke::solid(INK, AXIS_WIDTH));
                    }
                }
                Item::Circle { center, radius, fill, outlined } => {
                    if let Some(fill) = fill {
                        canvas.circle(on_page(*center), *radius, *fill, None);
                    }
                    if *outlined {
                        canvas.circle(on_page(*center), *radius, INK, Some(AXIS_WIDTH));
                    }
                }
                Item::Text { text, at, align, size } => {
                    let (x, y) = on_page(*at);
                    canvas.text(&Label::new(text, *size)?, (x, y + X_HEIGHT * size / 2.0), *align, INK);
                }
            }
        }
        Ok(())
    }
}

/// A line with one head or two; nothing if both ends coincide.
fn arrow(canvas: &mut Canvas, from: Point, to: Point, both: bool, width: f64) {
    let (dx, dy) = (to.0 - from.0, to.1 - from.1);
    let length = (dx * dx + dy * dy).sqrt();
    if !(length > 0.0 && length.is_finite()) {
        return;
    }
    let (ux, uy) = (dx / length, dy / length);
    // Heads grow a little with the shaft, and never longer than what there is room for.
    let head = f64::min(HEAD_LENGTH + 1.5 * width, if both { 0.45 * length } else { 0.9 * length });
    let half = HEAD_HALF_WIDTH / HEAD_LENGTH * head;
    let mut tip = |at: Point, sign: f64| {
        let base = (at.0 - sign * head * ux, at.1 - sign * head * uy);
        let side = |turn: f64| (base.0 - turn * half * uy, base.1 + turn * half * ux);
        canvas.polygon(&[at, side(1.0), side(-1.0)], INK);
        (at.0 - sign * 0.7 * head * ux, at.1 - sign * 0.7 * head * uy)
    };
    let end = tip(to, 1.0);
    let start = if both { tip(from, -1.0) } else { from };
    canvas.line(&[start, end], &Stroke::solid(INK, width));
}
