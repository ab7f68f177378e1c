//! Panels that several figures draw.

use crate::failure::Failure;
use crate::job::Job;
use files::table::Table;
use plot::style::COLUMN_WIDTH;
use plot::{Axis, ColorScale, Legend, Lines, Map, Picture, Series, Trajectory};
use scene::map::Axis as MapAxis;

/// Ticks of an axis of wave numbers.
const WAVE_NUMBERS: [(f64, &str); 5] =
    [(0.0, "0"), (0.25 * PI, "$\\pi/4$"), (0.5 * PI, "$\\pi/2$"), (0.75 * PI, "$3\\pi/4$"), (PI, "$\\pi$")];
const PI: f64 = std::f64::consts::PI;

/// One map of a grid.
#[derive(Clone, Copy, Debug)]
pub struct MapPanel<'a> {
    /// The panel of the scene, and its table.
    pub name: &'a str,
    /// The title, in the markup of labels; empty for none.
    pub title: &'a str,
    /// Names of regions and where they stand, in data coordinates.
    pub regions: &'a [(&'a str, (f64, f64))],
}

/// Which of its axes a map labels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Labels {
    /// The horizontal one.
    pub horizontal: bool,
    /// The vertical one.
    pub vertical: bool,
}

/// Maps of one colour scale in rows of `columns`, one column of a journal wide and `height` millimetres high. Neighbours
/// share axes: those at the left label the vertical one, those at the bottom the horizontal one.
///
/// # Errors
/// No such panel, or its table is missing or damaged.
pub fn map_grid(
    job: &Job,
    scale: ColorScale,
    columns: usize,
    height: f64,
    panels: &[MapPanel<'_>],
) -> Result<Picture, Failure> {
    let mut picture = Picture::new(COLUMN_WIDTH, height).columns(columns).scale(scale);
    for (index, panel) in panels.iter().enumerate() {
        let map = scene::map::read(&job.recipe.file, &job.panel(panel.name)?.tables)?;
        let labels = Labels { horizontal: index + columns >= panels.len(), vertical: index % columns == 0 };
        let mut drawn = map_panel(&map, &job.read(panel.name)?.column(map.columns()[2])?, labels)?;
        for &(name, at) in panel.regions {
            drawn = drawn.region(name, at);
        }
        picture = picture.titled(panel.title, drawn);
    }
    Ok(picture)
}

/// The picture of a map, from the values of its cells in the order of its table; NaN for those without one.
///
/// # Errors
/// They are not those of this map.
pub fn map_panel(map: &scene::map::Map, values: &[f64], labels: Labels) -> Result<Map, Failure> {
    let (columns, rows) = (map.x.cells, map.y.cells);
    if values.len() != columns * rows {
        return Err(Failure::work(format!("a table of {} rows for a map of {columns} x {rows} cells", values.len())));
    }
    // the table runs up the columns of the map, the picture along its rows
    let values = (0..columns * rows).map(|i| values[(i % columns) * rows + i / columns]).collect();
    let (x, y) = (axis(&map.x, labels.horizontal), axis(&map.y, labels.vertical));
    Ok(Map::new(x, y, columns, rows, values))
}

fn axis(axis: &MapAxis, is_labelled: bool) -> Axis {
    let name = if is_labelled { symbol(axis.parameter) } else { "" };
    let drawn = Axis::linear(name, axis.from, axis.to).steps(4);
    let is_wave_number = axis.parameter == "k" && (0.9 * PI..=1.1 * PI).contains(&axis.to);
    match (is_wave_number, is_labelled) {
        (true, true) => drawn.ticks(&WAVE_NUMBERS),
        (true, false) => drawn.ticks(&WAVE_NUMBERS.map(|(k, _)| (k, ""))),
        (false, true) => drawn,
        (false, false) => drawn.without_numbers(),
    }
}

/// The paper's symbol of a parameter.
fn symbol(parameter: &str) -> &str {
    match parameter {
        "mu" => "$\\mu$",
        "delta" => "$\\delta$",
        "a_v" => "$\\tilde a_v$",
        "v0" => "$v_0'$",
        "d_gap" => "$d'$",
        "headway" => "$\\Delta y$",
        "k" => "wave number $k$",
        "q" => "$q$",
        "a" => "$a$",
        "b" => "$b$",
        "c" => "$c$",
        other => other,
    }
}

/// Points (x, y) of two columns.
///
/// # Errors
/// There is no such column.
pub fn points(table: &Table, x: &str, y: &str) -> Result<Vec<(f64, f64)>, Failure> {
    Ok(table.column(x)?.into_iter().zip(table.column(y)?).collect())
}

/// How a standard deviation of speeds is drawn.
#[derive(Clone, Copy, Debug)]
pub struct StdPanel<'a> {
    /// The table.
    pub name: &'a str,
    /// The title, in the markup of labels.
    pub title: &'a str,
    /// The end of the time axis.
    pub t_end: f64,
    /// The top of the linear axis, in units of 10^`power`.
    pub top: f64,
    /// The power of ten in the label of the linear axis.
    pub power: i32,
    /// The ends of the logarithmic axis of the inset.
    pub decades: (f64, f64),
    /// The inset's place in fractions of the panel: left, bottom, right, top.
    pub inset: [f64; 4],
}

/// Standard deviations against time, one above the other: linear axes as published, and an inset with a logarithmic one
/// where the linear one shows a flat line.
///
/// # Errors
/// A table is missing or damaged.
pub fn std_column(job: &Job, panels: &[StdPanel<'_>]) -> Result<Picture, Failure> {
    let mut picture = Picture::new(COLUMN_WIDTH, 50.0 * panels.len() as f64).columns(1);
    for panel in panels {
        picture = picture.titled(panel.title, std_panel(panel, &points(&job.read(panel.name)?, "t", "std")?));
    }
    Ok(picture)
}

fn std_panel(panel: &StdPanel<'_>, points: &[(f64, f64)]) -> Lines {
    let label = match panel.power {
        0 => "std of speeds".to_owned(),
        power => format!("std of speeds $/ 10^{{{power}}}$"),
    };
    let unit = power_of_ten(panel.power);
    let scaled = points.iter().map(|&(t, std)| (t, std / unit)).collect();
    let (low, high) = panel.decades;
    let inset = Lines::new(Axis::linear("", 0.0, panel.t_end).steps(2), Axis::log10("", low, high))
        .legend(Legend::Hidden)
        .series(Series::line("", points.to_vec()));
    Lines::new(Axis::linear("$t$", 0.0, panel.t_end).steps(4), Axis::linear(&label, 0.0, panel.top).steps(4))
        .legend(Legend::Hidden)
        .series(Series::line("", scaled))
        .inset(panel.inset, inset)
}

/// 10^power, exact for the small powers of axis labels.
fn power_of_ten(power: i32) -> f64 {
    let size = (0..power.abs()).fold(1.0, |product, _| product * 10.0);
    if power < 0 { 1.0 / size } else { size }
}

/// More pedestrians than a run can have are not drawn.
const MOST_DRAWN: f64 = 1e7 + 1.0;

/// The trajectories of a table `t, n, x, v`, one for each pedestrian.
///
/// # Errors
/// A column is missing.
pub fn trajectories(table: &Table) -> Result<Vec<Trajectory>, Failure> {
    let (times, numbers) = (table.column("t")?, table.column("n")?);
    let (positions, speeds) = (table.column("x")?, table.column("v")?);
    if let Some((row, n)) =
        numbers.iter().enumerate().find(|(_, n)| !(n.fract() == 0.0 && (0.0..MOST_DRAWN).contains(*n)))
    {
        let problem = format!("line {}: n = {n:?} is not the number of a pedestrian; must be whole, from 0", row + 2);
        return Err(Failure::input(problem));
    }
    let count = numbers.iter().fold(0.0, |most: f64, &n| if n > most { n } else { most }) as usize + 1;
    let mut trajectories = vec![Trajectory::default(); count];
    for (row, &n) in numbers.iter().enumerate() {
        let trajectory = &mut trajectories[n as usize];
        trajectory.time.push(times[row]);
        trajectory.position.push(positions[row]);
        trajectory.speed.push(speeds[row]);
    }
    Ok(trajectories)
}
