//! Panels of a matrix in colours with its zero contour, region names and curves over it.

use crate::axes::{Axes, Margins, Place};
use crate::axis::Axis;
use crate::canvas::{Align, Canvas, Stroke};
use crate::color::Color;
use crate::color_scale::ColorScale;
use crate::contour::zero_lines;
use crate::error::PlotError;
use crate::font::X_HEIGHT;
use crate::geometry::{Point, Rect, clip, simplify};
use crate::label::Label;
use crate::raster::Raster;
use crate::style::{AXIS_WIDTH, CONTOUR_WIDTH, INK, MARKER_RADIUS, PANEL, PAPER, REFERENCE_DASH, REGION};

/// Pixels of the embedded image per cell, in each direction: values are interpolated in between.
const FINER: usize = 2;
/// Largest distance of a left-out contour point from the drawn line, in millimetres.
const TOLERANCE: f64 = 0.005;

/// Least distance of a region's name from the box, in millimetres.
const TEXT_EDGE: f64 = 0.7;

/// A panel of values over two axes.
#[derive(Debug, Clone)]
pub struct Map {
    x: Axis,
    y: Axis,
    columns: usize,
    rows: usize,
    values: Vec<f64>,
    contour: bool,
    curves: Vec<Vec<Point>>,
    regions: Vec<(String, Point)>,
    points: Vec<(String, Point)>,
}

impl Map {
    /// Values at the centres of `columns` x `rows` cells of equal size on paper that fill the ranges
    /// of the axes: `values[row * columns + column]`, the first row lowest. NaN marks a cell without value.
    #[must_use]
    pub fn new(x: Axis, y: Axis, columns: usize, rows: usize, values: Vec<f64>) -> Self {
        Self { x, y, columns, rows, values, contour: true, curves: vec![], regions: vec![], points: vec![] }
    }

    /// Leaves out the zero contour (drawn as a solid black line by default).
    #[must_use]
    pub fn without_contour(mut self) -> Self {
        self.contour = false;
        self
    }

    /// Adds a dashed curve through data points.
    #[must_use]
    pub fn curve(mut self, points: Vec<Point>) -> Self {
        self.curves.push(points);
        self
    }

    /// Writes a region's name (markup) centred at a data point, moved inside the box if it would stick
    /// out; black or white as the ground asks.
    #[must_use]
    pub fn region(mut self, name: &str, at: Point) -> Self {
        self.regions.push((name.to_owned(), at));
        self
    }

    /// Marks a data point by a small white disc, with a name (markup, may be empty) at its right.
    #[must_use]
    pub fn point(mut self, name: &str, at: Point) -> Self {
        self.points.push((name.to_owned(), at));
        self
    }

    fn axes(&self) -> Axes<'_> {
        Axes { x: &self.x, y: &self.y, sizes: PANEL }
    }

    pub(crate) fn margins(&self) -> Result<Margins, PlotError> {
        self.axes().margins()
    }

    pub(crate) fn draw(
        &self,
        canvas: &mut Canvas,
        rect: Rect,
        room: Margins,
        scale: &ColorScale,
    ) -> Result<(), PlotError> {
        let expected = self.columns * self.rows;
        if self.values.len() != expected || expected == 0 {
            let what = format!("a map of {} x {} cells", self.columns, self.rows);
            return Err(PlotError::Length { what, expected, found: self.values.len() });
        }
        let place = Place { rect, x: &self.x, y: &self.y };
        canvas.image(&self.raster(scale), &rect)?;
        self.draw_lines(canvas, &place);
        self.axes().draw(canvas, rect, room)?;
        self.draw_points(canvas, &place, scale)?;
        self.draw_regions(canvas, &place, scale)
    }

    /// The colours of the bilinear surface through the cells' values.
    fn raster(&self, scale: &ColorScale) -> Raster {
        let (width, height) = (self.columns * FINER, self.rows * FINER);
        Raster::from_fn(width, height, scale.palette(), |column, row| {
            let x = (column as f64 + 0.5) / FINER as f64;
            let y = (height as f64 - row as f64 - 0.5) / FINER as f64;
            scale.shade(self.value(x, y)) as u8
        })
    }

    /// The surface at a place counted in cells from the lower left corner; flat beyond the outer centres.
    fn value(&self, x: f64, y: f64) -> f64 {
        let (left, right, across) = neighbours(x, self.columns);
        let (below, above, up) = neighbours(y, self.rows);
        let cell = |column: usize, row: usize| self.values[row * self.columns + column];
        let blend = |start: f64, end: f64, share: f64| if share == 0.0 { start } else { start + share * (end - start) };
        let lower = blend(cell(left, below), cell(right, below), across);
        let upper = blend(cell(left, above), cell(right, above), across);
        blend(lower, upper, up)
    }

    fn draw_lines(&self, canvas: &mut Canvas, place: &Place) {
        let rect = place.rect;
        for points in &self.curves {
            let pieces = clip(&place.all(points), &rect);
            canvas.lines(&pieces, &Stroke::dashed(INK, CONTOUR_WIDTH, REFERENCE_DASH));
        }
        if !self.contour {
            return;
        }
        let on_paper = |&(x, y): &Point| {
            (rect.left + x / self.columns as f64 * rect.width, rect.bottom() - y / self.rows as f64 * rect.height)
        };
        let contours = zero_lines(self.columns, self.rows, &self.values);
        let smooth = |line: &Vec<Point>| simplify(&line.iter().map(on_paper).collect::<Vec<_>>(), TOLERANCE);
        canvas.lines(&contours.iter().map(smooth).collect::<Vec<_>>(), &Stroke::solid(INK, CONTOUR_WIDTH));
    }

    fn draw_points(&self, canvas: &mut Canvas, place: &Place, scale: &ColorScale) -> Result<(), PlotError> {
        for (name, at) in &self.points {
            let center = place.at(*at);
            canvas.circle(center, MARKER_RADIUS, PAPER, None);
            canvas.circle(center, MARKER_RADIUS, INK, Some(1.4 * AXIS_WIDTH));
            let start = (center.0 + 2.0 * MARKER_RADIUS, center.1);
            self.write(canvas, &place.rect, &Label::new(name, REGION)?, start, scale);
        }
        Ok(())
    }

    fn draw_regions(&self, canvas: &mut Canvas, place: &Place, scale: &ColorScale) -> Result<(), PlotError> {
        for (name, at) in &self.regions {
            let (label, (x, y)) = (Label::new(name, REGION)?, place.at(*at));
            let start = x - label.width / 2.0;
            let room = place.rect.right() - TEXT_EDGE - label.width;
            let inside = start.min(room).max(place.rect.left + TEXT_EDGE);
            self.write(canvas, &place.rect, &label, (inside, y), scale);
        }
        Ok(())
    }

    /// Writes a label whose middle line starts at a point, black or white, whichever reads better
    /// on most of its length.
    fn write(&self, canvas: &mut Canvas, rect: &Rect, label: &Label, (x, y): Point, scale: &ColorScale) {
        let row = (rect.bottom() - y) / rect.height * self.rows as f64;
        let dark = |tenth: &u32| {
            let along = x + label.width * f64::from(*tenth) / 10.0;
            is_dark(scale.color(self.value((along - rect.left) / rect.width * self.columns as f64, row)))
        };
        let color = if (0..=10).filter(dark).count() > 5 { PAPER } else { INK };
        canvas.text(label, (x, y + X_HEIGHT * REGION / 2.0), Align::Left, color);
    }
}

/// The cells whose centres enclose a place counted in cells, and the share of the way to the second.
fn neighbours(place: f64, count: usize) -> (usize, usize, f64) {
    let place = (place - 0.5).clamp(0.0, (count - 1) as f64);
    let first = place as usize;
    (first, (first + 1).min(count - 1), place - first as f64)
}

/// Whether white text reads better than black. The weights are those of Rec. 709 on the coded
/// bytes; 115 of 255 is where both texts have about the same contrast.
fn is_dark(color: Color) -> bool {
    let light = 0.2126 * f64::from(color.0) + 0.7152 * f64::from(color.1) + 0.0722 * f64::from(color.2);
    light < 115.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map(values: Vec<f64>) -> Map {
        Map::new(Axis::linear("", 0.0, 3.0), Axis::linear("", 0.0, 2.0), 3, 2, values)
    }

    #[test]
    fn values_stand_at_the_centres_of_their_cells() {
        let panel = map(vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
        assert_eq!((panel.value(0.5, 0.5), panel.value(2.5, 0.5)), (1.0, 3.0));
        assert_eq!((panel.value(0.5, 1.5), panel.value(1.5, 1.5)), (4.0, 5.0));
        assert_eq!(panel.value(1.0, 1.0), 3.0);
        // Flat beyond the outer centres.
        assert_eq!((panel.value(0.0, 0.0), panel.value(3.0, 2.0)), (1.0, 6.0));
    }

    #[test]
    fn a_missing_value_hides_only_its_neighbourhood() {
        let panel = map(vec![1.0, f64::NAN, 3.0, 4.0, 5.0, 6.0]);
        assert_eq!(panel.value(0.5, 0.5), 1.0);
        assert!(panel.value(1.0, 0.5).is_nan());
        assert_eq!(panel.value(1.5, 1.5), 5.0);
    }

    #[test]
    fn text_is_white_on_dark_ends_and_black_on_the_middle() {
        let scale = ColorScale::diverging("", 1.0);
        assert!(is_dark(scale.color(-1.0)) && is_dark(scale.color(1.0)) && !is_dark(scale.color(0.0)));
    }
}
