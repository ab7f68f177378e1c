//! Critical values of the parameters: for all waves, for those of a ring, for negative `delta`.

use crate::hard::rows::{CellValue, Rows, row};
use figures::failure::Failure;
use jam::laws::{Algebraic, Exponential, Logarithmic, Model};
use jam::stability::Linear;
use jam::uniform::steady_speed;
use std::f64::consts::{E, LN_2, PI};

/// Which waves may grow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Waves {
    /// All: the long ones are the first.
    All,
    /// The waves of a ring of N pedestrians.
    Ring(usize),
}

/// How one parameter decides about stability: the linearised law for a value of it.
type Family<'a> = &'a dyn Fn(f64) -> Linear;

/// The wave number that stands for the long waves where a growth rate is asked for: its square is the error.
const LONG: f64 = 1e-6;

/// The value at which the first wave neither grows nor decays, from the margin of stability, and the same from the sign
/// of the growth rates. `None` if nothing changes between `low` and `high`.
pub fn critical(family: Family<'_>, waves: Waves, (low, high): (f64, f64)) -> Option<(f64, f64)> {
    let by_margin = |value: f64| match waves {
        Waves::All => family(value).long_wave_margin() > 0.0,
        Waves::Ring(count) => family(value).margin(2.0 * PI / count as f64) > 0.0,
    };
    let by_rate = |value: f64| match waves {
        Waves::All => family(value).growth_rate(LONG) > 0.0,
        Waves::Ring(count) => family(value).fastest(count).0 > 0.0,
    };
    bisect(&by_margin, low, high).zip(bisect(&by_rate, low, high))
}

/// Where the answer changes between `low` and `high`, to the last bit.
pub fn bisect(is_unstable: &dyn Fn(f64) -> bool, mut low: f64, mut high: f64) -> Option<f64> {
    let at_low = is_unstable(low);
    if at_low == is_unstable(high) {
        return None;
    }
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return Some(high);
        }
        if is_unstable(middle) == at_low { low = middle } else { high = middle }
    }
}

/// The algebraic law `<mu, delta, q, a_v>` with the regularisation of the paper.
pub fn algebraic(strength: f64, (relative, power, widening): (f64, f64, f64)) -> Algebraic {
    Algebraic { mu: strength, delta: relative, q: power, a_v: widening, epsilon: 0.1, v0: 3.0 }
}

/// The exponential law `<a, b, 0, a_v>`.
pub fn exponential(strength: f64, range: f64, widening: f64) -> Exponential {
    Exponential { a: strength, b: range, c: 0.0, a_v: widening, epsilon: 0.1, v0: 3.0 }
}

/// The linearised logarithmic law in the uniform flow of this headway, `eps` = 0.01 as in the paper.
///
/// # Errors
/// There is no uniform flow.
pub fn logarithmic(desired_speed: f64, widening: f64, headway: f64) -> Result<Linear, Failure> {
    let model = Model::Logarithmic(Logarithmic { v0: desired_speed, a_v: widening, epsilon: 0.01 });
    let speed = steady_speed(&model, headway).map_err(Failure::work)?;
    Ok(model.linearise(headway, speed))
}

/// One critical value, and what it belongs to.
#[derive(Clone, Copy, Default)]
struct Asked {
    quantity: &'static str,
    law: &'static str,
    delta: Option<f64>,
    q: Option<f64>,
    a_v: Option<f64>,
    b: Option<f64>,
    v0: Option<f64>,
    d_gap: Option<f64>,
    headway: Option<f64>,
    /// The critical value in closed form for all waves, where there is one.
    closed: Option<f64>,
}

impl Asked {
    /// A row for a number of pedestrians, or 0 for all waves.
    fn row(&self, count: usize, found: Option<(f64, f64)>) -> Vec<CellValue> {
        let Asked { quantity, law, delta, q, a_v, b, v0, d_gap, headway, closed } = *self;
        let (value, error) = (found.map(|found| found.0), found.map(|found| (found.0 - found.1).abs()));
        let closed = closed.filter(|_| count == 0);
        let is_found = if value.is_some() { "yes" } else { "never" };
        // the paper's xi, in the limit eps -> 0
        let xi = headway.filter(|_| quantity == "critical_v0").zip(value).map(|(headway, v0)| {
            let c = E - 1.0;
            c * v0 / (2.0 * (1.0 + c * (1.0 - 0.5 * headway)))
        });
        row![quantity, law, delta, q, a_v, b, v0, d_gap, headway, count, is_found, value, error, closed, xi]
    }

    /// Two rows: for all waves and for a ring.
    fn push(&self, rows: &mut Rows, pedestrians: usize, family: Family<'_>, range: (f64, f64)) {
        rows.push(self.row(0, critical(family, Waves::All, range)));
        rows.push(self.row(pedestrians, critical(family, Waves::Ring(pedestrians), range)));
    }
}

/// Critical values of the paper's models, for all waves and for the ring of the paper.
///
/// # Errors
/// There is no uniform flow.
pub fn thresholds() -> Result<Rows, Failure> {
    let mut rows = Rows::new(&[
        "quantity", "law", "delta", "q", "a_v", "b", "v0", "d_gap", "headway", "n", "found", "value", "error",
        "closed", "xi",
    ]);
    for (law, count) in [("algebraic", 67), ("exponential", 57)] {
        // exact: the distance of the ring of the paper, subtracted in two orders
        let headway = 200.0 / count as f64;
        let found = Some((headway - 2.0, (200.0 - 2.0 * count as f64) / count as f64));
        rows.push(Asked { quantity: "d_gap", law, headway: Some(headway), ..Asked::default() }.row(count, found));
    }
    let models = [
        (0.0, 2.0, 0.0),
        (1.0, 2.0, 0.0),
        (-1.0, 2.0, 0.0),
        (0.0, 2.0, 0.2),
        (0.0, 1.0, 0.0),
        (1.0, 1.0, 0.0),
        (1.0, 1.0, 0.1),
        (0.0, 1.0, 0.1),
    ];
    for (delta, q, a_v) in models {
        for gap in [1.0, 200.0 / 67.0 - 2.0] {
            let family = |mu: f64| algebraic(mu, (delta, q, a_v)).linearise(gap);
            let closed = closed_mu((delta, q, a_v), gap);
            let asked = Asked { quantity: "critical_mu", law: "algebraic", closed, ..Asked::default() };
            let asked = Asked { delta: Some(delta), q: Some(q), a_v: Some(a_v), d_gap: Some(gap), ..asked };
            // a negative delta lessens gamma = mu + delta eps ln 2, which must be positive
            let least = 1e-9 + math::larger(0.0, -delta * 0.1 * LN_2);
            asked.push(&mut rows, 67, &family, (least, 1e3));
        }
    }
    for a_v in [0.0, 0.15, 0.2] {
        for gap in [1.5, 200.0 / 57.0 - 2.0] {
            let family = |a: f64| exponential(a, 1.5, a_v).linearise(gap);
            let closed = Some(0.75 * math::exp(gap / 1.5) / (1.0 - a_v));
            let asked = Asked { quantity: "critical_a", law: "exponential", closed, ..Asked::default() };
            let asked = Asked { a_v: Some(a_v), b: Some(1.5), d_gap: Some(gap), ..asked };
            asked.push(&mut rows, 57, &family, (0.0, 1e3));
        }
    }
    for headway in [1.5, 200.0 / 133.0] {
        let family = |v0: f64| logarithmic_without_widening(v0, headway);
        let closed = Some((1.0 + (E - 1.0) * (1.0 - 0.5 * headway)) / (E - 1.0));
        let asked = Asked { quantity: "critical_v0", law: "logarithmic", closed, ..Asked::default() };
        Asked { a_v: Some(0.0), headway: Some(headway), ..asked }.push(&mut rows, 133, &family, (1e-3, 1e3));
    }
    for v0 in [1.0, 2.0, 3.0, 4.0, 6.0] {
        let asked = Asked {
            quantity: "critical_a_v",
            law: "logarithmic",
            v0: Some(v0),
            headway: Some(1.5),
            ..Asked::default()
        };
        rows.push(asked.row(0, largest_widening(v0, 1.5)?));
    }
    Ok(rows)
}

/// The critical strength at the effective distance `d` from `2 phi = (1 + 2 kappa) (1 + 2 beta)`, where that is at most
/// a quadratic equation in `gamma`: without one of `delta`, `a_v`.
fn closed_mu((delta, q, a_v): (f64, f64, f64), d: f64) -> Option<f64> {
    let a = 2.0 * q / math::pow(d, q + 1.0);
    let gamma = match (delta, a_v) {
        (0.0, _) => (1.0 / (a * (1.0 - a_v))).sqrt(),
        (_, 0.0) => {
            let half = delta / math::pow(d, q);
            (half + (half * half + a).sqrt()) / a
        }
        _ => return None,
    };
    Some(gamma - delta * 0.1 * LN_2)
}

/// Without widening no steady speed is needed.
fn logarithmic_without_widening(desired_speed: f64, headway: f64) -> Linear {
    Logarithmic { v0: desired_speed, a_v: 0.0, epsilon: 0.01 }.linearise(headway, 0.0)
}

/// The largest widening at which the logarithmic law is still unstable: the last change on a grid, then bisection.
fn largest_widening(v0: f64, headway: f64) -> Result<Option<(f64, f64)>, Failure> {
    let margin = |a_v: f64| Ok::<f64, Failure>(logarithmic(v0, a_v, headway)?.long_wave_margin());
    let (mut last, step) = (None, 0.01);
    for i in 0..400 {
        let (low, high) = (step * f64::from(i), step * f64::from(i + 1));
        if margin(low)? > 0.0 && margin(high)? <= 0.0 {
            last = Some((low, high));
        }
    }
    Ok(last.and_then(|(low, high)| {
        // a flow exists at both ends, so it does between them
        let grows = |a_v: f64| logarithmic(v0, a_v, headway).is_ok_and(|linear| linear.long_wave_margin() > 0.0);
        let rate = |a_v: f64| logarithmic(v0, a_v, headway).is_ok_and(|linear| linear.growth_rate(LONG) > 0.0);
        bisect(&grows, low, high).zip(bisect(&rate, low, high))
    }))
}

/// Critical values of rings of 4 to 1024 pedestrians over that for all waves. On a ring `phi (1 + cos k) = 1` replaces
/// `2 phi = 1`, so that the ratio is `1 / cos(pi / N)` for `mu`, its square for `a` and `v_0'`.
///
/// # Errors
/// There is no uniform flow.
pub fn ring() -> Result<Rows, Failure> {
    let mut rows =
        Rows::new(&["quantity", "pedestrians", "value", "error", "all_waves", "above", "above_times_n_squared"]);
    let mu = |mu: f64| algebraic(mu, (0.0, 2.0, 0.0)).linearise(1.0);
    let a = |a: f64| exponential(a, 1.5, 0.0).linearise(1.5);
    let v0 = |v0: f64| logarithmic_without_widening(v0, 1.5);
    let families: [(&str, Family<'_>); 3] = [("critical_mu", &mu), ("critical_a", &a), ("critical_v0", &v0)];
    for (quantity, family) in families {
        for power in 2..=10 {
            let count = 1_usize << power;
            let Some((all, _)) = critical(family, Waves::All, (1e-6, 1e3)) else { continue };
            let Some((value, other)) = critical(family, Waves::Ring(count), (1e-6, 1e3)) else { continue };
            let above = value / all - 1.0;
            let scaled = above * (count * count) as f64;
            rows.push(row![quantity, count, value, (value - other).abs(), all, above, scaled]);
        }
    }
    Ok(rows)
}

/// What negative `delta` does: the critical strength of `<mu, delta, 2, 0>` at `d' = 1`, and the share of the square of
/// figure 3 where some wave grows, of the cells with `gamma > 0`.
pub fn minus_delta() -> Rows {
    let mut rows = Rows::new(&["delta", "critical_mu", "critical_mu_error", "cells", "unstable", "share"]);
    for i in -6..=6 {
        let delta = 0.25 * f64::from(i);
        let linear = |mu: f64, gap: f64| algebraic(mu, (delta, 2.0, 0.0)).linearise(gap);
        // with gamma <= 0 there is no force at equal speeds; kappa < -1/2 is unstable whatever the strength
        let least = math::larger(1e-9, -delta * 0.1 * LN_2 + 1e-9);
        let family = |mu: f64| linear(mu, 1.0);
        let found = bisect(&|mu| fastest(&family(mu)) > 0.0, least, 10.0);
        let other = bisect(&|mu| margin(&family(mu)) > 0.0, least, 10.0);
        let (mut cells, mut unstable) = (0_usize, 0_usize);
        for (x, y) in (0..100).flat_map(|x| (0..100).map(move |y| (x, y))) {
            let (mu, gap) = (0.02 * (f64::from(x) + 0.5), 0.02 * (f64::from(y) + 0.5));
            if algebraic(mu, (delta, 2.0, 0.0)).gamma() > 0.0 {
                cells += 1;
                unstable += usize::from(fastest(&linear(mu, gap)) > 0.0);
            }
        }
        let off = found.zip(other).map(|(a, b)| (a - b).abs());
        rows.push(row![delta, found, off, cells, unstable, unstable as f64 / cells as f64]);
    }
    rows
}

/// The largest growth rate over waves from very long to alternating ones.
fn fastest(linear: &Linear) -> f64 {
    wave_numbers().map(|k| linear.growth_rate(k)).fold(f64::NEG_INFINITY, math::larger)
}

/// The same question by algebra: the margin of the worst wave, or instability of the damping itself.
fn margin(linear: &Linear) -> f64 {
    let damping = -(1.0 + 2.0 * math::smaller(linear.beta, linear.kappa));
    wave_numbers().map(|k| linear.margin(k)).fold(damping, math::larger)
}

/// Wave numbers from 1e-4 to pi.
pub fn wave_numbers() -> impl Iterator<Item = f64> {
    [LONG, 1e-4, 1e-3, 1e-2].into_iter().chain((1..=60).map(|i| PI * f64::from(i) / 60.0))
}
