//! The lane functions against double-double numbers: the largest errors in units in the
//! last place.
//!
//! The bounds follow from the roundings. For the exponential: half a unit for the last
//! addition, and three roundings of terms below 1/8, each 1/16 of a unit at a result
//! between 1/2 and 1: 0.7. Where 1 is taken off and the result lies between 1/4 and 1/2
//! with twice such terms, 0.5 + 6/8 = 1.3. For the logarithm five roundings of terms
//! below 1/8 at a result between 1/4 and 1/2: 0.5 + 5/8 < 1.2. Composed functions add up
//! theirs, and the unit halves below a power of 2.

use crate::sample::{arguments, assert_error, error_in_units};
use math::double_double::{DoubleDouble, full};
use math::lane;
use std::f64::consts::SQRT_2;

#[test]
fn exp_keeps_its_bound() {
    let truth = |x: f64| DoubleDouble::from(x).exp();
    assert_error("exp", 0.7, &arguments(20, |random| random.uniform(-640.0, 709.4)), lane::exp, truth);
    assert_error("exp", 0.7, &arguments(21, |random| random.signed_spread(1e-20, 2.0)), lane::exp, truth);
}

#[test]
fn exp_m1_keeps_its_bound() {
    let truth = |x: f64| DoubleDouble::from(x).exp_m1();
    assert_error("exp_m1", 1.3, &arguments(22, |random| random.uniform(-2.0, 2.0)), lane::exp_m1, truth);
    assert_error("exp_m1", 1.3, &arguments(23, |random| random.uniform(-45.0, 709.0)), lane::exp_m1, truth);
    assert_error("exp_m1", 1.3, &arguments(24, |random| random.signed_spread(1e-280, 2.0)), lane::exp_m1, truth);
}

#[test]
fn ln_keeps_its_bound() {
    let truth = |x: f64| DoubleDouble::from(x).ln();
    assert_error("ln", 1.2, &arguments(25, |random| random.uniform(0.4, 3.0)), lane::ln, truth);
    assert_error("ln", 1.2, &arguments(26, |random| random.spread(f64::MIN_POSITIVE, 1e307)), lane::ln, truth);
}

#[test]
fn ln_1p_keeps_its_bound() {
    let truth = |x: f64| DoubleDouble::from(x).ln_1p();
    assert_error("ln_1p", 1.2, &arguments(27, |random| random.uniform(-1.0, 3.0)), lane::ln_1p, truth);
    assert_error("ln_1p", 1.2, &arguments(28, |random| random.spread(1e-280, 1e307)), lane::ln_1p, truth);
    assert_error("ln_1p", 1.2, &arguments(29, |random| -random.spread(1e-280, 0.999)), lane::ln_1p, truth);
}

/// ln(1 + e^x).
pub fn true_softplus(x: DoubleDouble) -> DoubleDouble {
    let tail = (-x.abs()).exp().ln_1p();
    if x.hi > 0.0 { x + tail } else { tail }
}

#[test]
fn softplus_keeps_its_bound() {
    let truth = |x: f64| true_softplus(DoubleDouble::from(x));
    assert_error("softplus", 2.0, &arguments(30, |random| random.uniform(-4.0, 4.0)), lane::softplus, truth);
    assert_error("softplus", 2.0, &arguments(31, |random| random.uniform(-640.0, 640.0)), lane::softplus, truth);
    assert_error("softplus", 2.0, &arguments(32, |random| random.signed_spread(1e-20, 40.0)), lane::softplus, truth);
}

/// The doubles about one, nearest first.
pub fn about(x: f64, count: i64) -> Vec<f64> {
    (0..count).flat_map(|k| [-k, k]).map(|k| f64::from_bits((x.to_bits() as i64 + k) as u64)).collect()
}

/// The logarithm takes another way from 1 + e^x = sqrt(2) on: both halves of it must change at the same double.
#[test]
fn softplus_keeps_its_bound_where_the_logarithm_takes_another_way() {
    let threshold = SQRT_2 - 1.0;
    let x = math::ln(threshold);
    let arguments = about(x, 40);
    assert!(arguments.iter().any(|&x| lane::exp(x) == threshold), "e^x is the threshold itself for some of them");
    let truth = |x: f64| true_softplus(DoubleDouble::from(x));
    assert_error("softplus", 2.0, &arguments, lane::softplus, truth);
    assert_error("softplus", 2.0, &about(-x, 40), lane::softplus, truth);
}

#[test]
fn sigmoid_keeps_its_bound() {
    let truth = |x: f64| DoubleDouble::ONE / ((-DoubleDouble::from(x)).exp() + 1.0);
    assert_error("sigmoid", 2.5, &arguments(33, |random| random.uniform(-4.0, 40.0)), lane::sigmoid, truth);
    assert_error("sigmoid", 2.5, &arguments(34, |random| random.uniform(-640.0, 40.0)), lane::sigmoid, truth);
}

/// Half a unit each for the sum and the quotient (the sum counts up to twice), 1.3 for the exponential.
#[test]
fn tanh_keeps_its_bound() {
    let truth = |x: f64| full::tanh(DoubleDouble::from(x));
    assert_error("tanh", 3.0, &arguments(40, |random| random.uniform(-2.0, 2.0)), lane::tanh, truth);
    assert_error("tanh", 3.0, &arguments(41, |random| random.uniform(-25.0, 25.0)), lane::tanh, truth);
    assert_error("tanh", 3.0, &arguments(42, |random| random.signed_spread(1e-280, 1.0)), lane::tanh, truth);
}

/// The error of ln(1 + c R) with R known, as a function of the argument R.
#[test]
fn scaled_logarithm_keeps_its_bound() {
    let c = std::f64::consts::E - 1.0;
    let truth = |r: f64| (DoubleDouble::from(r) * c).ln_1p();
    let computed = |r: f64| lane::ln_1p(c * r);
    assert_error("ln(1 + c R)", 2.0, &arguments(35, |random| random.uniform(0.0, 1.0)), computed, truth);
    assert_error("ln(1 + c R)", 2.0, &arguments(36, |random| random.spread(1e-280, 1e5)), computed, truth);
}

/// The errors of powers grow with the logarithm of the result.
#[test]
fn powers_keep_their_bounds() {
    for q in [-3.0, -2.5, 0.3, 1.7] {
        for x in arguments(37, |random| random.spread(0.05, 20.0)).into_iter().step_by(4) {
            let logarithm = DoubleDouble::from(x).ln() * q;
            assert_error_at(x, lane::pow(x, q), logarithm.exp(), 1.0 + 2.5 * logarithm.hi.abs());
        }
        for t in arguments(38, |random| random.uniform(-0.95, 19.0)).into_iter().step_by(4) {
            let logarithm = DoubleDouble::from(t).ln_1p() * q;
            assert_error_at(t, lane::pow_m1(t, q), logarithm.exp_m1(), 3.0 + 2.5 * logarithm.hi.abs());
        }
        for t in arguments(39, |random| random.signed_spread(1e-280, 1e-2)).into_iter().step_by(4) {
            let logarithm = DoubleDouble::from(t).ln_1p() * q;
            assert_error_at(t, lane::pow_m1(t, q), logarithm.exp_m1(), 3.0);
        }
    }
}

#[track_caller]
fn assert_error_at(x: f64, computed: f64, exact: DoubleDouble, bound: f64) {
    let error = error_in_units(computed, exact);
    assert!(error <= bound, "{error} units in the last place at {x:e}, allowed are {bound}");
}
