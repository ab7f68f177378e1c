//! The house style: every size, stroke and colour of a picture, in one place.
//!
//! Lengths are millimetres on paper. The sizes follow what physics journals ask for: text of 7 to 9 pt and lines of 0.5
//! to 1 pt at the printed size.
//!
//! Choices of contrast, checked by tests in numbers: the series colours are at least 9 apart in L* (so a grey print
//! tells them), at least 15 apart in CIELAB under simulated protanopia and deuteranopia, and each has a contrast of at
//! least 3:1 on white; every series has its own dash pattern as well.

use crate::font::FAMILY;
use crate::page::units;
use plotters::style::{Color as _, FontDesc, IntoFont, ShapeStyle, TextStyle, text_anchor};

/// A colour in sRGB, one byte a channel: red, green, blue.
pub use plotters::style::RGBColor as Color;

/// One typographic point in millimetres.
pub const POINT: f64 = 25.4 / 72.0;
/// Width of one column of a journal page, in millimetres.
pub const COLUMN_WIDTH: f64 = 86.0;
/// Width of a full journal page, in millimetres.
pub const FULL_WIDTH: f64 = 178.0;

/// Resolution of the PNG in dots per inch.
pub(crate) const DOTS_PER_INCH: f64 = 400.0;

/// Sizes of text in one panel; an inset uses smaller ones.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Sizes {
    /// Axis labels.
    pub label: f64,
    /// Numbers at ticks, legends and notes.
    pub tick: f64,
    /// Length of a tick; its number stands as far from its end again.
    pub tick_length: f64,
}

/// Sizes for a panel.
pub(crate) const PANEL: Sizes = Sizes { label: 8.5 * POINT, tick: 7.5 * POINT, tick_length: 0.8 };
/// Sizes for an inset.
pub(crate) const INSET: Sizes = Sizes { label: 7.0 * POINT, tick: 6.5 * POINT, tick_length: 0.6 };

/// Letters and titles of panels.
pub(crate) const TITLE: f64 = 8.5 * POINT;
/// Notes and legends.
pub(crate) const NOTE: f64 = 7.5 * POINT;
/// Names of regions: small enough for a third of a column.
pub(crate) const REGION: f64 = 6.5 * POINT;

/// Space left free along the edge of the page.
pub(crate) const PAGE_EDGE: f64 = 0.6;
/// Space between the numbers at the ticks and the line of the axis label.
pub(crate) const LABEL_GAP: f64 = 0.7;
/// Space between neighbouring panels.
pub(crate) const PANEL_GAP: f64 = 3.0;
/// Space between a row's labels and the titles of the row below.
pub(crate) const ROW_GAP: f64 = 2.0;
/// Height of the row that holds letter and title.
pub(crate) const TITLE_ROW: f64 = 4.6;
/// Distance of the letter's baseline from the box below it.
pub(crate) const TITLE_RISE: f64 = 1.5;

/// Width of a series line: 1 pt.
pub(crate) const SERIES_WIDTH: f64 = POINT;
/// Width of frames and ticks: 0.5 pt.
pub(crate) const AXIS_WIDTH: f64 = 0.5 * POINT;
/// Width of reference lines and guides: 0.6 pt.
pub(crate) const REFERENCE_WIDTH: f64 = 0.6 * POINT;
/// Width of the zero contour: 1 pt.
pub(crate) const CONTOUR_WIDTH: f64 = POINT;
/// Radius of a point marker.
pub(crate) const MARKER_RADIUS: f64 = 0.75;

/// Text, frames, contours.
pub(crate) const INK: Color = Color(0x11, 0x11, 0x11);
/// Reference lines and guides.
pub(crate) const GREY: Color = Color(0x77, 0x77, 0x77);
/// The page.
pub(crate) const PAPER: Color = Color(0xff, 0xff, 0xff);
/// Cells of a map without a value.
pub(crate) const MISSING: Color = Color(0xb8, 0xb8, 0xb0);

/// Series colours in their order of use: blue, orange, near-black, teal, crimson (L* 30, 61, 10, 51, 40).
pub(crate) const SERIES: [Color; 5] = [
    Color(0x00, 0x46, 0x8b),
    Color(0xd9, 0x7a, 0x00),
    Color(0x1b, 0x1b, 0x1b),
    Color(0x00, 0x8a, 0x72),
    Color(0xb8, 0x1c, 0x45),
];

/// Dash patterns in their order of use (on, off, ...) in millimetres; empty is a solid line.
pub(crate) const DASHES: [&[f64]; 6] =
    [&[], &[2.2, 0.9], &[0.7, 0.7], &[3.0, 0.7, 0.7, 0.7], &[4.2, 1.1], &[2.2, 0.7, 0.7, 0.7, 0.7, 0.7]];

/// Dashes of reference lines and of exact curves on maps.
pub(crate) const REFERENCE_DASH: &[f64] = &[1.2, 0.8];

/// A colour as SVG writes it, for instance `#0a141e`.
pub(crate) fn hex(color: Color) -> String {
    format!("#{:02x}{:02x}{:02x}", color.0, color.1, color.2)
}

/// plotters' style of a solid line, its width in millimetres.
pub(crate) fn pen(color: Color, width: f64) -> ShapeStyle {
    color.stroke_width(units(width).unsigned_abs())
}

/// plotters' style of a text, its size in millimetres.
pub(crate) fn text(size: f64, color: Color, across: text_anchor::HPos, up: text_anchor::VPos) -> TextStyle<'static> {
    let font: FontDesc<'static> = (FAMILY, f64::from(units(size))).into_font();
    font.color(&color).pos(text_anchor::Pos::new(across, up))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vision::{DEUTERANOPIA, NORMAL, PROTANOPIA, contrast, difference, lab};

    fn pairs() -> impl Iterator<Item = (Color, Color)> {
        let places = (0..SERIES.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
        places.map(|(i, j)| (SERIES[i], SERIES[j]))
    }

    #[test]
    fn series_differ_in_grey() {
        for (one, other) in pairs() {
            let apart = (lab(one, &NORMAL)[0] - lab(other, &NORMAL)[0]).abs();
            assert!(apart >= 9.0, "{one:?} {other:?}: {apart} in L*");
        }
    }

    #[test]
    fn series_differ_to_colour_blind_readers() {
        for vision in [NORMAL, PROTANOPIA, DEUTERANOPIA] {
            for (one, other) in pairs() {
                let apart = difference(one, other, &vision);
                assert!(apart >= 15.0, "{one:?} {other:?}: {apart}");
            }
        }
    }

    #[test]
    fn series_stand_out_on_paper() {
        for color in SERIES {
            assert!(contrast(color, PAPER) >= 3.0, "{color:?}");
        }
    }

    #[test]
    fn the_reference_dash_is_no_series() {
        assert!(DASHES.iter().all(|dash| *dash != REFERENCE_DASH));
        assert!((0..DASHES.len()).all(|i| (0..i).all(|j| DASHES[i] != DASHES[j])));
    }
}
