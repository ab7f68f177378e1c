//! The complex square root.

use crate::sample::{COUNT, Random, unit};
use math::complex_sqrt;
use math::double_double::DoubleDouble;

/// The root in double-double numbers: the larger part from the modulus, the other from the product.
fn truth(re: f64, im: f64) -> (DoubleDouble, DoubleDouble) {
    let (a, b) = (DoubleDouble::from(re.abs()), DoubleDouble::from(im.abs()));
    let large = ((a + (a * a + b * b).sqrt()) / 2.0).sqrt();
    let small = b / (large * 2.0);
    let (real, imaginary) = if re >= 0.0 { (large, small) } else { (small, large) };
    (real, if im < 0.0 { -imaginary } else { imaginary })
}

fn error(computed: f64, exact: DoubleDouble) -> f64 {
    ((computed - exact.hi) - exact.lo).abs() / unit(exact.hi)
}

#[test]
fn both_parts_are_within_three_units() {
    let mut random = Random(80);
    for _ in 0..COUNT {
        let (re, im) = (random.signed_spread(1e-60, 1e60), random.signed_spread(1e-60, 1e60));
        let ((x, y), exact) = (complex_sqrt(re, im), truth(re, im));
        assert!(error(x, exact.0) < 3.0 && error(y, exact.1) < 3.0, "{re:e} {im:e}");
        let (re, im) = (random.uniform(-10.0, 10.0), random.uniform(-10.0, 10.0));
        let ((x, y), exact) = (complex_sqrt(re, im), truth(re, im));
        assert!(error(x, exact.0) < 3.0 && error(y, exact.1) < 3.0, "{re:e} {im:e}");
    }
}

/// The root of a number times 4^k is the root times 2^k, to the bit.
#[test]
fn large_and_small_numbers_neither_overflow_nor_underflow() {
    let mut random = Random(81);
    for _ in 0..10_000 {
        let (re, im) = (random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
        let (x, y) = complex_sqrt(re, im);
        for k in [-490, -400, -250, 250, 400, 511] {
            let power = |k: i32| f64::from_bits(((k + 1023) as u64) << 52);
            let square = |x: f64| x * power(k) * power(k);
            assert_eq!(complex_sqrt(square(re), square(im)), (x * power(k), y * power(k)), "{re} {im} {k}");
        }
    }
    let (x, y) = complex_sqrt(5e-324, 5e-324);
    assert!((x / y - 2.414213562373095).abs() < 1e-15, "{x:e} {y:e}");
}

#[test]
fn the_branch_cut_is_the_negative_axis() {
    assert_eq!(complex_sqrt(-4.0, 0.0), (0.0, 2.0));
    assert_eq!(complex_sqrt(-4.0, -0.0), (0.0, -2.0));
    assert_eq!(complex_sqrt(4.0, -0.0).1.to_bits(), (-0.0_f64).to_bits());
    assert_eq!(complex_sqrt(9.0, 0.0), (3.0, 0.0));
    assert_eq!(complex_sqrt(-3.0, 4.0), (1.0, 2.0));
    assert_eq!(complex_sqrt(0.0, -8.0), (2.0, -2.0));
    assert_eq!(complex_sqrt(0.0, 0.0), (0.0, 0.0));
}

#[test]
fn infinite_parts_follow_the_c_standard() {
    let infinity = f64::INFINITY;
    assert_eq!(complex_sqrt(f64::NAN, -infinity), (infinity, -infinity));
    assert_eq!(complex_sqrt(infinity, -1.0), (infinity, -0.0));
    assert_eq!(complex_sqrt(-infinity, -1.0), (0.0, -infinity));
    let (x, y) = complex_sqrt(f64::NAN, 1.0);
    assert!(x.is_nan() && y.is_nan());
}
