//! Fills of classes: flat colours for regions that must be told apart without a scale, and hatchings for what has no
//! outcome of its own.
//!
//! The six colours lie at least 12 apart in L*, so that a grey print distinguishes them, and at least 16 apart in
//! CIELAB under normal vision and simulated protanopia, deuteranopia and tritanopia; tests hold them to it. The
//! hatchings share a white ground and differ by their lines alone.

use crate::elements::{Area, Shape};
use crate::error::PlotError;
use crate::geometry::{Point, Rect};
use crate::page::{Pen, units};
use crate::style::{AXIS_WIDTH, Color, GREY, PAPER};
use plotters_backend::BackendCoord;

/// Distance of the lines of a hatching, in millimetres.
const SPACING: f64 = 1.1;

/// How the cells of a class look.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Fill {
    pub(crate) color: Color,
    /// Hatched by lines that rise to the right.
    rising: bool,
    /// Hatched by lines that fall to the right.
    falling: bool,
}

impl Fill {
    /// Nearly white (L* 94).
    pub const PALE: Fill = Fill::flat(0xe9, 0xf0, 0xf5);
    /// Light grey (L* 77).
    pub const GREY: Fill = Fill::flat(0xbf, 0xbf, 0xb9);
    /// Orange (L* 65).
    pub const ORANGE: Fill = Fill::flat(0xe8, 0x84, 0x2c);
    /// Blue (L* 46).
    pub const BLUE: Fill = Fill::flat(0x24, 0x70, 0xb8);
    /// Dark purple (L* 29).
    pub const PURPLE: Fill = Fill::flat(0x5c, 0x2a, 0x86);
    /// Nearly black, reddish (L* 10).
    pub const BLACK: Fill = Fill::flat(0x38, 0x09, 0x0c);
    /// White, hatched by rising lines.
    pub const RISING: Fill = Fill { color: PAPER, rising: true, falling: false };
    /// White, hatched by falling lines.
    pub const FALLING: Fill = Fill { color: PAPER, rising: false, falling: true };
    /// White, hatched by lines in both directions.
    pub const CROSSED: Fill = Fill { color: PAPER, rising: true, falling: true };

    const fn flat(red: u8, green: u8, blue: u8) -> Fill {
        Fill { color: Color(red, green, blue), rising: false, falling: false }
    }

    pub(crate) fn is_hatched(self) -> bool {
        self.rising || self.falling
    }

    /// Draws the hatching over those of `columns` x `rows` cells of a box on the page (millimetres) that have this
    /// fill; columns count from the left, rows from below.
    pub(crate) fn hatch(
        self,
        page: &Area,
        rect: &Rect,
        cells: (usize, usize),
        is_filled: impl Fn(usize, usize) -> bool,
    ) -> Result<(), PlotError> {
        let directions = [(self.rising, 1.0), (self.falling, -1.0)];
        for (_, slope) in directions.into_iter().filter(|(is_drawn, _)| *is_drawn) {
            let lines = hatching(rect, cells, slope, &is_filled);
            let place = |(right, up): Point| (units(rect.left + right), units(rect.bottom() - up));
            for line in lines {
                let points: Vec<BackendCoord> = line.into_iter().map(place).collect();
                page.draw(&Shape::line(points, Pen::solid(GREY, AXIS_WIDTH), in_units(rect)))?;
            }
        }
        Ok(())
    }
}

/// A box in millimetres, in units of the page.
pub(crate) fn in_units(rect: &Rect) -> Rect {
    let [(left, top), (right, bottom)] = rect.corners().map(|(x, y)| (f64::from(x), f64::from(y)));
    Rect { left, top, width: right - left, height: bottom - top }
}

/// Segments of slope 1 or -1 over the cells that are filled, in millimetres right of and above the lower left corner.
fn hatching(
    rect: &Rect,
    (columns, rows): (usize, usize),
    slope: f64,
    is_filled: &impl Fn(usize, usize) -> bool,
) -> Vec<[Point; 2]> {
    let (width, height) = (rect.width, rect.height);
    let (wide, high) = (width / columns as f64, height / rows as f64);
    // up = slope * right + start
    let lowest = if slope > 0.0 { -width } else { 0.0 };
    let step = SPACING * std::f64::consts::SQRT_2;
    let count = ((width + height) / step) as usize;
    let mut lines: Vec<[Point; 2]> = Vec::new();
    for index in 0..=count {
        let start = lowest + (index as f64 + 0.5) * step;
        let across = (0..=columns).map(|column| column as f64 * wide);
        let mut cuts: Vec<f64> = across.chain((0..=rows).map(|row| (row as f64 * high - start) / slope)).collect();
        cuts.sort_by(f64::total_cmp);
        for pair in cuts.windows(2) {
            let at = |right: f64| (right, slope * right + start);
            let (right, up) = at((pair[0] + pair[1]) / 2.0);
            if !(right > 0.0 && right < width && up > 0.0 && up < height) {
                continue;
            }
            let (column, row) = (((right / wide) as usize).min(columns - 1), ((up / high) as usize).min(rows - 1));
            if !is_filled(column, row) {
                continue;
            }
            match lines.last_mut() {
                Some(last) if last[1] == at(pair[0]) => last[1] = at(pair[1]),
                _ => lines.push([at(pair[0]), at(pair[1])]),
            }
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::style::INK;
    use crate::vision::{DEUTERANOPIA, NORMAL, PROTANOPIA, TRITANOPIA, contrast, difference, lab};

    const FLAT: [Fill; 6] = [Fill::PALE, Fill::GREY, Fill::ORANGE, Fill::BLUE, Fill::PURPLE, Fill::BLACK];

    #[test]
    fn classes_differ_in_grey() {
        let lights = FLAT.map(|fill| lab(fill.color, &NORMAL)[0]);
        for pair in lights.windows(2) {
            // the least is 12.4, between grey and orange
            assert!(pair[0] - pair[1] >= 12.0, "{lights:?}");
        }
    }

    #[test]
    fn classes_differ_to_readers_with_any_colour_vision() {
        // the least are 18.3, 18.6, 16.3 and 17.9
        for vision in [NORMAL, PROTANOPIA, DEUTERANOPIA, TRITANOPIA] {
            for (place, one) in FLAT.iter().enumerate() {
                for other in &FLAT[place + 1..] {
                    let apart = difference(one.color, other.color, &vision);
                    assert!(apart >= 16.0, "{one:?} {other:?}: {apart}");
                }
            }
        }
    }

    #[test]
    fn a_class_without_hatching_differs_from_the_ground_of_one_with() {
        for vision in [NORMAL, PROTANOPIA, DEUTERANOPIA, TRITANOPIA] {
            for fill in FLAT {
                let apart = difference(fill.color, Fill::RISING.color, &vision);
                // the least is 6.0 (pale); 2.3 is just noticeable
                assert!(apart >= 5.0, "{fill:?}: {apart}");
            }
        }
    }

    #[test]
    fn a_black_line_with_a_white_rim_stands_out_on_every_class() {
        for fill in FLAT {
            let best = [INK, PAPER].map(|color| contrast(color, fill.color));
            assert!(best.iter().any(|contrast| *contrast >= 4.5), "{fill:?}: {best:?}");
        }
    }

    #[test]
    fn a_hatching_fills_its_cells_and_no_others() {
        let rect = Rect { left: 0.0, top: 0.0, width: 40.0, height: 20.0 };
        let length = |line: &[Point; 2]| (line[1].0 - line[0].0) * std::f64::consts::SQRT_2;
        for slope in [1.0, -1.0] {
            let all = hatching(&rect, (4, 2), slope, &|_, _| true);
            let total: f64 = all.iter().map(length).sum();
            // lines SPACING apart: area over spacing
            assert!((total * SPACING / 800.0 - 1.0).abs() < 0.02, "{total}");
            let corner = hatching(&rect, (4, 2), slope, &|column, row| (column, row) == (3, 1));
            assert!(!corner.is_empty());
            let ends = corner.iter().flatten();
            assert!(ends.copied().all(|(right, up)| right > 29.999 && up > 9.999), "{corner:?}");
        }
    }
}
