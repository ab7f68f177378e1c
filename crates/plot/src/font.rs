//! The two vendored typefaces: metrics for typesetting, and glyph outlines.

use crate::error::PlotError;
use std::sync::OnceLock;
use tiny_skia::PathBuilder;
use ttf_parser::{Face, OutlineBuilder};

/// Libertinus Serif Regular 7, SIL Open Font Licence 1.1 (see `fonts/OFL.txt`).
const REGULAR: &[u8] = include_bytes!("../fonts/LibertinusSerif-Regular.otf");
/// Libertinus Serif Italic 7, same licence.
const ITALIC: &[u8] = include_bytes!("../fonts/LibertinusSerif-Italic.otf");
/// The name by which plotters knows the face; the host is never asked for it.
pub(crate) const FAMILY: &str = "Libertinus Serif";

/// Height of lower-case letters without ascender, in em.
pub(crate) const X_HEIGHT: f64 = 0.43;
/// Height of digits, in em.
pub(crate) const DIGIT_HEIGHT: f64 = 0.645;
/// Sideways shift of the italic per height: tan(12 degrees).
pub(crate) const SLANT: f64 = 0.2126;

/// Measures of one glyph in em; the box is the ink's.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Glyph {
    pub advance: f64,
    pub left: f64,
    pub right: f64,
    pub top: f64,
}

impl Glyph {
    /// How far the ink leans over the glyph's right edge, in em.
    pub fn overhang(self) -> f64 {
        crate::geometry::larger(self.right - self.advance, 0.0)
    }
}

/// Measures of a character in the regular or the italic face.
///
/// # Errors
/// The face lacks the character: nothing else may take its place.
pub(crate) fn glyph(character: char, italic: bool) -> Result<Glyph, PlotError> {
    let face = face(italic)?;
    let id = face.glyph_index(character).ok_or_else(|| missing(character))?;
    let em = f64::from(face.units_per_em());
    let ink = face.glyph_bounding_box(id);
    let side = |value: Option<i16>| f64::from(value.unwrap_or(0)) / em;
    Ok(Glyph {
        advance: f64::from(face.glyph_hor_advance(id).unwrap_or(0)) / em,
        left: side(ink.map(|b| b.x_min)),
        right: side(ink.map(|b| b.x_max)),
        top: side(ink.map(|b| b.y_max)),
    })
}

/// Appends a glyph's outline; `place` takes points in em, y upwards, to where they go.
///
/// # Errors
/// The face lacks the character.
pub(crate) fn outline(
    character: char,
    italic: bool,
    path: &mut PathBuilder,
    place: impl Fn(f64, f64) -> (f32, f32),
) -> Result<(), PlotError> {
    let face = face(italic)?;
    let id = face.glyph_index(character).ok_or_else(|| missing(character))?;
    let em = f64::from(face.units_per_em());
    // a blank has no outline
    let _ = face.outline_glyph(id, &mut Tracer { path, place: |x, y| place(f64::from(x) / em, f64::from(y) / em) });
    Ok(())
}

struct Tracer<'a, F> {
    path: &'a mut PathBuilder,
    place: F,
}

impl<F: Fn(f32, f32) -> (f32, f32)> OutlineBuilder for Tracer<'_, F> {
    fn move_to(&mut self, x: f32, y: f32) {
        let (x, y) = (self.place)(x, y);
        self.path.move_to(x, y);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        let (x, y) = (self.place)(x, y);
        self.path.line_to(x, y);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let ((x1, y1), (x, y)) = ((self.place)(x1, y1), (self.place)(x, y));
        self.path.quad_to(x1, y1, x, y);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        let ((x1, y1), (x2, y2), (x, y)) = ((self.place)(x1, y1), (self.place)(x2, y2), (self.place)(x, y));
        self.path.cubic_to(x1, y1, x2, y2, x, y);
    }

    fn close(&mut self) {
        self.path.close();
    }
}

fn missing(character: char) -> PlotError {
    let code = u32::from(character);
    PlotError(format!("the vendored fonts have no glyph for '{character}' (U+{code:04X})"))
}

fn face(italic: bool) -> Result<&'static Face<'static>, PlotError> {
    static FACES: OnceLock<[Option<Face<'static>>; 2]> = OnceLock::new();
    let parse = |data| Face::parse(data, 0).ok();
    let faces = FACES.get_or_init(|| [parse(REGULAR), parse(ITALIC)]);
    let broken = || PlotError("drawing: a vendored font cannot be read".to_owned());
    faces[usize::from(italic)].as_ref().ok_or_else(broken)
}
