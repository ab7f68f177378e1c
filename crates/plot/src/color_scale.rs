//! Colour scales: the mapping from numbers to colours, and the colour bar.

use crate::axis::{self, Axis};
use crate::color::{self, DIVERGING, SEQUENTIAL};
use crate::elements::{Area, Chart, Shape, closed};
use crate::error::PlotError;
use crate::frame::Frame;
use crate::geometry::{Rect, larger};
use crate::label::Label;
use crate::page::units;
use crate::raster::Raster;
use crate::style::{AXIS_WIDTH, CONTOUR_WIDTH, Color, INK, LABEL_GAP, MISSING, PANEL, TITLE_RISE, pen, text};
use plotters::chart::ChartBuilder;
use plotters::element::{PathElement, Polygon};
use plotters::style::Color as _;
use plotters_backend::FontTransform;
use plotters_backend::text_anchor::{HPos, VPos};

/// Width of the bar.
const BAR_WIDTH: f64 = 3.2;
/// Height of a pointed end.
const POINT_HEIGHT: f64 = 2.6;
/// Number of colours of a sequential scale: few enough to draw each colour's lines as one path.
const CLASSES: usize = 16;
/// Number of colours of a diverging scale: odd, so that zero lies in the middle of the neutral one.
const SHADES: usize = 255;

/// A colour scale with its label and range; one a picture, shared by all its panels.
#[derive(Debug, Clone)]
#[must_use]
pub struct ColorScale {
    pub(crate) range: Axis,
    /// Stops and number of shades.
    stops: &'static [Color],
    shades: usize,
    /// Whether there are values beyond the ends: their bar is pointed.
    pointed: bool,
}

/// A sign counts for the ends of a scale if at least this share of the values has it.
const COUNTS: f64 = 0.01;
/// The share of a sign's values that are no larger than its typical one.
const TYPICAL: f64 = 0.7;
/// The ends lie at this part of a typical value or above.
const SHOWN: f64 = 0.75;

impl ColorScale {
    /// Blue below zero, red above, near-white at zero. The ends are 1, 2 or 4 times a power of ten, near the typical
    /// size of the values of one sign, the smaller one of both: few large values must not bleach all the others, nor
    /// one sign the other. Values beyond get the colours of the ends, which the bar shows by pointed ends.
    pub fn diverging(label: &str, values: impl IntoIterator<Item = f64>) -> Self {
        let mut values: Vec<f64> = values.into_iter().filter(|value| value.is_finite() && *value != 0.0).collect();
        values.sort_by(f64::total_cmp);
        let (negative, positive) = values.split_at(values.partition_point(|value| *value < 0.0));
        let counts = |side: &&[f64]| side.len() as f64 > COUNTS * values.len() as f64;
        let size = |side: &[f64]| {
            let mut sizes: Vec<f64> = side.iter().map(|value| value.abs()).collect();
            sizes.sort_by(f64::total_cmp);
            sizes[(TYPICAL * sizes.len() as f64) as usize]
        };
        let sizes = [negative, positive].into_iter().filter(counts).map(size);
        let typical = sizes.reduce(|one, other| -larger(-one, -other)).unwrap_or(0.0);
        let limit = axis::round_up(SHOWN * typical, &[1, 2, 4]);
        let pointed = values.iter().any(|value| value.abs() > limit);
        Self { range: Axis::linear(label, -limit, limit).steps(4), stops: &DIVERGING, shades: SHADES, pointed }
    }

    /// Sixteen colours from dark to light, between round numbers around the values (finite ones count).
    pub fn sequential(label: &str, values: impl IntoIterator<Item = f64>) -> Self {
        Self { range: Axis::around(label, values), stops: &SEQUENTIAL, shades: CLASSES, pointed: false }
    }

    /// The upper end of the scale.
    #[must_use]
    pub fn limit(&self) -> f64 {
        self.range.to
    }

    /// Red, green and blue of the equally spaced stops between which the colours lie, from the lower end.
    #[must_use]
    pub fn stops(&self) -> Vec<[u8; 3]> {
        self.stops.iter().map(|&Color(red, green, blue)| [red, green, blue]).collect()
    }

    /// The shade of a value, from 0; NaN has the one after the last.
    pub(crate) fn shade(&self, value: f64) -> usize {
        if value.is_nan() {
            return self.shades;
        }
        let place = self.place(value);
        if place > 0.0 { (place as usize).min(self.shades - 1) } else { 0 }
    }

    /// How far a value lies outside a shade, in widths of a shade; not positive if inside.
    pub(crate) fn beyond(&self, value: f64, shade: usize) -> f64 {
        let place = self.place(value);
        larger(shade as f64 - place, place - (shade + 1) as f64)
    }

    fn place(&self, value: f64) -> f64 {
        self.range.fraction(value) * self.shades as f64
    }

    /// The colours of the shades, and after them the colour of NaN.
    pub(crate) fn palette(&self) -> Vec<Color> {
        let last = self.shades - 1;
        let shades = (0..=last).map(|shade| color::along(self.stops, shade as f64 / last as f64));
        shades.chain([MISSING]).collect()
    }

    /// The colour of a value.
    pub(crate) fn color(&self, value: f64) -> Color {
        self.palette()[self.shade(value)]
    }

    /// Room that numbers need beside the bar; the label stands above or farther right.
    fn numbers(&self) -> Result<f64, PlotError> {
        let (x, y) = (Axis::linear("", 0.0, 1.0).without_numbers(), self.range.clone().without_label());
        Ok(Frame { x: &x, y: &y, sizes: PANEL }.margins()?.left)
    }

    fn title(&self) -> Result<Label, PlotError> {
        Label::new(&self.range.title(), PANEL.label)
    }

    /// Room that bar, numbers and label need right of the panels.
    pub(crate) fn width(&self) -> Result<f64, PlotError> {
        let (bar, label) = (BAR_WIDTH + self.numbers()?, self.title()?);
        Ok(match stands_above(&label) {
            true => larger(bar, (BAR_WIDTH + label.width) / 2.0),
            false => bar + 2.0 * LABEL_GAP + PANEL.label,
        })
    }

    /// Draws the bar with its left edge and height given by `rect`.
    pub(crate) fn draw(&self, page: &Area, rect: &Rect) -> Result<(), PlotError> {
        let point = if self.pointed { POINT_HEIGHT } else { 0.0 };
        let bar = Rect { left: rect.left, top: rect.top + point, width: BAR_WIDTH, height: rect.height - 2.0 * point };
        self.draw_colors(page, &bar)?;
        let numbers = units(self.numbers()?);
        let corner = (units(bar.left), units(bar.top));
        let area = page.clone().shrink(corner, (units(bar.width) + numbers, units(bar.height)));
        let mut builder = ChartBuilder::on(&area);
        let mut chart: Chart = builder
            .right_y_label_area_size(numbers)
            .build_cartesian_2d(Axis::linear("", 0.0, 1.0), self.range.clone().without_label())?;
        let line = pen(INK, AXIS_WIDTH);
        let mut mesh = chart.configure_mesh();
        mesh.disable_mesh().axis_style(line).set_all_tick_mark_size(units(PANEL.tick_length));
        mesh.label_style(text(PANEL.tick, INK, HPos::Left, VPos::Center)).draw()?;
        let title = self.range.title();
        if stands_above(&self.title()?) {
            let place = (units(bar.left + BAR_WIDTH / 2.0), units(rect.top - TITLE_RISE));
            page.draw_text(&title, &text(PANEL.label, INK, HPos::Center, VPos::Bottom), place)?;
        } else {
            let place = (units(bar.right() + 2.0 * LABEL_GAP) + numbers, units(rect.top + rect.height / 2.0));
            let style = text(PANEL.label, INK, HPos::Center, VPos::Top).transform(FontTransform::Rotate270);
            page.draw_text(&title, &style, place)?;
        }
        Ok(())
    }

    fn draw_colors(&self, page: &Area, bar: &Rect) -> Result<(), PlotError> {
        let shades = self.shades;
        let [(left, top), (right, bottom)] = bar.corners();
        let middle = (left + right) / 2;
        let mut outline = vec![(left, top), (right, top), (right, bottom), (left, bottom)];
        if self.pointed {
            let (high, low) = ((middle, top - units(POINT_HEIGHT)), (middle, bottom + units(POINT_HEIGHT)));
            let palette = self.palette();
            // The ends reach below the image, so that no seam shows between the two.
            let ground = (top + bottom) / 2;
            let upper = vec![high, (right, top), (right, ground), (left, ground), (left, top)];
            let lower = vec![low, (left, bottom), (left, ground), (right, ground), (right, bottom)];
            page.draw(&Polygon::new(upper, palette[shades - 1].filled()))?;
            page.draw(&Polygon::new(lower, palette[0].filled()))?;
            outline = vec![high, (right, top), (right, bottom), low, (left, bottom), (left, top)];
        }
        let raster = Raster::from_fn(1, shades, self.palette(), |_, row| (shades - 1 - row) as u8);
        page.draw(&Shape::image(raster, bar.corners()))?;
        if self.shades == SHADES {
            let zero = (top + bottom) / 2;
            page.draw(&PathElement::new([(left, zero), (right, zero)], pen(INK, CONTOUR_WIDTH)))?;
        }
        page.draw(&PathElement::new(closed(&outline), pen(INK, AXIS_WIDTH)))?;
        Ok(())
    }
}

/// Short labels stand upright above the bar, long ones read upwards beside it.
fn stands_above(label: &Label) -> bool {
    label.width < 9.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ends(values: &[f64]) -> (f64, f64, bool) {
        let scale = ColorScale::diverging("", values.iter().copied());
        (scale.range.from, scale.range.to, scale.pointed)
    }

    #[test]
    fn a_diverging_scale_fits_its_values() {
        assert_eq!(ends(&[-1.5e-4, 1e-4, 0.5e-4, f64::NAN]), (-1e-4, 1e-4, true));
        assert_eq!(ends(&[-0.3, 0.35]), (-0.4, 0.4, false));
        // few large values do not bleach the others, nor one sign the other
        assert_eq!(ends(&[-0.1, 0.1, 0.1, -0.1, 0.1, 0.1, 0.1, 500.0]), (-0.1, 0.1, true));
        assert_eq!(ends(&[-0.1, -0.1, 50.0, 60.0]), (-0.1, 0.1, true));
        assert_eq!(ends(&[0.0]).1, 1.0);
    }

    #[test]
    fn a_sequential_scale_fits_its_values() {
        let scale = ColorScale::sequential("", [0.31, 0.96]);
        assert_eq!((scale.range.from, scale.range.to), (0.3, 1.0));
        assert!(scale.shade(0.31) < 4 && scale.shade(0.96) > 13);
    }
}
