//! Plane panels: cells in the flat colour of their class, with lines and region names on top.

use crate::axis::{Axis, NOWHERE};
use crate::color_scale::ColorScale;
use crate::contour::zero_lines;
use crate::elements::{Area, Shape};
use crate::error::PlotError;
use crate::fill::{Fill, in_units};
use crate::frame::{Frame, Margins};
use crate::geometry::{Point, Rect};
use crate::grid::PanelBox;
use crate::label::Label;
use crate::map::is_dark;
use crate::page::{Pen, units};
use crate::picture::Panel;
use crate::raster::Raster;
use crate::regions::widest_spot;
use crate::style::{CONTOUR_WIDTH, INK, PANEL, PAPER, REFERENCE_DASH, REFERENCE_WIDTH, REGION, text};
use plotters::element::Rectangle;
use plotters::style::Color as _;
use plotters_backend::text_anchor::{HPos, VPos};

/// Least space around a region's name, and step in which more is looked for, in millimetres.
const NAME_MARGIN: f64 = 0.5;
/// Least number of places along each axis tried for a name.
const PLACES: usize = 120;
/// Least number of pixels along each axis: some SVG viewers blur the borders of pixels.
const PIXELS: usize = 480;
/// Width of a line with its white rim, relative to that without.
const RIM: f64 = 2.4;
/// Length of the teeth of a border, in millimetres; each stands in the middle of a dash.
const TOOTH: f64 = 0.9;

/// A panel of classes over two axes, linear or logarithmic.
#[derive(Debug, Clone)]
#[must_use]
pub struct Plane {
    x: Axis,
    y: Axis,
    columns: usize,
    rows: usize,
    classes: Vec<usize>,
    looks: Vec<(Fill, String)>,
    lines: Vec<(Line, Surface)>,
}

/// The kinds of lines over a plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Line {
    /// A zero contour.
    Contour,
    /// A border with teeth on the negative side.
    Border,
}

/// A matrix of values from edge to edge of the plane.
#[derive(Debug, Clone)]
struct Surface {
    columns: usize,
    rows: usize,
    values: Vec<f64>,
}

impl Plane {
    /// Classes of `columns` x `rows` cells of equal size on paper that fill the ranges of the axes:
    /// `classes[row * columns + column]`, the first row lowest; each the place of a [`Plane::class`], from 0.
    pub fn new(x: Axis, y: Axis, columns: usize, rows: usize, classes: Vec<usize>) -> Self {
        Self { x, y, columns, rows, classes, looks: Vec::new(), lines: Vec::new() }
    }

    /// Adds a class. Its name (markup) stands once, where its region is widest, black or white as the ground asks; a
    /// region without room for it has none.
    pub fn class(mut self, fill: Fill, name: &str) -> Self {
        self.looks.push((fill, name.to_owned()));
        self
    }

    /// Draws the zero contour of values at `columns` x `rows` points (each at least 2), equally far apart on paper and
    /// the outermost on the edges: `values[row * columns + column]`, the first row lowest; NaN where there is none.
    pub fn contour(self, columns: usize, rows: usize, values: Vec<f64>) -> Self {
        self.line(Line::Contour, columns, rows, values)
    }

    /// As [`Plane::contour`]: the border of a region, as a thin dashed line with teeth on the side of negative values.
    pub fn border(self, columns: usize, rows: usize, values: Vec<f64>) -> Self {
        self.line(Line::Border, columns, rows, values)
    }

    fn line(mut self, line: Line, columns: usize, rows: usize, values: Vec<f64>) -> Self {
        self.lines.push((line, Surface { columns, rows, values }));
        self
    }

    fn frame(&self) -> Frame<'_> {
        Frame { x: &self.x, y: &self.y, sizes: PANEL }
    }

    fn check(&self) -> Result<(), PlotError> {
        let (columns, rows) = (self.columns, self.rows);
        let own = (format!("a plane of {columns} x {rows} cells"), columns * rows, self.classes.len());
        let lines = self.lines.iter().map(|(_, surface)| {
            let Surface { columns, rows, values } = surface;
            (format!("a line over {columns} x {rows} points"), columns * rows, values.len())
        });
        for (what, expected, found) in [own].into_iter().chain(lines) {
            if found != expected || expected == 0 {
                return Err(PlotError::length(&what, expected, found));
            }
        }
        if self.lines.iter().any(|(_, surface)| surface.columns < 2 || surface.rows < 2) {
            return Err(PlotError("a line over a plane needs at least 2 x 2 points".to_owned()));
        }
        match self.classes.iter().find(|class| **class >= self.looks.len()) {
            Some(class) => Err(PlotError(format!("a plane has class {class}; there are {}", self.looks.len()))),
            None => Ok(()),
        }
    }

    /// The cells in their colours, the first row on top.
    fn raster(&self) -> Raster {
        let palette = self.looks.iter().map(|(fill, _)| fill.color).collect();
        let [across, down] = [self.columns, self.rows].map(|count| PIXELS.div_ceil(count));
        let class = |column: usize, row: usize| {
            self.classes[(self.rows - 1 - row / down) * self.columns + column / across] as u8
        };
        Raster::from_fn(self.columns * across, self.rows * down, palette, class)
    }

    /// The place of a class name with the given width in millimetres, in millimetres to the right of and above the
    /// lower left corner: away from the lines over the plane, as long as there is such a place.
    fn place(&self, rect: &Rect, class: usize, width: f64) -> Option<Point> {
        // few cells are divided, so that there are enough places to choose from
        let finer = [self.columns, self.rows].map(|count| PLACES.div_ceil(count));
        let (columns, rows) = (self.columns * finer[0], self.rows * finer[1]);
        let of = |place: usize| self.classes[place / columns / finer[1] * self.columns + place % columns / finer[0]];
        let own: Vec<f64> = (0..columns * rows).map(|place| if of(place) == class { 1.0 } else { -1.0 }).collect();
        let mut clear = own.clone();
        for (right, up) in self.lines.iter().flat_map(|(_, surface)| surface.lines()).flatten() {
            let index = |share: f64, count: usize| ((share * count as f64) as usize).min(count - 1);
            clear[index(up, rows) * columns + index(right, columns)] = -1.0;
        }
        // from millimetres to places
        let (across, up) = (columns as f64 / rect.width, rows as f64 / rect.height);
        let room = ((width + 2.0 * NAME_MARGIN) * across, (REGION + 2.0 * NAME_MARGIN) * up);
        let margin = (NAME_MARGIN * across, NAME_MARGIN * up);
        let spot = |values: &[f64]| widest_spot((columns, rows), values, true, room, margin);
        let (column, row) = spot(&clear).or_else(|| spot(&own))?;
        Some((column / across, row / up))
    }

    fn draw_names(&self, page: &Area, rect: &Rect) -> Result<(), PlotError> {
        for (class, (fill, name)) in self.looks.iter().enumerate().filter(|(_, (_, name))| !name.is_empty()) {
            let width = Label::new(name, REGION)?.width;
            let Some((right, up)) = self.place(rect, class, width) else { continue };
            let (x, y) = (rect.left + right, rect.bottom() - up);
            if fill.is_hatched() {
                let (half, above) = (width / 2.0 + NAME_MARGIN, REGION / 2.0 + 0.5 * NAME_MARGIN);
                let corners = [(x - half, y - above), (x + half, y + above)].map(|(x, y)| (units(x), units(y)));
                page.draw(&Rectangle::new(corners, fill.color.filled()))?;
            }
            let color = if is_dark(fill.color) { PAPER } else { INK };
            page.draw_text(name, &text(REGION, color, HPos::Center, VPos::Center), (units(x), units(y)))?;
        }
        Ok(())
    }
}

impl Panel for Plane {
    fn margins(&self) -> Result<Margins, PlotError> {
        self.frame().margins()
    }

    fn draw(&self, page: &Area, cell: &PanelBox, _: Option<&ColorScale>) -> Result<(), PlotError> {
        let PanelBox { rect, room } = cell;
        self.check()?;
        let mut chart = self.frame().chart(page, rect, room)?;
        page.draw(&Shape::image(self.raster(), rect.corners()))?;
        for (class, (fill, _)) in self.looks.iter().enumerate() {
            let is_filled = |column: usize, row: usize| self.classes[row * self.columns + column] == class;
            fill.hatch(page, rect, (self.columns, self.rows), is_filled)?;
        }
        for (line, surface) in &self.lines {
            line.draw(page, rect, &surface.on_page(rect), &|point| surface.nearest(rect, point))?;
        }
        self.frame().draw(page, &mut chart)?;
        self.draw_names(page, rect)
    }
}

impl Surface {
    /// The zero lines, in shares of width and height from the lower left corner; a little beyond the edges, too.
    fn lines(&self) -> impl Iterator<Item = Vec<Point>> {
        // the first point counts as the centre of a cell
        let along = |place: f64, count: usize| (place - 0.5) / (count - 1) as f64;
        let share = move |(column, row): Point| (along(column, self.columns), along(row, self.rows));
        let lines = zero_lines(self.columns, self.rows, &self.values).into_iter();
        lines.map(move |line| line.into_iter().map(share).collect())
    }

    /// The zero lines in millimetres on the page.
    fn on_page(&self, rect: &Rect) -> Vec<Vec<Point>> {
        let place = |(right, up): Point| (rect.left + right * rect.width, rect.bottom() - up * rect.height);
        self.lines().map(|line| line.into_iter().map(place).collect()).collect()
    }

    /// The value nearest to a place of the page, in millimetres.
    fn nearest(&self, rect: &Rect, (x, y): Point) -> f64 {
        let index = |share: f64, count: usize| ((share * (count - 1) as f64).round() as usize).min(count - 1);
        let column = index((x - rect.left) / rect.width, self.columns);
        self.values[index((rect.bottom() - y) / rect.height, self.rows) * self.columns + column]
    }
}

impl Line {
    /// Draws lines (in millimetres) inside a box of the page, with a white rim that shows on dark ground. `value` tells
    /// the sides of a border apart.
    pub(crate) fn draw(
        self,
        page: &Area,
        rect: &Rect,
        lines: &[Vec<Point>],
        value: &dyn Fn(Point) -> f64,
    ) -> Result<(), PlotError> {
        let stroke = |lines: &[Vec<Point>], pen: Pen| {
            let broken = |line: &Vec<Point>| -> Vec<(i32, i32)> {
                line.iter().map(|(x, y)| (units(*x), units(*y))).chain([(NOWHERE, NOWHERE)]).collect()
            };
            page.draw(&Shape::line(lines.iter().flat_map(broken).collect(), pen, in_units(rect)))
        };
        let (width, dash): (f64, &[f64]) = match self {
            Line::Contour => (CONTOUR_WIDTH, &[]),
            Line::Border => (REFERENCE_WIDTH, REFERENCE_DASH),
        };
        let teeth: Vec<Vec<Point>> = match self {
            Line::Contour => Vec::new(),
            Line::Border => lines.iter().flat_map(|line| teeth(line, value)).collect(),
        };
        for lines in [lines, &teeth] {
            stroke(lines, Pen::solid(PAPER, RIM * width))?;
        }
        stroke(lines, Pen::dashed(INK, width, dash))?;
        Ok(stroke(&teeth, Pen::solid(INK, width))?)
    }
}

/// Short strokes across a line (in millimetres) on its negative side.
fn teeth(line: &[Point], value: &dyn Fn(Point) -> f64) -> Vec<Vec<Point>> {
    let distance: f64 = REFERENCE_DASH.iter().sum();
    let (mut teeth, mut next) = (Vec::new(), REFERENCE_DASH[0] / 2.0);
    for pair in line.windows(2) {
        let [(x0, y0), (x1, y1)] = [pair[0], pair[1]];
        let (dx, dy) = (x1 - x0, y1 - y0);
        let step = (dx * dx + dy * dy).sqrt();
        while next <= step && step > 0.0 {
            let at = (x0 + dx * next / step, y0 + dy * next / step);
            let side = |sign: f64| (at.0 - sign * TOOTH * dy / step, at.1 + sign * TOOTH * dx / step);
            let sides = [1.0, -1.0].map(|sign| (value(side(sign)), side(sign))).into_iter();
            let lower = sides.filter(|(value, _)| *value < 0.0).min_by(|one, other| one.0.total_cmp(&other.0));
            if let Some((_, end)) = lower {
                teeth.push(vec![at, end]);
            }
            next += distance;
        }
        next -= step;
    }
    teeth
}

#[cfg(test)]
mod tests {
    use super::*;

    const RECT: Rect = Rect { left: 10.0, top: 5.0, width: 40.0, height: 20.0 };

    fn plane(classes: Vec<usize>, columns: usize, rows: usize) -> Plane {
        let (x, y) = (Axis::log10("", 1.0, 1e4), Axis::linear("", 0.0, 2.0));
        Plane::new(x, y, columns, rows, classes).class(Fill::PALE, "left").class(Fill::BLUE, "right")
    }

    /// The left half of one class, the right half of the other.
    fn halves() -> Vec<usize> {
        (0..200).map(|cell| usize::from(cell % 20 >= 10)).collect()
    }

    #[test]
    fn cells_keep_their_colours_and_the_first_row_is_lowest() {
        let raster = plane(vec![0, 1, 1, 1, 0, 0], 3, 2).raster();
        let middle = |column: usize, row: usize| raster.color(column * 160 + 80, row * 240 + 120);
        let (lower, upper) = ([0, 1, 2].map(|column| middle(column, 1)), [0, 1, 2].map(|column| middle(column, 0)));
        let (pale, blue) = (Fill::PALE.color, Fill::BLUE.color);
        assert_eq!((lower, upper), ([pale, blue, blue], [blue, pale, pale]));
    }

    #[test]
    fn a_name_stands_in_its_region_and_beside_the_lines() {
        let bare = plane(halves(), 20, 10);
        let (left, right) = (bare.place(&RECT, 0, 6.0).expect("room"), bare.place(&RECT, 1, 6.0).expect("room"));
        assert!((left.0 - 10.0).abs() < 4.0 && (right.0 - 30.0).abs() < 4.0, "{left:?} {right:?}");
        // a line through the middle of the right half: the name goes above it or below
        let values = (0..200).map(|cell| f64::from(cell / 20) - 4.5).collect();
        let (_, up) = plane(halves(), 20, 10).contour(20, 10, values).place(&RECT, 1, 6.0).expect("room");
        assert!((up - 10.0).abs() > 2.0, "{up}");
        assert_eq!(bare.place(&RECT, 1, 21.0), None);
    }

    #[test]
    fn teeth_point_to_the_negative_side() {
        let line: Vec<Point> = (0..=20).map(|i| (10.0 + 2.0 * f64::from(i), 15.0)).collect();
        for sign in [1.0, -1.0] {
            let found = teeth(&line, &|(_, y)| sign * (y - 15.0));
            assert_eq!(found.len(), 20);
            assert!(found.iter().all(|tooth| sign * (tooth[1].1 - tooth[0].1) < 0.0), "{found:?}");
        }
    }

    #[test]
    fn lines_follow_the_paper_not_the_scale() {
        // 41 points from edge to edge, zero at a quarter of the way
        let values = (0..410).map(|point| f64::from(point % 41) - 10.0).collect();
        let plane = plane(halves(), 20, 10).contour(41, 10, values);
        let lines = plane.lines[0].1.on_page(&RECT);
        assert!(lines.len() == 1 && lines[0].iter().all(|(x, _)| (x - 20.0).abs() < 1e-9), "{lines:?}");
        let [first, last] = [lines[0][0].1, lines[0][lines[0].len() - 1].1];
        let (top, bottom) = if first < last { (first, last) } else { (last, first) };
        assert!(top <= RECT.top && bottom >= RECT.bottom(), "{top} {bottom}: from edge to edge");
    }

    #[test]
    fn wrong_numbers_of_cells_and_unknown_classes_are_told() {
        let message = |plane: Plane| plane.check().expect_err("a complaint").0;
        assert!(message(plane(vec![0; 5], 3, 2)).contains("6 values needed, 5 given"));
        assert!(message(plane(vec![0, 1, 2, 0, 0, 0], 3, 2)).contains("class 2"));
        assert!(message(plane(vec![0; 6], 3, 2).border(4, 4, vec![0.0; 15])).contains("16 values needed, 15 given"));
        assert!(message(plane(vec![0; 6], 3, 2).contour(1, 4, vec![0.0; 4])).contains("at least 2 x 2"));
    }
}
