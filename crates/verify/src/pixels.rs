//! Compares the pixels of two pictures, and draws their difference.

use serde::Serialize;
use std::io::Cursor;

/// A picture as rows of red, green, blue, alpha.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Four bytes a pixel, row by row from the top.
    pub rgba: Vec<u8>,
}

/// A pixel counts as changed above a threshold when the largest difference of its channels, 0 to 255, is larger.
pub const THRESHOLDS: [u8; 8] = [0, 1, 2, 4, 8, 16, 32, 64];

/// How two pictures of the same size differ.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Pixels {
    /// All pixels.
    pub pixels: usize,
    /// Those that are not equal.
    pub changed: usize,
    /// Largest difference of a channel.
    pub largest: u8,
    /// Share of the pixels that changed by more than each of [`THRESHOLDS`].
    pub shares: [f64; THRESHOLDS.len()],
    /// The smallest box around all changed pixels: left, top, right, bottom, the last two included.
    pub within: Option<[usize; 4]>,
}

impl Image {
    /// Decodes a PNG.
    ///
    /// # Errors
    /// The decoder's words: a file that is cut short, or no PNG.
    pub fn decode(bytes: &[u8]) -> Result<Image, String> {
        let words = |error: png::DecodingError| error.to_string();
        let mut decoder = png::Decoder::new(Cursor::new(bytes));
        decoder.set_transformations(png::Transformations::ALPHA | png::Transformations::STRIP_16);
        let mut reader = decoder.read_info().map_err(words)?;
        let mut buffer = vec![0; reader.output_buffer_size().ok_or("too large")?];
        let frame = reader.next_frame(&mut buffer).map_err(words)?;
        reader.finish().map_err(words)?;
        let (width, height) = (frame.width, frame.height);
        let rgba = match frame.color_type {
            png::ColorType::Rgba => buffer,
            png::ColorType::GrayscaleAlpha => {
                buffer.chunks_exact(2).flat_map(|pixel| [pixel[0], pixel[0], pixel[0], pixel[1]]).collect()
            }
            other => return Err(format!("pixels of {other:?}")),
        };
        Ok(Image { width, height, rgba })
    }

    /// Encodes a PNG.
    ///
    /// # Errors
    /// The encoder's words.
    pub fn encode(&self) -> Result<Vec<u8>, String> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, self.width, self.height);
        encoder.set_color(png::ColorType::Rgba);
        encoder.set_depth(png::BitDepth::Eight);
        let written = encoder.write_header().and_then(|mut writer| writer.write_image_data(&self.rgba));
        written.map_err(|error| error.to_string())?;
        Ok(bytes)
    }

    /// The pixels, four channels each.
    fn pixels(&self) -> impl Iterator<Item = &[u8]> {
        self.rgba.chunks_exact(4)
    }
}

/// Compares two pictures.
///
/// # Errors
/// Their sizes, when these are not equal.
pub fn compare(expected: &Image, actual: &Image) -> Result<Pixels, String> {
    let size = |image: &Image| format!("{} x {}", image.width, image.height);
    if (expected.width, expected.height) != (actual.width, actual.height) {
        return Err(format!("expected {} pixels, found {}", size(expected), size(actual)));
    }
    let width = expected.width as usize;
    let mut found = Pixels { pixels: width * expected.height as usize, ..Pixels::default() };
    let mut above = [0_usize; THRESHOLDS.len()];
    for (index, (one, other)) in expected.pixels().zip(actual.pixels()).enumerate() {
        let apart = distance(one, other);
        if apart == 0 {
            continue;
        }
        let (x, y) = (index % width, index / width);
        let [left, top, right, bottom] = found.within.unwrap_or([x, y, x, y]);
        found.within = Some([left.min(x), top.min(y), right.max(x), bottom.max(y)]);
        found.changed += 1;
        found.largest = found.largest.max(apart);
        above.iter_mut().zip(THRESHOLDS).for_each(|(count, threshold)| *count += usize::from(apart > threshold));
    }
    found.shares = above.map(|count| count as f64 / found.pixels.max(1) as f64);
    Ok(found)
}

/// The expected picture in pale grey, with changed pixels in red, darker for larger changes.
pub fn difference(expected: &Image, actual: &Image) -> Image {
    let pixel = |(one, other): (&[u8], &[u8])| match distance(one, other) {
        0 => {
            let grey = (one[..3].iter().map(|&channel| u16::from(channel)).sum::<u16>() / 3) as u8;
            let pale = 192 + grey / 4;
            [pale, pale, pale, 255]
        }
        apart => [255 - apart / 3, 96 - apart / 3, 96 - apart / 3, 255],
    };
    let rgba = expected.pixels().zip(actual.pixels()).flat_map(pixel).collect();
    Image { width: expected.width, height: expected.height, rgba }
}

/// The largest difference of the channels of two pixels.
fn distance(one: &[u8], other: &[u8]) -> u8 {
    one.iter().zip(other).map(|(a, b)| a.abs_diff(*b)).max().unwrap_or(0)
}
