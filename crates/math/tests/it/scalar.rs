//! The scalar functions against CORE-MATH, which rounds correctly. (CORE-MATH is a C library, so the test needs a C
//! compiler.)
#![cfg(all(target_os = "linux", target_arch = "x86_64"))]

use crate::sample::{Random, arguments};
use std::f64::consts::{FRAC_PI_2, LN_2};

/// Arguments at the edges of ranges, reductions and roundings.
fn edges() -> Vec<f64> {
    let mut edges = vec![0.0, f64::MIN_POSITIVE, f64::MAX, 709.782712893384, 745.1332191019412, 708.0, 0.25, 0.4];
    edges.extend((1..200).map(|k| f64::from(k) * 0.5 * LN_2));
    edges.extend((1..200).map(|k| f64::from(k) * 0.5 * FRAC_PI_2));
    // less 2^-53 and 2^-52, where e^x and e^x - 1 to 106 bits are in the middle of two doubles
    edges.extend((0..2046_u64).filter(|e| !(970..=971).contains(e)).map(|e| f64::from_bits(e << 52)));
    edges.extend((1..=1000).map(f64::from));
    // the double next to a multiple of pi/2, of all doubles
    edges.push(6381956970095103.0 * (1u128 << 127) as f64 * f64::from_bits((1023 + 670) << 52));
    let around = edges.iter().flat_map(|x| [x.next_down(), *x, x.next_up()]);
    around.flat_map(|x| [x, -x]).collect()
}

/// Asserts that every value is the double nearest to the truth.
fn assert_rounded(name: &str, arguments: &[f64], ours: impl Fn(f64) -> f64, truth: impl Fn(f64) -> f64) {
    let mut wrong = 0;
    let mut example = f64::NAN;
    for &x in arguments {
        let (value, exact) = (ours(x), truth(x));
        if value.to_bits() != exact.to_bits() && !(value.is_nan() && exact.is_nan()) {
            wrong += 1;
            example = x;
        }
    }
    assert_eq!(wrong, 0, "{name}({example:e}) is {:e}, right is {:e}", ours(example), truth(example));
}

#[test]
fn exp_is_rounded_correctly() {
    assert_rounded("exp", &edges(), math::exp, core_math::exp);
    let middle = arguments(1, |random| random.uniform(-750.0, 720.0));
    assert_rounded("exp", &middle, math::exp, core_math::exp);
    let small = arguments(2, |random| random.signed_spread(1e-20, 2.0));
    assert_rounded("exp", &small, math::exp, core_math::exp);
}

#[test]
fn exp_m1_is_rounded_correctly() {
    assert_rounded("exp_m1", &edges(), math::exp_m1, core_math::expm1);
    let small = arguments(3, |random| random.signed_spread(1e-20, 2.0));
    assert_rounded("exp_m1", &small, math::exp_m1, core_math::expm1);
    let middle = arguments(4, |random| random.uniform(-60.0, 710.0));
    assert_rounded("exp_m1", &middle, math::exp_m1, core_math::expm1);
}

#[test]
fn ln_is_rounded_correctly() {
    assert_rounded("ln", &edges(), math::ln, core_math::log);
    let all = arguments(5, |random| random.spread(5e-324, f64::MAX));
    assert_rounded("ln", &all, math::ln, core_math::log);
    let near_1 = arguments(6, |random| random.uniform(0.5, 2.0));
    assert_rounded("ln", &near_1, math::ln, core_math::log);
}

#[test]
fn log10_is_rounded_correctly() {
    assert_rounded("log10", &edges(), math::log10, core_math::log10);
    let all = arguments(7, |random| random.spread(5e-324, f64::MAX));
    assert_rounded("log10", &all, math::log10, core_math::log10);
    let powers: Vec<f64> = (0..=22).map(|n| format!("1e{n}").parse().unwrap()).collect();
    assert_rounded("log10", &powers, math::log10, core_math::log10);
}

#[test]
fn ln_1p_is_rounded_correctly() {
    assert_rounded("ln_1p", &edges(), math::ln_1p, core_math::log1p);
    let small = arguments(8, |random| random.signed_spread(1e-20, 1.0));
    assert_rounded("ln_1p", &small, math::ln_1p, core_math::log1p);
    let all = arguments(9, |random| random.spread(5e-324, f64::MAX));
    assert_rounded("ln_1p", &all, math::ln_1p, core_math::log1p);
}

#[test]
fn sin_and_cos_are_rounded_correctly() {
    let turns = arguments(10, |random| random.uniform(-10.0, 10.0));
    let all = arguments(11, |random| random.signed_spread(1e-20, f64::MAX));
    for arguments in [edges(), turns, all] {
        assert_rounded("sin", &arguments, math::sin, core_math::sin);
        assert_rounded("cos", &arguments, math::cos, core_math::cos);
    }
}

#[test]
fn pow_is_rounded_correctly() {
    let bases = arguments(12, |random| random.spread(1e-3, 1e3));
    for exponent in [-12.5, -0.2, 0.7 / 8.0, 0.5, 1.0 / 3.0, 1.7, 101.0] {
        let ours = |x| math::pow(x, exponent);
        assert_rounded("pow", &bases[..bases.len() / 4], ours, |x| core_math::pow(x, exponent));
    }
    let mut random = Random(13);
    for _ in 0..bases.len() {
        let (x, y) = (random.spread(1e-300, 1e300), random.signed_spread(1e-3, 1e3));
        assert_eq!(math::pow(x, y), core_math::pow(x, y), "pow({x:e}, {y:e})");
    }
}

#[test]
fn pow_of_special_values_is_that_of_the_c_standard() {
    let values = [0.0, 1e-310, 0.3, 0.5, 1.0, 2.0, 3.0, 4.5, 9e15, 1e300, f64::INFINITY, f64::NAN];
    let signed = || values.iter().flat_map(|&x| [x, -x]);
    for (x, y) in signed().flat_map(|x| signed().map(move |y| (x, y))) {
        let (ours, truth) = (math::pow(x, y), core_math::pow(x, y));
        assert!(
            ours.to_bits() == truth.to_bits() || (ours.is_nan() && truth.is_nan()),
            "pow({x}, {y}) = {ours}, {truth}"
        );
    }
}
