//! A curve or point set of a line panel, and its style.

use crate::elements::{Area, Chart, EVERYWHERE, Mark, Shape, sides};
use crate::error::PlotError;
use crate::geometry::{Point, Rect};
use crate::page::Pen;
use crate::style::{Color, DASHES, MARKER_RADIUS, SERIES, SERIES_WIDTH};
use plotters_backend::BackendCoord;
use std::iter::once;

/// Shape of a point marker.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Marker {
    /// A circle.
    Circle,
    /// A square on its side.
    Square,
    /// A triangle on its base.
    Triangle,
    /// A square on its corner.
    Diamond,
    /// An upright cross, two strokes.
    Plus,
    /// A slanting cross, two strokes.
    Cross,
}

/// A series of points in data coordinates, drawn as a line, as markers, or both.
#[derive(Debug, Clone)]
#[must_use]
pub struct Series {
    pub(crate) name: String,
    points: Vec<Point>,
    line: bool,
    marker: Option<Marker>,
    filled: bool,
    every: usize,
    look: Option<usize>,
    dash: Option<usize>,
    width: f64,
    radius: f64,
}

impl Series {
    /// A line through points; a NaN (or a value not positive on a logarithmic axis) breaks it. A name (markup) puts it
    /// in the legend; empty for none.
    pub fn line(name: &str, points: Vec<Point>) -> Self {
        Self {
            name: name.to_owned(),
            points,
            line: true,
            marker: None,
            filled: false,
            every: 1,
            look: None,
            dash: None,
            width: SERIES_WIDTH,
            radius: MARKER_RADIUS,
        }
    }

    /// Hollow markers without a line, as for published data.
    pub fn points(name: &str, marker: Marker, points: Vec<Point>) -> Self {
        Self { line: false, marker: Some(marker), ..Self::line(name, points) }
    }

    /// Adds markers to a line.
    pub fn marker(mut self, marker: Marker) -> Self {
        self.marker = Some(marker);
        self
    }

    /// Fills the markers with the series colour.
    pub fn filled(mut self) -> Self {
        self.filled = true;
        self
    }

    /// Draws a marker at every `step`-th point only.
    pub fn every(mut self, step: usize) -> Self {
        self.every = step.max(1);
        self
    }

    /// Takes the colour and dashes of the series at this place of the house cycle, instead of its own.
    pub fn look(mut self, index: usize) -> Self {
        self.look = Some(index);
        self
    }

    /// Draws the line solid, whatever its place in the cycle.
    pub fn solid(mut self) -> Self {
        self.dash = Some(0);
        self
    }

    /// Draws the line `factor` times as thick as usual.
    pub fn thick(mut self, factor: f64) -> Self {
        self.width = SERIES_WIDTH * factor;
        self
    }

    /// Draws the markers `factor` times as large as usual.
    pub fn marker_size(mut self, factor: f64) -> Self {
        self.radius = MARKER_RADIUS * factor;
        self
    }

    fn color(&self, index: usize) -> Color {
        SERIES[self.look.unwrap_or(index) % SERIES.len()]
    }

    fn pen(&self, index: usize) -> Pen {
        let dash = self.dash.or(self.look).unwrap_or(index);
        Pen::dashed(self.color(index), self.width, DASHES[dash % DASHES.len()])
    }

    fn mark<C>(&self, at: C, index: usize, sides: Rect) -> Option<Shape<C>> {
        let (color, radius, filled) = (self.color(index), self.radius, self.filled);
        self.marker.map(|marker| Shape::mark(at, Mark { marker, radius, color, filled }, sides))
    }

    /// Draws the series that stands at place `index` of its panel.
    pub(crate) fn draw(&self, chart: &mut Chart, index: usize) -> Result<(), PlotError> {
        let sides = sides(chart);
        if self.line {
            chart.draw_series(once(Shape::line(self.points.clone(), self.pen(index), sides)))?;
        }
        let points = self.points.iter().step_by(self.every);
        chart.draw_series(points.filter_map(|point| self.mark(*point, index, sides)))?;
        Ok(())
    }

    /// Draws a sample of the series between two points of one height.
    pub(crate) fn sample(&self, page: &Area, ends: [BackendCoord; 2], index: usize) -> Result<(), PlotError> {
        let [start, end] = ends;
        if self.line {
            page.draw(&Shape::line(ends.to_vec(), self.pen(index), EVERYWHERE))?;
        }
        if let Some(mark) = self.mark(((start.0 + end.0) / 2, start.1), index, EVERYWHERE) {
            page.draw(&mark)?;
        }
        Ok(())
    }
}

impl Marker {
    /// Corners around a point; shapes are sized to cover about the same area as the circle.
    pub(crate) fn corners(self, (x, y): BackendCoord, radius: f64) -> Vec<BackendCoord> {
        let corners: &[Point] = match self {
            Marker::Square | Marker::Cross => &[(-0.89, -0.89), (0.89, -0.89), (0.89, 0.89), (-0.89, 0.89)],
            Marker::Triangle => &[(0.0, -1.35), (1.17, 0.68), (-1.17, 0.68)],
            _ => &[(0.0, -1.25), (1.25, 0.0), (0.0, 1.25), (-1.25, 0.0)],
        };
        let at = |&(right, down): &Point| (x + (right * radius).round() as i32, y + (down * radius).round() as i32);
        corners.iter().map(at).collect()
    }
}
