//! Pictures of planes of outcomes: cells in the colours of their classes, with the exact criterion on top.

use figures::failure::Failure;
use figures::titles::symbol;
use jam::outcome::Class;
use plot::style::COLUMN_WIDTH;
use plot::{Axis, Fill, Key, Picture, Plane};
use sweep::{CellOutcome, Exact, Sweep, table};

/// Classes in the order of keys, with their colours: those that touch most often differ most in lightness.
const LOOKS: [(Class, Fill); 9] = [
    (Class::Decays, Fill::PALE),
    (Class::Waves, Fill::BLUE),
    (Class::WavesBackwards, Fill::PURPLE),
    (Class::Contact, Fill::ORANGE),
    (Class::BlowUp, Fill::BLACK),
    (Class::Undecided, Fill::GREY),
    (Class::Closed, Fill::RISING),
    (Class::NoUniformFlow, Fill::FALLING),
    (Class::Undefined, Fill::CROSSED),
];

/// Points along each axis through which the exact lines are drawn: they bend little, and lie less than a hundredth of a
/// millimetre off.
const POINTS: usize = 80;
/// How far inside the plane, in cells, the outermost of them lie.
const INSIDE: f64 = 0.01;
/// Height of a picture of one plane, in millimetres.
const HEIGHT: f64 = 84.0;

/// The picture of one plane.
///
/// # Errors
/// The cells are not those of the plane.
pub fn picture(sweep: &Sweep, cells: &[CellOutcome]) -> Result<Picture, Failure> {
    grid(&[("", sweep, cells)], 1, [COLUMN_WIDTH, HEIGHT])
}

/// Planes in rows of `columns`, each under its title, with one key below; width and height are millimetres. Of
/// neighbours that share an axis, the one at the left, or below, labels it.
///
/// # Errors
/// The cells of a plane are not those of the plane.
pub fn grid(
    planes: &[(&str, &Sweep, &[CellOutcome])],
    columns: usize,
    [width, height]: [f64; 2],
) -> Result<Picture, Failure> {
    let mut picture = Picture::new(width, height).columns(columns);
    let mut shown = Shown { classes: [false; LOOKS.len()], lines: [false; 2] };
    for (index, (title, sweep, cells)) in planes.iter().enumerate() {
        let below = planes.get(index + columns).is_some_and(|(_, below, _)| is_shared(&below.x, &sweep.x));
        let beside = index % columns > 0 && is_shared(&planes[index - 1].1.y, &sweep.y);
        let axes = [axis(&sweep.x, !below), axis(&sweep.y, !beside)];
        picture = picture.titled(title, panel(sweep, cells, axes, &mut shown)?);
    }
    Ok(picture.key(shown.key()))
}

/// The cells of a plane from the text of its table; `file` names it in complaints.
///
/// # Errors
/// A line that is not one of this plane.
pub fn cells_of(file: &str, text: &str, sweep: &Sweep) -> Result<Vec<CellOutcome>, Failure> {
    table::cells(sweep, text).map_err(|problem| Failure::input(format!("{file}:{problem}")))
}

/// What a key has to explain.
struct Shown {
    classes: [bool; LOOKS.len()],
    /// The exact criterion, and the border of backward flow.
    lines: [bool; 2],
}

impl Shown {
    fn key(&self) -> Key {
        let classes = LOOKS.iter().zip(self.classes).filter(|(_, is_shown)| *is_shown);
        let key = classes.fold(Key::new(), |key, ((class, fill), _)| key.fill(*fill, class.in_words()));
        let key = if self.lines[0] { key.contour("exact criterion") } else { key };
        if self.lines[1] { key.border("uniform flow walks backwards (teeth)") } else { key }
    }
}

fn panel(sweep: &Sweep, cells: &[CellOutcome], [x, y]: [Axis; 2], shown: &mut Shown) -> Result<Plane, Failure> {
    let (columns, rows) = (sweep.x.cells, sweep.y.cells);
    if cells.len() != columns * rows {
        return Err(Failure::work(format!("{} cells for a plane of {columns} x {rows}", cells.len())));
    }
    let look = |cell: &CellOutcome| LOOKS.iter().position(|(class, _)| *class == cell.class).unwrap_or(0);
    // the table runs up the columns of the plane, the picture along its rows
    let classes: Vec<usize> = (0..columns * rows).map(|i| look(&cells[(i % columns) * rows + i / columns])).collect();
    for class in &classes {
        shown.classes[*class] = true;
    }
    let mut plane = Plane::new(x, y, columns, rows, classes);
    for (class, fill) in LOOKS {
        plane = plane.class(fill, class.in_words());
    }
    let exact = exact(sweep)?;
    let values = |value: fn(&Exact) -> f64| exact.iter().map(value).collect::<Vec<f64>>();
    let lines = [values(|exact| exact.speed), values(|exact| exact.margin)];
    let has_both_signs = |values: &Vec<f64>| values.iter().any(|v| *v < 0.0) && values.iter().any(|v| *v >= 0.0);
    let [is_backward, is_critical] = [0, 1].map(|line| has_both_signs(&lines[line]));
    shown.lines = [shown.lines[0] || is_critical, shown.lines[1] || is_backward];
    let [speeds, margins] = lines;
    if is_backward {
        plane = plane.border(POINTS, POINTS, speeds);
    }
    Ok(if is_critical { plane.contour(POINTS, POINTS, margins) } else { plane })
}

/// What is known exactly of [`POINTS`] x [`POINTS`] points from edge to edge of the plane, row by row.
fn exact(sweep: &Sweep) -> Result<Vec<Exact>, Failure> {
    let place = |i: usize, axis: &sweep::Axis| {
        let cells = axis.cells as f64;
        // at the very end of an axis a law may have no value
        (i as f64 / (POINTS - 1) as f64 * cells).clamp(INSIDE, cells - INSIDE)
    };
    let at = |i: usize| [place(i % POINTS, &sweep.x), place(i / POINTS, &sweep.y)];
    Ok((0..POINTS * POINTS).map(|i| sweep.exact(at(i))).collect::<Result<Vec<Exact>, String>>()?)
}

fn is_shared(one: &sweep::Axis, other: &sweep::Axis) -> bool {
    let of = |axis: &sweep::Axis| (axis.parameter.clone(), axis.from, axis.to, axis.is_log);
    of(one) == of(other)
}

fn axis(axis: &sweep::Axis, is_labelled: bool) -> Axis {
    let name = if is_labelled { format!("${}$", symbol(&axis.parameter)) } else { String::new() };
    let drawn = if axis.is_log {
        Axis::log10(&name, axis.from, axis.to)
    } else {
        Axis::linear(&name, axis.from, axis.to).steps(4)
    };
    if is_labelled { drawn } else { drawn.without_numbers() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use files::scene_file;
    use sweep::DecidedBy;

    /// A plane of the algebraic law whose uniform flow is stable and unstable, forwards and backwards.
    fn sweep() -> Sweep {
        let text = "title = \"\"\nsource = \"\"\n[law]\nkind = \"algebraic\"\ndelta = 1.0\nq = 2.0\nv0 = 3.0\nepsilon = 0.1\n\
                    [ring]\npedestrians = 67\n[start]\nshift = 0.1\n[run]\nt_end = 10.0\nmethod = \"taylor\"\ntolerance = 1e-6\n[sweep]\n\
                    x = { parameter = \"mu\", from = 0.2, to = 1.0, cells = 4 }\n\
                    y = { parameter = \"headway\", from = 2.2, to = 4.0, cells = 3, scale = \"log\" }\n";
        let parsed = scene_file::parse("plane.toml", text).expect("a scene");
        sweep::read(&parsed.file, &parsed.panels[0].tables).expect("a sweep")
    }

    /// Cells of some classes, one of them with a number.
    fn cells() -> Vec<CellOutcome> {
        let numbers = [12.5, 0.1, -1e-300, f64::NAN, f64::NAN, 3e-9];
        let cell = |class| CellOutcome { class, backward_flow: true, decided_by: DecidedBy::Run, numbers };
        [Class::Contact, Class::Waves, Class::Decays].map(cell).repeat(4)
    }

    #[test]
    fn a_table_gives_the_cells_that_it_was_made_of() {
        let (sweep, cells) = (sweep(), cells());
        let text = table::table(&sweep, &cells);
        let read = cells_of("cells.csv", &text, &sweep).expect("cells");
        assert_eq!(read.len(), 12);
        assert_eq!(table::table(&sweep, &read), text);
    }

    #[test]
    fn a_table_of_another_plane_or_a_damaged_one_is_refused_with_its_line() {
        let sweep = sweep();
        let text = table::table(&sweep, &cells());
        let third = text.lines().nth(2).expect("a line");
        let damaged = [
            (text.replace("mu,", "q,"), "cells.csv:1:"),
            (text.replace(third, &third.replacen("0.", "0.5", 1)), "cells.csv:3:"),
            (text.replace(third, &third.replace("waves", "wave")), "cells.csv:3:"),
            (text.replace(&format!("{third}\n"), ""), "cells.csv:3:"),
            (text.lines().take(12).fold(String::new(), |text, line| text + line + "\n"), "11 cells; this plane has 12"),
            (format!("{text}{third}\n"), "cells.csv:14:"),
        ];
        for (text, told) in damaged {
            let failure = cells_of("cells.csv", &text, &sweep).expect_err("a complaint");
            assert!(failure.message.contains(told) && failure.code == 2, "{told}: {}", failure.message);
        }
    }

    #[test]
    fn a_key_names_what_occurs_and_nothing_else() {
        let (sweep, cells) = (sweep(), cells());
        let mut shown = Shown { classes: [false; LOOKS.len()], lines: [false; 2] };
        let axes = || [axis(&sweep.x, true), axis(&sweep.y, true)];
        let _ = panel(&sweep, &cells, axes(), &mut shown).expect("a panel");
        let classes: Vec<Class> =
            LOOKS.iter().zip(shown.classes).filter(|(_, is_shown)| *is_shown).map(|((class, _), _)| *class).collect();
        assert_eq!((classes, shown.lines), (vec![Class::Decays, Class::Waves, Class::Contact], [true; 2]));
        assert!(panel(&sweep, &cells[1..], axes(), &mut shown).is_err());
    }

    #[test]
    fn every_class_has_a_look_of_its_own() {
        for class in Class::ALL {
            assert_eq!(LOOKS.iter().filter(|(of, _)| *of == class).count(), 1, "{class:?}");
        }
        for (place, (_, fill)) in LOOKS.iter().enumerate() {
            assert!(LOOKS[..place].iter().all(|(_, other)| other != fill), "{fill:?}");
        }
    }

    #[test]
    fn the_exact_lines_lie_where_the_cells_change() {
        let sweep = sweep();
        for i in 0..4 {
            for j in 0..3 {
                let (place, exact) =
                    (sweep.place([i, j]).expect("a place"), sweep.exact([i as f64 + 0.5, j as f64 + 0.5]));
                let exact = exact.expect("numbers");
                assert_eq!(place.unstable.map(|[all, _]| all), Some(exact.margin > 0.0), "{i} {j}");
                assert_eq!(place.backward_flow, exact.speed < 0.0, "{i} {j}");
            }
        }
        // long waves of an infinite row become unstable at mu = 0.73970 for d' = 1, which is a headway of 3
        let x = (0.739_70 - 0.2) / 0.8 * 4.0;
        let y = math::log10(3.0 / 2.2) / math::log10(4.0 / 2.2) * 3.0;
        let margins = [-0.001, 0.001].map(|step| sweep.exact([x + step, y]).expect("numbers").margin);
        assert!(margins[0] < 0.0 && margins[1] > 0.0, "{margins:?}");
    }

    #[test]
    fn pictures_of_one_plane_and_of_several_can_be_drawn() {
        let (sweep, cells) = (sweep(), cells());
        let one =
            picture(&sweep, &cells).and_then(|picture| picture.render().map_err(Failure::work)).expect("a picture");
        let planes = [("left", &sweep, &cells[..]), ("right", &sweep, &cells[..]), ("below", &sweep, &cells[..])];
        let several = grid(&planes, 2, [plot::style::FULL_WIDTH, 130.0]).expect("a picture").render().expect("files");
        assert!(one.png.starts_with(b"\x89PNG") && several.png.len() > one.png.len());
    }
}
