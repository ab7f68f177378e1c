//! The pixel surface.

use crate::error::PlotError;
use crate::page::{Pen, Surface, units};
use crate::raster::{self, Raster};
use crate::style::{Color, DOTS_PER_INCH};
use plotters_backend::BackendCoord;
use tiny_skia::{FillRule, LineJoin, Paint, Path, Pixmap, PremultipliedColorU8, Stroke, StrokeDash, Transform};

/// A page of pixels.
pub struct Pixels {
    pixmap: Pixmap,
    /// Pixels in a unit of the page, across and down: the page is a whole number of pixels.
    scale: (f32, f32),
}

impl Pixels {
    /// An empty page of a size in millimetres.
    ///
    /// # Errors
    /// It has no pixel, or too many.
    pub fn new(width: f64, height: f64) -> Result<Self, PlotError> {
        let dots = |length: f64| (length / 25.4 * DOTS_PER_INCH).round() as u32;
        let (columns, rows) = (dots(width), dots(height));
        let pixmap = Pixmap::new(columns, rows).ok_or_else(|| PlotError::room("the page", width, height))?;
        Ok(Self { pixmap, scale: (columns as f32 / units(width) as f32, rows as f32 / units(height) as f32) })
    }

    /// The finished PNG. The page is painted white first, so every pixel is opaque.
    pub fn png(&self) -> Result<Vec<u8>, PlotError> {
        let rgb: Vec<u8> = self.pixmap.pixels().iter().flat_map(|dot| [dot.red(), dot.green(), dot.blue()]).collect();
        let dots = (DOTS_PER_INCH / 0.0254).round() as u32;
        raster::encode(self.pixmap.width() as usize, self.pixmap.height() as usize, &rgb, |encoder| {
            encoder.set_color(png::ColorType::Rgb);
            // Flat areas and repeated letters: deflate finds more in them than any filter (measured).
            encoder.set_filter(png::Filter::NoFilter);
            let size = png::PixelDimensions { xppu: dots, yppu: dots, unit: png::Unit::Meter };
            encoder.set_pixel_dims(Some(size));
        })
    }

    fn transform(&self) -> Transform {
        Transform::from_scale(self.scale.0, self.scale.1)
    }
}

fn paint(color: Color) -> Paint<'static> {
    let mut paint = Paint::default();
    paint.set_color_rgba8(color.0, color.1, color.2, 255);
    paint
}

impl Surface for Pixels {
    fn fill(&mut self, path: &Path, color: Color) {
        self.pixmap.fill_path(path, &paint(color), FillRule::Winding, self.transform(), None);
    }

    fn stroke(&mut self, path: &Path, pen: &Pen) {
        let lengths = pen.dash.iter().map(|length| units(*length) as f32).collect();
        let stroke = Stroke {
            width: units(pen.width) as f32,
            line_join: LineJoin::Round,
            dash: StrokeDash::new(lengths, 0.0),
            ..Stroke::default()
        };
        self.pixmap.stroke_path(path, &paint(pen.color), &stroke, self.transform(), None);
    }

    fn image(&mut self, image: &Raster, from: BackendCoord, to: BackendCoord) -> Result<(), PlotError> {
        let (columns, rows) = (self.pixmap.width() as usize, self.pixmap.height() as usize);
        let dot = |unit: i32, scale: f32, most: usize| ((unit as f32 * scale).round() as usize).min(most);
        let (left, right) = (dot(from.0, self.scale.0, columns), dot(to.0, self.scale.0, columns));
        let (top, bottom) = (dot(from.1, self.scale.1, rows), dot(to.1, self.scale.1, rows));
        let pixels = self.pixmap.pixels_mut();
        for row in top..bottom {
            for column in left..right {
                // the pixel of the image below the middle of the dot
                let across = (2 * (column - left) + 1) * image.width() / (2 * (right - left));
                let down = (2 * (row - top) + 1) * image.height() / (2 * (bottom - top));
                let Color(red, green, blue) = image.color(across, down);
                let dot = PremultipliedColorU8::from_rgba(red, green, blue, 255);
                pixels[row * columns + column] = dot.unwrap_or(PremultipliedColorU8::TRANSPARENT);
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::page::Page;
    use crate::style::{INK, PAPER, pen};
    use plotters_backend::DrawingBackend;

    fn color(page: &Page<Pixels>, column: u32, row: u32) -> Option<Color> {
        page.surface.pixmap.pixel(column, row).map(|dot| Color(dot.red(), dot.green(), dot.blue()))
    }

    #[test]
    fn shapes_lie_where_they_were_drawn() -> Result<(), PlotError> {
        // 400 dots: a dot is 63.5 units
        let mut page = Page::new((25_400, 25_400), Pixels::new(25.4, 25.4)?);
        page.draw_rect((0, 0), (25_400, 25_400), &PAPER, true).expect("drawn");
        page.draw_line((0, 12_700), (25_400, 12_700), &pen(INK, 0.635)).expect("drawn");
        assert_eq!((color(&page, 200, 194), color(&page, 200, 195)), (Some(PAPER), Some(INK)));
        assert_eq!((color(&page, 200, 204), color(&page, 200, 205)), (Some(INK), Some(PAPER)));
        Ok(())
    }

    #[test]
    fn pixels_of_images_stay_sharp() -> Result<(), PlotError> {
        let mut page = Page::new((25_400, 25_400), Pixels::new(25.4, 25.4)?);
        let board = Raster::from_fn(2, 2, vec![PAPER, INK], |column, row| ((column + row) % 2) as u8);
        page.surface.image(&board, (0, 0), (12_700, 25_400))?;
        let found = [(99, 199), (100, 199), (99, 200), (100, 200)].map(|(column, row)| color(&page, column, row));
        assert_eq!(found, [PAPER, INK, INK, PAPER].map(Some));
        assert_eq!(page.surface.pixmap.pixel(200, 0).map(|dot| dot.alpha()), Some(0));
        Ok(())
    }
}
