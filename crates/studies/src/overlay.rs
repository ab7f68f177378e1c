//! Distances of the published curves of figures 12 (left) and 13 from runs with fixed steps and with other parameters.

use crate::hard::rows::{CellValue, Rows, row};
use crate::parameters::jammed::{Run, Start, snapshots};
use figures::failure::Failure;
use files::table::Table;
use ode::{Control, Method};

/// A run as it is compared: the standard deviation at whole times from 0, the speeds at t = 300.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sampled {
    /// Standard deviations of the speeds.
    pub spread: Vec<f64>,
    /// Speeds of the pedestrians.
    pub speeds: Vec<f64>,
}

/// The time of figure 12, left.
const EARLY: f64 = 300.0;

impl Sampled {
    /// From the tables of a run.
    ///
    /// # Errors
    /// A column is missing.
    pub fn from_tables(std: &Table, trajectories: &Table) -> Result<Sampled, Failure> {
        let speeds = trajectories.rows().filter(|row| (row[0] - EARLY).abs() < 0.5).map(|row| row[3]).collect();
        Ok(Sampled { spread: std.column("std")?, speeds })
    }

    /// The run of the figures by steps of fixed length.
    ///
    /// # Errors
    /// The integration failed.
    pub fn by_steps(method: Method, step: f64) -> Result<Sampled, Failure> {
        Sampled::of(&Run::default(), (method, Control::Fixed { step }))
    }

    /// A run like that of the figures.
    ///
    /// # Errors
    /// The integration failed.
    pub fn of(run: &Run, how: (Method, Control)) -> Result<Sampled, Failure> {
        // the start, at rest, is no sample
        let mut sampled = Sampled { spread: vec![0.0], speeds: Vec::new() };
        for snapshot in snapshots(run, how)? {
            sampled.spread.push(snapshot.spread);
            if (snapshot.time - EARLY).abs() < 0.5 * run.sample {
                sampled.speeds = snapshot.speeds;
            }
        }
        Ok(sampled)
    }

    /// Published minus regenerated standard deviations, at the times of the published ones.
    ///
    /// # Errors
    /// The run has no sample at one of them.
    pub fn spread_differences(&self, published: &[(f64, f64)]) -> Result<Vec<f64>, Failure> {
        let run = sampled("std", "t", &self.spread);
        published.iter().map(|&(place, value)| Ok(value - run(place)?)).collect()
    }

    /// Published minus regenerated speeds.
    ///
    /// # Errors
    /// The run has no pedestrian of one of the numbers.
    pub fn speed_differences(&self, published: &[(f64, f64)]) -> Result<Vec<f64>, Failure> {
        let run = sampled("speed", "n", &self.speeds);
        published.iter().map(|&(place, value)| Ok(value - run(place)?)).collect()
    }
}

/// The number of a run at a place that was read off an axis: whole up to its reading error. An error names a place at
/// which the run has none.
pub fn sampled(what: &str, axis: &str, values: &[f64]) -> impl Fn(f64) -> Result<f64, Failure> {
    move |place| {
        let index = place.round();
        let value = if index >= 0.0 { values.get(index as usize) } else { None };
        value.copied().ok_or_else(|| {
            let count = values.len();
            Failure::input(format!(
                "{what}: published at {axis} = {place:?}, but the run has {count} samples, from {axis} = 0"
            ))
        })
    }
}

/// The largest, the root of the mean square, and the median of the sizes of differences.
pub fn sizes(differences: &[f64]) -> [f64; 3] {
    let mut sizes: Vec<f64> = differences.iter().map(|difference| difference.abs()).collect();
    sizes.sort_by(f64::total_cmp);
    let squares: f64 = sizes.iter().map(|size| size * size).sum();
    let count = sizes.len();
    let median = 0.5 * (sizes[(count - 1) / 2] + sizes[count / 2]);
    [sizes[count - 1], (squares / count as f64).sqrt(), median]
}

/// The published curves: `(t, std)` of figure 13 and `(n, v)` of figure 12, left.
#[derive(Clone, Debug)]
pub struct Published {
    /// Figure 13.
    pub spread: Vec<(f64, f64)>,
    /// Figure 12, left.
    pub speeds: Vec<(f64, f64)>,
}

/// One row of the table of schemes; `step` is `None` for a run whose error does not count.
///
/// # Errors
/// The run lacks a sample.
pub fn scheme(name: &str, step: Option<f64>, run: &Sampled, published: &Published) -> Result<Vec<CellValue>, Failure> {
    let [std_largest, std_rms, std_median] = sizes(&run.spread_differences(&published.spread)?);
    let [speed_largest, speed_rms, speed_median] = sizes(&run.speed_differences(&published.speeds)?);
    Ok(row![name, step, std_largest, std_rms, std_median, speed_largest, speed_rms, speed_median])
}

/// What else than Euler's scheme may explain the distance of the published standard deviations from the accurate run:
/// other parameters, or axes that were read off wrongly. Each number is that of the run of the figures unless it is
/// named.
///
/// # Errors
/// A run failed or lacks a sample.
pub fn rivals(accurate: &Sampled, euler: &Sampled, published: &Published) -> Result<Rows, Failure> {
    let mut rows =
        Rows::new(&["rival", "v0", "length", "shift", "std_largest", "std_rms", "speed_largest", "speed_rms"]);
    let of = Run::default();
    let mut push = |name: &str, run: &Run, spread: &[f64], speeds: &[f64]| {
        let Start::One(shift) = run.start else { return };
        let ([std_largest, std_rms, _], [speed_largest, speed_rms, _]) = (sizes(spread), sizes(speeds));
        rows.push(row![name, run.desired_speed, run.length, shift, std_largest, std_rms, speed_largest, speed_rms]);
    };
    let speeds = accurate.speed_differences(&published.speeds)?;
    push("none", &of, &accurate.spread_differences(&published.spread)?, &speeds);
    push("axes", &of, &registered(&accurate.spread, &published.spread)?, &speeds);
    push("euler", &of, &euler.spread_differences(&published.spread)?, &euler.speed_differences(&published.speeds)?);
    let others = [
        ("desired_speed", Run { desired_speed: 1.0005, ..of }),
        ("length", Run { length: 200.1, ..of }),
        ("both", Run { desired_speed: 1.0004, length: 200.05, ..of }),
        ("shift", Run { start: Start::One(0.102), ..of }),
    ];
    for (name, run) in others {
        let made = Sampled::of(&run, (Method::Taylor, Control::Adaptive { tolerance: 1e-10 }))?;
        let spread = made.spread_differences(&published.spread)?;
        push(name, &run, &spread, &made.speed_differences(&published.speeds)?);
    }
    Ok(rows)
}

/// The differences that are left once both axes are shifted and stretched so that the squares are least:
/// `published - (a + (1 + b) std + (c + d t) std')`, to first order in the four numbers.
fn registered(spread: &[f64], published: &[(f64, f64)]) -> Result<Vec<f64>, Failure> {
    let run = sampled("std", "t", spread);
    let mut left = Vec::new();
    let mut shapes: [Vec<f64>; 4] = Default::default();
    for &(t, value) in published {
        let (std, slope) = (run(t)?, 0.5 * (run(t + 1.0).or_else(|_| run(t))? - run(math::larger(t - 1.0, 0.0))?));
        left.push(value - std);
        for (shape, number) in shapes.iter_mut().zip([1.0, std, slope, t * slope]) {
            shape.push(number);
        }
    }
    // one shape after the other, each made orthogonal to those before
    for at in 0..shapes.len() {
        let (before, rest) = shapes.split_at_mut(at);
        let shape = &mut rest[0];
        before.iter().for_each(|other| without(shape, other));
        without(&mut left, shape);
    }
    Ok(left)
}

/// Takes from a row its part along another.
fn without(row: &mut [f64], along: &[f64]) {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let part = dot(row, along) / dot(along, along);
    row.iter_mut().zip(along).for_each(|(value, along)| *value -= part * along);
}

/// The columns of the table of schemes.
pub const SCHEMES: [&str; 8] =
    ["method", "dt", "std_largest", "std_rms", "std_median", "speed_largest", "speed_rms", "speed_median"];

/// Distances of two runs from the published curves beside the stated errors of reading: typical and largest.
///
/// # Errors
/// A run lacks a sample.
pub fn distance(runs: &[(&str, &Sampled)], published: &Published) -> Result<Rows, Failure> {
    let mut rows = Rows::new(&[
        "figure",
        "curve",
        "run",
        "points",
        "largest",
        "root_mean_square",
        "median",
        "reading_error_typical",
        "reading_error_largest",
    ]);
    // data/reference/README.md
    let (of_speeds, of_spread) = ((3e-5, 3e-5), (4e-4, 2e-3));
    for (name, run) in runs {
        let speeds = run.speed_differences(&published.speeds)?;
        let spread = run.spread_differences(&published.spread)?;
        for (figure, curve, differences, reading) in
            [("fig12", "t300", speeds, of_speeds), ("fig13", "std", spread, of_spread)]
        {
            let [largest, rms, median] = sizes(&differences);
            rows.push(row![figure, curve, *name, differences.len(), largest, rms, median, reading.0, reading.1]);
        }
    }
    Ok(rows)
}
