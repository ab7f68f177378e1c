//! The standard deviation of figure 4, stable panel, by the scheme of the paper in positions, unwrapped and wrapped
//! into the ring, beside the true values.

use super::heun::Adding;
use super::{Extent, Run, State, solution};
use crate::hard::Tables;
use crate::hard::rows::{Rows, row};
use figures::failure::Failure;
use jam::states::StateVariables;
use std::path::Path;

/// The step of the paper.
const STEP: f64 = 1e-5;
/// Times between rows.
const SAMPLE: f64 = 5.0;

/// Positions and speeds, plain sums, steps of 1e-5; the true curve from the reference solution.
pub fn tables(extent: Extent, solutions: &Path) -> Result<Tables, Failure> {
    let exact = solution::spreads(solutions)?;
    let count = if extent == Extent::Full { 400 } else { 4 };
    let curves =
        [State::RingSystem(StateVariables::Positions), State::Wrapped].map(|state| move || curve(state, count));
    let [unwrapped, wrapped] = std::thread::scope(|scope| curves.map(|curve| scope.spawn(curve)).map(|one| one.join()));
    let of =
        |curve: std::thread::Result<_>| curve.map_err(|_| Failure::work("a thread of the verbatim run panicked"))?;
    let (unwrapped, wrapped): (Vec<f64>, Vec<f64>) = (of(unwrapped)?, of(wrapped)?);
    let mut rows = Rows::new(&["t", "std", "wrapped", "exact"]);
    for (index, (unwrapped, wrapped)) in unwrapped.into_iter().zip(wrapped).enumerate() {
        let time = index as f64 * SAMPLE;
        rows.push(row![time, unwrapped, wrapped, exact.get(time as usize).copied()]);
    }
    Ok(vec![("verbatim_fig04_stable", rows)])
}

/// The standard deviations at multiples of [`SAMPLE`], from 0.
fn curve(state: State, count: usize) -> Result<Vec<f64>, Failure> {
    let mut run = Run::new(state);
    let mut found = vec![run.speed_std()];
    for _ in 0..count {
        run.advance(STEP, SAMPLE, Adding::Plain)?;
        found.push(run.speed_std());
    }
    Ok(found)
}
