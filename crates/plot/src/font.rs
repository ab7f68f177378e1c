//! The two vendored faces and the measures that typesetting needs from them.

use crate::error::PlotError;
use std::sync::OnceLock;
use ttf_parser::Face;

/// Libertinus Serif Regular 7, SIL Open Font Licence 1.1 (see `fonts/OFL.txt`).
pub(crate) const REGULAR: &[u8] = include_bytes!("../fonts/LibertinusSerif-Regular.otf");
/// Libertinus Serif Italic 7, same licence.
pub(crate) const ITALIC: &[u8] = include_bytes!("../fonts/LibertinusSerif-Italic.otf");
/// The family name inside both files.
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
    pub bottom: f64,
    pub top: f64,
}

impl Glyph {
    /// How far the ink leans over the glyph's right edge, in em.
    pub fn overhang(self) -> f64 {
        (self.right - self.advance).max(0.0)
    }
}

/// Measures of a character in the regular or the italic face.
///
/// # Errors
/// [`PlotError::Glyph`] if the face lacks the character: nothing else may take its place.
pub(crate) fn glyph(character: char, italic: bool) -> Result<Glyph, PlotError> {
    let face = face(italic)?;
    let id = face.glyph_index(character).ok_or(PlotError::Glyph { character })?;
    let em = f64::from(face.units_per_em());
    let ink = face.glyph_bounding_box(id);
    let side = |value: Option<i16>| f64::from(value.unwrap_or(0)) / em;
    Ok(Glyph {
        advance: f64::from(face.glyph_hor_advance(id).unwrap_or(0)) / em,
        left: side(ink.map(|b| b.x_min)),
        right: side(ink.map(|b| b.x_max)),
        bottom: side(ink.map(|b| b.y_min)),
        top: side(ink.map(|b| b.y_max)),
    })
}

fn face(italic: bool) -> Result<&'static Face<'static>, PlotError> {
    static FACES: OnceLock<[Option<Face<'static>>; 2]> = OnceLock::new();
    let parse = |data| Face::parse(data, 0).ok();
    let faces = FACES.get_or_init(|| [parse(REGULAR), parse(ITALIC)]);
    let broken = || PlotError::Backend("a vendored font cannot be read".to_owned());
    faces[usize::from(italic)].as_ref().ok_or_else(broken)
}
