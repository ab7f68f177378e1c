//! Line panels: series, reference lines, notes, a legend and an inset.

use crate::axis::Axis;
use crate::color_scale::ColorScale;
use crate::elements::{Area, Shape, sides};
use crate::error::PlotError;
use crate::frame::{Frame, Margins};
use crate::geometry::{Point, Rect, larger, largest};
use crate::grid::PanelBox;
use crate::label::Label;
use crate::page::{Pen, units};
use crate::picture::Panel;
use crate::series::Series;
use crate::style::{GREY, INK, INSET, MARKER_RADIUS, NOTE, PANEL, PAPER, REFERENCE_DASH, REFERENCE_WIDTH, Sizes, text};
use plotters::element::Rectangle;
use plotters::style::Color as _;
use plotters_backend::text_anchor::{HPos, VPos};
use std::iter::once;

/// Length of a line's sample in the legend; holds every dash pattern once.
const SAMPLE: f64 = 7.0;
/// Height of a legend row, in em.
const ROW: f64 = 1.35;
/// Space between a sample and its name, and around the legend.
const PADDING: f64 = 1.2;
/// Space around an inset, inside its room.
const INSET_EDGE: f64 = 0.8;

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

/// A panel of curves.
#[derive(Debug, Clone)]
#[must_use]
pub struct Lines {
    x: Axis,
    y: Axis,
    series: Vec<Series>,
    guides: Vec<(Vec<Point>, bool)>,
    notes: Vec<(String, Point)>,
    legend: Corner,
    inset: Option<(Box<Lines>, [f64; 4])>,
    sizes: Sizes,
}

impl Panel for Lines {
    fn margins(&self) -> Result<Margins, PlotError> {
        let margins = self.frame().margins()?;
        // a marker at the end of the axis stands out of the box
        Ok(Margins { right: larger(margins.right, MARKER_RADIUS), ..margins })
    }

    fn draw(&self, page: &Area, cell: &PanelBox, _: Option<&ColorScale>) -> Result<(), PlotError> {
        let PanelBox { rect, room } = cell;
        let mut chart = self.frame().chart(page, rect, room)?;
        let sides = sides(&chart);
        self.frame().draw(page, &mut chart)?;
        for (points, dashed) in &self.guides {
            let pen = Pen::dashed(GREY, REFERENCE_WIDTH, if *dashed { REFERENCE_DASH } else { &[] });
            chart.draw_series(once(Shape::line(points.clone(), pen, sides)))?;
        }
        for (index, series) in self.series.iter().enumerate() {
            series.draw(&mut chart, index)?;
        }
        self.draw_legend(page, rect)?;
        for (note, at) in &self.notes {
            page.draw_text(note, &text(self.note_size(), INK, HPos::Left, VPos::Bottom), chart.backend_coord(at))?;
        }
        match &self.inset {
            Some((panel, part)) => panel.draw_inset(page, &rect.part(*part)),
            None => Ok(()),
        }
    }
}

impl Lines {
    /// An empty panel with its two axes.
    pub fn new(x: Axis, y: Axis) -> Self {
        let legend = Corner::TopRight;
        Self { x, y, series: vec![], guides: vec![], notes: vec![], legend, inset: None, sizes: PANEL }
    }

    /// Adds a series; its place decides its colour and dashes.
    pub fn series(mut self, series: Series) -> Self {
        self.series.push(series);
        self
    }

    /// Puts the names of the series, on opaque white, in a corner where no curve runs; by default the upper right one.
    pub fn legend(mut self, corner: Corner) -> Self {
        self.legend = corner;
        self
    }

    /// Forgets the names of the series: another panel shows them.
    pub fn unnamed(mut self) -> Self {
        self.series.iter_mut().for_each(|series| series.name.clear());
        self
    }

    /// Adds a dashed grey line across the box at height `y`.
    pub fn horizontal(mut self, y: f64) -> Self {
        self.guides.push((vec![(self.x.from, y), (self.x.to, y)], true));
        self
    }

    /// Adds a dashed grey line up the box at `x`.
    pub fn vertical(mut self, x: f64) -> Self {
        self.guides.push((vec![(x, self.y.from), (x, self.y.to)], true));
        self
    }

    /// Adds a thin solid grey line, for instance a slope to compare with.
    pub fn guide(mut self, points: &[Point]) -> Self {
        self.guides.push((points.to_vec(), false));
        self
    }

    /// Adds a text (markup) whose baseline starts at a data point.
    pub fn note(mut self, text: &str, at: Point) -> Self {
        self.notes.push((text.to_owned(), at));
        self
    }

    /// Adds a smaller panel on opaque white. `part` is the room for it and its labels, in fractions of the box: `[x
    /// from, y from, x to, y to]`, from the lower left corner.
    pub fn inset(mut self, part: [f64; 4], panel: Self) -> Self {
        self.inset = Some((Box::new(Self { sizes: INSET, ..panel }), part));
        self
    }

    fn frame(&self) -> Frame<'_> {
        Frame { x: &self.x, y: &self.y, sizes: self.sizes }
    }

    fn draw_inset(&self, page: &Area, room: &Rect) -> Result<(), PlotError> {
        let margins = self.margins()?;
        let rect = Rect {
            left: room.left + margins.left + INSET_EDGE,
            top: room.top + margins.top + INSET_EDGE,
            width: room.width - margins.left - margins.right - 2.0 * INSET_EDGE,
            height: room.height - margins.top - margins.bottom - 2.0 * INSET_EDGE,
        };
        if !(rect.width > 5.0 && rect.height > 5.0) {
            return Err(PlotError::room("an inset's box", rect.width, rect.height));
        }
        page.draw(&Rectangle::new(room.corners(), PAPER.filled()))?;
        self.draw(page, &PanelBox { rect, room: margins }, None)
    }

    fn note_size(&self) -> f64 {
        if self.sizes.tick < NOTE { self.sizes.tick } else { NOTE }
    }

    fn draw_legend(&self, page: &Area, rect: &Rect) -> Result<(), PlotError> {
        let size = self.note_size();
        let named: Vec<(usize, &Series)> =
            self.series.iter().enumerate().filter(|(_, series)| !series.name.is_empty()).collect();
        if named.is_empty() {
            return Ok(());
        }
        let widths = named.iter().map(|(_, series)| Ok(Label::new(&series.name, size)?.width));
        let widest = largest(widths.collect::<Result<Vec<f64>, PlotError>>()?);
        let row = ROW * size;
        let (width, height) = (SAMPLE + widest + 3.0 * PADDING, row * named.len() as f64 + PADDING);
        let (is_left, is_top) = match self.legend {
            Corner::TopLeft => (true, true),
            Corner::TopRight => (false, true),
            Corner::BottomLeft => (true, false),
            Corner::BottomRight => (false, false),
        };
        let left = if is_left { rect.left + PADDING } else { rect.right() - width - PADDING };
        let top = if is_top { rect.top + PADDING } else { rect.bottom() - height - PADDING };
        page.draw(&Rectangle::new(Rect { left, top, width, height }.corners(), PAPER.filled()))?;
        let (start, end) = (units(left + PADDING), units(left + PADDING + SAMPLE));
        for (line, (index, series)) in named.iter().enumerate() {
            let middle = units(top + PADDING / 2.0 + row * (line as f64 + 0.5));
            series.sample(page, [(start, middle), (end, middle)], *index)?;
            page.draw_text(&series.name, &text(size, INK, HPos::Left, VPos::Center), (end + units(PADDING), middle))?;
        }
        Ok(())
    }
}
