//! A legend panel: swatches and line samples with their names.

use crate::color_scale::ColorScale;
use crate::elements::Area;
use crate::error::PlotError;
use crate::fill::Fill;
use crate::frame::Margins;
use crate::geometry::{Rect, larger, largest};
use crate::grid::PanelBox;
use crate::label::Label;
use crate::page::units;
use crate::picture::Panel;
use crate::plane::Line;
use crate::style::{AXIS_WIDTH, INK, NOTE, pen, text};
use plotters::element::Rectangle;
use plotters::style::Color as _;
use plotters_backend::text_anchor::{HPos, VPos};

/// Width and height of a swatch, in millimetres.
const SWATCH: (f64, f64) = (5.0, 2.6);
/// Space between a swatch and its name, in millimetres.
const GAP: f64 = 1.1;
/// Space between columns of entries, in millimetres.
const COLUMN_GAP: f64 = 4.0;
/// Height of an entry with the space to the next, in millimetres.
const ENTRY: f64 = 4.0;

/// A legend. It has no axes and takes no letter; it stands in a grid as a panel, or below all panels with
/// [`Picture::key`](crate::Picture::key). Entries run down as few columns as the height allows, or down as many as fit
/// the width.
#[derive(Debug, Clone, Default)]
#[must_use]
pub struct Key {
    entries: Vec<(Sample, String)>,
}

#[derive(Debug, Clone, Copy)]
enum Sample {
    Fill(Fill),
    Line(Line),
}

impl Key {
    /// An empty legend.
    pub fn new() -> Self {
        Self::default()
    }

    /// A class of planes (its name in markup).
    pub fn fill(self, fill: Fill, name: &str) -> Self {
        self.entry(Sample::Fill(fill), name)
    }

    /// The line of [`Plane::contour`](crate::Plane::contour).
    pub fn contour(self, name: &str) -> Self {
        self.entry(Sample::Line(Line::Contour), name)
    }

    /// The line of [`Plane::border`](crate::Plane::border); the teeth of its sample point downwards.
    pub fn border(self, name: &str) -> Self {
        self.entry(Sample::Line(Line::Border), name)
    }

    fn entry(mut self, sample: Sample, name: &str) -> Self {
        self.entries.push((sample, name.to_owned()));
        self
    }

    /// The height of all entries on a width.
    ///
    /// # Errors
    /// A name that cannot be typeset, or is too wide.
    pub(crate) fn height(&self, width: f64) -> Result<f64, PlotError> {
        Ok(self.most_columns(width)?.0 as f64 * ENTRY)
    }

    /// Draws the entries in as few rows as fit a width, in the middle of it.
    pub(crate) fn draw_in(&self, page: &Area, rect: &Rect) -> Result<(), PlotError> {
        let (rows, widths) = self.most_columns(rect.width)?;
        let left = rect.left + (rect.width - total(&widths)) / 2.0;
        self.draw_columns(page, (left, rect.top), rows, &widths)
    }

    /// Rows, and the widths of columns, with as many columns as fit.
    fn most_columns(&self, width: f64) -> Result<(usize, Vec<f64>), PlotError> {
        for rows in 1..=self.entries.len() {
            let widths = self.widths(rows)?;
            if total(&widths) <= width {
                return Ok((rows, widths));
            }
        }
        if self.entries.is_empty() {
            return Ok((0, Vec::new()));
        }
        let needed = total(&self.widths(self.entries.len())?);
        Err(PlotError(format!("layout: a key {width:.1} mm wide; at least {needed:.1} mm needed")))
    }

    /// Widths of the columns for the given number of rows.
    fn widths(&self, rows: usize) -> Result<Vec<f64>, PlotError> {
        let width = |(_, name): &(Sample, String)| Ok(SWATCH.0 + GAP + Label::new(name, NOTE)?.width);
        let column = |entries: &[(Sample, String)]| {
            let widths = entries.iter().map(width).collect::<Result<Vec<f64>, PlotError>>()?;
            Ok(largest(widths))
        };
        self.entries.chunks(rows).map(column).collect()
    }

    fn draw_columns(&self, page: &Area, (left, top): (f64, f64), rows: usize, widths: &[f64]) -> Result<(), PlotError> {
        let mut x = left;
        for (entries, width) in self.entries.chunks(larger(rows as f64, 1.0) as usize).zip(widths) {
            for (row, (sample, name)) in entries.iter().enumerate() {
                let middle = top + (row as f64 + 0.5) * ENTRY;
                let swatch = Rect { left: x, top: middle - SWATCH.1 / 2.0, width: SWATCH.0, height: SWATCH.1 };
                sample.draw(page, &swatch)?;
                let place = (units(swatch.right() + GAP), units(middle));
                page.draw_text(name, &text(NOTE, INK, HPos::Left, VPos::Center), place)?;
            }
            x += width + COLUMN_GAP;
        }
        Ok(())
    }
}

/// The width of columns with the space between them.
fn total(widths: &[f64]) -> f64 {
    widths.iter().sum::<f64>() + COLUMN_GAP * widths.len().saturating_sub(1) as f64
}

impl Sample {
    fn draw(self, page: &Area, rect: &Rect) -> Result<(), PlotError> {
        match self {
            Sample::Fill(fill) => {
                page.draw(&Rectangle::new(rect.corners(), fill.color.filled()))?;
                fill.hatch(page, rect, (1, 1), |_, _| true)?;
                Ok(page.draw(&Rectangle::new(rect.corners(), pen(INK, AXIS_WIDTH)))?)
            }
            Sample::Line(line) => {
                let middle = rect.top + rect.height / 2.0;
                let points = vec![(rect.left, middle), (rect.right(), middle)];
                line.draw(page, rect, &[points], &|(_, y)| middle - y)
            }
        }
    }
}

impl Panel for Key {
    fn margins(&self) -> Result<Margins, PlotError> {
        Ok(Margins::default())
    }

    fn draw(&self, page: &Area, cell: &PanelBox, _: Option<&ColorScale>) -> Result<(), PlotError> {
        let rect = cell.rect;
        let fitting = ((rect.height / ENTRY) as usize).max(1);
        let rows = fitting.min(self.entries.len().max(1));
        let widths = self.widths(rows)?;
        if total(&widths) > rect.width {
            let (width, height, needed) = (rect.width, rect.height, total(&widths));
            let problem = format!("layout: a key of {width:.1} mm x {height:.1} mm; it needs {needed:.1} mm of width");
            return Err(PlotError(problem));
        }
        self.draw_columns(page, (rect.left, rect.top), rows, &widths)
    }

    fn is_lettered(&self) -> bool {
        false
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn key() -> Key {
        let key = Key::new().fill(Fill::PALE, "decays").fill(Fill::BLUE, "waves").fill(Fill::ORANGE, "contact");
        key.contour("exact criterion").border("uniform flow walks backwards")
    }

    #[test]
    fn entries_take_as_few_rows_as_the_width_allows() -> Result<(), PlotError> {
        let rows = |width: f64| Ok::<usize, PlotError>(key().most_columns(width)?.0);
        assert_eq!((rows(178.0)?, rows(60.0)?, rows(44.0)?), (1, 3, 5));
        assert_eq!(key().height(178.0)?, ENTRY);
        assert_eq!(Key::new().height(10.0)?, 0.0);
        Ok(())
    }

    #[test]
    fn a_key_without_room_says_how_much_it_needs() {
        let message = key().height(20.0).expect_err("too narrow").0;
        assert!(message.contains("20.0 mm") && message.contains("at least"), "{message}");
    }
}
