//! The surface that writes SVG: every shape a path of whole micrometres, letters as outlines, no fonts, no scripts.

use crate::error::PlotError;
use crate::page::{Pen, Surface, units};
use crate::raster::Raster;
use crate::style::{Color, hex};
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use plotters_backend::BackendCoord;
use std::fmt::Write as _;
use tiny_skia::{Path, PathSegment, Point};

/// An SVG in the making.
pub struct Svg {
    text: String,
    /// The path that is still open: lines of one pen that follow each other become one path.
    open: Option<Pen>,
}

impl Svg {
    /// An empty drawing of a size in millimetres.
    pub fn new(width: f64, height: f64) -> Self {
        let text = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" width=\"{width}mm\" height=\"{height}mm\" \
             viewBox=\"0 0 {} {}\" fill=\"none\" stroke-linejoin=\"round\">",
            units(width),
            units(height)
        );
        Self { text, open: None }
    }

    /// The finished text.
    pub fn finish(&mut self) -> Vec<u8> {
        self.close();
        self.text.push_str("\n</svg>\n");
        std::mem::take(&mut self.text).into_bytes()
    }

    fn close(&mut self) {
        if self.open.take().is_some() {
            self.text.push_str("\"/>");
        }
    }

    // writing to a String cannot fail
    fn write(&mut self, words: std::fmt::Arguments<'_>) {
        let _ = self.text.write_fmt(words);
    }
}

impl Surface for Svg {
    fn fill(&mut self, path: &Path, color: Color) {
        self.close();
        self.write(format_args!("\n<path fill=\"{}\" d=\"", hex(color)));
        data(path, &mut self.text);
        self.text.push_str("\"/>");
    }

    fn stroke(&mut self, path: &Path, pen: &Pen) {
        if self.open != Some(*pen) {
            self.close();
            let width = units(pen.width);
            self.write(format_args!("\n<path stroke=\"{}\" stroke-width=\"{width}\"", hex(pen.color)));
            if !pen.dash.is_empty() {
                let lengths: Vec<String> = pen.dash.iter().map(|length| units(*length).to_string()).collect();
                self.write(format_args!(" stroke-dasharray=\"{}\"", lengths.join(" ")));
            }
            self.text.push_str(" d=\"");
            self.open = Some(*pen);
        }
        data(path, &mut self.text);
    }

    fn circle(&mut self, (x, y): BackendCoord, radius: u32, color: Color, width: Option<f64>) {
        self.close();
        let ink = match width {
            Some(width) => format!("stroke=\"{}\" stroke-width=\"{}\"", hex(color), units(width)),
            None => format!("fill=\"{}\"", hex(color)),
        };
        self.write(format_args!("\n<circle cx=\"{x}\" cy=\"{y}\" r=\"{radius}\" {ink}/>"));
    }

    fn image(&mut self, image: &Raster, (left, top): BackendCoord, to: BackendCoord) -> Result<(), PlotError> {
        self.close();
        let (width, height) = (to.0 - left, to.1 - top);
        // Inkscape 1.2 finds images by the older name of the attribute only
        let file = STANDARD.encode(image.png()?);
        self.write(format_args!(
            "\n<image x=\"{left}\" y=\"{top}\" width=\"{width}\" height=\"{height}\" preserveAspectRatio=\"none\" \
             image-rendering=\"optimizeSpeed\" style=\"image-rendering:pixelated\" \
             xlink:href=\"data:image/png;base64,{file}\"/>"
        ));
        Ok(())
    }
}

/// Appends the commands of a path, from point to point relative to the one before: shorter than absolute.
fn data(path: &Path, text: &mut String) {
    let whole = |point: Point| (point.x.round() as i32, point.y.round() as i32);
    let (mut start, mut at) = ((0, 0), (0, 0));
    let steps = |text: &mut String, letter: char, points: &[Point], at: &mut BackendCoord| {
        text.push(letter);
        for point in points {
            let (x, y) = whole(*point);
            let _ = write!(text, "{} {} ", x - at.0, y - at.1);
        }
        text.pop();
        *at = points.last().map_or(*at, |point| whole(*point));
    };
    for segment in path.segments() {
        match segment {
            PathSegment::MoveTo(to) => {
                at = whole(to);
                start = at;
                let _ = write!(text, "M{} {}", at.0, at.1);
            }
            PathSegment::LineTo(to) => steps(text, 'l', &[to], &mut at),
            PathSegment::QuadTo(by, to) => steps(text, 'q', &[by, to], &mut at),
            PathSegment::CubicTo(by, then, to) => steps(text, 'c', &[by, then, to], &mut at),
            PathSegment::Close => {
                text.push('z');
                at = start;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::page::Page;
    use crate::style::{INK, PAPER, REFERENCE_DASH, pen};
    use plotters_backend::DrawingBackend;

    /// The elements that some calls write.
    fn elements(draw: impl FnOnce(&mut Page<Svg>)) -> Vec<String> {
        let mut page = Page::new((10_000, 5_000), Svg::new(10.0, 5.0));
        draw(&mut page);
        let text = String::from_utf8(page.surface.finish()).expect("an SVG is text");
        let lines: Vec<String> = text.lines().map(str::to_owned).collect();
        assert!(lines[0].contains("width=\"10mm\" height=\"5mm\" viewBox=\"0 0 10000 5000\""), "{}", lines[0]);
        assert_eq!(lines.last().map(String::as_str), Some("</svg>"));
        lines[1..lines.len() - 1].to_vec()
    }

    #[test]
    fn lines_of_one_pen_are_one_path_of_relative_steps() {
        let drawn = elements(|page| {
            let thin = pen(INK, 0.2);
            page.draw_path([(100, 200), (150, 200), (150, 180)], &thin).expect("drawn");
            page.draw_line((0, 0), (10, -5), &thin).expect("drawn");
            page.draw_line((0, 0), (1, 1), &pen(INK, 0.3)).expect("drawn");
        });
        let expected = [
            "<path stroke=\"#111111\" stroke-width=\"200\" d=\"M100 200l50 0l0 -20M0 0l10 -5\"/>",
            "<path stroke=\"#111111\" stroke-width=\"300\" d=\"M0 0l1 1\"/>",
        ];
        assert_eq!(drawn, expected);
    }

    #[test]
    fn fills_and_dashes() {
        let drawn = elements(|page| {
            page.fill_polygon([(0, 0), (10, 0), (10, 20)], &PAPER).expect("drawn");
            page.polylines(&[vec![(0, 0), (9, 0)]], &Pen::dashed(INK, 0.1, REFERENCE_DASH));
            page.draw_text("l", &crate::style::text(1.0, INK, Default::default(), Default::default()), (0, 0))
                .expect("drawn");
        });
        assert_eq!(drawn[0], "<path fill=\"#ffffff\" d=\"M0 0l10 0l0 20z\"/>");
        assert!(drawn[1].contains("stroke-dasharray=\"1200 800\""), "{}", drawn[1]);
        assert!(drawn[2].starts_with("<path fill=\"#111111\" d=\"M") && drawn[2].contains('c'), "{}", drawn[2]);
    }
}
