//! Properties of every finished page.

use crate::gallery::{KINDS, page};
use plot::{PlotError, Rendered};
use std::sync::OnceLock;

/// The pictures of the gallery by name, drawn once.
fn pictures() -> Result<&'static [(&'static str, Rendered)], PlotError> {
    static PICTURES: OnceLock<Result<Vec<(&'static str, Rendered)>, PlotError>> = OnceLock::new();
    let draw = || KINDS.into_iter().map(|(name, _, picture)| Ok((name, picture().render()?))).collect();
    PICTURES.get_or_init(draw).as_deref().map_err(Clone::clone)
}

/// Width, height and bytes (red, green, blue) of a PNG.
fn decode(file: &[u8]) -> (usize, usize, Vec<u8>) {
    let mut reader = png::Decoder::new(std::io::Cursor::new(file)).read_info().expect("a PNG");
    let mut bytes = vec![0; reader.output_buffer_size().expect("a size")];
    let info = reader.next_frame(&mut bytes).expect("pixels");
    assert_eq!((info.color_type, info.bit_depth), (png::ColorType::Rgb, png::BitDepth::Eight));
    (info.width as usize, info.height as usize, bytes)
}

#[test]
fn the_gallery_is_what_the_code_draws() -> Result<(), PlotError> {
    let same = include_str!("../../gallery.html") == page()?;
    assert!(same, "gallery.html is out of date: cargo run --release -p plot --example gallery");
    Ok(())
}

#[test]
fn the_page_has_its_physical_size() -> Result<(), PlotError> {
    let (_, files) = &pictures()?[5];
    let (width, height, _) = decode(&files.png);
    // 86 mm and 24 mm at 400 dots per inch
    assert_eq!((width, height), (1354, 378));
    let svg = String::from_utf8_lossy(&files.svg).into_owned();
    assert!(svg.contains("width=\"86mm\" height=\"24mm\" viewBox=\"0 0 86000 24000\""), "{}", &svg[..200]);
    Ok(())
}

#[test]
fn nothing_touches_the_edge_of_the_page() -> Result<(), PlotError> {
    for (name, files) in pictures()? {
        let (width, height, bytes) = decode(&files.png);
        // 0.3 mm at 400 dots per inch
        let rim = 5;
        for (index, pixel) in bytes.chunks_exact(3).enumerate() {
            let (x, y) = (index % width, index / width);
            let outside = x < rim || y < rim || x >= width - rim || y >= height - rim;
            assert!(!outside || pixel == [255; 3], "{name}: ink at pixel {x}, {y} of {width} x {height}");
        }
    }
    Ok(())
}

#[test]
fn letters_are_outlines() -> Result<(), PlotError> {
    for (name, files) in pictures()? {
        let svg = String::from_utf8_lossy(&files.svg);
        assert!(!svg.contains("<text") && !svg.contains("font") && !svg.contains("opacity"), "{name}");
    }
    Ok(())
}

#[test]
fn maps_and_fields_are_images() -> Result<(), PlotError> {
    for (kind, images) in [(3, 3), (4, 2)] {
        let (name, files) = &pictures()?[kind];
        let svg = String::from_utf8_lossy(&files.svg);
        // the bar is one
        assert_eq!(svg.matches("<image").count(), images, "{name}");
    }
    Ok(())
}
