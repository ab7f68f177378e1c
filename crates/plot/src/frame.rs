//! The frame of a panel: a plotters chart with box, ticks, numbers and axis labels.

use crate::axis::{Axis, Tick};
use crate::elements::{Area, Chart};
use crate::error::PlotError;
use crate::geometry::{Rect, larger, largest};
use crate::label::{LINE_TOP, Label};
use crate::page::units;
use crate::style::{AXIS_WIDTH, INK, LABEL_GAP, Sizes, pen, text};
use plotters::chart::ChartBuilder;
use plotters::element::{PathElement, Rectangle};
use plotters_backend::text_anchor::{HPos, VPos};

/// Room below the baseline of a line of text, in em.
const LINE_BOTTOM: f64 = 0.22;

/// Least space between neighbouring numbers, in em.
const NUMBER_GAP: f64 = 0.65;

/// Space around a panel's box, in millimetres.
#[derive(Debug, Clone, Copy, Default)]
pub struct Margins {
    pub left: f64,
    pub right: f64,
    pub top: f64,
    pub bottom: f64,
}

/// Two axes around one box.
pub(crate) struct Frame<'a> {
    pub x: &'a Axis,
    pub y: &'a Axis,
    pub sizes: Sizes,
}

/// Places of an axis' numbers as fractions of its length, with their widths.
fn numbers(axis: &Axis, size: f64) -> Result<Vec<(f64, f64)>, PlotError> {
    let numbered = axis.marks().into_iter().filter_map(|tick| Some((axis.fraction(tick.value), tick.text?)));
    numbered.map(|(place, text)| Ok((place, Label::new(&text, size)?.width))).collect()
}

/// The axis with as many numbers as stand side by side on a length without touching.
fn fitting(axis: &Axis, size: f64, length: f64) -> Result<Axis, PlotError> {
    let mut axis = axis.clone();
    loop {
        let mut numbers = numbers(&axis, size)?;
        numbers.sort_by(|a, b| a.0.total_cmp(&b.0));
        let touch =
            |pair: &[(f64, f64)]| (pair[1].0 - pair[0].0) * length - (pair[0].1 + pair[1].1) / 2.0 < NUMBER_GAP * size;
        match axis.sparser() {
            Some(sparser) if numbers.windows(2).any(touch) => axis = sparser,
            _ => return Ok(axis),
        }
    }
}

impl Frame<'_> {
    /// The space that ticks, numbers and labels need around the box.
    ///
    /// # Errors
    /// A range that cannot be drawn, a label that cannot be typeset.
    pub fn margins(&self) -> Result<Margins, PlotError> {
        self.x.check()?;
        self.y.check()?;
        let Sizes { label, tick, tick_length } = self.sizes;
        let (across, up) = (numbers(self.x, tick)?, numbers(self.y, tick)?);
        let overhang = |end: f64| {
            largest(across.iter().filter(|(place, _)| (place - end).abs() < 0.04).map(|(_, width)| width / 2.0))
        };
        let line = |axis: &Axis| match axis.title().is_empty() {
            true => 0.0,
            false => LABEL_GAP + (LINE_TOP + LINE_BOTTOM) * label,
        };
        let row = if across.is_empty() { 0.0 } else { LINE_TOP * tick };
        let widest = largest(up.iter().map(|(_, width)| *width));
        Ok(Margins {
            left: larger(2.0 * tick_length + widest + line(self.y), overhang(0.0)),
            right: overhang(1.0),
            top: LINE_TOP * tick / 2.0,
            bottom: 2.0 * tick_length + row + line(self.x),
        })
    }

    /// The chart whose box is `rect`. The axis labels stand at the outer ends of `room`, which may be wider than
    /// needed, so that labels of neighbouring panels align.
    ///
    /// # Errors
    /// A label that cannot be typeset.
    pub fn chart(&self, page: &Area, rect: &Rect, room: &Margins) -> Result<Chart, PlotError> {
        let below = larger(room.bottom - LINE_BOTTOM * self.sizes.label, self.sizes.tick_length);
        let area = page.clone().shrink(
            (units(rect.left) - units(room.left), units(rect.top)),
            (units(rect.width) + units(room.left), units(rect.height) + units(below)),
        );
        let x = fitting(self.x, self.sizes.tick, rect.width)?;
        let mut builder = ChartBuilder::on(&area);
        builder.y_label_area_size(units(room.left)).x_label_area_size(units(below));
        Ok(builder.build_cartesian_2d(x, self.y.clone())?)
    }

    /// Draws ticks, numbers, labels and the box.
    ///
    /// # Errors
    /// A label that cannot be typeset.
    pub fn draw(&self, page: &Area, chart: &mut Chart) -> Result<(), PlotError> {
        let Sizes { label, tick, tick_length } = self.sizes;
        let line = pen(INK, AXIS_WIDTH);
        chart
            .configure_mesh()
            .disable_mesh()
            .axis_style(line)
            .set_all_tick_mark_size(units(tick_length))
            .label_style(text(tick, INK, HPos::Left, VPos::Top))
            .axis_desc_style(text(label, INK, HPos::Left, VPos::Top))
            .x_desc(self.x.title())
            .y_desc(self.y.title())
            .draw()?;
        let (across, up) = chart.plotting_area().get_pixel_range();
        // plotters knows no minor ticks
        let minor = |axis: &Axis| axis.marks().into_iter().filter(|tick| tick.text.is_none());
        let spec = chart.as_coord_spec();
        for Tick { value, .. } in minor(spec.x_spec()) {
            let (x, _) = chart.backend_coord(&(value, self.y.from));
            page.draw(&PathElement::new([(x, up.end), (x, up.end + units(0.6 * tick_length))], line))?;
        }
        for Tick { value, .. } in minor(spec.y_spec()) {
            let (_, y) = chart.backend_coord(&(self.x.from, value));
            page.draw(&PathElement::new([(across.start - units(0.6 * tick_length), y), (across.start, y)], line))?;
        }
        page.draw(&Rectangle::new([(across.start, up.start), (across.end, up.end)], line))?;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(axis: &Axis, length: f64) -> Result<usize, PlotError> {
        Ok(numbers(&fitting(axis, 2.6, length)?, 2.6)?.len())
    }

    #[test]
    fn numbers_give_way_on_short_axes() -> Result<(), PlotError> {
        let axis = Axis::linear("", 0.0, 2.0).steps(4);
        assert_eq!(texts(&axis, 40.0)?, 5);
        // Five numbers of 3.3 mm have no room on 12 mm, three have.
        assert_eq!(texts(&axis, 12.0)?, 3);
        let names = [(0.0, "zero"), (1.0, "one"), (2.0, "two"), (3.0, "three"), (4.0, "four")];
        let own = Axis::linear("", 0.0, 4.0).ticks(&names);
        assert_eq!((texts(&own, 60.0)?, texts(&own, 16.0)?), (5, 3));
        Ok(())
    }
}
