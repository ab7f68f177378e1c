//! Work-precision diagrams: the error of every method on one scene against right-hand sides and against seconds.

use crate::hard::rows::Rows;
use figures::failure::Failure;
use figures::job::Job;
use files::table::Table;
use ode::Method;
use plot::style::COLUMN_WIDTH;
use plot::{Axis, Corner, Lines, Marker, Picture, Point, Series};

/// How a method is drawn: fixed steps as dashed lines with filled markers, adaptive ones as solid lines with hollow
/// markers, like orders in like colours.
struct Look {
    method: Method,
    name: &'static str,
    /// Place in the cycle of colours.
    color: usize,
    marker: Marker,
}

const fn look(method: Method, name: &'static str, color: usize, marker: Marker) -> Look {
    Look { method, name, color, marker }
}

/// The methods in the order of the legends: the first [`IN_FIRST`] are named in the first panel.
const LOOKS: [Look; 14] = [
    look(Method::Euler, "Euler", 1, Marker::Circle),
    look(Method::Ballistic, "ballistic", 2, Marker::Square),
    look(Method::Heun, "Heun", 3, Marker::Triangle),
    look(Method::Rk4, "RK4", 4, Marker::Diamond),
    look(Method::Bs32, "BS 3(2)", 2, Marker::Triangle),
    look(Method::Dopri54, "DOPRI 5(4)", 0, Marker::Square),
    look(Method::Tsit54, "Tsitouras 5(4)", 0, Marker::Cross),
    look(Method::Verner65, "Verner 6(5)", 1, Marker::Circle),
    look(Method::Verner76, "Verner 7(6)", 1, Marker::Plus),
    look(Method::Verner87, "Verner 8(7)", 3, Marker::Square),
    look(Method::Verner98, "Verner 9(8)", 3, Marker::Triangle),
    look(Method::Dop853, "DOP853", 3, Marker::Circle),
    look(Method::Extrapolation, "extrapolation", 4, Marker::Diamond),
    look(Method::Taylor, "Taylor", 4, Marker::Circle),
];
const IN_FIRST: usize = 7;

/// The methods beside whose curves the slope of their order is drawn.
const SLOPES: [Method; 4] = [Method::Euler, Method::Heun, Method::Rk4, Method::Dop853];

/// Writes the tables `work` and `time` of a scene from the report of accuracy and from the archived timings. `method`
/// is the place in [`Method::ALL`], from 0; `error` the larger of those of gaps and speeds. Runs that stopped early
/// have no error and no row.
///
/// # Errors
/// A table is missing or damaged, or cannot be written.
pub fn tables(job: &mut Job, scene: &str) -> Result<(), Failure> {
    let name = format!("precision_{scene}");
    let (measured, timed) = (job.accuracy(&name)?, job.timing_rows(&name)?);
    let mut work = Table::new(&["method", "order", "control", "right_hand_sides", "error"]);
    let mut time = Table::new(&["method", "order", "control", "seconds", "error"]);
    for (number, method) in Method::ALL.into_iter().enumerate() {
        let (number, order) = (number as f64, method.order() as f64);
        let seconds = of(&timed, method, &["control", "seconds"])?;
        for row in of(&measured, method, &["control", "right_hand_sides", "error_gap", "error_speed"])?.rows() {
            let (control, error) = (row[0], math::larger(row[2], row[3]));
            work.push(&[number, order, control, row[1], error]);
            if let Some(timing) = seconds.rows().find(|timing| timing[0] == control) {
                time.push(&[number, order, control, timing[1], error]);
            }
        }
    }
    job.write("work", &work)?;
    job.write("time", &time)
}

fn of(rows: &Rows, method: Method, columns: &[&str]) -> Result<Table, Failure> {
    Ok(rows.select(&[("method", method.name())], columns)?)
}

/// Both diagrams, one above the other.
///
/// # Errors
/// A table is missing or damaged.
pub fn picture(job: &Job) -> Result<Picture, Failure> {
    let work = panel(&job.read("work")?, "right_hand_sides", "right-hand sides", true)?;
    let time = panel(&job.read("time")?, "seconds", "seconds on one core", false)?;
    let title = "dashed: fixed steps; grey: slopes 1, 2, 4, 8";
    Ok(Picture::new(COLUMN_WIDTH, 170.0).columns(1).titled(title, work).titled("archived timings", time))
}

fn panel(table: &Table, cost: &str, label: &str, is_first: bool) -> Result<Lines, Failure> {
    let curves: Vec<Vec<Point>> =
        LOOKS.iter().map(|look| curve(table, cost, look.method)).collect::<Result<_, Failure>>()?;
    let points = || curves.iter().flatten();
    let (least_cost, most) = range(points().map(|point| point.0));
    let (least_error, largest) = range(points().map(|point| point.1));
    // room for the legend, at the left of all curves
    let x = Axis::log10(label, decade_below(least_cost / 200.0), decade_above(most));
    let y = Axis::log10("largest error of a gap or speed", decade_below(least_error), decade_above(largest));
    let mut lines = Lines::new(x, y).legend(Corner::BottomLeft);
    for (look, curve) in LOOKS.iter().zip(&curves).filter(|(look, _)| SLOPES.contains(&look.method)) {
        if let Some(guide) = slope(curve, look.method.order()) {
            lines = lines.guide(&guide);
        }
    }
    for (index, (look, curve)) in LOOKS.iter().zip(curves).enumerate() {
        let name = if (index < IN_FIRST) == is_first { look.name } else { "" };
        let series = Series::line(name, curve).look(look.color).marker(look.marker);
        lines = lines.series(if look.method.is_adaptive() { series.solid() } else { series.filled() });
    }
    Ok(lines)
}

/// Errors of a method against its cost, coarse to fine.
fn curve(table: &Table, cost: &str, method: Method) -> Result<Vec<Point>, Failure> {
    let (methods, costs, errors) = (table.column("method")?, table.column(cost)?, table.column("error")?);
    let is_meant = |number: f64| Method::ALL.get(number as usize) == Some(&method);
    let points = methods.iter().zip(costs.into_iter().zip(errors));
    Ok(points.filter(|(number, _)| is_meant(**number)).map(|(_, point)| point).collect())
}

/// A piece of a line on which the error falls as the cost to the power of minus `order`, below the middle of a curve;
/// nothing for a curve without one.
fn slope(curve: &[Point], order: usize) -> Option<[Point; 2]> {
    // rounding shows below, and errors as large as the solution above
    let steep: Vec<&Point> = curve.iter().filter(|point| (1e-10..1e-2).contains(&point.1)).collect();
    let &&(cost, error) = steep.get(steep.len() / 2)?;
    let (nearer, fall) = (0.8 * cost, math::pow(HALF_WIDTH, order as f64));
    Some([(nearer / HALF_WIDTH, error * fall), (nearer * HALF_WIDTH, error / fall)])
}

/// A slope is drawn from the cost over this to the cost times this.
const HALF_WIDTH: f64 = 1.8;

/// The least and the largest number.
fn range(numbers: impl Iterator<Item = f64>) -> (f64, f64) {
    numbers.fold((f64::INFINITY, 0.0), |(low, high), number| (math::smaller(low, number), math::larger(high, number)))
}

fn decade_below(number: f64) -> f64 {
    math::pow(10.0, math::log10(number).floor())
}

fn decade_above(number: f64) -> f64 {
    math::pow(10.0, math::log10(number).ceil())
}
