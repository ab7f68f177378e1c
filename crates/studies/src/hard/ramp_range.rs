//! Case 4: the smooth ramp over its whole range, against double-double arithmetic.

use super::Tables;
use super::rows::{Rows, row};
use figures::failure::Failure;
use jam::ramp::smooth_ramp;
use math::double_double::DoubleDouble;

/// `x / eps` runs over these ranges, both signs, [`POINTS`] each. Between 660 and 708 the numbers of 106 bits underflow
/// themselves.
const RANGES: [[f64; 2]; 9] = [
    [1e-5, 1e-4],
    [1e-4, 1e-3],
    [1e-3, 1e-2],
    [1e-2, 1e-1],
    [1e-1, 1.0],
    [1.0, 10.0],
    [10.0, 100.0],
    [100.0, 660.0],
    [708.0, 1e5],
];
const POINTS: usize = 2000;

/// The largest relative error of `r_eps(x)` against the function of the same two doubles, and that of `-x / eps` as it
/// is rounded before the force sees it: its relative error of half a unit becomes `|x| / eps` half units of the result.
pub fn tables(quick: bool) -> Result<Tables, Failure> {
    let mut rows = Rows::new(&["epsilon", "sign", "from", "to", "points", "relative_error", "at", "allowed"]);
    let points = if quick { POINTS / 20 } else { POINTS };
    for epsilon in [0.1, 0.01, 1e-6] {
        for sign in [-1.0, 1.0] {
            for [from, to] in RANGES {
                let (worst, at) = worst_error(epsilon, sign, [from, to], points);
                rows.push(row![epsilon, sign, from, to, points, worst, at, allowed(sign * to)]);
            }
        }
    }
    Ok(vec![("ramp_range", rows)])
}

/// 4 units for the function and the product, and what the rounding of the argument makes of it on the flat side. Beyond
/// 708 widths the function has left the range of normal doubles and stays at exp(-708): off by all of that, and the
/// rounding of what lies below that range.
fn allowed(argument: f64) -> f64 {
    let flat = if argument > 0.0 { 0.5 * argument } else { 0.5 };
    if argument > 708.0 { 1.000_001 } else { (4.0 + flat) * f64::EPSILON }
}

/// The largest relative error and `x / eps` there; what lies below the least normal double, 3e-308, counts as that.
fn worst_error(epsilon: f64, sign: f64, [from, to]: [f64; 2], points: usize) -> (f64, f64) {
    let mut worst = (0.0, from);
    for k in 0..points {
        // irrational steps: no point is special
        let share = (k as f64 * 0.618_033_988_749_894_9).fract();
        let x = sign * epsilon * math::exp(math::ln(from) + share * (math::ln(to) - math::ln(from)));
        let exact = ramp(x, epsilon);
        let off = (DoubleDouble::from(smooth_ramp(x, epsilon)) - exact).abs().hi;
        let error = off / math::larger(exact.hi, epsilon * math::exp(-708.0));
        if error > worst.0 {
            worst = (error, x / epsilon);
        }
    }
    worst
}

/// `eps ln(1 + exp(-x / eps))` in double-double numbers.
fn ramp(x: f64, epsilon: f64) -> DoubleDouble {
    let y = DoubleDouble::from(-x) / epsilon;
    let above = if y.hi > 0.0 { y } else { DoubleDouble::ZERO };
    (above + ln_1p(exp(-y.abs()))) * epsilon
}

/// `e^y` for `y <= 0`, 0 below -700: Taylor's series of `y / 4096`, squared twelve times; relative error below 2^-88.
fn exp(y: DoubleDouble) -> DoubleDouble {
    if y.hi < -700.0 {
        return DoubleDouble::ZERO;
    }
    let small = y.times(1.0 / 4096.0);
    let mut sum = DoubleDouble::ONE;
    // the first term left out is 0.18^25 / 25!, 1e-44
    for k in (1..25).rev() {
        sum = DoubleDouble::ONE + sum * small / f64::from(k);
    }
    (0..12).fold(sum, |power, _| power * power)
}

/// `ln(1 + t)` for `0 <= t <= 1`: the series for small `t`, else one step of Newton's method from the double.
fn ln_1p(t: DoubleDouble) -> DoubleDouble {
    if t.hi < 1e-3 {
        // t - t^2 / 2 + ...: the first term left out is below 1e-36 of the result
        return (1..13).rev().fold(DoubleDouble::ZERO, |sum, k| (DoubleDouble::ONE / f64::from(k)) - t * sum) * t;
    }
    let guess = math::ln_1p(t.hi);
    let off = (DoubleDouble::ONE + t) * exp(DoubleDouble::from(-guess)) - 1.0;
    // ln(1 + off), off of 1e-16
    off - off * off * 0.5 + guess
}
