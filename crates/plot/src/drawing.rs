//! Free sketches from a few primitives: lines, arrows, dimensions, boxes, discs and labels.

use crate::color_scale::ColorScale;
use crate::elements::{Area, EVERYWHERE, Shape};
use crate::error::PlotError;
use crate::frame::Margins;
use crate::geometry::Point;
use crate::grid::PanelBox;
use crate::page::{Pen, units};
use crate::picture::Panel;
use crate::style::{AXIS_WIDTH, Color, INK, PANEL, POINT, REFERENCE_DASH, pen, text};
use plotters::element::{Circle, PathElement, Polygon, Rectangle};
use plotters::style::Color as _;
use plotters_backend::BackendCoord;
use plotters_backend::text_anchor::{HPos, VPos};

/// Length of an arrow's head.
const HEAD_LENGTH: f64 = 1.9;
/// Half the width of an arrow's head at its base.
const HEAD_HALF_WIDTH: f64 = 0.62;

/// Draws one thing on a page; the function says where a point of the sketch lies on it.
type Item = dyn Fn(&Area, &dyn Fn(Point) -> BackendCoord) -> Result<(), PlotError>;

/// A sketch. Points are (x, y) in millimetres from the panel's lower left corner, y upwards; what is added later lies
/// above.
#[derive(Default)]
#[must_use]
pub struct Drawing {
    items: Vec<Box<Item>>,
}

impl Drawing {
    /// An empty sketch.
    pub fn new() -> Self {
        Self::default()
    }

    /// A solid line; `points` is its width in typographic points.
    pub fn line(self, from: Point, to: Point, points: f64) -> Self {
        let pen = pen(INK, points * POINT);
        self.add(move |page, at| Ok(page.draw(&PathElement::new([at(from), at(to)], pen))?))
    }

    /// A thin dashed line.
    pub fn dashed(self, from: Point, to: Point) -> Self {
        let pen = Pen::dashed(INK, AXIS_WIDTH, REFERENCE_DASH);
        self.add(move |page, at| Ok(page.draw(&Shape::line(vec![at(from), at(to)], pen, EVERYWHERE))?))
    }

    /// An arrow with its head at `to`; `points` is its width in typographic points.
    pub fn arrow(self, from: Point, to: Point, points: f64) -> Self {
        self.add(move |page, at| arrow(page, at, [from, to], false, points * POINT))
    }

    /// A thin arrow with heads at both ends, as for a length.
    pub fn dimension(self, from: Point, to: Point) -> Self {
        self.add(move |page, at| arrow(page, at, [from, to], true, AXIS_WIDTH))
    }

    /// A filled box between two opposite corners, with a thin outline.
    pub fn rectangle(self, corner: Point, opposite: Point, fill: Color) -> Self {
        self.add(move |page, at| {
            page.draw(&Rectangle::new([at(corner), at(opposite)], fill.filled()))?;
            Ok(page.draw(&Rectangle::new([at(corner), at(opposite)], pen(INK, AXIS_WIDTH)))?)
        })
    }

    /// A small black disc.
    pub fn dot(self, center: Point, radius: f64) -> Self {
        self.add(move |page, at| Ok(page.draw(&Circle::new(at(center), units(radius), INK.filled()))?))
    }

    /// A label (markup, 8.5 pt) centred at a point, in both directions.
    pub fn label(self, words: &str, place: Point) -> Self {
        let (words, style) = (words.to_owned(), text(PANEL.label, INK, HPos::Center, VPos::Center));
        self.add(move |page, at| Ok(page.draw_text(&words, &style, at(place))?))
    }

    fn add(mut self, item: impl Fn(&Area, &dyn Fn(Point) -> BackendCoord) -> Result<(), PlotError> + 'static) -> Self {
        self.items.push(Box::new(item));
        self
    }
}

impl Panel for Drawing {
    fn margins(&self) -> Result<Margins, PlotError> {
        Ok(Margins::default())
    }

    fn draw(&self, page: &Area, cell: &PanelBox, _: Option<&ColorScale>) -> Result<(), PlotError> {
        let rect = cell.rect;
        let at = |(x, y): Point| (units(rect.left + x), units(rect.bottom() - y));
        self.items.iter().try_for_each(|item| item(page, &at))
    }
}

/// A line with one head or two; nothing if both ends coincide.
fn arrow(
    page: &Area,
    on_page: &dyn Fn(Point) -> BackendCoord,
    [from, to]: [Point; 2],
    both: bool,
    width: f64,
) -> Result<(), PlotError> {
    let (dx, dy) = (to.0 - from.0, to.1 - from.1);
    let length = (dx * dx + dy * dy).sqrt();
    if !(length > 0.0 && length.is_finite()) {
        return Ok(());
    }
    let (ux, uy) = (dx / length, dy / length);
    // Heads grow a little with the shaft, and never longer than what there is room for.
    let (wanted, room) = (HEAD_LENGTH + 1.5 * width, if both { 0.45 * length } else { 0.9 * length });
    let head = if wanted < room { wanted } else { room };
    let half = HEAD_HALF_WIDTH / HEAD_LENGTH * head;
    let tip = |at: Point, sign: f64| -> Result<Point, PlotError> {
        let base = (at.0 - sign * head * ux, at.1 - sign * head * uy);
        let side = |turn: f64| (base.0 - turn * half * uy, base.1 + turn * half * ux);
        page.draw(&Polygon::new([at, side(1.0), side(-1.0)].map(on_page), INK.filled()))?;
        Ok((at.0 - sign * 0.7 * head * ux, at.1 - sign * 0.7 * head * uy))
    };
    let end = tip(to, 1.0)?;
    let start = if both { tip(from, -1.0)? } else { from };
    Ok(page.draw(&PathElement::new([start, end].map(on_page), pen(INK, width)))?)
}
