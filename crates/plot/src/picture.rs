//! A page: panels in a grid, lettered, with boxes that align and one shared colour bar.

use crate::color_scale::ColorScale;
use crate::elements::Area;
use crate::error::PlotError;
use crate::frame::Margins;
use crate::geometry::{Rect, larger, largest};
use crate::grid::{Grid, PanelBox};
use crate::key::Key;
use crate::page::{Page, units};
use crate::pixels::Pixels;
use crate::style::{INK, PAGE_EDGE, PANEL_GAP, PAPER, ROW_GAP, TITLE, TITLE_RISE, TITLE_ROW, text};
use crate::svg::Svg;
use plotters_backend::text_anchor::{HPos, VPos};
use std::cell::RefCell;
use std::rc::Rc;

/// A finished picture: the bytes of two files that look alike everywhere.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Rendered {
    /// SVG without text or fonts: letters are outlines.
    pub svg: Vec<u8>,
    /// PNG of 400 dots per inch, 8-bit colours, with its physical size.
    pub png: Vec<u8>,
}

/// One panel of a picture: [`Lines`](crate::Lines), [`Map`](crate::Map), [`Plane`](crate::Plane),
/// [`SpaceTime`](crate::SpaceTime), [`Drawing`](crate::Drawing) or [`Key`].
pub trait Panel {
    #[doc(hidden)]
    fn margins(&self) -> Result<Margins, PlotError>;
    #[doc(hidden)]
    fn draw(&self, page: &Area, cell: &PanelBox, scale: Option<&ColorScale>) -> Result<(), PlotError>;
    /// Whether the panel counts among the lettered ones.
    #[doc(hidden)]
    fn is_lettered(&self) -> bool {
        true
    }
}

/// A picture in the making.
#[must_use]
pub struct Picture {
    width: f64,
    height: f64,
    columns: usize,
    row_shares: Vec<f64>,
    scale: Option<ColorScale>,
    key: Option<Key>,
    panels: Vec<(Box<dyn Panel>, String)>,
}

impl Picture {
    /// An empty page; both sides in millimetres, from 5 to 2000. All panels go in one row until [`Picture::columns`]
    /// says otherwise.
    pub fn new(width: f64, height: f64) -> Self {
        Self { width, height, columns: usize::MAX, row_shares: vec![], scale: None, key: None, panels: vec![] }
    }

    /// Number of panels in a row, at least 1.
    pub fn columns(mut self, columns: usize) -> Self {
        self.columns = columns.max(1);
        self
    }

    /// Relative heights of the boxes in a column; equal by default.
    pub fn row_shares(mut self, shares: &[f64]) -> Self {
        self.row_shares = shares.to_vec();
        self
    }

    /// The colour scale of all maps and space-time panels; its bar is drawn at the right.
    pub fn scale(mut self, scale: ColorScale) -> Self {
        self.scale = Some(scale);
        self
    }

    /// The key to all panels, in a row or more along the lower edge of the page.
    pub fn key(mut self, key: Key) -> Self {
        self.key = Some(key);
        self
    }

    /// Adds a panel, row by row.
    pub fn panel(self, panel: impl Panel + 'static) -> Self {
        self.titled("", panel)
    }

    /// Adds a panel with a title (markup) beside its letter.
    pub fn titled(mut self, title: &str, panel: impl Panel + 'static) -> Self {
        self.panels.push((Box::new(panel), title.to_owned()));
        self
    }

    /// Draws the picture and makes both files.
    ///
    /// # Errors
    /// Any [`PlotError`]: sizes, ranges, labels and lengths are checked here.
    pub fn render(self) -> Result<Rendered, PlotError> {
        let valid = |side: f64| (5.0..=2000.0).contains(&side);
        if !valid(self.width) || !valid(self.height) {
            return Err(PlotError::room("page", self.width, self.height));
        }
        let surfaces = (Svg::new(self.width, self.height), Pixels::new(self.width, self.height)?);
        let size = (units(self.width).unsigned_abs(), units(self.height).unsigned_abs());
        let page = Rc::new(RefCell::new(Page::new(size, surfaces)));
        self.draw(&Area::from(&page))?;
        let (svg, pixels) = &mut page.borrow_mut().surface;
        Ok(Rendered { svg: svg.finish(), png: pixels.png()? })
    }

    fn draw(&self, page: &Area) -> Result<(), PlotError> {
        page.fill(&PAPER)?;
        let cells = self.cells()?;
        let mut letters = ('a'..='z').cycle();
        for ((panel, title), cell) in self.panels.iter().zip(&cells) {
            panel.draw(page, cell, self.scale.as_ref())?;
            let letter = if panel.is_lettered() { letters.next() } else { None };
            self.head(page, letter, title, &cell.rect)?;
        }
        if let Some(key) = &self.key {
            let height = key.height(self.key_width())?;
            let top = self.height - PAGE_EDGE - height;
            key.draw_in(page, &Rect { left: PAGE_EDGE, top, width: self.key_width(), height })?;
        }
        let (Some(scale), Some(first), Some(last)) = (&self.scale, cells.first(), cells.last()) else {
            return Ok(());
        };
        let right = largest(cells.iter().map(|cell| cell.rect.right()));
        let (left, top) = (right + self.bar_gap()?, first.rect.top);
        scale.draw(page, &Rect { left, top, width: 0.0, height: last.rect.bottom() - top })
    }

    /// Letter and title above a box.
    fn head(&self, page: &Area, letter: Option<char>, title: &str, rect: &Rect) -> Result<(), PlotError> {
        let head = match letter.filter(|_| self.has_letters()) {
            Some(letter) => format!("({letter})$\\;\\,${title}"),
            None => title.to_owned(),
        };
        let place = (units(rect.left), units(rect.top - TITLE_RISE));
        Ok(page.draw_text(&head, &text(TITLE, INK, HPos::Left, VPos::Bottom), place)?)
    }

    fn has_letters(&self) -> bool {
        self.panels.iter().filter(|(panel, _)| panel.is_lettered()).count() > 1
    }

    fn key_width(&self) -> f64 {
        self.width - 2.0 * PAGE_EDGE
    }

    fn bar_gap(&self) -> Result<f64, PlotError> {
        let last = largest(self.margins()?.into_iter().map(|margins| margins.right));
        Ok(larger(last + 1.0, PANEL_GAP))
    }

    /// Margins of each panel, with the room that letters and titles take.
    fn margins(&self) -> Result<Vec<Margins>, PlotError> {
        let above = self.scale.is_some() || self.has_letters() || self.panels.iter().any(|panel| !panel.1.is_empty());
        let margins = |(panel, _): &(Box<dyn Panel>, String)| {
            let own = panel.margins()?;
            Ok(Margins { top: if above { larger(own.top, TITLE_ROW) } else { own.top }, ..own })
        };
        self.panels.iter().map(margins).collect()
    }

    fn cells(&self) -> Result<Vec<PanelBox>, PlotError> {
        if self.panels.is_empty() {
            return Err(PlotError("layout: a picture needs at least one panel".to_owned()));
        }
        let room = |scale: &ColorScale| -> Result<f64, PlotError> {
            scale.range.check()?;
            Ok(self.bar_gap()? + scale.width()?)
        };
        let bar = self.scale.as_ref().map(room).transpose()?;
        let below = self.key.as_ref().map(|key| key.height(self.key_width())).transpose()?;
        let grid = Grid {
            width: self.width,
            height: self.height - below.map_or(0.0, |key| key + ROW_GAP),
            columns: self.columns.min(self.panels.len()),
            row_shares: &self.row_shares,
            bar,
        };
        grid.cells(&self.margins()?)
    }
}
