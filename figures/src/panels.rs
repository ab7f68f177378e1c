//! Panels that several figures draw.

use crate::failure::Failure;
use crate::job::Job;
use files::table::Table;
use plot::{Axis, Legend, Lines, Map, Series, Trajectory};
use scene::map::Axis as MapAxis;

/// Ticks of an axis of wave numbers.
const WAVE_NUMBERS: [(f64, &str); 5] =
    [(0.0, "0"), (0.25 * PI, "$\\pi/4$"), (0.5 * PI, "$\\pi/2$"), (0.75 * PI, "$3\\pi/4$"), (PI, "$\\pi$")];
const PI: f64 = std::f64::consts::PI;

/// Which of its axes a map in a grid labels: neighbours share the others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Labels {
    /// Both.
    Both,
    /// The horizontal one: there is a neighbour at the left.
    Horizontal,
    /// The vertical one: there is a neighbour below.
    Vertical,
    /// None: neighbours at the left and below.
    None,
}

/// The map of a panel of the figure's scene, from the table of the same name.
///
/// # Errors
/// No such panel, or its table is missing or damaged.
pub fn map_of(job: &Job, panel: &str, labels: Labels) -> Result<Map, Failure> {
    let map = scene::map::read(&job.recipe.file, &job.panel(panel)?.tables)?;
    map_panel(&map, &job.read(panel)?, labels)
}

/// The picture of a map, from its table.
///
/// # Errors
/// The table is not that of this map.
pub fn map_panel(map: &scene::map::Map, table: &Table, labels: Labels) -> Result<Map, Failure> {
    let (columns, rows) = (map.x.cells, map.y.cells);
    let values = table.column(map.columns()[2])?;
    if values.len() != columns * rows {
        return Err(Failure::work(format!("a table of {} rows for a map of {columns} x {rows} cells", values.len())));
    }
    // the table runs up the columns of the map, the picture along its rows
    let values = (0..columns * rows).map(|i| values[(i % columns) * rows + i / columns]).collect();
    let x = axis(&map.x, matches!(labels, Labels::Both | Labels::Horizontal));
    let y = axis(&map.y, matches!(labels, Labels::Both | Labels::Vertical));
    Ok(Map::new(x, y, columns, rows, values))
}

fn axis(axis: &MapAxis, is_labelled: bool) -> Axis {
    let name = if is_labelled { symbol(axis.parameter) } else { "" };
    let drawn = Axis::linear(name, axis.from, axis.to).steps(4);
    let is_wave_number = axis.parameter == "k" && axis.to > 0.9 * PI;
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

/// A standard deviation of speeds against time, `scale` times as large (10^`power` on the axis label), with an inset on
/// a logarithmic axis from 10^`floor` up. `part` is the inset's place (see [`Lines::inset`]).
pub fn std_panel(
    points: &[(f64, f64)],
    t_end: f64,
    top: f64,
    power: i32,
    decades: (f64, f64),
    part: [f64; 4],
) -> Lines {
    let label = match power {
        0 => "std of speeds".to_owned(),
        power => format!("std of speeds $/ 10^{{{power}}}$"),
    };
    let factor = math_power(power);
    let scaled = points.iter().map(|&(t, std)| (t, std / factor)).collect();
    let inset = Lines::new(Axis::linear("", 0.0, t_end).steps(2), Axis::log10("", decades.0, decades.1))
        .legend(Legend::Hidden)
        .series(Series::line("", points.to_vec()));
    Lines::new(Axis::linear("$t$", 0.0, t_end).steps(4), Axis::linear(&label, 0.0, top).steps(4))
        .legend(Legend::Hidden)
        .series(Series::line("", scaled))
        .inset(part, inset)
}

/// 10^power, exact for the small powers of axis labels.
fn math_power(power: i32) -> f64 {
    let size = (0..power.abs()).fold(1.0, |product, _| product * 10.0);
    if power < 0 { 1.0 / size } else { size }
}

/// The trajectories of a table `t, n, x, v`, one for each pedestrian.
///
/// # Errors
/// A column is missing.
pub fn trajectories(table: &Table) -> Result<Vec<Trajectory>, Failure> {
    let (times, numbers) = (table.column("t")?, table.column("n")?);
    let (positions, speeds) = (table.column("x")?, table.column("v")?);
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
