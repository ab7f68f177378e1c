//! Places the boxes of a picture's panels.

use crate::error::PlotError;
use crate::frame::Margins;
use crate::geometry::{Rect, larger};
use crate::style::{PAGE_EDGE, PANEL_GAP, ROW_GAP};

/// Least side of a box, in millimetres.
const LEAST: f64 = 5.0;

/// A panel's box and the room around it, which panels of one column and row share.
#[derive(Debug, Clone, Copy)]
pub struct PanelBox {
    pub rect: Rect,
    pub room: Margins,
}

/// A page to be divided; lengths in millimetres.
pub(crate) struct Grid<'a> {
    pub width: f64,
    pub height: f64,
    /// Panels in a row, at least 1.
    pub columns: usize,
    /// Relative heights of boxes; empty for equal ones.
    pub row_shares: &'a [f64],
    /// Width that the colour bar takes at the right, with its distance from the boxes.
    pub bar: Option<f64>,
}

/// Margins, positions and lengths of the boxes along one direction.
struct Track {
    before: Vec<f64>,
    after: Vec<f64>,
    starts: Vec<f64>,
    lengths: Vec<f64>,
}

impl Grid<'_> {
    /// The cell of each panel, row by row: those of a column share left and width, those of a row top and height.
    ///
    /// # Errors
    /// Shares are wrong, or a box would be smaller than 5 mm.
    pub fn cells(&self, margins: &[Margins]) -> Result<Vec<PanelBox>, PlotError> {
        let rows = margins.len().div_ceil(self.columns);
        let (mut across, mut down) = (Track::new(self.columns), Track::new(rows));
        for (index, margins) in margins.iter().enumerate() {
            across.widen(index % self.columns, margins.left, margins.right);
            down.widen(index / self.columns, margins.top, margins.bottom);
        }
        if self.bar.is_some() {
            // The bar's distance has made room for what stands right of the last column.
            across.after[self.columns - 1] = 0.0;
        }
        across.divide(self.width - self.bar.unwrap_or(0.0), &[], PANEL_GAP)?;
        down.divide(self.height, self.row_shares, ROW_GAP)?;
        let cell = |index: usize| {
            let (column, row) = (index % self.columns, index / self.columns);
            let (left, top) = (across.starts[column], down.starts[row]);
            let rect = Rect { left, top, width: across.lengths[column], height: down.lengths[row] };
            let (left, right) = (across.before[column], across.after[column]);
            let (top, bottom) = (down.before[row], down.after[row]);
            PanelBox { rect, room: Margins { left, right, top, bottom } }
        };
        Ok((0..margins.len()).map(cell).collect())
    }
}

impl Track {
    fn new(count: usize) -> Self {
        Self { before: vec![0.0; count], after: vec![0.0; count], starts: vec![], lengths: vec![] }
    }

    fn widen(&mut self, index: usize, before: f64, after: f64) {
        self.before[index] = larger(self.before[index], before);
        self.after[index] = larger(self.after[index], after);
    }

    /// Divides what margins, gaps and the page's edges leave of a length among the boxes.
    fn divide(&mut self, length: f64, shares: &[f64], gap: f64) -> Result<(), PlotError> {
        let count = self.before.len();
        let equal = vec![1.0; count];
        let shares = if shares.is_empty() { &equal } else { shares };
        if shares.len() != count || shares.iter().any(|share| !(share.is_finite() && *share > 0.0)) {
            return Err(PlotError(format!("layout: {count} positive shares needed, given: {shares:?}")));
        }
        let margins: f64 = self.before.iter().chain(&self.after).sum();
        let free = length - 2.0 * PAGE_EDGE - margins - gap * (count - 1) as f64;
        let total: f64 = shares.iter().sum();
        self.lengths = shares.iter().map(|share| free * share / total).collect();
        if self.lengths.iter().any(|length| *length < LEAST) {
            let lengths = &self.lengths;
            return Err(PlotError(format!("layout: boxes of {lengths:.1?} mm; at least {LEAST} mm each needed")));
        }
        let mut place = PAGE_EDGE;
        for index in 0..count {
            place += self.before[index];
            self.starts.push(place);
            place += self.lengths[index] + self.after[index] + gap;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NARROW: Margins = Margins { left: 4.0, right: 1.0, top: 2.0, bottom: 6.0 };
    const WIDE: Margins = Margins { left: 10.0, right: 3.0, top: 2.0, bottom: 9.0 };

    #[test]
    fn boxes_of_a_row_and_of_a_column_align() -> Result<(), PlotError> {
        let grid = Grid { width: 178.0, height: 120.0, columns: 2, row_shares: &[2.0, 1.0], bar: Some(20.0) };
        let cells = grid.cells(&[NARROW, WIDE, WIDE, NARROW])?;
        let [a, b, c, d] = [0, 1, 2, 3].map(|index| cells[index].rect);
        assert_eq!((a.left, a.width, b.left, b.width), (c.left, c.width, d.left, d.width));
        assert_eq!((a.top, a.height, c.top, c.height), (b.top, b.height, d.top, d.height));
        assert!((a.width - b.width).abs() < 1e-12);
        assert!((a.height - 2.0 * c.height).abs() < 1e-12);
        assert!((b.right() - (178.0 - 20.0 - PAGE_EDGE)).abs() < 1e-12, "{b:?}");
        Ok(())
    }
}
