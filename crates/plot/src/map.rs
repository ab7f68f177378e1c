//! Map panels: a matrix in colours, with its zero contour, region names and curves on top.

use crate::axis::Axis;
use crate::color_scale::ColorScale;
use crate::contour::zero_lines;
use crate::elements::{Area, Shape, sides};
use crate::error::PlotError;
use crate::frame::{Frame, Margins};
use crate::geometry::{Point, Rect};
use crate::grid::PanelBox;
use crate::label::Label;
use crate::page::Pen;
use crate::picture::Panel;
use crate::raster::Raster;
use crate::regions::widest_spot;
use crate::style::{CONTOUR_WIDTH, Color, INK, PANEL, PAPER, REGION, text};
use plotters_backend::text_anchor::{HPos, VPos};
use std::iter::once;

/// Pixels of the embedded image per cell, in each direction: values are interpolated in between.
const FINER: usize = 2;
/// Least space around a region's name, and step in which more is looked for, in millimetres.
const NAME_MARGIN: f64 = 0.2;

/// A panel of values over two axes.
#[derive(Debug, Clone)]
#[must_use]
pub struct Map {
    x: Axis,
    y: Axis,
    columns: usize,
    rows: usize,
    values: Vec<f64>,
    names: [String; 2],
}

impl Panel for Map {
    fn margins(&self) -> Result<Margins, PlotError> {
        self.frame().margins()
    }

    fn draw(&self, page: &Area, cell: &PanelBox, scale: Option<&ColorScale>) -> Result<(), PlotError> {
        let PanelBox { rect, room } = cell;
        let scale = scale.ok_or_else(|| PlotError("layout: this panel needs Picture::scale".to_owned()))?;
        let expected = self.columns * self.rows;
        if self.values.len() != expected || expected == 0 {
            let what = format!("a map of {} x {} cells", self.columns, self.rows);
            return Err(PlotError::length(&what, expected, self.values.len()));
        }
        let mut chart = self.frame().chart(page, rect, room)?;
        page.draw(&Shape::image(self.raster(scale), rect.corners()))?;
        chart.draw_series(once(Shape::line(self.contour(), Pen::solid(INK, CONTOUR_WIDTH), sides(&chart))))?;
        self.frame().draw(page, &mut chart)?;
        for (name, positive) in self.names.iter().zip([false, true]).filter(|(name, _)| !name.is_empty()) {
            let width = Label::new(name, REGION)?.width;
            let Some((spot, color)) = self.place(rect, width, positive, scale) else { continue };
            let style = text(REGION, color, HPos::Center, VPos::Center);
            page.draw_text(name, &style, chart.backend_coord(&self.at(spot)))?;
        }
        Ok(())
    }
}

impl Map {
    /// Values at the centres of `columns` x `rows` cells of equal size on paper that fill the ranges of the axes (both
    /// linear): `values[row * columns + column]`, the first row lowest. NaN marks a cell without value.
    pub fn new(x: Axis, y: Axis, columns: usize, rows: usize, values: Vec<f64>) -> Self {
        Self { x, y, columns, rows, values, names: Default::default() }
    }

    /// Names (markup) of the regions where values are negative and where they are positive. Each stands once, where its
    /// region is widest, black or white as the ground asks; a region without room for it has none.
    pub fn names(mut self, negative: &str, positive: &str) -> Self {
        self.names = [negative.to_owned(), positive.to_owned()];
        self
    }

    fn frame(&self) -> Frame<'_> {
        Frame { x: &self.x, y: &self.y, sizes: PANEL }
    }

    /// The place, counted in cells, and the colour of a region's name with the given width in millimetres.
    fn place(&self, rect: &Rect, width: f64, positive: bool, scale: &ColorScale) -> Option<(Point, Color)> {
        // from millimetres to cells
        let (across, up) = (self.columns as f64 / rect.width, self.rows as f64 / rect.height);
        let room = ((width + 2.0 * NAME_MARGIN) * across, (REGION + 2.0 * NAME_MARGIN) * up);
        let margin = (NAME_MARGIN * across, NAME_MARGIN * up);
        let spot = widest_spot((self.columns, self.rows), &self.values, positive, room, margin)?;
        // black or white, whichever reads better on most of the name
        let dark = |tenth: &u32| {
            let along = spot.0 + (f64::from(*tenth) / 10.0 - 0.5) * width * across;
            is_dark(scale.color(self.value(along, spot.1)))
        };
        Some((spot, if (0..=10).filter(dark).count() > 5 { PAPER } else { INK }))
    }

    /// The data point at a place counted in cells from the lower left corner.
    fn at(&self, (x, y): Point) -> Point {
        (self.x.value(x / self.columns as f64), self.y.value(y / self.rows as f64))
    }

    /// The zero lines in data coordinates, broken where one ends.
    fn contour(&self) -> Vec<Point> {
        let lines = zero_lines(self.columns, self.rows, &self.values);
        let broken = |line: Vec<Point>| line.into_iter().map(|point| self.at(point)).chain([(f64::NAN, f64::NAN)]);
        lines.into_iter().flat_map(broken).collect()
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

    /// The surface at a place counted in cells from the lower left corner; flat beyond the outer centres, and in cells
    /// beside one without value, which so hides no other.
    fn value(&self, x: f64, y: f64) -> f64 {
        let (left, right, across) = neighbours(x, self.columns);
        let (below, above, up) = neighbours(y, self.rows);
        let cell = |column: usize, row: usize| self.values[row * self.columns + column];
        let blend = |start: f64, end: f64, share: f64| if share == 0.0 { start } else { start + share * (end - start) };
        let lower = blend(cell(left, below), cell(right, below), across);
        let upper = blend(cell(left, above), cell(right, above), across);
        let surface = blend(lower, upper, up);
        let own = |place: f64, count: usize| (place as usize).min(count - 1);
        if surface.is_nan() { cell(own(x, self.columns), own(y, self.rows)) } else { surface }
    }
}

/// The cells whose centres enclose a place counted in cells, and the share of the way to the second.
fn neighbours(place: f64, count: usize) -> (usize, usize, f64) {
    let place = (place - 0.5).clamp(0.0, (count - 1) as f64);
    let first = place as usize;
    (first, (first + 1).min(count - 1), place - first as f64)
}

/// Whether white text reads better than black. The weights are those of Rec. 709 on the coded bytes; 115 of 255 is
/// where both texts have about the same contrast.
pub(crate) fn is_dark(color: Color) -> bool {
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
    fn a_missing_value_hides_no_other_cell() {
        let panel = map(vec![1.0, f64::NAN, 3.0, 4.0, 5.0, 6.0]);
        assert_eq!((panel.value(0.5, 0.5), panel.value(0.9, 0.9), panel.value(2.1, 0.1)), (1.0, 1.0, 3.0));
        assert!(panel.value(1.0, 0.5).is_nan() && panel.value(1.9, 0.9).is_nan());
        assert_eq!(panel.value(1.5, 1.1), 5.0);
        assert_eq!(panel.value(1.5, 1.5), 5.0);
    }

    #[test]
    fn text_is_white_on_the_dark_end_and_black_elsewhere() {
        let scale = ColorScale::diverging("", [-1.0, 1.0]);
        assert!(is_dark(scale.color(1.0)) && !is_dark(scale.color(0.0)) && !is_dark(scale.color(-1.0)));
    }
}
