//! One curve or set of points of a line panel, and its look.

use crate::axes::Place;
use crate::canvas::{Canvas, Stroke};
use crate::color::Color;
use crate::geometry::{Point, clip, simplify};
use crate::style::{AXIS_WIDTH, DASHES, MARKER_RADIUS, PAPER, SERIES, SERIES_WIDTH};

/// Largest distance of a left-out point from the drawn line, in millimetres.
const TOLERANCE: f64 = 0.005;

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
    /// A line through points; a NaN (or a value not positive on a logarithmic axis) breaks it.
    /// A name (markup) puts it in the legend; empty for none.
    #[must_use]
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
    #[must_use]
    pub fn points(name: &str, marker: Marker, points: Vec<Point>) -> Self {
        Self { line: false, marker: Some(marker), ..Self::line(name, points) }
    }

    /// Adds markers to a line.
    #[must_use]
    pub fn marker(mut self, marker: Marker) -> Self {
        self.marker = Some(marker);
        self
    }

    /// Fills the markers with the series colour.
    #[must_use]
    pub fn filled(mut self) -> Self {
        self.filled = true;
        self
    }

    /// Draws a marker at every `step`-th point only.
    #[must_use]
    pub fn every(mut self, step: usize) -> Self {
        self.every = step.max(1);
        self
    }

    /// Takes the colour and dashes of the series at this place of the house cycle, instead of its own.
    #[must_use]
    pub fn look(mut self, index: usize) -> Self {
        self.look = Some(index);
        self
    }

    /// Draws the line solid, whatever its place in the cycle.
    #[must_use]
    pub fn solid(mut self) -> Self {
        self.dash = Some(0);
        self
    }

    /// Draws the line `factor` times as thick as usual.
    #[must_use]
    pub fn thick(mut self, factor: f64) -> Self {
        self.width = SERIES_WIDTH * factor;
        self
    }

    /// Draws the markers `factor` times as large as usual.
    #[must_use]
    pub fn marker_size(mut self, factor: f64) -> Self {
        self.radius = MARKER_RADIUS * factor;
        self
    }

    fn color(&self, index: usize) -> Color {
        SERIES[self.look.unwrap_or(index) % SERIES.len()]
    }

    fn stroke(&self, index: usize) -> Stroke {
        let dash = self.dash.or(self.look).unwrap_or(index);
        Stroke::dashed(self.color(index), self.width, DASHES[dash % DASHES.len()])
    }

    /// Draws the series that stands at place `index` of its panel.
    pub(crate) fn draw(&self, canvas: &mut Canvas, place: &Place, index: usize) {
        let points = place.all(&self.points);
        if self.line {
            let pieces: Vec<Vec<Point>> =
                clip(&points, &place.rect).iter().map(|piece| simplify(piece, TOLERANCE)).collect();
            canvas.lines(&pieces, &self.stroke(index));
        }
        for point in points.iter().step_by(self.every) {
            if place.rect.contains(*point) {
                self.draw_marker(canvas, *point, index);
            }
        }
    }

    /// Draws a sample of the series from `start` to `end`, both on one height.
    pub(crate) fn sample(&self, canvas: &mut Canvas, start: Point, end: Point, index: usize) {
        if self.line {
            canvas.line(&[start, end], &self.stroke(index));
        }
        self.draw_marker(canvas, ((start.0 + end.0) / 2.0, start.1), index);
    }

    /// The last point that lies in the box, on paper.
    pub(crate) fn end(&self, place: &Place) -> Option<Point> {
        place.all(&self.points).into_iter().rev().find(|point| place.rect.contains(*point))
    }

    fn draw_marker(&self, canvas: &mut Canvas, center: Point, index: usize) {
        let Some(marker) = self.marker else { return };
        let color = self.color(index);
        let corners = corners(marker, center, self.radius);
        match marker {
            Marker::Circle if self.filled => canvas.circle(center, self.radius, color, None),
            Marker::Circle => {
                canvas.circle(center, self.radius, PAPER, None);
                canvas.circle(center, self.radius, color, Some(1.4 * AXIS_WIDTH));
            }
            Marker::Plus | Marker::Cross => {
                let stroke = Stroke::solid(color, 1.4 * AXIS_WIDTH);
                canvas.line(&[corners[0], corners[2]], &stroke);
                canvas.line(&[corners[1], corners[3]], &stroke);
            }
            _ => {
                canvas.polygon(&corners, if self.filled { color } else { PAPER });
                canvas.closed(&corners, &Stroke::solid(color, 1.4 * AXIS_WIDTH));
            }
        }
    }
}

/// Corners of a marker; shapes are sized to cover about the same area as the circle.
fn corners(marker: Marker, (x, y): Point, radius: f64) -> Vec<Point> {
    match marker {
        Marker::Square | Marker::Cross => {
            let half = 0.89 * radius;
            vec![(x - half, y - half), (x + half, y - half), (x + half, y + half), (x - half, y + half)]
        }
        Marker::Triangle => {
            let (half, up, down) = (1.17 * radius, 1.35 * radius, 0.68 * radius);
            vec![(x, y - up), (x + half, y + down), (x - half, y + down)]
        }
        Marker::Diamond | Marker::Circle | Marker::Plus => {
            let half = 1.25 * radius;
            vec![(x, y - half), (x + half, y), (x, y + half), (x - half, y)]
        }
    }
}
