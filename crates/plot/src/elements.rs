//! Elements of panels that plotters lacks: dashed lines that end at the box, point markers, images.

use crate::axis::{Axis, NOWHERE};
use crate::error::PlotError;
use crate::geometry::{Point, Rect, clip, simplify};
use crate::page::{Page, Pen, Surface, UNITS, units};
use crate::pixels::Pixels;
use crate::raster::Raster;
use crate::series::Marker;
use crate::style::{AXIS_WIDTH, Color, PAPER, pen};
use crate::svg::Svg;
use plotters::chart::ChartContext;
use plotters::coord::cartesian::Cartesian2d;
use plotters::coord::{CoordTranslate, Shift};
use plotters::drawing::{self, DrawingArea, DrawingAreaErrorKind};
use plotters::element::{CoordMapper, Drawable, PointCollection};
use plotters_backend::{BackendCoord, DrawingBackend, DrawingErrorKind};

/// The page of a picture: both of its files.
pub type Paper = Page<(Svg, Pixels)>;
/// A part of the page, counted in units.
pub type Area = DrawingArea<Paper, Shift>;
/// A part of the page with axes.
pub(crate) type Chart = ChartContext<'static, Paper, Cartesian2d<Axis, Axis>>;

impl From<DrawingAreaErrorKind<PlotError>> for PlotError {
    fn from(error: DrawingAreaErrorKind<PlotError>) -> Self {
        match error {
            DrawingAreaErrorKind::BackendError(DrawingErrorKind::DrawingError(error)) => error,
            other => Self(format!("drawing: {other}")),
        }
    }
}

/// From data to the page, also beyond the box: plotters' own way moves such points to the edge of the box, which bends
/// the lines to them.
pub(crate) struct Everywhere;

impl CoordMapper for Everywhere {
    type Output = BackendCoord;

    fn map<CT: CoordTranslate>(coordinates: &CT, from: &CT::From, _: &drawing::Rect) -> BackendCoord {
        coordinates.translate(from)
    }
}

/// The whole plane.
pub(crate) const EVERYWHERE: Rect = Rect { left: 0.0, top: 0.0, width: f64::INFINITY, height: f64::INFINITY };

/// The box of a chart on the page, in units.
pub(crate) fn sides(chart: &Chart) -> Rect {
    let (across, down) = chart.plotting_area().get_pixel_range();
    Rect {
        left: f64::from(across.start),
        top: f64::from(down.start),
        width: f64::from(across.end - across.start),
        height: f64::from(down.end - down.start),
    }
}

type Draw = dyn Fn(Vec<BackendCoord>, &mut Paper) -> Result<(), DrawingErrorKind<PlotError>>;

/// Something at points of an area or a chart.
pub(crate) struct Shape<C> {
    points: Vec<C>,
    draw: Box<Draw>,
}

impl<'a, C> PointCollection<'a, C, Everywhere> for &'a Shape<C> {
    type Point = &'a C;
    type IntoIter = std::slice::Iter<'a, C>;

    fn point_iter(self) -> Self::IntoIter {
        self.points.iter()
    }
}

impl<C> Drawable<Paper, Everywhere> for Shape<C> {
    fn draw<I: Iterator<Item = BackendCoord>>(
        &self,
        points: I,
        page: &mut Paper,
        _: (u32, u32),
    ) -> Result<(), DrawingErrorKind<PlotError>> {
        (self.draw)(points.collect(), page)
    }
}

/// Largest distance of a left-out point from a drawn line, in millimetres.
const TOLERANCE: f64 = 0.01;

impl<C> Shape<C> {
    /// A line through points, drawn inside a box of the page; a point without a place breaks it.
    pub fn line(points: Vec<C>, pen: Pen, sides: Rect) -> Self {
        let draw = move |points: Vec<BackendCoord>, page: &mut Paper| {
            let place = |unit: i32| if unit == NOWHERE { f64::NAN } else { f64::from(unit) };
            let points: Vec<Point> = points.into_iter().map(|(x, y)| (place(x), place(y))).collect();
            let whole = |(x, y): Point| (x.round() as i32, y.round() as i32);
            let thin = |piece: &Vec<Point>| simplify(piece, TOLERANCE * UNITS).into_iter().map(whole).collect();
            let pieces: Vec<Vec<BackendCoord>> = clip(&points, &sides).iter().map(thin).collect();
            page.polylines(&pieces, &pen);
            Ok(())
        };
        Self { points, draw: Box::new(draw) }
    }

    /// A point marker; nothing where the point lies outside a box of the page.
    pub fn mark(at: C, mark: Mark, sides: Rect) -> Self {
        let draw = move |points: Vec<BackendCoord>, page: &mut Paper| {
            let [center] = points[..] else { return Ok(()) };
            let inside = sides.contains((f64::from(center.0), f64::from(center.1)));
            if inside { mark.draw(center, page) } else { Ok(()) }
        };
        Self { points: vec![at], draw: Box::new(draw) }
    }

    /// An image stretched over the box between two corners.
    pub fn image(raster: Raster, corners: [C; 2]) -> Self {
        let draw = move |corners: Vec<BackendCoord>, page: &mut Paper| {
            page.surface.image(&raster, corners[0], corners[1]).map_err(DrawingErrorKind::DrawingError)
        };
        Self { points: corners.into(), draw: Box::new(draw) }
    }
}

/// How a point marker looks.
#[derive(Clone, Copy)]
pub(crate) struct Mark {
    pub marker: Marker,
    /// In millimetres.
    pub radius: f64,
    pub color: Color,
    pub filled: bool,
}

impl Mark {
    fn draw(&self, center: BackendCoord, page: &mut Paper) -> Result<(), DrawingErrorKind<PlotError>> {
        let ground = if self.filled { self.color } else { PAPER };
        let line = pen(self.color, 1.4 * AXIS_WIDTH);
        let corners = self.marker.corners(center, self.radius * UNITS);
        match self.marker {
            Marker::Circle => {
                let radius = units(self.radius).unsigned_abs();
                page.draw_circle(center, radius, &ground, true)?;
                if self.filled { Ok(()) } else { page.draw_circle(center, radius, &line, false) }
            }
            Marker::Plus | Marker::Cross => {
                page.draw_path([corners[0], corners[2]], &line)?;
                page.draw_path([corners[1], corners[3]], &line)
            }
            _ => {
                page.fill_polygon(corners.iter().copied(), &ground)?;
                page.draw_path(closed(&corners), &line)
            }
        }
    }
}

/// A ring through corners that starts in the middle of a side, so that the first corner has a join like the others.
pub(crate) fn closed(corners: &[BackendCoord]) -> Vec<BackendCoord> {
    let [first, second, ..] = *corners else { return Vec::new() };
    let middle = ((first.0 + second.0) / 2, (first.1 + second.1) / 2);
    [&[middle], &corners[1..], &[first, middle]].concat()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::style::INK;
    use std::cell::RefCell;
    use std::rc::Rc;

    /// The SVG of a line inside a box of 10 mm x 10 mm.
    fn drawn(points: &[BackendCoord]) -> Result<String, PlotError> {
        let surfaces = (Svg::new(10.0, 10.0), Pixels::new(10.0, 10.0)?);
        let page = Rc::new(RefCell::new(Page::new((10_000, 10_000), surfaces)));
        let sides = Rect { left: 0.0, top: 0.0, width: 10_000.0, height: 10_000.0 };
        Area::from(&page).draw(&Shape::line(points.to_vec(), Pen::solid(INK, 0.2), sides))?;
        Ok(String::from_utf8_lossy(&page.borrow_mut().surface.0.finish()).into_owned())
    }

    #[test]
    fn a_line_that_leaves_the_box_keeps_its_direction() -> Result<(), PlotError> {
        let svg = drawn(&[(0, 0), (10_000, 40_000)])?;
        assert!(svg.contains("d=\"M0 0l2500 10000\""), "{svg}");
        Ok(())
    }

    #[test]
    fn a_point_without_a_place_breaks_the_line() -> Result<(), PlotError> {
        let svg = drawn(&[(0, 0), (500, 0), (NOWHERE, 0), (800, 0), (900, 100)])?;
        assert!(svg.contains("d=\"M0 0l500 0M800 0l100 100\""), "{svg}");
        Ok(())
    }
}
