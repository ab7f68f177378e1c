//! Zeros, infinities, NaN, and the edges of the domains.

use math::lane;
use std::f64::consts::LN_2;

const INFINITY: f64 = f64::INFINITY;

#[test]
fn scalar_functions_know_special_values() {
    assert_eq!((math::exp(0.0), math::exp(INFINITY), math::exp(-INFINITY)), (1.0, INFINITY, 0.0));
    assert_eq!((math::exp_m1(INFINITY), math::exp_m1(-INFINITY)), (INFINITY, -1.0));
    assert_eq!((math::ln(1.0), math::ln(0.0), math::ln(INFINITY)), (0.0, -INFINITY, INFINITY));
    assert_eq!((math::ln_1p(-1.0), math::ln_1p(INFINITY)), (-INFINITY, INFINITY));
    assert_eq!((math::log10(1000.0), math::log10(1e-300), math::log10(0.0)), (3.0, -300.0, -INFINITY));
    for f in [math::exp_m1, math::ln_1p, math::sin] {
        for x in [0.0, -0.0, 5e-324, -1e-310] {
            assert_eq!(f(x).to_bits(), x.to_bits(), "{x:e}");
        }
    }
    for f in [math::exp, math::exp_m1, math::ln, math::ln_1p, math::log10, math::sin, math::cos] {
        assert!(f(f64::NAN).is_nan());
    }
    for x in [math::ln(-1.0), math::ln_1p(-2.0), math::log10(-0.1), math::sin(INFINITY), math::cos(-INFINITY)] {
        assert!(x.is_nan());
    }
}

#[test]
fn lanes_overflow_and_underflow_where_they_say() {
    assert_eq!((lane::exp(709.79), lane::exp(1e300), lane::exp(INFINITY)), (INFINITY, INFINITY, INFINITY));
    assert_eq!((lane::exp(-708.01), lane::exp(-1e300), lane::exp(-INFINITY)), (0.0, 0.0, 0.0));
    assert!(lane::exp(709.782712893384).is_finite() && lane::exp(-708.0) > 0.0);
    assert_eq!((lane::exp_m1(709.01), lane::exp_m1(INFINITY)), (INFINITY, INFINITY));
    assert!(lane::exp_m1(709.0).is_finite(), "the last argument that is computed");
    assert_eq!((lane::exp_m1(-1e3), lane::exp_m1(-INFINITY), lane::exp_m1(0.0)), (-1.0, -1.0, 0.0));
    assert_eq!((lane::ln(1.0), lane::ln_1p(0.0)), (0.0, 0.0));
}

#[test]
fn lanes_answer_nan_outside_their_domains() {
    for x in [0.0, -0.0, -1.0, 1e-310, INFINITY, -INFINITY, f64::NAN, 2e307] {
        assert!(lane::ln(x).is_nan(), "{x:e}");
    }
    for x in [-1.0, -2.0, INFINITY, -INFINITY, f64::NAN, 2e307] {
        assert!(lane::ln_1p(x).is_nan(), "{x:e}");
    }
    for f in [lane::exp, lane::exp_m1, lane::softplus, lane::sigmoid, lane::tanh] {
        assert!(f(f64::NAN).is_nan());
    }
}

#[test]
fn tanh_reaches_its_limits_and_keeps_the_sign_of_zero() {
    assert_eq!((lane::tanh(INFINITY), lane::tanh(-INFINITY), lane::tanh(19.1)), (1.0, -1.0, 1.0));
    assert!(lane::tanh(18.0) < 1.0);
    for x in [0.0, -0.0, 1e-300, -5e-308] {
        assert_eq!(lane::tanh(x).to_bits(), x.to_bits(), "{x:e}");
    }
}

#[test]
fn softplus_and_sigmoid_reach_their_limits() {
    assert_eq!((lane::softplus(1e5), lane::softplus(710.0), lane::softplus(0.0)), (1e5, 710.0, LN_2));
    assert_eq!((lane::sigmoid(0.0), lane::sigmoid(1e5)), (0.5, 1.0));
    for x in [-1e5, -750.0, -709.0] {
        assert!(lane::softplus(x) < 4e-308 && lane::sigmoid(x) < 4e-308);
    }
}
