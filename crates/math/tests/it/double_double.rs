//! Numbers of 106 bits: exact sums and products, and values known to more digits.

use crate::sample::Random;
use math::double_double::DoubleDouble;

/// Asserts a relative distance of at most 2^-`bits`.
#[track_caller]
fn assert_near(value: DoubleDouble, truth: DoubleDouble, bits: i32) {
    let distance = (value - truth).hi.abs() / truth.hi.abs();
    assert!(distance <= f64::from_bits(((1023 - bits) as u64) << 52), "{value:?} for {truth:?}: {distance:e}");
}

fn pair(hi: f64, lo: f64) -> DoubleDouble {
    DoubleDouble { hi, lo }
}

#[test]
fn sums_and_products_of_doubles_are_exact() {
    let mut random = Random(60);
    for _ in 0..100_000 {
        // whole numbers, whose sums and products a machine integer holds
        let (a, b) = (random.bits() as i64 >> 11, random.bits() as i64 >> 30);
        let sum = DoubleDouble::sum(a as f64, b as f64);
        assert_eq!(sum.hi as i128 + sum.lo as i128, a as i128 + b as i128);
        let product = DoubleDouble::product(a as f64, b as f64);
        assert_eq!(product.hi as i128 + product.lo as i128, a as i128 * b as i128);
    }
}

#[test]
fn operations_undo_each_other() {
    let mut random = Random(61);
    let mut number = || DoubleDouble::sum(random.uniform(0.5, 2.0), random.uniform(-1e-17, 1e-17));
    for _ in 0..100_000 {
        let (a, b) = (number(), number());
        assert_near((a + b) - b, a, 102);
        assert_near(a * b / b, a, 101);
        assert_near(a / b * b, a, 101);
        assert_near((a * a).sqrt(), a, 101);
        assert_near(a * b.hi / b.hi, a, 101);
        assert_near(-(-a - 3.0) - 3.0, a, 102);
    }
    assert_eq!(DoubleDouble::ZERO.sqrt(), DoubleDouble::ZERO);
    assert_eq!(f64::from(DoubleDouble::ONE + 1e-17), 1.0);
}

/// Values computed with mpmath to 400 bits.
#[test]
fn functions_have_eighty_bits() {
    let of = |x: f64| DoubleDouble::from(x);
    assert_near(of(1.0) / 3.0, pair(0.3333333333333333, 1.850371707708594e-17), 102);
    assert_near(of(2.0).sqrt(), pair(std::f64::consts::SQRT_2, -9.667293313452913e-17), 102);
    assert_near(of(1.0).exp(), pair(std::f64::consts::E, 1.4456468917292502e-16), 80);
    assert_near(of(-100.5).exp(), pair(2.256340135917036e-44, 1.4495434372921381e-60), 80);
    assert_near(of(3.0).ln(), pair(1.0986122886681098, -9.07129723500153e-17), 80);
    assert_near(of(10.0).ln(), pair(std::f64::consts::LN_10, -2.1707562233822494e-16), 80);
    assert_near(of(1e-5).exp_m1(), pair(1.0000050000166668e-5, -3.111926571619883e-22), 80);
    assert_near(of(-0.3).ln_1p(), pair(-0.35667494393873234, -2.6895094047056423e-17), 80);
}

#[test]
fn outside_their_domains_twofold_functions_say_so() {
    for x in [0.0, -0.0, -1.0, -1e300, f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
        assert!(DoubleDouble::from(x).ln().hi.is_nan(), "{x}");
    }
    for x in [-1.0, -2.0, f64::INFINITY, f64::NAN] {
        assert!(DoubleDouble::from(x).ln_1p().hi.is_nan(), "{x}");
    }
    let overflow = 709.782_712_893_384;
    for x in [710.0, 800.0, 1e300, f64::INFINITY, overflow + 1e-3] {
        assert_eq!(DoubleDouble::from(x).exp().hi, f64::INFINITY, "{x}");
    }
    for x in [-708.1, -800.0, -1e300, f64::NEG_INFINITY] {
        assert_eq!(DoubleDouble::from(x).exp(), DoubleDouble::ZERO, "{x}");
    }
    assert!(DoubleDouble::from(overflow).exp().hi.is_finite());
    assert!(DoubleDouble::from(-708.0).exp().hi > 3e-308 && DoubleDouble::from(709.5).exp().hi > 1e308);
}
