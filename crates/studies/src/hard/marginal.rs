//! Case 6: parameters at the edge of stability: growth rates of 1e-9, and an edge that depends on the number of
//! pedestrians.

use super::Tables;
use super::rows::{Rows, row};
use super::run::{Case, figure_4, two_methods};
use super::waves::growth_rate;
use figures::failure::Failure;
use jam::ring::Ring;
use jam::states::StateVariables;
use jam::uniform::steady_speed;
use std::f64::consts::PI;

const HEADWAY: f64 = 3.0;
/// How long the waves are followed.
const TIME: f64 = 200.0;
/// So small that its cube (1e-16 of it) does not count.
const AMPLITUDE: f64 = 1e-8;

fn case(strength: f64, pedestrians: usize) -> Case {
    let model = figure_4(strength);
    let ring = Ring { pedestrians, length: pedestrians as f64 * HEADWAY };
    Case { model, ring, kind: StateVariables::Deviations }
}

/// Where the longest wave of a ring neither grows nor decays: `phi (1 + cos k) = 1`, `phi = 2 mu^2 / d'^3`, `d' = 1`.
fn threshold(pedestrians: usize) -> f64 {
    let half = math::cos(PI / pedestrians as f64);
    0.5 / half
}

/// Growth of one wave at the edge, measured by two methods; the edge against the number of pedestrians.
pub fn tables(quick: bool) -> Result<Tables, Failure> {
    let mut growth = Rows::new(&["n", "factor", "exact", "exact_error", "measured", "other_method", "relative_error"]);
    let counts: &[usize] = if quick { &[16] } else { &[16, 64, 256] };
    for &count in counts {
        for off in [-1e-3, -1e-6, 0.0, 1e-6, 1e-3] {
            let case = case(threshold(count) * (1.0 + off), count);
            let speed = steady_speed(&case.model, HEADWAY).map_err(Failure::work)?;
            let linear = case.model.linearise(HEADWAY, speed);
            let k = 2.0 * PI / count as f64;
            let exact = linear.refined_growth_rate(k);
            let [one, two] = two_methods(1e-15).map(|how| growth_rate(&case, (k, AMPLITUDE), TIME, how));
            let (one, two) = (one?, two?);
            let relative = (off != 0.0).then(|| (one - exact) / exact);
            growth.push(row![count, 1.0 + off, exact, exact - linear.growth_rate(k), one, two, relative]);
        }
    }
    let mut edge = Rows::new(&["n", "mu_cr", "found", "difference", "shift_times_n_squared"]);
    for power in 1..=if quick { 4 } else { 12 } {
        let count = 1usize << power;
        // two pedestrians have the wave k = pi alone, which never grows
        if count > 2 {
            let (formula, found) = (threshold(count), edge_by_bisection(count)?);
            let scaled = (found - 0.5) * (count * count) as f64;
            edge.push(row![count, formula, found, found - formula, scaled]);
        }
    }
    Ok(vec![("marginal", growth), ("marginal_threshold", edge)])
}

/// The least `mu` at which a wave grows, by bisection of the largest growth rate over the waves of the ring.
fn edge_by_bisection(count: usize) -> Result<f64, Failure> {
    let (mut low, mut high) = (0.4, 2.0);
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        let case = case(middle, count);
        let speed = steady_speed(&case.model, HEADWAY).map_err(Failure::work)?;
        let fastest = case.model.linearise(HEADWAY, speed).fastest(count).0;
        if fastest > 0.0 { high = middle } else { low = middle }
    }
    Ok(high)
}
