//! The standard deviation of figure 4, stable panel, as the scheme of the paper gives it, beside the true one.

use super::heun::{Adding, Sum};
use super::{Extent, SHIFT, figure_4_stable, solution};
use crate::hard::Tables;
use crate::hard::rows::{Rows, row};
use figures::failure::Failure;
use jam::ring::Start;
use jam::states::FormKind;
use std::path::Path;

/// The step of the paper.
const STEP: f64 = 1e-5;
/// Times between rows.
const SAMPLE: f64 = 5.0;

/// Positions and speeds, plain sums, steps of 1e-5; the true curve from the reference solution.
pub fn tables(extent: Extent, solutions: &Path) -> Result<Tables, Failure> {
    let mut rows = Rows::new(&["t", "std", "exact"]);
    let exact = solution::spreads(solutions)?;
    let (model, ring) = figure_4_stable();
    let form = FormKind::Positions.build(&model, ring);
    let mut sum = Sum::new(form.start(Start { shift: SHIFT }));
    let count = if extent == Extent::Full { 400 } else { 4 };
    for index in 0..=count {
        if index > 0 {
            sum.advance(&*form, STEP, SAMPLE, Adding::Plain)?;
        }
        let time = f64::from(index) * SAMPLE;
        rows.push(row![time, form.speed_deviation(&sum.state), exact.get(time as usize).copied()]);
    }
    Ok(vec![("verbatim_fig04_stable", rows)])
}
