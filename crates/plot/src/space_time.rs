//! Panels of many trajectories on a ring, coloured by speed, so that jams show as dark bands.

use crate::axes::{Axes, Margins, Place};
use crate::axis::Axis;
use crate::canvas::{Canvas, Stroke};
use crate::color_scale::ColorScale;
use crate::error::PlotError;
use crate::field::Snapshot;
use crate::geometry::{Point, Rect, clip, simplify};
use crate::raster::Raster;
use crate::style::{INK, PANEL, PAPER, REFERENCE_WIDTH};

/// Largest distance of a left-out point from the drawn line, in millimetres.
const TOLERANCE: f64 = 0.025;
/// How far a speed must leave its shade before the colour changes, in widths of a shade.
const PERSISTENCE: f64 = 0.3;
/// Width of a trajectory, in millimetres.
const LINE_WIDTH: f64 = 0.09;
/// Side of a pixel of a speed field, in millimetres.
const FIELD_PIXEL: f64 = 0.1;

/// One trajectory: samples of time, unwrapped position and speed, all of one length.
#[derive(Debug, Clone, Default)]
pub struct Trajectory {
    /// Times, rising.
    pub time: Vec<f64>,
    /// Positions, not reduced to the ring.
    pub position: Vec<f64>,
    /// Speeds; they choose the colour.
    pub speed: Vec<f64>,
}

/// A panel of trajectories.
#[derive(Debug, Clone)]
pub struct SpaceTime {
    time: Axis,
    position: Axis,
    length: f64,
    trajectories: Vec<Trajectory>,
    width: f64,
    every: usize,
    field: bool,
    window: Option<[f64; 4]>,
    time_upwards: bool,
}

impl SpaceTime {
    /// Trajectories on a ring of a given length (positive), drawn over the ranges of the two axes;
    /// positions on the axis lie between 0 and the length, and both axes are linear. The colour scale
    /// must be sequential.
    #[must_use]
    pub fn new(time: Axis, position: Axis, length: f64, trajectories: &[Trajectory]) -> Self {
        Self {
            time,
            position,
            length,
            trajectories: trajectories.to_vec(),
            width: LINE_WIDTH,
            every: 1,
            field: false,
            window: None,
            time_upwards: false,
        }
    }

    /// Draws trajectories this wide, in millimetres; 0.09 by default, more for a few trajectories.
    #[must_use]
    pub fn line_width(mut self, width: f64) -> Self {
        self.width = width;
        self
    }

    /// Draws only every `step`-th trajectory, where all of them would merge into one area.
    #[must_use]
    pub fn every(mut self, step: usize) -> Self {
        self.every = step.max(1);
        self
    }

    /// Fills the panel with the speed, linear in space between neighbouring trajectories, instead
    /// of lines: for panels where lines would lie closer than they can be printed. With
    /// [`SpaceTime::every`], the trajectories it chooses are drawn over the field in white.
    #[must_use]
    pub fn field(mut self) -> Self {
        self.field = true;
        self
    }

    /// Outlines a window, for instance the one that another panel enlarges.
    #[must_use]
    pub fn outline(mut self, time: [f64; 2], position: [f64; 2]) -> Self {
        self.window = Some([time[0], time[1], position[0], position[1]]);
        self
    }

    /// Lets time run upwards and position to the right, instead of time to the right.
    #[must_use]
    pub fn time_upwards(mut self) -> Self {
        self.time_upwards = true;
        self
    }

    fn place(&self, rect: Rect) -> Place<'_> {
        let (x, y) = if self.time_upwards { (&self.position, &self.time) } else { (&self.time, &self.position) };
        Place { rect, x, y }
    }

    fn axes(&self) -> Axes<'_> {
        let Place { x, y, .. } = self.place(Rect { left: 0.0, top: 0.0, width: 0.0, height: 0.0 });
        Axes { x, y, sizes: PANEL }
    }

    /// A data point in the order of the axes.
    fn turned(&self, (time, position): Point) -> Point {
        if self.time_upwards { (position, time) } else { (time, position) }
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
        self.check()?;
        let place = self.place(rect);
        if self.field {
            canvas.image(&self.raster(&place, scale), &rect)?;
            if self.every > 1 {
                self.draw_traces(canvas, &place, scale);
            }
        } else {
            self.draw_lines(canvas, &place, scale);
        }
        if let Some([from, to, low, high]) = self.window {
            let corners =
                [(from, low), (to, low), (to, high), (from, high)].map(|corner| place.at(self.turned(corner)));
            // A white rim keeps the outline visible on dark ground.
            canvas.closed(&corners, &Stroke::solid(PAPER, 3.0 * REFERENCE_WIDTH));
            canvas.closed(&corners, &Stroke::solid(INK, REFERENCE_WIDTH));
        }
        self.axes().draw(canvas, rect, room)
    }

    fn draw_lines(&self, canvas: &mut Canvas, place: &Place, scale: &ColorScale) {
        let palette = scale.palette();
        let mut shades: Vec<Vec<Vec<Point>>> = vec![Vec::new(); palette.len()];
        for trajectory in self.trajectories.iter().step_by(self.every) {
            for (shade, piece) in self.pieces(trajectory, scale) {
                let clipped = clip(&place.all(&piece), &place.rect);
                shades[shade].extend(clipped.iter().map(|piece| simplify(piece, TOLERANCE)));
            }
        }
        // The slow come last, on top: a jam must not vanish below those who left it.
        for (pieces, color) in shades.iter().zip(palette).rev() {
            canvas.lines(pieces, &Stroke::solid(color, self.width));
        }
    }

    /// The chosen trajectories in white.
    fn draw_traces(&self, canvas: &mut Canvas, place: &Place, scale: &ColorScale) {
        let mut traces = Vec::new();
        for trajectory in self.trajectories.iter().step_by(self.every) {
            for (_, piece) in self.pieces(trajectory, scale) {
                let clipped = clip(&place.all(&piece), &place.rect);
                traces.extend(clipped.iter().map(|piece| simplify(piece, TOLERANCE)));
            }
        }
        canvas.lines(&traces, &Stroke::solid(PAPER, self.width));
    }

    /// The speed field over the box, one pixel for each 0.1 mm.
    fn raster(&self, place: &Place, scale: &ColorScale) -> Raster {
        let pixels = |length: f64| ((length / FIELD_PIXEL).round() as usize).max(1);
        let (width, height) = (pixels(place.rect.width), pixels(place.rect.height));
        let right = |column: usize| (column as f64 + 0.5) / width as f64;
        let up = |row: usize| (height as f64 - row as f64 - 0.5) / height as f64;
        let snapshot = |fraction: f64| Snapshot::new(&self.trajectories, self.length, self.time.value(fraction));
        let shade = |now: &Snapshot, fraction: f64| scale.shade(now.speed(self.position.value(fraction))) as u8;
        if self.time_upwards {
            let times: Vec<Snapshot> = (0..height).map(|row| snapshot(up(row))).collect();
            Raster::from_fn(width, height, scale.palette(), |column, row| shade(&times[row], right(column)))
        } else {
            let times: Vec<Snapshot> = (0..width).map(|column| snapshot(right(column))).collect();
            Raster::from_fn(width, height, scale.palette(), |column, row| shade(&times[column], up(row)))
        }
    }

    fn check(&self) -> Result<(), PlotError> {
        if !(self.length.is_finite() && self.length > 0.0) {
            let valid = "the ring's length must be positive and finite";
            return Err(PlotError::Range { axis: self.position.label.clone(), from: 0.0, to: self.length, valid });
        }
        for axis in [&self.time, &self.position] {
            if axis.logarithmic {
                let valid = "a space-time panel needs linear axes";
                return Err(PlotError::Range { axis: axis.label.clone(), from: axis.from, to: axis.to, valid });
            }
        }
        for (index, trajectory) in self.trajectories.iter().enumerate() {
            let expected = trajectory.time.len();
            for (name, found) in [("positions", trajectory.position.len()), ("speeds", trajectory.speed.len())] {
                if found != expected {
                    return Err(PlotError::Length { what: format!("{name} of trajectory {index}"), expected, found });
                }
            }
        }
        Ok(())
    }

    /// Lines of one shade each, in the order of the axes, reduced to the ring.
    fn pieces(&self, trajectory: &Trajectory, scale: &ColorScale) -> Vec<(usize, Vec<Point>)> {
        let mut pieces: Vec<(usize, Vec<Point>)> = Vec::new();
        let mut before = None;
        for index in 1..trajectory.time.len() {
            let sample = |index: usize| (trajectory.time[index], trajectory.position[index]);
            let speed = (trajectory.speed[index - 1] + trajectory.speed[index]) / 2.0;
            let shade = match before {
                Some(old) if scale.beyond(speed, old) <= PERSISTENCE => old,
                _ => scale.shade(speed),
            };
            before = Some(shade);
            for [start, end] in on_ring(sample(index - 1), sample(index), self.length) {
                let (start, end) = (self.turned(start), self.turned(end));
                match pieces.last_mut() {
                    Some((last, piece)) if *last == shade && piece.last() == Some(&start) => piece.push(end),
                    _ => pieces.push((shade, vec![start, end])),
                }
            }
        }
        pieces
    }
}

/// A step from one (time, unwrapped position) to the next, reduced to the ring: one segment, or
/// two if the step passes the ring's seam. Steps of more than one ring length are not drawn.
fn on_ring(start: Point, end: Point, length: f64) -> Vec<[Point; 2]> {
    let (lap, next) = ((start.1 / length).floor(), (end.1 / length).floor());
    let reduced = |(time, position): Point, lap: f64| (time, position - lap * length);
    if lap == next {
        return vec![[reduced(start, lap), reduced(end, lap)]];
    }
    if (next - lap).abs() != 1.0 {
        return Vec::new();
    }
    let seam = f64::max(lap, next) * length;
    let time = start.0 + (seam - start.1) / (end.1 - start.1) * (end.0 - start.0);
    let (leave, enter) = if next > lap { (length, 0.0) } else { (0.0, length) };
    vec![[reduced(start, lap), (time, leave)], [(time, enter), reduced(end, next)]]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_step_over_the_seam_becomes_two() {
        assert_eq!(on_ring((0.0, 19.0), (1.0, 21.0), 10.0), [[(0.0, 9.0), (0.5, 10.0)], [(0.5, 0.0), (1.0, 1.0)]]);
        assert_eq!(on_ring((0.0, 21.0), (1.0, 19.0), 10.0), [[(0.0, 1.0), (0.5, 0.0)], [(0.5, 10.0), (1.0, 9.0)]]);
    }

    #[test]
    fn one_colour_makes_one_line_a_lap() {
        let time: Vec<f64> = (0..=30).map(f64::from).collect();
        let walk = Trajectory { position: time.clone(), speed: vec![1.0; 31], time };
        let panel = SpaceTime::new(Axis::linear("", 0.0, 30.0), Axis::linear("", 0.0, 10.0), 10.0, &[]);
        let pieces = panel.pieces(&walk, &ColorScale::sequential("", 0.0, 2.0));
        assert_eq!(pieces.iter().filter(|(_, piece)| piece.len() > 2).count(), 3);
    }
}
