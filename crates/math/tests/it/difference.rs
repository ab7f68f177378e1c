//! Differences of the softplus function: their errors must be small relative to the difference.

use crate::lane::{about, true_softplus};
use crate::sample::{COUNT, Random, assert_error, error_in_units};
use math::double_double::DoubleDouble;
use math::lane::{SoftplusBase, softplus_difference};
use std::f64::consts::{FRAC_1_SQRT_2, SQRT_2};

/// softplus(y0 + d) - softplus(y0): for small d as ln(1 + (e^d - 1) / (1 + e^-y0)),
/// in which nothing cancels, and as it stands for larger ones.
fn true_difference(y0: f64, d: f64) -> DoubleDouble {
    let (start, step) = (DoubleDouble::from(y0), DoubleDouble::from(d));
    if d.abs() > 1.0 {
        return true_softplus(DoubleDouble::sum(y0, d)) - true_softplus(start);
    }
    (step.exp_m1() / ((-start).exp() + 1.0)).ln_1p()
}

#[track_caller]
fn assert_difference(y0: f64, steps: &[f64]) {
    let base = SoftplusBase::new(y0);
    let name = format!("softplus difference from {y0:e}");
    assert_error(&name, BOUND, steps, |d| softplus_difference(&base, d), |d| true_difference(y0, d));
}

/// Units in the last place: the exponential 1.3, a constant and a product half a unit each,
/// the logarithm 1.2; not all at once, and rarely at a value where the unit halves.
const BOUND: f64 = 3.0;

/// Arguments for each of the points.
fn few(seed: u64, mut next: impl FnMut(&mut Random) -> f64) -> Vec<f64> {
    let mut random = Random(seed);
    (0..COUNT / 8).map(|_| next(&mut random)).collect()
}

const POINTS: [f64; 16] =
    [-300.0, -40.0, -25.0, -3.0, -1.0, -0.3, -1e-3, -1e-200, 0.0, 1e-200, 1e-3, 0.3, 1.0, 3.0, 25.0, 300.0];

#[test]
fn tiny_steps_keep_their_precision() {
    for y0 in POINTS {
        assert_difference(y0, &few(50, |random| random.signed_spread(1e-150, 1.0)));
    }
}

#[test]
fn steps_of_all_sizes_keep_their_precision() {
    for y0 in POINTS {
        let steps = few(51, |random| random.signed_spread(1e-3, 300.0));
        assert_difference(y0, &steps);
        // to the other side of 0
        let crossings = few(52, |random| -2.0 * y0 + random.signed_spread(1e-6, 2.0));
        assert_difference(y0, &crossings);
    }
}

/// The logarithm takes another way where u = (e^-|y| - a) / (1 + a), a = e^-|y0|, passes sqrt(2) - 1 or sqrt(1/2) - 1:
/// for the doubles about these the two halves of it must change at the same one.
#[test]
fn steps_to_where_the_logarithm_takes_another_way_keep_their_precision() {
    let mut tried = 0;
    for y0 in POINTS {
        let a = math::exp(-y0.abs());
        for threshold in [SQRT_2 - 1.0, FRAC_1_SQRT_2 - 1.0] {
            let decay = a + threshold * (1.0 + a);
            if decay <= 0.0 || decay > 1.0 {
                continue;
            }
            for y in [math::ln(decay), -math::ln(decay)] {
                assert_difference(y0, &about(y - y0, 200));
                tried += 1;
            }
        }
    }
    assert!(tried > 20, "{tried}");
}

#[test]
fn random_points_and_steps_keep_their_precision() {
    let mut random = Random(53);
    for _ in 0..COUNT / 2 {
        let (y0, d) = (random.uniform(-30.0, 30.0), random.uniform(-30.0, 30.0));
        let error = error_in_units(softplus_difference(&SoftplusBase::new(y0), d), true_difference(y0, d));
        assert!(error <= BOUND, "{error} units in the last place from {y0} by {d}");
    }
}

/// However far the points are from each other and from 0, the difference has the sign of
/// the step, is no larger than it, and is all of the step on the far positive side.
#[test]
fn far_points_behave() {
    let sizes = [0.0, 1e-300, 1e-5, 0.5, 24.9, 25.0, 700.0, 707.9, 708.1, 750.0, 1e3, 1e5];
    let signed = || sizes.iter().flat_map(|&x| [x, -x]);
    for (y0, d) in signed().flat_map(|y0| signed().map(move |d| (y0, d))) {
        let change = softplus_difference(&SoftplusBase::new(y0), d);
        assert!(change * d >= 0.0 && change.abs() <= d.abs(), "from {y0:e} by {d:e}: {change:e}");
        if d.abs() >= 0.5 {
            // as many units as the rounding of y0 + d makes
            let truth = (true_softplus(DoubleDouble::sum(y0, d)) - true_softplus(DoubleDouble::from(y0))).hi;
            let allowed = (3.0 + (y0 + d).abs()) * f64::EPSILON * truth.abs() + 4e-308;
            assert!((change - truth).abs() <= allowed, "from {y0:e} by {d:e}: {change:e} for {truth:e}");
        }
        if y0 >= 750.0 && y0 + d >= 750.0 {
            assert_eq!(change, d, "from {y0:e} by {d:e}");
        }
        if y0 <= 0.0 && y0 + d >= 750.0 {
            assert_eq!(change, y0 + d - true_softplus(DoubleDouble::from(y0)).hi, "from {y0:e} by {d:e}");
        }
    }
}

#[test]
fn the_base_at_0_is_that_of_0() {
    assert_eq!(SoftplusBase::ZERO, SoftplusBase::new(0.0));
}
