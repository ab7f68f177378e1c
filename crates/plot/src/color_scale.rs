//! Colour scales: from a number to a colour, and the bar that explains it.

use crate::canvas::{Align, Canvas, Stroke};
use crate::color::{self, Color, DIVERGING, SEQUENTIAL};
use crate::error::PlotError;
use crate::font::DIGIT_HEIGHT;
use crate::geometry::{Point, Rect};
use crate::label::Label;
use crate::raster::Raster;
use crate::style::{AXIS_WIDTH, CONTOUR_WIDTH, INK, LABEL_GAP, MISSING, PANEL, TICK_GAP, TITLE_RISE};

/// Width of the bar.
const BAR_WIDTH: f64 = 3.2;
/// Height of a pointed end.
const POINT_HEIGHT: f64 = 2.6;
/// Number of colours of a sequential scale: few enough to draw each colour's lines as one path.
const CLASSES: usize = 16;
/// Number of colours of a diverging scale: odd, so that zero lies in the middle of the neutral one.
const SHADES: usize = 255;

/// Which colours a scale runs through.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Family {
    Diverging,
    Sequential,
}

/// A colour scale with its label and range; one a picture, shared by all its panels.
#[derive(Debug, Clone)]
pub struct ColorScale {
    label: String,
    from: f64,
    to: f64,
    family: Family,
    pointed: bool,
}

impl ColorScale {
    /// Blue below zero, red above, near-white at zero; values beyond `-limit` and `limit` (positive,
    /// finite) get the colours of the ends, which the bar shows by pointed ends.
    #[must_use]
    pub fn diverging(label: &str, limit: f64) -> Self {
        Self { label: label.to_owned(), from: -limit, to: limit, family: Family::Diverging, pointed: true }
    }

    /// Sixteen colours from dark (`from`) to light (`to`, larger); values beyond get the end colours.
    #[must_use]
    pub fn sequential(label: &str, from: f64, to: f64) -> Self {
        Self { label: label.to_owned(), from, to, family: Family::Sequential, pointed: false }
    }

    /// # Errors
    /// [`PlotError::Range`] if the range is empty or not finite.
    pub(crate) fn check(&self) -> Result<(), PlotError> {
        if self.from.is_finite() && self.to.is_finite() && self.from < self.to {
            return Ok(());
        }
        let valid = "a colour scale needs finite ends, the first below the second";
        Err(PlotError::Range { axis: self.label.clone(), from: self.from, to: self.to, valid })
    }

    /// Number of shades between the two ends.
    pub(crate) fn shades(&self) -> usize {
        if self.family == Family::Diverging { SHADES } else { CLASSES }
    }

    /// The shade of a value, from 0; NaN has the one after the last.
    pub(crate) fn shade(&self, value: f64) -> usize {
        if value.is_nan() {
            return self.shades();
        }
        let place = self.place(value);
        if place > 0.0 { (place as usize).min(self.shades() - 1) } else { 0 }
    }

    /// How far a value lies outside a shade, in widths of a shade; not positive if inside.
    pub(crate) fn beyond(&self, value: f64, shade: usize) -> f64 {
        let place = self.place(value);
        f64::max(shade as f64 - place, place - (shade + 1) as f64)
    }

    fn place(&self, value: f64) -> f64 {
        (value - self.from) / (self.to - self.from) * self.shades() as f64
    }

    /// The colours of the shades, and after them the colour of NaN.
    pub(crate) fn palette(&self) -> Vec<Color> {
        let (stops, last) = match self.family {
            Family::Diverging => (DIVERGING.as_slice(), SHADES - 1),
            Family::Sequential => (SEQUENTIAL.as_slice(), CLASSES - 1),
        };
        let shades = (0..=last).map(|shade| color::along(stops, shade as f64 / last as f64));
        shades.chain([MISSING]).collect()
    }

    /// The colour of a value.
    pub(crate) fn color(&self, value: f64) -> Color {
        self.palette()[self.shade(value)]
    }

    /// Room that bar, numbers and label need right of the panels.
    pub(crate) fn width(&self) -> Result<f64, PlotError> {
        let (numbers, label) = (self.numbers()?, self.typeset()?);
        let numbers = numbers.iter().fold(0.0, |most, (_, label)| f64::max(most, label.width));
        let bar = BAR_WIDTH + PANEL.tick_length + TICK_GAP + numbers;
        Ok(if stands_above(&label) {
            f64::max(bar, (BAR_WIDTH + label.width) / 2.0)
        } else {
            bar + 2.0 * LABEL_GAP + label.height()
        })
    }

    fn typeset(&self) -> Result<Label, PlotError> {
        Label::new(&self.label, PANEL.label)
    }

    /// Five numbers from end to end, with as many decimals as the second needs.
    fn numbers(&self) -> Result<Vec<(f64, Label)>, PlotError> {
        let step = (self.to - self.from) / 4.0;
        let values: Vec<f64> = (0..=4).map(|index| self.from + step * f64::from(index)).collect();
        let exact = |decimals: &usize| {
            let written = |value: &f64| format!("{value:.decimals$}").parse().unwrap_or(f64::NAN);
            values.iter().all(|value| (written(value) - value).abs() < 1e-6 * step)
        };
        let decimals = (0..6).find(exact).unwrap_or(3);
        let number = |value: &f64| {
            let text = if *value == 0.0 { "0".to_owned() } else { format!("{value:.decimals$}") };
            Ok((*value, Label::new(&text.replace('-', "\u{2212}"), PANEL.tick)?))
        };
        values.iter().map(number).collect()
    }

    /// Draws the bar with its left edge and height given by `rect`.
    pub(crate) fn draw(&self, canvas: &mut Canvas, rect: &Rect) -> Result<(), PlotError> {
        let point = if self.pointed { POINT_HEIGHT } else { 0.0 };
        let bar = Rect { left: rect.left, top: rect.top + point, width: BAR_WIDTH, height: rect.height - 2.0 * point };
        self.draw_colors(canvas, &bar)?;
        let mut edge = 0.0;
        for (value, number) in self.numbers()? {
            let y = bar.bottom() - (value - self.from) / (self.to - self.from) * bar.height;
            let stroke = Stroke::solid(INK, AXIS_WIDTH);
            canvas.line(&[(bar.right(), y), (bar.right() + PANEL.tick_length, y)], &stroke);
            let start = bar.right() + PANEL.tick_length + TICK_GAP;
            canvas.text(&number, (start, y + DIGIT_HEIGHT * PANEL.tick / 2.0), Align::Left, INK);
            edge = f64::max(edge, start + number.width);
        }
        let label = self.typeset()?;
        if stands_above(&label) {
            canvas.text(&label, (bar.left + BAR_WIDTH / 2.0, rect.top - TITLE_RISE), Align::Center, INK);
        } else {
            canvas.text_upwards(&label, (edge + 2.0 * LABEL_GAP + label.ascent, rect.top + rect.height / 2.0), INK);
        }
        Ok(())
    }

    fn draw_colors(&self, canvas: &mut Canvas, bar: &Rect) -> Result<(), PlotError> {
        let shades = self.shades();
        let [upper_left, upper_right, lower_right, lower_left] = bar.corners();
        let mut outline: Vec<Point> = bar.corners().to_vec();
        if self.pointed {
            let middle = bar.left + bar.width / 2.0;
            let (high, low) = ((middle, bar.top - POINT_HEIGHT), (middle, bar.bottom() + POINT_HEIGHT));
            // The ends reach below the image, so that no seam shows between the two.
            let ground = bar.top + bar.height / 2.0;
            canvas.polygon(
                &[high, upper_right, (bar.right(), ground), (bar.left, ground), upper_left],
                self.color(self.to),
            );
            canvas.polygon(
                &[low, lower_left, (bar.left, ground), (bar.right(), ground), lower_right],
                self.color(self.from),
            );
            outline = vec![upper_right, lower_right, low, lower_left, upper_left, high];
        }
        canvas.image(&Raster::from_fn(1, shades, self.palette(), |_, row| (shades - 1 - row) as u8), bar)?;
        if self.family == Family::Diverging {
            let zero = bar.top + bar.height / 2.0;
            canvas.line(&[(bar.left, zero), (bar.right(), zero)], &Stroke::solid(INK, CONTOUR_WIDTH));
        }
        canvas.closed(&outline, &Stroke::solid(INK, AXIS_WIDTH));
        Ok(())
    }
}

/// Short labels stand upright above the bar, long ones read upwards beside it.
fn stands_above(label: &Label) -> bool {
    label.width < 9.0
}
