//! Small images of pixels, and PNG files in and out.

use crate::color::Color;
use crate::error::PlotError;

/// An image of few colours: rows from the top, pixels from the left, each the place of its colour
/// in the palette.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Raster {
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

    /// The image as a `data:` address that holds a PNG.
    pub fn data_url(&self) -> Result<String, PlotError> {
        let mut file = Vec::new();
        let mut encoder = encoder(&mut file, self.width, self.height, png::ColorType::Indexed);
        encoder.set_palette(self.palette.iter().flat_map(|color| color.bytes()).collect::<Vec<u8>>());
        let mut writer = encoder.write_header().map_err(encoding)?;
        writer.write_image_data(&self.pixels).map_err(encoding)?;
        writer.finish().map_err(encoding)?;
        Ok(format!("data:image/png;base64,{}", base64(&file)))
    }
}

fn encoding(reason: png::EncodingError) -> PlotError {
    PlotError::Backend(format!("PNG: {reason}"))
}

fn encoder(file: &mut Vec<u8>, width: usize, height: usize, colors: png::ColorType) -> png::Encoder<'_, &mut Vec<u8>> {
    let mut encoder = png::Encoder::new(file, width as u32, height as u32);
    encoder.set_color(colors);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::Balanced);
    encoder
}

/// A PNG file of 8-bit red, green, blue with its resolution.
pub(crate) fn encode(width: usize, height: usize, rgb: &[u8], dots_per_metre: u32) -> Result<Vec<u8>, PlotError> {
    let mut file = Vec::new();
    let mut encoder = encoder(&mut file, width, height, png::ColorType::Rgb);
    // Flat areas and repeated letters: deflate finds more in them than any filter (measured).
    encoder.set_filter(png::Filter::NoFilter);
    let size = png::PixelDimensions { xppu: dots_per_metre, yppu: dots_per_metre, unit: png::Unit::Meter };
    encoder.set_pixel_dims(Some(size));
    let mut writer = encoder.write_header().map_err(encoding)?;
    writer.write_image_data(rgb).map_err(encoding)?;
    writer.finish().map_err(encoding)?;
    Ok(file)
}

/// The pixels of a PNG made by this crate.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Pixels {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Rows from the top, pixels from the left, four bytes each: red, green, blue, opacity.
    pub rgba: Vec<u8>,
}

/// Decodes a PNG of 8-bit colours into its pixels, so that pictures can be hashed or compared
/// whatever the encoder's version.
///
/// # Errors
/// [`PlotError::Backend`] if the bytes are no PNG of 8-bit RGB or RGBA.
pub fn decode(file: &[u8]) -> Result<Pixels, PlotError> {
    let fault = |reason: png::DecodingError| PlotError::Backend(format!("PNG: {reason}"));
    let mut reader = png::Decoder::new(std::io::Cursor::new(file)).read_info().map_err(fault)?;
    let size = reader.output_buffer_size().ok_or_else(|| PlotError::Backend("PNG: too large".to_owned()))?;
    let mut bytes = vec![0; size];
    let info = reader.next_frame(&mut bytes).map_err(fault)?;
    bytes.truncate(info.buffer_size());
    let rgba = match (info.color_type, info.bit_depth) {
        (png::ColorType::Rgba, png::BitDepth::Eight) => bytes,
        (png::ColorType::Rgb, png::BitDepth::Eight) => {
            bytes.chunks_exact(3).flat_map(|c| [c[0], c[1], c[2], 255]).collect()
        }
        (color, depth) => {
            return Err(PlotError::Backend(format!("PNG: {color:?} of {depth:?} bits; 8-bit RGB or RGBA needed")));
        }
    };
    Ok(Pixels { width: info.width, height: info.height, rgba })
}

/// Base64 of RFC 4648, with padding.
fn base64(bytes: &[u8]) -> String {
    const ALPHABET: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for chunk in bytes.chunks(3) {
        let byte = |index: usize| u32::from(chunk.get(index).copied().unwrap_or(0));
        let group = byte(0) << 16 | byte(1) << 8 | byte(2);
        for place in 0..4 {
            let digit = ALPHABET[(group >> (18 - 6 * place) & 63) as usize];
            text.push(if place <= chunk.len() { char::from(digit) } else { '=' });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_of_the_standard() {
        // RFC 4648, section 10.
        for (plain, coded) in [("", ""), ("f", "Zg=="), ("fo", "Zm8="), ("foo", "Zm9v"), ("foobar", "Zm9vYmFy")] {
            assert_eq!(base64(plain.as_bytes()), coded);
        }
    }

    #[test]
    fn pixels_survive_the_file() -> Result<(), PlotError> {
        let rgb: Vec<u8> = (0..45).map(|byte| byte * 5).collect();
        let pixels = decode(&encode(5, 3, &rgb, 15748)?)?;
        let read: Vec<u8> = pixels.rgba.chunks_exact(4).flat_map(|c| [c[0], c[1], c[2]]).collect();
        assert_eq!((pixels.width, pixels.height, read), (5, 3, rgb));
        Ok(())
    }
}
