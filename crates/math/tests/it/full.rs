//! The elementary functions of double-double numbers against mpmath, their widths, and decimal text.

use crate::sample::Random;
use math::double_double::{DoubleDouble, decimal, full};
use math::simd::{Kernel, Width, dispatch_up_to};

/// Function, argument, value with 40 digits (`functions.py`).
const TABLE: &str = include_str!("../functions.csv");

#[test]
fn functions_have_100_bits() {
    let mut worst = [("exp", 0.0_f64), ("exp_m1", 0.0), ("ln", 0.0), ("ln_1p", 0.0)];
    for line in TABLE.lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let x = DoubleDouble::from(cells[1].parse::<f64>().expect("a double"));
        let value = match cells[0] {
            "exp" => full::exp(x),
            "exp_m1" => full::exp_m1(x),
            "ln" => full::ln(x),
            _ => full::ln_1p(x),
        };
        let truth = decimal::parse(cells[2]).expect(line);
        // ln 1 = 0 is exact
        let error = if value == truth { 0.0 } else { ((value - truth).hi / truth.hi).abs() };
        let entry = worst.iter_mut().find(|entry| entry.0 == cells[0]).expect("a known name");
        entry.1 = math::larger(entry.1, error);
        assert!(error < f64::from_bits((1023 - 100) << 52), "{line}: relative error {error:e}");
    }
    println!("largest relative errors: {worst:?}");
}

#[test]
fn logarithms_undo_exponentials_of_twofold_arguments() {
    let mut random = Random(80);
    for _ in 0..100_000 {
        let x = DoubleDouble::sum(random.uniform(-5.0, 5.0), random.uniform(-1e-17, 1e-17));
        // what the value of the exponential leaves out counts for its logarithm as an absolute error
        let allowed = f64::from_bits((1023 - 96) << 52);
        let near = |value: DoubleDouble| (value - x).hi.abs() <= allowed * math::larger(x.hi.abs(), 1.0);
        assert!(near(full::ln(full::exp(x))), "{x:?}");
        // e^x - 1 near -1 has lost the digits
        assert!(x.hi < -1.0 || near(full::ln_1p(full::exp_m1(x))), "{x:?}");
        let difference = full::softplus(x) - full::softplus(-x);
        assert!(near(difference), "ln(1 + e^x) - ln(1 + e^-x) is not x = {x:?}");
    }
    let tiny = full::ln_1p(full::exp_m1(DoubleDouble::sum(1e-12, 3e-29)));
    assert!((tiny - DoubleDouble::sum(1e-12, 3e-29)).hi.abs() < 1e-12 * 1e-29, "{tiny:?}");
}

#[test]
fn tanh_is_that_of_its_definition_and_of_its_series() {
    let mut random = Random(84);
    let allowed = f64::from_bits((1023 - 97) << 52);
    for _ in 0..20_000 {
        let x = DoubleDouble::sum(random.uniform(-45.0, 45.0), random.uniform(-1e-17, 1e-17));
        let (up, down) = (full::exp(x), full::exp(-x));
        let truth = (up - down) / (up + down);
        let error = (full::tanh(x) - truth).hi.abs();
        assert!(error <= allowed, "{x:?}: {error:e}");
        let x = DoubleDouble::from(random.signed_spread(1e-100, 1e-5));
        // tanh x = x - x^3/3 + 2 x^5/15 - 17 x^7/315 + ..., of which the next term is below 2^-130
        let z = x * x;
        let tail = z * 2.0 / 15.0 - z * z * 17.0 / 315.0;
        let truth = x * (z * (tail - DoubleDouble::ONE / 3.0) + 1.0);
        let error = ((full::tanh(x) - truth).hi / x.hi).abs();
        assert!(error <= allowed, "{x:?}: relative error {error:e}");
    }
    assert_eq!((full::tanh(DoubleDouble::ZERO).hi, full::tanh(DoubleDouble::from(-1e300)).hi), (0.0, -1.0));
}

#[test]
fn a_tail_keeps_its_relative_precision() {
    // ln(1 + y) = y - y^2/2 up to y^3 for y = e^x
    for x in [-40.0, -60.5, -300.25, -699.0] {
        let y = full::exp(DoubleDouble::from(x));
        let truth = y - y * y * 0.5;
        let error = ((full::softplus(DoubleDouble::from(x)) - truth).hi / truth.hi).abs();
        assert!(error < f64::from_bits((1023 - 96) << 52), "relative error {error:e} at {x}");
    }
}

/// One function of double-double numbers over a slice.
struct Map<'a, F> {
    f: F,
    x: &'a [DoubleDouble],
    out: &'a mut [DoubleDouble],
}

impl<F: Fn(DoubleDouble) -> DoubleDouble> Kernel for Map<'_, F> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        for (out, x) in self.out.iter_mut().zip(self.x) {
            *out = (self.f)(*x);
        }
    }
}

#[test]
fn twofold_functions_have_the_same_bits_at_every_width() {
    let mut random = Random(81);
    let x: Vec<DoubleDouble> = (0..1001)
        .map(|_| DoubleDouble::sum(random.signed_spread(1e-20, 600.0), random.uniform(-1e-40, 1e-40)))
        .collect();
    let bits = |values: &[DoubleDouble]| values.iter().map(|v| [v.hi.to_bits(), v.lo.to_bits()]).collect::<Vec<_>>();
    for f in [full::exp, full::exp_m1, full::softplus, full::tanh] {
        let single: Vec<DoubleDouble> = x.iter().map(|x| f(std::hint::black_box(*x))).collect();
        for width in [Width::Baseline, Width::Four, Width::Eight] {
            let mut out = vec![DoubleDouble::ZERO; x.len()];
            dispatch_up_to(width, Map { f: |x| f(x), x: &x, out: &mut out });
            assert_eq!(bits(&out), bits(&single), "{width:?}");
        }
    }
}

#[test]
fn exact_values_are_rounded_once_to_decimals() {
    let text = |hi: f64, lo: f64, digits: usize| decimal::format(DoubleDouble { hi, lo }, digits);
    assert_eq!(text(0.1, 0.0, 20), "1.0000000000000000555e-1");
    assert_eq!(text(1.0, -1e-30, 20), "1.0000000000000000000");
    assert_eq!(text(1.0, -1e-20, 20), "9.9999999999999999999e-1");
    assert_eq!(text(1.0, -1e-20, 19), "1.000000000000000000");
    assert_eq!(text(-1234.5, 0.0, 5), "-1.2345e3");
    assert_eq!(text(0.125, 0.0, 2), "1.2e-1", "a tie goes to the even digit");
    assert_eq!(text(0.375, 0.0, 2), "3.8e-1");
    assert_eq!(text(0.125, 1e-300, 2), "1.3e-1", "a little more than a tie");
    assert_eq!(text(0.125, -1e-300, 2), "1.2e-1");
    assert_eq!(text(0.0, 0.0, 20), "0");
    assert_eq!(text(0.265625, 0.0, 2), "2.7e-1", "more than a tie, without a zero behind the five");
    assert_eq!((text(0.0, 0.25, 2), text(0.0, -0.25, 2)), ("2.5e-1".to_owned(), "-2.5e-1".to_owned()));
    assert_eq!(text(5e-324, 0.0, 3), "4.94e-324");
    assert_eq!(text(9007199254740993.0, 1.0, 16), "9.007199254740993e15");
    assert_eq!(text(7.0, 0.0, 1), "7");
}

#[test]
fn decimals_are_read_to_98_bits() {
    let same = |text: &str, hi: f64, lo: f64| {
        let value = decimal::parse(text).expect("a number");
        assert!(
            (value - DoubleDouble { hi, lo }).hi.abs() <= hi.abs() * f64::from_bits((1023 - 98) << 52),
            "{text}: {value:?}"
        );
    };
    same("3.1415926535897932384626433832795028842", std::f64::consts::PI, 1.2246467991473532e-16);
    same("-1e-1", -0.1, 5.551115123125783e-18);
    same("100", 100.0, 0.0);
    for text in ["", "-", "1e", "nan", "1.2.3", "0x1"] {
        assert_eq!(decimal::parse(text), None, "{text}");
    }
    let mut random = Random(82);
    for _ in 0..1000 {
        let value = DoubleDouble::sum(random.signed_spread(1e-30, 1e30), 0.0);
        let value = DoubleDouble { lo: value.hi * random.uniform(-1e-17, 1e-17), ..value };
        let read = decimal::parse(&decimal::format(value, 34)).expect("a number");
        assert!((read - value).hi.abs() <= value.hi.abs() * f64::from_bits((1023 - 98) << 52), "{value:?}");
    }
}

#[test]
fn logarithms_next_to_minus_1_keep_their_precision() {
    // 1 + x = 2^-k, exactly, or less by a tail of x
    for k in 2..=50 {
        let power = f64::from_bits((1023 - k) << 52);
        let truth = -(DoubleDouble::LN_2 * k as f64);
        let error = ((full::ln_1p(DoubleDouble::from(power - 1.0)) - truth).hi / truth.hi).abs();
        assert!(error < f64::from_bits((1023 - 100) << 52), "2^-{k}: {error:e}");
        let tail = power * f64::from_bits((1023 - 60) << 52);
        // ln(p + t) = ln p + t / p - (t / p)^2 / 2
        let value = full::ln_1p(DoubleDouble::sum(power - 1.0, tail));
        let difference = (value - truth - tail / power).hi.abs();
        assert!(difference < truth.hi.abs() * f64::from_bits((1023 - 98) << 52), "2^-{k}: {difference:e}");
    }
}

#[test]
fn beyond_700_the_exponential_stays_where_it_is() {
    for far in [700.5, 1e3, 1e6, 1e300] {
        assert_eq!(full::exp(DoubleDouble::from(far)), full::exp(DoubleDouble::from(700.0)));
        assert_eq!(full::exp(DoubleDouble::from(-far)), full::exp(DoubleDouble::from(-700.0)));
        assert_eq!(full::softplus(DoubleDouble::from(far)).hi, far);
    }
    let (large, small) = (full::exp(DoubleDouble::from(700.0)).hi, full::exp(DoubleDouble::from(-700.0)).hi);
    assert!(
        (large / 1.0142320547350045e304 - 1.0).abs() < 1e-15 && (small / 9.85967654375977e-305 - 1.0).abs() < 1e-15
    );
    // and one step before it is another value
    assert!(full::exp(DoubleDouble::from(699.5)) != full::exp(DoubleDouble::from(700.0)));
}

/// A double with so many significant digits, by the standard library, which is exact, in the form of
/// [`decimal::format`].
fn by_std(value: f64, digits: usize) -> String {
    format!("{:.*e}", digits - 1, value).replace("e0", "")
}

#[test]
fn decimals_are_those_of_the_exact_value() {
    let mut random = Random(83);
    for _ in 0..3000 {
        let x = random.signed_spread(1e-30, 1e30);
        for digits in [1, 2, 17, 40, 90] {
            assert_eq!(decimal::format(DoubleDouble::from(x), digits), by_std(x, digits), "{x:e}");
        }
        // a tail that the sum can hold, of either sign: the digits of the sum
        let tail = x * f64::from_bits((1023 - 20) << 52) * if random.bits() & 1 == 0 { 1.0 } else { -1.0 };
        let hi = f64::from_bits(x.to_bits() & !0xff_ffff);
        let lo = f64::from_bits(tail.to_bits() & !0xffff_ffff);
        if DoubleDouble::sum(hi, lo).lo == 0.0 {
            assert_eq!(decimal::format(DoubleDouble { hi, lo }, 60), by_std(hi + lo, 60), "{hi:e} {lo:e}");
        }
    }
    for x in [5e-324, f64::MIN_POSITIVE, 1.5, 2.0, 1e300, 0.1, 0.7, 1.0 / 3.0, 3.0, f64::MAX] {
        for digits in [1, 30, 60] {
            assert_eq!(decimal::format(DoubleDouble::from(x), digits), by_std(x, digits), "{x:e}");
        }
    }
}
