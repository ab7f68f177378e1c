//! Invalid data are refused with the numbers at fault, and never drawn.

use plot::{Axis, ColorScale, Lines, Map, Picture, PlotError, Series};

fn empty() -> Lines {
    Lines::new(Axis::linear("$x$", 0.0, 1.0), Axis::linear("$y$", 0.0, 1.0))
}

fn map(cells: usize) -> Map {
    Map::new(Axis::linear("$x$", 0.0, 1.0), Axis::linear("$y$", 0.0, 1.0), 3, 2, vec![0.0; cells])
}

fn message(picture: Picture) -> String {
    picture.render().map_or_else(|fault| fault.to_string(), |_| "drawn".to_owned())
}

#[test]
fn pages_without_room() {
    assert!(message(Picture::new(f64::NAN, 50.0).panel(empty())).contains("NaN mm x 50 mm"));
    assert!(message(Picture::new(86.0, 1e9).panel(empty())).contains("between 5 and 2000 mm"));
    assert!(message(Picture::new(12.0, 50.0).panel(empty()).panel(empty())).contains("at least 5 mm each needed"));
    assert!(message(Picture::new(86.0, 50.0)).contains("at least one panel"));
    assert!(message(Picture::new(86.0, 50.0).row_shares(&[1.0, 2.0]).panel(empty())).contains("1 positive shares"));
}

#[test]
fn ranges_that_cannot_be_drawn() {
    let panel = Lines::new(Axis::log10("$x$", 0.0, 1.0), Axis::linear("$y$", 0.0, 1.0));
    assert!(message(Picture::new(86.0, 50.0).panel(panel)).contains("axis '$x$' runs from 0 to 1"));
    let panel = Lines::new(Axis::linear("$x$", 1.0, 1.0), Axis::linear("$y$", 0.0, 1.0));
    assert!(message(Picture::new(86.0, 50.0).panel(panel)).contains("two different finite ends"));
}

#[test]
fn arrays_of_the_wrong_length() {
    let page = || Picture::new(86.0, 50.0).scale(ColorScale::diverging("", [1.0]));
    assert!(message(page().panel(map(5))).contains("3 x 2 cells: 6 values needed, 5 given"));
}

#[test]
fn a_map_needs_a_scale() {
    assert!(message(Picture::new(86.0, 50.0).panel(map(6))).contains("Picture::scale"));
}

#[test]
fn labels_that_cannot_be_set() {
    let named = |name: &str| message(Picture::new(86.0, 50.0).panel(empty().series(Series::line(name, vec![]))));
    assert!(named("$\\bogus$").contains("unknown command '\\bogus'"));
    assert!(named("$x").contains("'$' expected"));
    assert!(named("\u{4e2d}").contains("U+4E2D"));
}

#[test]
fn data_without_a_place_are_left_out() -> Result<(), PlotError> {
    let axes = || Lines::new(Axis::linear("$x$", 0.0, 1.0), Axis::log10("$y$", 1e-3, 1.0));
    let full = axes().series(Series::line("", vec![(0.0, 0.1), (0.5, 0.1)]));
    let gaps = vec![(0.0, 0.1), (0.5, 0.1), (0.6, 0.0), (0.7, f64::NAN), (0.8, f64::INFINITY), (0.9, -1.0)];
    let holed = axes().series(Series::line("", gaps));
    assert!(Picture::new(86.0, 50.0).panel(full).render()? == Picture::new(86.0, 50.0).panel(holed).render()?);
    Ok(())
}
