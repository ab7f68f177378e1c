//! Panels of many trajectories on a ring, coloured by speed, so that jams show as dark bands.

use crate::axis::Axis;
use crate::color_scale::ColorScale;
use crate::elements::{Area, Chart, Shape, sides};
use crate::error::PlotError;
use crate::field::Snapshot;
use crate::frame::{Frame, Margins};
use crate::geometry::{Point, Rect, larger};
use crate::grid::PanelBox;
use crate::page::Pen;
use crate::picture::Panel;
use crate::raster::Raster;
use crate::style::{Color, INK, PANEL, PAPER, REFERENCE_WIDTH};
use std::iter::once;

/// How far a speed must leave its shade before the colour changes, in widths of a shade.
const PERSISTENCE: f64 = 0.3;
/// Width of a trajectory, in millimetres.
const LINE_WIDTH: f64 = 0.09;
/// Side of a pixel of a speed field, in millimetres.
const FIELD_PIXEL: f64 = 0.1;

/// One trajectory: time (rising), position (not reduced to the ring) and speed (chooses the colour) of each sample.
pub type Trajectory = Vec<[f64; 3]>;

/// A panel of trajectories.
#[derive(Debug, Clone)]
#[must_use]
pub struct SpaceTime {
    time: Axis,
    position: Axis,
    length: f64,
    trajectories: Vec<Trajectory>,
    width: f64,
    every: usize,
    field: bool,
    window: Option<[f64; 4]>,
}

impl Panel for SpaceTime {
    fn margins(&self) -> Result<Margins, PlotError> {
        self.frame().margins()
    }

    fn draw(&self, page: &Area, cell: &PanelBox, scale: Option<&ColorScale>) -> Result<(), PlotError> {
        let PanelBox { rect, room } = cell;
        let scale = scale.ok_or_else(|| PlotError("layout: this panel needs Picture::scale".to_owned()))?;
        self.check()?;
        let mut chart = self.frame().chart(page, rect, room)?;
        let shades = self.shades(scale);
        if self.field {
            page.draw(&Shape::image(self.raster(rect, scale), rect.corners()))?;
            let traces = if self.every > 1 { shades.concat() } else { Vec::new() };
            self.draw_lines(&mut chart, traces, PAPER)?;
        } else {
            // The slow come last, on top: a jam must not vanish below those who left it.
            for (lines, color) in shades.into_iter().zip(scale.palette()).rev() {
                self.draw_lines(&mut chart, lines, color)?;
            }
        }
        if let Some([t0, t1, x0, x1]) = self.window {
            let ring = vec![((t0 + t1) / 2.0, x0), (t1, x0), (t1, x1), (t0, x1), (t0, x0), ((t0 + t1) / 2.0, x0)];
            // a white rim keeps the outline visible on dark ground
            for pen in [Pen::solid(PAPER, 3.0 * REFERENCE_WIDTH), Pen::solid(INK, REFERENCE_WIDTH)] {
                chart.draw_series(once(Shape::line(ring.clone(), pen, sides(&chart))))?;
            }
        }
        self.frame().draw(page, &mut chart)
    }
}

impl SpaceTime {
    /// Trajectories on a ring of a given length (positive), drawn over the ranges of the two axes; positions on the
    /// axis lie between 0 and the length, and both axes are linear. The colour scale must be sequential.
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
        }
    }

    /// Draws trajectories this wide, in millimetres; 0.09 by default, more for a few trajectories.
    pub fn line_width(mut self, width: f64) -> Self {
        self.width = width;
        self
    }

    /// Draws only every `step`-th trajectory, where all of them would merge into one area.
    pub fn every(mut self, step: usize) -> Self {
        self.every = step.max(1);
        self
    }

    /// Fills the panel with the speed, linear in space between neighbouring trajectories, instead of lines: for panels
    /// where lines would lie closer than they can be printed. With [`SpaceTime::every`], the trajectories it chooses
    /// are drawn over the field in white.
    pub fn field(mut self) -> Self {
        self.field = true;
        self
    }

    /// Outlines a window, for instance the one that another panel enlarges.
    pub fn outline(mut self, time: [f64; 2], position: [f64; 2]) -> Self {
        self.window = Some([time[0], time[1], position[0], position[1]]);
        self
    }

    fn frame(&self) -> Frame<'_> {
        Frame { x: &self.time, y: &self.position, sizes: PANEL }
    }

    fn draw_lines(&self, chart: &mut Chart, points: Vec<Point>, color: Color) -> Result<(), PlotError> {
        let curve = Shape::line(points, Pen::solid(color, self.width), sides(chart));
        chart.draw_series(once(curve))?;
        Ok(())
    }

    /// The chosen trajectories as lines of one shade each, broken where one ends: those of a shade together.
    fn shades(&self, scale: &ColorScale) -> Vec<Vec<Point>> {
        let mut shades = vec![Vec::new(); scale.palette().len()];
        for trajectory in self.trajectories.iter().step_by(self.every) {
            for (shade, piece) in self.pieces(trajectory, scale) {
                shades[shade].extend(piece);
                shades[shade].push((f64::NAN, f64::NAN));
            }
        }
        shades
    }

    /// The speed field over the box, one pixel for each 0.1 mm.
    fn raster(&self, rect: &Rect, scale: &ColorScale) -> Raster {
        let pixels = |length: f64| ((length / FIELD_PIXEL).round() as usize).max(1);
        let (width, height) = (pixels(rect.width), pixels(rect.height));
        let time = |column: usize| self.time.value((column as f64 + 0.5) / width as f64);
        let place = |row: usize| self.position.value((height as f64 - row as f64 - 0.5) / height as f64);
        let now: Vec<Snapshot> =
            (0..width).map(|column| Snapshot::new(&self.trajectories, self.length, time(column))).collect();
        Raster::from_fn(width, height, scale.palette(), |column, row| scale.shade(now[column].speed(place(row))) as u8)
    }

    fn check(&self) -> Result<(), PlotError> {
        if !(self.length.is_finite() && self.length > 0.0) {
            let valid = "the ring's length must be positive and finite";
            return Err(PlotError::range(&self.position.label, 0.0, self.length, valid));
        }
        for axis in [&self.time, &self.position] {
            if axis.logarithmic {
                let valid = "a space-time panel needs linear axes";
                return Err(PlotError::range(&axis.label, axis.from, axis.to, valid));
            }
        }
        Ok(())
    }

    /// Lines of one shade each, in the order of the axes, reduced to the ring.
    fn pieces(&self, trajectory: &Trajectory, scale: &ColorScale) -> Vec<(usize, Vec<Point>)> {
        let mut pieces: Vec<(usize, Vec<Point>)> = Vec::new();
        let mut before = None;
        for pair in trajectory.windows(2) {
            let ([t0, x0, v0], [t1, x1, v1]) = (pair[0], pair[1]);
            let speed = (v0 + v1) / 2.0;
            let shade = match before {
                Some(old) if scale.beyond(speed, old) <= PERSISTENCE => old,
                _ => scale.shade(speed),
            };
            before = Some(shade);
            for [start, end] in on_ring((t0, x0), (t1, x1), self.length) {
                match pieces.last_mut() {
                    Some((last, piece)) if *last == shade && piece.last() == Some(&start) => piece.push(end),
                    _ => pieces.push((shade, vec![start, end])),
                }
            }
        }
        pieces
    }
}

/// A step from one (time, unwrapped position) to the next, reduced to the ring: one segment, or two if the step passes
/// the ring's seam. Steps of more than one ring length are not drawn.
fn on_ring(start: Point, end: Point, length: f64) -> Vec<[Point; 2]> {
    let (lap, next) = ((start.1 / length).floor(), (end.1 / length).floor());
    let reduced = |(time, position): Point, lap: f64| (time, position - lap * length);
    if lap == next {
        return vec![[reduced(start, lap), reduced(end, lap)]];
    }
    if (next - lap).abs() != 1.0 {
        return Vec::new();
    }
    let seam = larger(lap, next) * length;
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
        let walk = (0..=30).map(|t| [f64::from(t), f64::from(t), 1.0]).collect();
        let panel = SpaceTime::new(Axis::linear("", 0.0, 30.0), Axis::linear("", 0.0, 10.0), 10.0, &[]);
        let pieces = panel.pieces(&walk, &ColorScale::sequential("", [0.0, 2.0]));
        assert_eq!(pieces.iter().filter(|(_, piece)| piece.len() > 2).count(), 3);
    }
}
