//! Truncation against rounding of Heun's scheme on the stable run of figure 4, in every form of the state and in
//! wrapped positions, with plain and compensated sums.

use super::heun::{Adding, without_rounding};
use super::solution::{Distances, distances, exact_scene, state_at, written};
use super::{Extent, Run, STATES, State, optimum};
use crate::hard::Tables;
use crate::hard::rows::{Rows, row};
use figures::failure::Failure;
use math::double_double::DoubleDouble;
use reference::scenes::LENGTH;
use std::path::Path;

/// The numbers of steps in a unit of time: steps of 1e-1 to 1e-5.
const PER_UNIT: [f64; 13] = [1e1, 2e1, 5e1, 1e2, 2e2, 5e2, 1e3, 2e3, 5e3, 1e4, 2e4, 5e4, 1e5];
/// Number of steps that are run without rounding; the truncation of shorter ones follows from the last three of these.
const WITHOUT_ROUNDING: usize = 5;
/// The times of the rows.
const TIMES: [f64; 3] = [500.0, 1000.0, 2000.0];

/// What is known without rounding.
struct Exact {
    /// The true states at the times.
    solution: Vec<Vec<DoubleDouble>>,
    /// What truncation adds to them, for each step and time.
    truncation: Vec<Vec<Vec<DoubleDouble>>>,
}

/// How far each form is from the solution at each time and step; of that what truncation does (the same for all forms,
/// which are linear in each other) and what rounding adds.
pub fn tables(extent: Extent, solutions: &Path) -> Result<Tables, Failure> {
    let (steps, times) = match extent {
        Extent::Quick => (WITHOUT_ROUNDING, 1),
        Extent::Usual => (10, 2),
        Extent::Full => (PER_UNIT.len(), TIMES.len()),
    };
    let (steps, times) = (&PER_UNIT[..steps], &TIMES[..times]);
    let exact = Exact::new(steps, times, solutions)?;
    let ways = STATES.into_iter().flat_map(|state| [(state, Adding::Plain), (state, Adding::Compensated)]);
    // one thread a way; the order of the rows is that of the ways
    let found = std::thread::scope(|scope| {
        let exact = &exact;
        let threads: Vec<_> =
            ways.map(|way| (way, scope.spawn(move || errors(way.0.0, way.1, steps, times, exact)))).collect();
        threads.into_iter().map(|(way, thread)| (way, thread.join())).collect::<Vec<_>>()
    });
    let mut rows = Rows::new(&COLUMNS);
    for (((_, state), adding), lines) in found {
        let lines = lines.map_err(|_| Failure::work("a thread of the study of rounding panicked"))??;
        let sum = if adding == Adding::Plain { "plain" } else { "compensated" };
        for Line { per_unit, time, total, truncation, rounding } in lines {
            let ([a, b, c], [d, e, f], [g, h, i]) = (total, truncation, rounding);
            rows.push(row![state, sum, 1.0 / per_unit, time, a, b, c, d, e, f, g, h, i]);
        }
    }
    let mut tables = vec![("rounding", rows)];
    if extent == Extent::Full {
        tables.push(("rounding_optimum", optimum::table(&tables[0].1)?));
    }
    Ok(tables)
}

const COLUMNS: [&str; 13] = [
    "state",
    "sum",
    "dt",
    "t",
    "error_gap",
    "error_speed",
    "error_std",
    "truncation_gap",
    "truncation_speed",
    "truncation_std",
    "rounding_gap",
    "rounding_speed",
    "rounding_std",
];

/// A row: distances of the run from the solution, of the scheme without rounding from it, and of the two from each
/// other.
struct Line {
    per_unit: f64,
    time: f64,
    total: Distances,
    truncation: Distances,
    rounding: Distances,
}

fn errors(state: State, adding: Adding, steps: &[f64], times: &[f64], exact: &Exact) -> Result<Vec<Line>, Failure> {
    let exact_ring = exact_scene()?.ring;
    let mut lines = Vec::new();
    for (&per_unit, truncation) in steps.iter().zip(&exact.truncation) {
        let mut run = Run::new(state);
        let mut before = 0.0;
        for ((&time, solution), truncation) in times.iter().zip(&exact.solution).zip(truncation) {
            run.advance(1.0 / per_unit, time - before, adding)?;
            before = time;
            let state = written(&exact_ring, &run);
            let truncated: Vec<DoubleDouble> = solution.iter().zip(truncation).map(|(a, b)| *a + *b).collect();
            lines.push(Line {
                per_unit,
                time,
                total: distances(&exact_ring, &state, solution),
                truncation: distances(&exact_ring, &truncated, solution),
                rounding: distances(&exact_ring, &state, &truncated),
            });
        }
    }
    Ok(lines)
}

impl Exact {
    fn new(steps: &[f64], times: &[f64], solutions: &Path) -> Result<Exact, Failure> {
        let scene = exact_scene()?;
        let solution = times.iter().map(|&t| state_at(solutions, &scene.ring, t)).collect::<Result<Vec<_>, _>>()?;
        let mut truncation = Vec::new();
        for &per_unit in &steps[..WITHOUT_ROUNDING] {
            let mut state = scene.ring.start(LENGTH, scene.shift);
            let (mut before, mut errors) = (0.0, Vec::new());
            for (&time, solution) in times.iter().zip(&solution) {
                // the step is the double that the runs have
                let h = DoubleDouble::from(1.0 / per_unit);
                without_rounding(&scene.ring, &mut state, h, ((time - before) * per_unit) as u64);
                before = time;
                errors.push(state.iter().zip(solution).map(|(a, b)| *a - *b).collect::<Vec<DoubleDouble>>());
            }
            truncation.push(errors);
        }
        for &per_unit in &steps[WITHOUT_ROUNDING..] {
            let ratio = PER_UNIT[WITHOUT_ROUNDING - 1] / per_unit;
            let [coarse, middle, fine] = [3, 2, 1].map(|back| &truncation[WITHOUT_ROUNDING - back]);
            let each = coarse.iter().zip(middle).zip(fine);
            truncation.push(each.map(|((coarse, middle), fine)| extrapolated([coarse, middle, fine], ratio)).collect());
        }
        Ok(Exact { solution, truncation })
    }
}

/// The error of steps that are `ratio` times as long as the shortest of three, from `E = a h^2 + b h^3 + c h^4`. The
/// three are in the ratios 4, 2 and 1.
fn extrapolated(errors: [&[DoubleDouble]; 3], ratio: f64) -> Vec<DoubleDouble> {
    // Lagrange's polynomial through E / h^2
    let weights = [
        (ratio - 1.0) * (ratio - 2.0) / 6.0 / 16.0,
        -(ratio - 1.0) * (ratio - 4.0) / 2.0 / 4.0,
        (ratio - 2.0) * (ratio - 4.0) / 3.0,
    ];
    let [coarse, middle, fine] = errors;
    let each = coarse.iter().zip(middle).zip(fine);
    each.map(|((a, b), c)| (*a * weights[0] + *b * weights[1] + *c * weights[2]) * (ratio * ratio)).collect()
}
