//! Small pixel images, and PNG files.

use crate::error::PlotError;
use crate::style::Color;

/// An image of few colours: rows from the top, pixels from the left, each the place of its colour in the palette.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Raster {
    width: usize,
    height: usize,
    palette: Vec<Color>,
    pixels: Vec<u8>,
}

impl Raster {
    /// An image whose pixel at column and row (from the top) is given by a function.
    pub fn from_fn(width: usize, height: usize, palette: Vec<Color>, shade: impl Fn(usize, usize) -> u8) -> Self {
        let places = (0..height).flat_map(|row| (0..width).map(move |column| (column, row)));
        let pixels = places.map(|(column, row)| shade(column, row)).collect();
        Self { width, height, palette, pixels }
    }

    /// Pixels in a row.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Rows.
    pub fn height(&self) -> usize {
        self.height
    }

    /// The colour at a column and row inside the image.
    pub fn color(&self, column: usize, row: usize) -> Color {
        self.palette[usize::from(self.pixels[row * self.width + column])]
    }

    /// The image as a PNG.
    pub fn png(&self) -> Result<Vec<u8>, PlotError> {
        let palette: Vec<u8> = self.palette.iter().flat_map(|color| [color.0, color.1, color.2]).collect();
        encode(self.width, self.height, &self.pixels, |encoder| {
            encoder.set_color(png::ColorType::Indexed);
            encoder.set_palette(palette);
        })
    }
}

/// A PNG file of one byte a pixel and channel, after some settings.
pub(crate) fn encode<'a>(
    width: usize,
    height: usize,
    pixels: &[u8],
    settings: impl FnOnce(&mut png::Encoder<'a, &mut Vec<u8>>),
) -> Result<Vec<u8>, PlotError> {
    let mut file = Vec::new();
    let write = |file| -> Result<(), png::EncodingError> {
        let mut encoder = png::Encoder::new(file, width as u32, height as u32);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_compression(png::Compression::Balanced);
        settings(&mut encoder);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(pixels)?;
        writer.finish()
    };
    write(&mut file).map_err(|reason| PlotError(format!("PNG: {reason}")))?;
    Ok(file)
}
