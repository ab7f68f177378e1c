//! Panels used by several figures.

use crate::failure::Failure;
use crate::job::Job;
use crate::titles::symbol;
use files::scene_file::Panel;
use files::table::Table;
use plot::style::COLUMN_WIDTH;
use plot::{Axis, ColorScale, Lines, Map, Picture, Series, Trajectory};
use scene::map::Value;

/// Ticks of an axis of wave numbers.
const WAVE_NUMBERS: [(f64, &str); 5] =
    [(0.0, "0"), (0.25 * PI, "$\\pi/4$"), (0.5 * PI, "$\\pi/2$"), (0.75 * PI, "$3\\pi/4$"), (PI, "$\\pi$")];
const PI: f64 = std::f64::consts::PI;

/// Which of its axes a map labels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Labels {
    /// The horizontal one.
    pub horizontal: bool,
    /// The vertical one.
    pub vertical: bool,
}

/// Maps of one colour scale in rows of `columns`, one column of a journal wide and `height` millimetres high, each
/// under its title. Neighbours share axes: those at the left label the vertical one, those at the bottom the horizontal
/// one.
///
/// # Errors
/// No such panel, or its table is missing or damaged.
pub fn map_grid(
    job: &Job,
    symbol: &str,
    (columns, height): (usize, f64),
    names: &[&str],
    title: impl Fn(&Panel) -> String,
) -> Result<Picture, Failure> {
    let mut picture = Picture::new(COLUMN_WIDTH, height).columns(columns);
    let mut all = Vec::new();
    for (index, name) in names.iter().enumerate() {
        let panel = job.panel(name)?;
        let map = scene::map::read(&job.scene_file.file, &panel.tables)?;
        let values = job.read(name)?.column(map.columns()[2])?;
        let labels = Labels { horizontal: index + columns >= names.len(), vertical: index % columns == 0 };
        picture = picture.titled(&title(panel), map_panel(&map, &values, labels)?);
        all.extend(values);
    }
    Ok(picture.scale(ColorScale::diverging(symbol, all)))
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
    let [negative, positive] = match map.value {
        Value::Criterion | Value::Margin => ["stable", "unstable"],
        Value::GrowthRate => ["decays", "grows"],
    };
    Ok(Map::new(x, y, columns, rows, values).names(negative, positive))
}

fn axis(axis: &scene::axis::Axis, is_labelled: bool) -> Axis {
    let name = if is_labelled { format!("${}$", symbol(&axis.parameter)) } else { String::new() };
    let drawn = Axis::linear(&name, axis.from, axis.to).steps(4);
    let is_wave_number = axis.parameter == "k" && (0.9 * PI..=1.1 * PI).contains(&axis.to);
    match (is_wave_number, is_labelled) {
        (true, true) => drawn.ticks(&WAVE_NUMBERS),
        (true, false) => drawn.ticks(&WAVE_NUMBERS.map(|(k, _)| (k, ""))),
        (false, true) => drawn,
        (false, false) => drawn.without_numbers(),
    }
}

/// Points (x, y) of two columns.
///
/// # Errors
/// There is no such column.
pub fn points(table: &Table, x: &str, y: &str) -> Result<Vec<(f64, f64)>, Failure> {
    Ok(table.column(x)?.into_iter().zip(table.column(y)?).collect())
}

/// Standard deviations against time, one above the other: linear axes as published, and an inset with a logarithmic one
/// where the linear one shows a flat line. `insets`: table, and the inset's place in fractions of its panel.
///
/// # Errors
/// A table is missing or damaged.
pub fn std_column(
    job: &Job,
    insets: &[(&str, [f64; 4])],
    title: impl Fn(&Panel) -> String,
) -> Result<Picture, Failure> {
    let mut picture = Picture::new(COLUMN_WIDTH, 50.0 * insets.len() as f64).columns(1);
    for &(name, inset) in insets {
        let panel = std_panel(points(&job.read(name)?, "t", "std")?, inset);
        picture = picture.titled(&title(job.panel(name)?), panel);
    }
    Ok(picture)
}

fn std_panel(points: Vec<(f64, f64)>, place: [f64; 4]) -> Lines {
    let times = || points.iter().map(|&(t, _)| t).chain([0.0]);
    let std = || points.iter().map(|&(_, std)| std);
    let inset = Lines::new(Axis::around("", times()).steps(2), Axis::decades("", std()))
        .series(Series::line("", points.clone()));
    Lines::new(Axis::around("$t$", times()).steps(4), Axis::from_zero("std of speeds", std()).steps(4))
        .series(Series::line("", points.clone()))
        .inset(place, inset)
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
    let mut trajectories = vec![Trajectory::new(); count];
    for (row, &n) in numbers.iter().enumerate() {
        trajectories[n as usize].push([times[row], positions[row], speeds[row]]);
    }
    Ok(trajectories)
}
