//! The frame of a panel: box, ticks, numbers and axis labels, and the way from data to paper.

use crate::axis::Axis;
use crate::canvas::{Align, Canvas, Stroke};
use crate::error::PlotError;
use crate::font::DIGIT_HEIGHT;
use crate::geometry::{Point, Rect};
use crate::label::Label;
use crate::style::{AXIS_WIDTH, INK, LABEL_GAP, Sizes, TICK_GAP};

/// Room that a label's line takes above its baseline, in em: a capital with an accent fits, and
/// lines of neighbouring panels align.
const LINE_ASCENT: f64 = 0.92;
/// Room below the baseline, in em.
const LINE_DESCENT: f64 = 0.22;

/// Space around a panel's box, in millimetres.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Margins {
    pub left: f64,
    pub right: f64,
    pub top: f64,
    pub bottom: f64,
}

/// Two axes around one box.
pub(crate) struct Axes<'a> {
    pub x: &'a Axis,
    pub y: &'a Axis,
    pub sizes: Sizes,
}

/// A box on paper together with the axes that its data belong to.
#[derive(Clone, Copy)]
pub(crate) struct Place<'a> {
    pub rect: Rect,
    pub x: &'a Axis,
    pub y: &'a Axis,
}

impl Place<'_> {
    /// Where a data point lies on paper; a coordinate without a place becomes NaN.
    pub fn at(&self, (x, y): Point) -> Point {
        let right = self.rect.left + self.x.fraction(x) * self.rect.width;
        let down = self.rect.bottom() - self.y.fraction(y) * self.rect.height;
        (right, down)
    }

    /// Where data points lie on paper.
    pub fn all(&self, points: &[Point]) -> Vec<Point> {
        points.iter().map(|point| self.at(*point)).collect()
    }
}

/// Numbers of an axis, typeset.
fn numbers(axis: &Axis, size: f64) -> Result<Vec<(f64, Option<Label>)>, PlotError> {
    let typeset = |text: Option<String>| text.map(|text| Label::new(&text, size)).transpose();
    axis.marks().into_iter().map(|tick| Ok((tick.value, typeset(tick.text)?))).collect()
}

/// Numbers of an axis of a given length, as many as stand side by side without touching.
fn numbers_that_fit(axis: &Axis, size: f64, length: f64) -> Result<Vec<(f64, Option<Label>)>, PlotError> {
    let mut axis = axis.clone();
    loop {
        let numbers = numbers(&axis, size)?;
        let mut places: Vec<(f64, f64)> = numbers
            .iter()
            .filter_map(|(value, label)| Some((axis.fraction(*value) * length, label.as_ref()?.width / 2.0)))
            .collect();
        places.sort_by(|a, b| a.0.total_cmp(&b.0));
        let touch = |pair: &[(f64, f64)]| pair[1].0 - pair[1].1 - pair[0].0 - pair[0].1 < 0.45 * size;
        match axis.sparser() {
            Some(sparser) if places.windows(2).any(touch) => axis = sparser,
            _ => return Ok(numbers),
        }
    }
}

/// The width of the widest number of an axis.
fn widest(numbers: &[(f64, Option<Label>)]) -> f64 {
    numbers.iter().filter_map(|(_, label)| label.as_ref()).fold(0.0, |widest, label| f64::max(widest, label.width))
}

impl Axes<'_> {
    /// The space that ticks, numbers and labels need around the box.
    ///
    /// # Errors
    /// A range that cannot be drawn, a label that cannot be typeset.
    pub fn margins(&self) -> Result<Margins, PlotError> {
        self.x.check()?;
        self.y.check()?;
        let outside = self.sizes.tick_length + TICK_GAP;
        let (across, up) = (numbers(self.x, self.sizes.tick)?, numbers(self.y, self.sizes.tick)?);
        let overhang = |end: f64| {
            let at_end = across.iter().filter(|(value, _)| (self.x.fraction(*value) - end).abs() < 0.04);
            at_end.filter_map(|(_, label)| label.as_ref()).fold(0.0, |most, label| f64::max(most, label.width / 2.0))
        };
        let line =
            if self.x.label.is_empty() { 0.0 } else { LABEL_GAP + (LINE_ASCENT + LINE_DESCENT) * self.sizes.label };
        let number_row =
            if across.iter().any(|(_, label)| label.is_some()) { DIGIT_HEIGHT * self.sizes.tick } else { 0.0 };
        let column =
            if self.y.label.is_empty() { 0.0 } else { LABEL_GAP + (LINE_ASCENT + LINE_DESCENT) * self.sizes.label };
        Ok(Margins {
            left: f64::max(outside + widest(&up) + column, overhang(0.0)),
            right: overhang(1.0),
            top: DIGIT_HEIGHT * self.sizes.tick / 2.0,
            bottom: outside + number_row + line,
        })
    }

    /// Draws box, ticks, numbers and labels around `rect`. The axis labels stand at the outer ends
    /// of `room`, which may be wider than needed, so that labels of neighbouring panels align.
    pub fn draw(&self, canvas: &mut Canvas, rect: Rect, room: Margins) -> Result<(), PlotError> {
        canvas.outline(&rect, &Stroke::solid(INK, AXIS_WIDTH));
        self.horizontal(canvas, &rect, room.bottom)?;
        self.vertical(canvas, &rect, room.left)
    }

    fn horizontal(&self, canvas: &mut Canvas, rect: &Rect, room: f64) -> Result<(), PlotError> {
        let baseline = rect.bottom() + self.sizes.tick_length + TICK_GAP + DIGIT_HEIGHT * self.sizes.tick;
        for (value, label) in numbers_that_fit(self.x, self.sizes.tick, rect.width)? {
            let x = rect.left + self.x.fraction(value) * rect.width;
            let length = self.length(label.is_some());
            canvas.line(&[(x, rect.bottom()), (x, rect.bottom() + length)], &Stroke::solid(INK, AXIS_WIDTH));
            if let Some(label) = label {
                canvas.text(&label, (x, baseline), Align::Center, INK);
            }
        }
        let label = Label::new(&self.x.label, self.sizes.label)?;
        let middle = (rect.left + rect.width / 2.0, rect.bottom() + room - LINE_DESCENT * self.sizes.label);
        canvas.text(&label, middle, Align::Center, INK);
        Ok(())
    }

    fn vertical(&self, canvas: &mut Canvas, rect: &Rect, room: f64) -> Result<(), PlotError> {
        let end = rect.left - self.sizes.tick_length - TICK_GAP;
        for (value, label) in numbers(self.y, self.sizes.tick)? {
            let y = rect.bottom() - self.y.fraction(value) * rect.height;
            let length = self.length(label.is_some());
            canvas.line(&[(rect.left - length, y), (rect.left, y)], &Stroke::solid(INK, AXIS_WIDTH));
            if let Some(label) = label {
                canvas.text(&label, (end, y + DIGIT_HEIGHT * self.sizes.tick / 2.0), Align::Right, INK);
            }
        }
        let label = Label::new(&self.y.label, self.sizes.label)?;
        let middle = (rect.left - room + LINE_ASCENT * self.sizes.label, rect.top + rect.height / 2.0);
        canvas.text_upwards(&label, middle, INK);
        Ok(())
    }

    fn length(&self, numbered: bool) -> f64 {
        if numbered { self.sizes.tick_length } else { 0.6 * self.sizes.tick_length }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(axis: &Axis, length: f64) -> Result<usize, PlotError> {
        Ok(numbers_that_fit(axis, 2.6, length)?.iter().filter(|(_, label)| label.is_some()).count())
    }

    #[test]
    fn numbers_give_way_on_short_axes() -> Result<(), PlotError> {
        let axis = Axis::linear("", 0.0, 2.0).steps(4);
        assert_eq!(texts(&axis, 40.0)?, 5);
        // Five numbers of 3.3 mm have no room on 12 mm, three have.
        assert_eq!(texts(&axis, 12.0)?, 3);
        let own = Axis::linear("", 0.0, 4.0).ticks(&[
            (0.0, "zero"),
            (1.0, "one"),
            (2.0, "two"),
            (3.0, "three"),
            (4.0, "four"),
        ]);
        assert_eq!((texts(&own, 60.0)?, texts(&own, 16.0)?), (5, 3));
        Ok(())
    }
}
