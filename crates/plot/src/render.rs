//! From the drawing's SVG to the two files: pixels, and an SVG whose text is outlines.

use crate::canvas::UNITS;
use crate::error::PlotError;
use crate::font;
use crate::raster;
use crate::style::DOTS_PER_INCH;
use resvg::{tiny_skia, usvg};
use std::sync::{Arc, OnceLock};

/// A finished picture: the bytes of two files that look alike everywhere.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Rendered {
    /// SVG without text or fonts: letters are outlines.
    pub svg: Vec<u8>,
    /// PNG of 400 dots per inch, 8-bit colours, with its physical size.
    pub png: Vec<u8>,
}

/// Makes both files from plotters' SVG and the pieces that go in place of the placeholders.
pub(crate) fn render(drawing: &str, inserts: &[String], width: f64, height: f64) -> Result<Rendered, PlotError> {
    let svg = assemble(drawing, inserts, width, height)?;
    let options = usvg::Options {
        font_family: font::FAMILY.to_owned(),
        fontdb: fonts(),
        image_rendering: usvg::ImageRendering::OptimizeSpeed,
        ..usvg::Options::default()
    };
    let tree = usvg::Tree::from_str(&svg, &options).map_err(|reason| PlotError::Backend(reason.to_string()))?;
    let outlines = usvg::WriteOptions {
        coordinates_precision: 1,
        indent: usvg::Indent::None,
        attributes_indent: usvg::Indent::None,
        ..usvg::WriteOptions::default()
    };
    Ok(Rendered { svg: tree.to_string(&outlines).into_bytes(), png: pixels(&tree, width, height)? })
}

fn fonts() -> Arc<usvg::fontdb::Database> {
    static FONTS: OnceLock<Arc<usvg::fontdb::Database>> = OnceLock::new();
    let load = || {
        let mut fonts = usvg::fontdb::Database::new();
        fonts.load_font_data(font::REGULAR.to_vec());
        fonts.load_font_data(font::ITALIC.to_vec());
        Arc::new(fonts)
    };
    FONTS.get_or_init(load).clone()
}

/// Gives the page its physical size and puts the pieces in place of the placeholders.
fn assemble(drawing: &str, inserts: &[String], width: f64, height: f64) -> Result<String, PlotError> {
    let body = drawing.find('\n').map_or("", |end| &drawing[end + 1..]);
    let (units_wide, units_high) = ((width * UNITS).round(), (height * UNITS).round());
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}mm\" height=\"{height}mm\" \
         viewBox=\"0 0 {units_wide} {units_high}\" stroke-linejoin=\"round\">\n"
    );
    let mut next = inserts.iter();
    for line in body.lines() {
        let is_placeholder = line.starts_with("<rect") && line.contains("opacity=\"0.5\"");
        let piece = if is_placeholder { next.next().map(String::as_str) } else { Some(line) };
        svg.push_str(piece.ok_or_else(|| PlotError::Backend("a placeholder without its piece".to_owned()))?);
        svg.push('\n');
    }
    match next.next() {
        None => Ok(svg),
        Some(_) => Err(PlotError::Backend("a piece without its placeholder".to_owned())),
    }
}

fn pixels(tree: &usvg::Tree, width: f64, height: f64) -> Result<Vec<u8>, PlotError> {
    let dots = |length: f64| (length / 25.4 * DOTS_PER_INCH).round() as u32;
    let (columns, rows) = (dots(width), dots(height));
    let mut pixmap = tiny_skia::Pixmap::new(columns, rows).ok_or_else(|| PlotError::Room {
        what: "page".to_owned(),
        width,
        height,
    })?;
    let size = tree.size();
    let scale = tiny_skia::Transform::from_scale(columns as f32 / size.width(), rows as f32 / size.height());
    resvg::render(tree, scale, &mut pixmap.as_mut());
    // The page is painted white first, so every pixel is opaque.
    let rgb: Vec<u8> = pixmap.data().chunks_exact(4).flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect();
    let dots_per_metre = (DOTS_PER_INCH / 0.0254).round() as u32;
    raster::encode(columns as usize, rows as usize, &rgb, dots_per_metre)
}
