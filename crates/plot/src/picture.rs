//! A page: panels in a grid, lettered, with boxes that align and one shared colour bar.

use crate::axes::Margins;
use crate::canvas::{Align, Canvas};
use crate::color_scale::ColorScale;
use crate::drawing::Drawing;
use crate::error::PlotError;
use crate::geometry::Rect;
use crate::grid::{Cell, Grid};
use crate::label::Label;
use crate::lines::Lines;
use crate::map::Map;
use crate::render::{self, Rendered};
use crate::space_time::SpaceTime;
use crate::style::{INK, LETTER, PANEL_GAP, TITLE, TITLE_RISE, TITLE_ROW};

/// One panel of a picture.
#[derive(Debug, Clone)]
pub enum Panel {
    /// Curves over an axis.
    Lines(Lines),
    /// A matrix of values in colours.
    Map(Map),
    /// Trajectories coloured by speed.
    SpaceTime(SpaceTime),
    /// A free sketch.
    Drawing(Drawing),
}

impl From<Lines> for Panel {
    fn from(panel: Lines) -> Self {
        Self::Lines(panel)
    }
}

impl From<Map> for Panel {
    fn from(panel: Map) -> Self {
        Self::Map(panel)
    }
}

impl From<SpaceTime> for Panel {
    fn from(panel: SpaceTime) -> Self {
        Self::SpaceTime(panel)
    }
}

impl From<Drawing> for Panel {
    fn from(panel: Drawing) -> Self {
        Self::Drawing(panel)
    }
}

impl Panel {
    fn margins(&self) -> Result<Margins, PlotError> {
        match self {
            Self::Lines(panel) => panel.margins(),
            Self::Map(panel) => panel.margins(),
            Self::SpaceTime(panel) => panel.margins(),
            Self::Drawing(_) => Ok(Margins::default()),
        }
    }

    fn draw(&self, canvas: &mut Canvas, cell: &Cell, scale: Option<&ColorScale>) -> Result<(), PlotError> {
        let none = || PlotError::Layout("a map or a space-time panel needs Picture::scale".to_owned());
        let Cell { rect, room } = *cell;
        match self {
            Self::Lines(panel) => panel.draw(canvas, rect, room),
            Self::Map(panel) => panel.draw(canvas, rect, room, scale.ok_or_else(none)?),
            Self::SpaceTime(panel) => panel.draw(canvas, rect, room, scale.ok_or_else(none)?),
            Self::Drawing(panel) => panel.draw(canvas, rect),
        }
    }
}

/// A picture in the making.
#[derive(Debug, Clone)]
pub struct Picture {
    width: f64,
    height: f64,
    columns: usize,
    column_shares: Vec<f64>,
    row_shares: Vec<f64>,
    scale: Option<ColorScale>,
    panels: Vec<(Panel, String)>,
}

impl Picture {
    /// An empty page; both sides in millimetres, from 5 to 2000. All panels go in one row until
    /// [`Picture::columns`] says otherwise.
    #[must_use]
    pub fn new(width: f64, height: f64) -> Self {
        Self {
            width,
            height,
            columns: usize::MAX,
            column_shares: vec![],
            row_shares: vec![],
            scale: None,
            panels: vec![],
        }
    }

    /// Number of panels in a row, at least 1.
    #[must_use]
    pub fn columns(mut self, columns: usize) -> Self {
        self.columns = columns.max(1);
        self
    }

    /// Relative widths of the boxes in a row; equal by default.
    #[must_use]
    pub fn column_shares(mut self, shares: &[f64]) -> Self {
        self.column_shares = shares.to_vec();
        self
    }

    /// Relative heights of the boxes in a column; equal by default.
    #[must_use]
    pub fn row_shares(mut self, shares: &[f64]) -> Self {
        self.row_shares = shares.to_vec();
        self
    }

    /// The colour scale of all maps and space-time panels; its bar is drawn at the right.
    #[must_use]
    pub fn scale(mut self, scale: ColorScale) -> Self {
        self.scale = Some(scale);
        self
    }

    /// Adds a panel, row by row.
    #[must_use]
    pub fn panel(self, panel: impl Into<Panel>) -> Self {
        self.titled("", panel)
    }

    /// Adds a panel with a title (markup) beside its letter.
    #[must_use]
    pub fn titled(mut self, title: &str, panel: impl Into<Panel>) -> Self {
        self.panels.push((panel.into(), title.to_owned()));
        self
    }

    /// Draws the picture and makes both files.
    ///
    /// # Errors
    /// Any [`PlotError`]: sizes, ranges, labels and lengths are checked here.
    pub fn render(self) -> Result<Rendered, PlotError> {
        let valid = |side: f64| (5.0..=2000.0).contains(&side);
        if !valid(self.width) || !valid(self.height) {
            return Err(PlotError::Room { what: "page".to_owned(), width: self.width, height: self.height });
        }
        let mut svg = String::new();
        let mut canvas = Canvas::new(&mut svg, self.width, self.height);
        self.draw(&mut canvas)?;
        let inserts = canvas.finish()?;
        render::render(&svg, &inserts, self.width, self.height)
    }

    fn draw(&self, canvas: &mut Canvas) -> Result<(), PlotError> {
        let cells = self.cells()?;
        for (index, (panel, title)) in self.panels.iter().enumerate() {
            panel.draw(canvas, &cells[index], self.scale.as_ref())?;
            self.head(canvas, index, title, &cells[index].rect)?;
        }
        let (Some(scale), Some(first), Some(last)) = (&self.scale, cells.first(), cells.last()) else {
            return Ok(());
        };
        let right = cells.iter().fold(0.0, |most, cell| f64::max(most, cell.rect.right()));
        let (left, top) = (right + self.bar_gap()?, first.rect.top);
        scale.draw(canvas, &Rect { left, top, width: 0.0, height: last.rect.bottom() - top })
    }

    /// Letter and title above a box.
    fn head(&self, canvas: &mut Canvas, index: usize, title: &str, rect: &Rect) -> Result<(), PlotError> {
        let baseline = rect.top - TITLE_RISE;
        let mut start = rect.left;
        if self.panels.len() > 1 {
            let letter = Label::new(&format!("({})", char::from(b'a' + (index % 26) as u8)), LETTER)?;
            canvas.text(&letter, (start, baseline), Align::Left, INK);
            start += letter.width + 0.5 * LETTER;
        }
        canvas.text(&Label::new(title, TITLE)?, (start, baseline), Align::Left, INK);
        Ok(())
    }

    fn bar_gap(&self) -> Result<f64, PlotError> {
        let last = self.margins()?.into_iter().fold(0.0, |most, margins| f64::max(most, margins.right));
        Ok(f64::max(last + 1.0, PANEL_GAP))
    }

    /// Margins of each panel, with the room that letters and titles take.
    fn margins(&self) -> Result<Vec<Margins>, PlotError> {
        let above =
            self.scale.is_some() || self.panels.len() > 1 || self.panels.iter().any(|panel| !panel.1.is_empty());
        let margins = |(panel, _): &(Panel, String)| {
            let own = panel.margins()?;
            Ok(Margins { top: if above { f64::max(own.top, TITLE_ROW) } else { own.top }, ..own })
        };
        self.panels.iter().map(margins).collect()
    }

    fn cells(&self) -> Result<Vec<Cell>, PlotError> {
        if self.panels.is_empty() {
            return Err(PlotError::Layout("a picture needs at least one panel".to_owned()));
        }
        let bar = match &self.scale {
            Some(scale) => {
                scale.check()?;
                Some(self.bar_gap()? + scale.width()?)
            }
            None => None,
        };
        let grid = Grid {
            width: self.width,
            height: self.height,
            columns: self.columns.min(self.panels.len()),
            column_shares: &self.column_shares,
            row_shares: &self.row_shares,
            bar,
        };
        grid.cells(&self.margins()?)
    }
}
