//! Pictures of planes of outcomes: classes of cells in colours, with the exact criterion on top.

use crate::failure::Failure;
use crate::titles::symbol;
use jam::outcome::Class;
use plot::style::COLUMN_WIDTH;
use plot::{Axis, Fill, Key, Picture, Plane};
use scene::sweep::{self, Cell, Exact, Sweep, table};

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

/// The exact lines are drawn through at least so many points along each axis, however few the cells are.
const FINEST: usize = 200;
/// Height of a picture of one plane, in millimetres.
const HEIGHT: f64 = 84.0;

/// The picture of one plane.
///
/// # Errors
/// The cells are not those of the plane.
pub fn picture(sweep: &Sweep, cells: &[Cell]) -> Result<Picture, Failure> {
    grid(&[("", sweep, cells)], 1, [COLUMN_WIDTH, HEIGHT])
}

/// Planes in rows of `columns`, each under its title, with one key below; width and height are millimetres. Of neighbours
/// that share an axis, the one at the left, or below, labels it.
///
/// # Errors
/// The cells of a plane are not those of the plane.
pub fn grid(
    planes: &[(&str, &Sweep, &[Cell])],
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
pub fn cells_of(file: &str, text: &str, sweep: &Sweep) -> Result<Vec<Cell>, Failure> {
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

fn panel(sweep: &Sweep, cells: &[Cell], [x, y]: [Axis; 2], shown: &mut Shown) -> Result<Plane, Failure> {
    let (columns, rows) = (sweep.x.cells, sweep.y.cells);
    if cells.len() != columns * rows {
        return Err(Failure::work(format!("{} cells for a plane of {columns} x {rows}", cells.len())));
    }
    let look = |cell: &Cell| LOOKS.iter().position(|(class, _)| *class == cell.class).unwrap_or(0);
    // the table runs up the columns of the plane, the picture along its rows
    let classes: Vec<usize> = (0..columns * rows).map(|i| look(&cells[(i % columns) * rows + i / columns])).collect();
    for class in &classes {
        shown.classes[*class] = true;
    }
    let mut plane = Plane::new(x, y, columns, rows, classes);
    for (class, fill) in LOOKS {
        plane = plane.class(fill, class.in_words());
    }
    let ([across, up], exact) = exact(sweep)?;
    let values = |value: fn(&Exact) -> f64| exact.iter().map(value).collect::<Vec<f64>>();
    let lines = [values(|exact| exact.speed), values(|exact| exact.margin)];
    let has_both_signs = |values: &Vec<f64>| values.iter().any(|v| *v < 0.0) && values.iter().any(|v| *v >= 0.0);
    let [is_backward, is_critical] = [0, 1].map(|line| has_both_signs(&lines[line]));
    shown.lines = [shown.lines[0] || is_critical, shown.lines[1] || is_backward];
    let [speeds, margins] = lines;
    if is_backward {
        plane = plane.border(across, up, speeds);
    }
    Ok(if is_critical { plane.contour(across, up, margins) } else { plane })
}

/// What is known exactly of a grid of points over the plane, at least as fine as its cells: their numbers across and up,
/// and the points row by row.
fn exact(sweep: &Sweep) -> Result<([usize; 2], Vec<Exact>), Failure> {
    // an odd number keeps the centres of the cells
    let points = |axis: &sweep::Axis| axis.cells * (FINEST.div_ceil(axis.cells) | 1);
    let size = [points(&sweep.x), points(&sweep.y)];
    let place = |i: usize, size: usize, axis: &sweep::Axis| (i as f64 + 0.5) * axis.cells as f64 / size as f64;
    let points = (0..size[0] * size[1]).map(|i| {
        let at = [place(i % size[0], size[0], &sweep.x), place(i / size[0], size[1], &sweep.y)];
        sweep.exact(at)
    });
    Ok((size, points.collect::<Result<Vec<Exact>, String>>()?))
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
