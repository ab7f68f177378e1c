//! How the jams of figures 11 to 13 depend on the choices made: the run of those figures with one number changed at a
//! time. Two methods without common coefficients compute every row; the columns that end in `_error` hold their
//! differences.

pub mod jammed;

use crate::hard::Tables;
use crate::hard::rows::{CellValue, Rows, row};
use figures::failure::Failure;
use jam::jams::{self, Jam};
use jam::uniform::steady_speed;
use jammed::{Jammed, Run, Snapshot, Start, run, snapshots};
use ode::{Control, Method};

/// The local error of the runs of the tables, relative to the perturbation.
const TOLERANCE: f64 = 1e-9;

/// The cells of a row after the number that was changed.
const OBSERVED: [&str; 20] = [
    "steady_speed",
    "growth_rate",
    "stop",
    "stop_t",
    "jams",
    "jams_error",
    "jam_speed",
    "jam_speed_error",
    "mean_speed",
    "mean_speed_error",
    "flow",
    "flow_error",
    "plateau",
    "plateau_error",
    "onset",
    "onset_error",
    "slowest",
    "slowest_error",
    "fastest",
    "fastest_error",
];

/// All tables of the supplement.
///
/// # Errors
/// There is no uniform flow, or a run broke off without an event.
pub fn tables() -> Result<Tables, Failure> {
    let main = Run::default();
    let eps = [0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1].map(|epsilon| (epsilon, Run { epsilon, ..main }));
    let number = [33, 67, 133, 266].map(|n| (n as f64, Run { pedestrians: n, length: 1.5 * n as f64, ..main }));
    let length = [1.3, 1.4, 1.5, 1.6, 1.7, 1.8, 1.9].map(|dy| (dy, Run { length: dy * 133.0, ..main }));
    let speed = [0.7, 0.8, 0.85, 0.9, 1.0, 1.1, 1.2, 1.25, 1.3, 1.4].map(|v0| (v0, Run { desired_speed: v0, ..main }));
    Ok(vec![
        ("eps", table("epsilon", &eps)?),
        ("shift", shifts(&main)?),
        ("number", table("pedestrians", &number)?),
        ("length", table("headway", &length)?),
        ("speed", table("v0", &speed)?),
        ("tolerance", tolerances(&main)?),
        ("time", times(&main)?),
        ("criterion", criteria(&main)?),
    ])
}

/// One row for each run, with the number that was changed in the first column.
fn table(name: &str, runs: &[(f64, Run)]) -> Result<Rows, Failure> {
    let mut rows = Rows::new(&[&[name][..], &OBSERVED].concat());
    for (value, changed) in runs {
        rows.push([vec![CellValue::from(*value)], observed(changed)?].concat());
    }
    Ok(rows)
}

/// The size of the first disturbance, and its form.
fn shifts(main: &Run) -> Result<Rows, Failure> {
    let mut rows = Rows::new(&[&["start", "shift"][..], &OBSERVED].concat());
    let one = [1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 0.3, 0.5].map(|shift| ("one", Start::One(shift)));
    let random = [1e-4, 0.1].map(|size| ("random", Start::Random(size)));
    for (word, start) in one.into_iter().chain(random) {
        let (Start::One(size) | Start::Random(size)) = start;
        rows.push([vec![CellValue::from(word), CellValue::from(size)], observed(&Run { start, ..*main })?].concat());
    }
    Ok(rows)
}

/// The run as it is, by one method at several tolerances, against the strictest of another: a control.
fn tolerances(main: &Run) -> Result<Rows, Failure> {
    let strict = run(main, (Method::Dop853, Control::Adaptive { tolerance: 1e-13 }))?;
    let mut rows = Rows::new(&[&["tolerance"][..], &OBSERVED].concat());
    for tolerance in [1e-5, 1e-7, 1e-9, 1e-11, 1e-13] {
        let one = run(main, (Method::Taylor, Control::Adaptive { tolerance }))?;
        rows.push([vec![CellValue::from(tolerance)], cells(main, &one, &strict)?].concat());
    }
    Ok(rows)
}

/// How long the jams are followed, and how often.
const LONG: (f64, f64) = (10_000.0, 100.0);

/// The number of jams against time, far beyond the end of the figures.
fn times(main: &Run) -> Result<Rows, Failure> {
    let long = Run { end: LONG.0, sample: LONG.1, ..*main };
    let (one, other) = two(&long)?;
    let mut rows = Rows::new(&["t", "jams", "jams_error", "std", "std_error"]);
    // the two curves cross: what they differ by at one time may be less than the error, the most so far is not
    let mut most = 0.0;
    for (a, b) in one.iter().zip(&other) {
        let (count, off) = (count(main, a, 0.5), count(main, a, 0.5).abs_diff(count(main, b, 0.5)));
        most = math::larger(most, (a.spread - b.spread).abs());
        rows.push(row![a.time, count, off, a.spread, most]);
    }
    Ok(rows)
}

/// What counts as a jam: pedestrians slower than the lowest speed and this share of the range of speeds. The figures'
/// number is that at a share of 1/2.
fn criteria(main: &Run) -> Result<Rows, Failure> {
    let (one, other) = two(&Run { sample: main.end, ..*main })?;
    let mut rows = Rows::new(&["share", "jams", "jams_error", "pedestrians", "extent"]);
    for share in [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9] {
        let (Some(a), Some(b)) = (one.last(), other.last()) else { break };
        let found = jams_of(main, a, share);
        let off = found.len().abs_diff(count(main, b, share));
        let inside: usize = found.iter().map(|jam| jam.pedestrians).sum();
        rows.push(row![share, found.len(), off, inside, found.iter().map(|jam| jam.extent).sum::<f64>()]);
    }
    Ok(rows)
}

fn two(changed: &Run) -> Result<(Vec<Snapshot>, Vec<Snapshot>), Failure> {
    let by = |method| snapshots(changed, (method, Control::Adaptive { tolerance: TOLERANCE }));
    Ok((by(Method::Taylor)?, by(Method::Dop853)?))
}

fn jams_of(run: &Run, at: &Snapshot, share: f64) -> Vec<Jam> {
    // below a contrast that counts there is no threshold either
    let Some(middle) = jams::threshold(&at.speeds, run.desired_speed) else { return Vec::new() };
    let low = at.speeds.iter().copied().fold(f64::INFINITY, math::smaller);
    jams::find(&at.positions, &at.speeds, run.length, low + 2.0 * share * (middle - low))
}

fn count(run: &Run, at: &Snapshot, share: f64) -> usize {
    jams_of(run, at, share).len()
}

fn observed(changed: &Run) -> Result<Vec<CellValue>, Failure> {
    let by = |method| run(changed, (method, Control::Adaptive { tolerance: TOLERANCE }));
    cells(changed, &by(Method::Taylor)?, &by(Method::Dop853)?)
}

/// The columns [`OBSERVED`]: what one run shows, and how far the other one is off.
fn cells(changed: &Run, one: &Jammed, other: &Jammed) -> Result<Vec<CellValue>, Failure> {
    let model = changed.model();
    let headway = changed.ring().headway();
    let steady = steady_speed(&model, headway).map_err(Failure::work)?;
    let growth = model.linearise(headway, steady).fastest(changed.pedestrians).0;
    let mut cells = vec![
        CellValue::from(steady),
        CellValue::from(growth),
        CellValue::from(one.stop.map_or("t_end", |stop| stop.0)),
        CellValue::from(one.stop.map(|stop| stop.1)),
    ];
    for number in Jammed::NUMBERS {
        let (a, b) = (number(one), number(other));
        cells.push(CellValue::from(a));
        cells.push(CellValue::from(a.zip(b).map(|(a, b)| (a - b).abs())));
    }
    Ok(cells)
}
