//! What every finished page must hold.

use crate::samples::{curves, maps, sketch, space_time};
use plot::{Picture, PlotError, decode};

fn pictures() -> Vec<(&'static str, Picture)> {
    vec![("curves", curves()), ("maps", maps()), ("space-time", space_time(12, 200)), ("sketch", sketch())]
}

#[test]
fn same_data_same_bytes() -> Result<(), PlotError> {
    for (name, picture) in pictures() {
        assert!(picture.clone().render()? == picture.render()?, "{name}");
    }
    Ok(())
}

#[test]
fn the_page_has_its_physical_size() -> Result<(), PlotError> {
    let files = sketch().render()?;
    let pixels = decode(&files.png)?;
    // 60 mm and 22 mm at 400 dots per inch.
    assert_eq!((pixels.width, pixels.height), (945, 346));
    assert_eq!(pixels.rgba.len(), 945 * 346 * 4);
    Ok(())
}

#[test]
fn nothing_touches_the_edge_of_the_page() -> Result<(), PlotError> {
    for (name, picture) in pictures() {
        let pixels = decode(&picture.render()?.png)?;
        let (width, height) = (pixels.width as usize, pixels.height as usize);
        // 0.3 mm at 400 dots per inch.
        let rim = 5;
        for (index, pixel) in pixels.rgba.chunks_exact(4).enumerate() {
            let (x, y) = (index % width, index / width);
            let outside = x < rim || y < rim || x >= width - rim || y >= height - rim;
            assert!(!outside || pixel == [255; 4], "{name}: ink at pixel {x}, {y} of {width} x {height}");
        }
    }
    Ok(())
}

#[test]
fn letters_are_outlines() -> Result<(), PlotError> {
    for (name, picture) in pictures() {
        let svg = String::from_utf8_lossy(&picture.render()?.svg).into_owned();
        assert!(!svg.contains("<text") && !svg.contains("font"), "{name}");
    }
    Ok(())
}

#[test]
fn every_insert_arrives() -> Result<(), PlotError> {
    // Two maps and the bar are images; placeholders must not stay behind.
    let svg = String::from_utf8_lossy(&maps().render()?.svg).into_owned();
    assert_eq!(svg.matches("<image").count(), 3);
    assert!(!svg.contains("opacity"), "a placeholder was left in the page");
    Ok(())
}

#[test]
fn a_run_of_the_size_of_figure_11_stays_small() -> Result<(), PlotError> {
    let files = space_time(133, 3000).render()?;
    assert!(files.svg.len() < 1_000_000 && files.png.len() < 1_000_000, "{} {}", files.svg.len(), files.png.len());
    Ok(())
}
