//! Panels of curves: series, reference lines, notes, a legend and an inset.

use crate::axes::{Axes, Margins, Place};
use crate::axis::Axis;
use crate::canvas::{Align, Canvas, Stroke};
use crate::error::PlotError;
use crate::font::DIGIT_HEIGHT;
use crate::geometry::{Point, Rect, clip};
use crate::label::Label;
use crate::series::Series;
use crate::style::{GREY, INK, INSET, NOTE, PANEL, PAPER, REFERENCE_DASH, REFERENCE_WIDTH, Sizes};

/// Length of a line's sample in the legend; holds every dash pattern once.
const SAMPLE: f64 = 7.0;
/// Length of a line's sample before a label at its end.
const END_SAMPLE: f64 = 3.0;
/// Height of a legend row, in em.
const ROW: f64 = 1.35;
/// Space between a sample and its name, and around the legend.
const PADDING: f64 = 1.2;

/// A corner of the box.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Corner {
    /// Upper left.
    TopLeft,
    /// Upper right.
    TopRight,
    /// Lower left.
    BottomLeft,
    /// Lower right.
    BottomRight,
}

/// Where the names of the series go.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Legend {
    /// No names.
    Hidden,
    /// In a corner, on opaque white; choose one where no curve runs.
    Corner(Corner),
    /// Right of the box, each at the height where its curve ends.
    Ends,
}

/// A text at a data point.
#[derive(Debug, Clone)]
pub(crate) struct Note {
    pub text: String,
    pub at: Point,
    pub align: Align,
}

/// A panel of curves.
#[derive(Debug, Clone)]
pub struct Lines {
    x: Axis,
    y: Axis,
    series: Vec<Series>,
    guides: Vec<(Vec<Point>, bool)>,
    notes: Vec<Note>,
    legend: Legend,
    inset: Option<(Box<Lines>, [f64; 4])>,
    sizes: Sizes,
}

impl Lines {
    /// An empty panel with its two axes.
    #[must_use]
    pub fn new(x: Axis, y: Axis) -> Self {
        let legend = Legend::Corner(Corner::TopRight);
        Self { x, y, series: vec![], guides: vec![], notes: vec![], legend, inset: None, sizes: PANEL }
    }

    /// Adds a series; its place decides its colour and dashes.
    #[must_use]
    pub fn series(mut self, series: Series) -> Self {
        self.series.push(series);
        self
    }

    /// Says where the names of the series go; the upper right corner by default.
    #[must_use]
    pub fn legend(mut self, legend: Legend) -> Self {
        self.legend = legend;
        self
    }

    /// Adds a dashed grey line across the box at height `y`.
    #[must_use]
    pub fn horizontal(mut self, y: f64) -> Self {
        self.guides.push((vec![(self.x.from, y), (self.x.to, y)], true));
        self
    }

    /// Adds a dashed grey line up the box at `x`.
    #[must_use]
    pub fn vertical(mut self, x: f64) -> Self {
        self.guides.push((vec![(x, self.y.from), (x, self.y.to)], true));
        self
    }

    /// Adds a thin solid grey line, for instance a slope to compare with.
    #[must_use]
    pub fn guide(mut self, points: &[Point]) -> Self {
        self.guides.push((points.to_vec(), false));
        self
    }

    /// Adds a text (markup) whose baseline starts at a data point.
    #[must_use]
    pub fn note(mut self, text: &str, at: Point) -> Self {
        self.notes.push(Note { text: text.to_owned(), at, align: Align::Left });
        self
    }

    /// Adds a smaller panel on opaque white. `part` is the room for it and its labels, in fractions
    /// of the box: `[x from, y from, x to, y to]`, from the lower left corner.
    #[must_use]
    pub fn inset(mut self, part: [f64; 4], panel: Self) -> Self {
        self.inset = Some((Box::new(Self { sizes: INSET, ..panel }), part));
        self
    }

    fn axes(&self) -> Axes<'_> {
        Axes { x: &self.x, y: &self.y, sizes: self.sizes }
    }

    pub(crate) fn margins(&self) -> Result<Margins, PlotError> {
        let mut margins = self.axes().margins()?;
        if self.legend == Legend::Ends {
            let names = self.names()?;
            let widest = names.iter().fold(0.0, |most, (_, name)| f64::max(most, name.width));
            margins.right = f64::max(margins.right, END_SAMPLE + 2.0 * PADDING + widest);
        }
        Ok(margins)
    }

    pub(crate) fn draw(&self, canvas: &mut Canvas, rect: Rect, room: Margins) -> Result<(), PlotError> {
        let place = Place { rect, x: &self.x, y: &self.y };
        self.axes().draw(canvas, rect, room)?;
        for (points, dashed) in &self.guides {
            let dash = if *dashed { REFERENCE_DASH } else { &[] };
            canvas.lines(&clip(&place.all(points), &rect), &Stroke::dashed(GREY, REFERENCE_WIDTH, dash));
        }
        for (index, series) in self.series.iter().enumerate() {
            series.draw(canvas, &place, index);
        }
        match self.legend {
            Legend::Hidden => {}
            Legend::Corner(corner) => self.draw_legend(canvas, &rect, corner)?,
            Legend::Ends => self.draw_ends(canvas, &place)?,
        }
        for note in &self.notes {
            canvas.text(&Label::new(&note.text, self.note_size())?, place.at(note.at), note.align, INK);
        }
        match &self.inset {
            Some((panel, part)) => panel.draw_inset(canvas, &rect.part(*part)),
            None => Ok(()),
        }
    }

    fn draw_inset(&self, canvas: &mut Canvas, room: &Rect) -> Result<(), PlotError> {
        let margins = self.margins()?;
        let edge = 0.8;
        let rect = Rect {
            left: room.left + margins.left + edge,
            top: room.top + margins.top + edge,
            width: room.width - margins.left - margins.right - 2.0 * edge,
            height: room.height - margins.top - margins.bottom - 2.0 * edge,
        };
        if !(rect.width > 5.0 && rect.height > 5.0) {
            return Err(PlotError::Room { what: "an inset's box".to_owned(), width: rect.width, height: rect.height });
        }
        canvas.fill_rect(room, PAPER);
        self.draw(canvas, rect, margins)
    }

    fn note_size(&self) -> f64 {
        f64::min(NOTE, self.sizes.tick)
    }

    /// The named series with their places and typeset names.
    fn names(&self) -> Result<Vec<(usize, Label)>, PlotError> {
        let named = self.series.iter().enumerate().filter(|(_, series)| !series.name.is_empty());
        named.map(|(index, series)| Ok((index, Label::new(&series.name, self.note_size())?))).collect()
    }

    fn draw_legend(&self, canvas: &mut Canvas, rect: &Rect, corner: Corner) -> Result<(), PlotError> {
        let names = self.names()?;
        if names.is_empty() {
            return Ok(());
        }
        let row = ROW * self.note_size();
        let widest = names.iter().fold(0.0, |most, (_, name)| f64::max(most, name.width));
        let (width, height) = (SAMPLE + widest + 3.0 * PADDING, row * names.len() as f64 + PADDING);
        let inside = 1.2;
        let left = match corner {
            Corner::TopLeft | Corner::BottomLeft => rect.left + inside,
            Corner::TopRight | Corner::BottomRight => rect.right() - width - inside,
        };
        let top = match corner {
            Corner::TopLeft | Corner::TopRight => rect.top + inside,
            Corner::BottomLeft | Corner::BottomRight => rect.bottom() - height - inside,
        };
        canvas.fill_rect(&Rect { left, top, width, height }, PAPER);
        for (line, (index, name)) in names.iter().enumerate() {
            let middle = top + PADDING / 2.0 + row * (line as f64 + 0.5);
            let start = left + PADDING;
            self.series[*index].sample(canvas, (start, middle), (start + SAMPLE, middle), *index);
            let baseline = middle + DIGIT_HEIGHT * self.note_size() / 2.0;
            canvas.text(name, (start + SAMPLE + PADDING, baseline), Align::Left, INK);
        }
        Ok(())
    }

    /// Names right of the box, pushed apart where curves end close together.
    fn draw_ends(&self, canvas: &mut Canvas, place: &Place) -> Result<(), PlotError> {
        let mut ends: Vec<(f64, usize, Label)> = Vec::new();
        for (index, name) in self.names()? {
            if let Some((_, y)) = self.series[index].end(place) {
                ends.push((y, index, name));
            }
        }
        ends.sort_by(|a, b| a.0.total_cmp(&b.0));
        let wanted: Vec<f64> = ends.iter().map(|end| end.0).collect();
        let start = place.rect.right() + PADDING;
        for (middle, (_, index, name)) in spread(&wanted, ROW * self.note_size()).into_iter().zip(ends) {
            self.series[index].sample(canvas, (start, middle), (start + END_SAMPLE, middle), index);
            let baseline = middle + DIGIT_HEIGHT * self.note_size() / 2.0;
            canvas.text(&name, (start + END_SAMPLE + PADDING, baseline), Align::Left, INK);
        }
        Ok(())
    }
}

/// Moves rising values as little as needed (in the sum of squares) so that neighbours are `gap` apart.
fn spread(wanted: &[f64], gap: f64) -> Vec<f64> {
    // Without their gaps the values must not fall: pool those that do into their mean.
    let mut pools: Vec<(f64, usize)> = Vec::new();
    for (index, value) in wanted.iter().enumerate() {
        pools.push((value - gap * index as f64, 1));
        while let [.., (before, many), (mean, count)] = pools.as_slice() {
            if before <= mean {
                break;
            }
            let (total, size) = (before * *many as f64 + mean * *count as f64, many + count);
            pools.truncate(pools.len() - 2);
            pools.push((total / size as f64, size));
        }
    }
    let levels = pools.iter().flat_map(|(mean, count)| std::iter::repeat_n(*mean, *count));
    levels.enumerate().map(|(index, level)| level + gap * index as f64).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn crowded_names_are_pushed_apart_around_their_middle() {
        assert_eq!(spread(&[0.0, 10.0], 3.0), [0.0, 10.0]);
        assert_eq!(spread(&[5.0, 5.0], 2.0), [4.0, 6.0]);
        let moved = spread(&[1.0, 1.5, 2.0, 9.0], 1.0);
        assert!(moved.windows(2).all(|pair| pair[1] - pair[0] > 1.0 - 1e-12), "{moved:?}");
        assert_eq!(moved[3], 9.0);
    }
}
