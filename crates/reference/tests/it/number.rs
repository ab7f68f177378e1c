//! Differences against subtraction in double-double numbers; the laws in every kind of number.

use math::double_double::DoubleDouble;
use reference::formula::{Formula, smooth_ramp};
use reference::number::{Difference, Number, Parted};

fn whole(x: Difference<DoubleDouble>) -> DoubleDouble {
    x.whole()
}

#[test]
fn differences_are_those_of_longer_numbers() {
    type Function = (&'static str, fn(Difference<f64>) -> Difference<f64>, fn(DoubleDouble) -> DoubleDouble);
    let functions: [Function; 11] = [
        ("exp", Number::exp, Number::exp),
        ("softplus", Number::softplus, Number::softplus),
        ("ln_1p", Number::ln_1p, Number::ln_1p),
        ("power", |x| x.power(-0.7), |x| x.power(-0.7)),
        ("product", |x| x * x, |x| x * x),
        ("exp_m1", Number::exp_m1, Number::exp_m1),
        ("ln", Number::ln, Number::ln),
        ("root", Number::root, Number::root),
        ("tanh", Number::tanh, Number::tanh),
        ("cube", |x| x.whole_power(3), |x| x.whole_power(3)),
        ("quotient", |x| Difference::from(3.0) / x, |x| DoubleDouble::from(3.0) / x),
    ];
    for (name, difference, long) in functions {
        for base in [0.03, 0.7, 2.0, 30.0] {
            for change in [1e-12, -3e-9, 2e-5, -1e-3, 0.02, -0.029, 0.9, 1.1, 20.0] {
                let x = Difference { base, change };
                let expected = long(DoubleDouble::sum(base, change)) - long(DoubleDouble::from(base));
                let error = (difference(x).change - f64::from(expected)).abs();
                // a few roundings of the difference; of the values where the change is large
                let size = f64::from(expected).abs();
                let value = f64::from(long(DoubleDouble::from(base))).abs();
                let rounding = if change.abs() < 0.02 { 0.0 } else { 2e-15 * value };
                // both long values have roundings of their own, which a small difference of them inherits
                let allowed = 2e-14 * size + rounding + 1e-31 * value;
                assert!(error <= allowed, "{name}({base} + {change}): off by {error:e}, allowed {allowed:e}");
            }
        }
    }
}

#[test]
fn a_law_in_differences_and_in_parts_is_the_law() {
    let laws = [
        Formula::Algebraic { mu: 0.7, delta: 0.4, q: 1.3, a_v: 0.2, epsilon: 0.01, v0: 1.5 },
        Formula::Exponential { a: 3.0, b: 0.4, c: 7.0, a_v: 0.1, epsilon: 0.02, v0: 1.5 },
        Formula::Logarithmic { a_v: 0.3, epsilon: 0.05, v0: 0.8 },
    ];
    for law in laws {
        for (u, w, w_ahead) in [(1e-9, -2e-9, 1e-10), (0.3, 0.1, -0.2), (-0.4, 0.05, 0.06)] {
            let (s, v) = (3.1, 0.6);
            let number = |base: f64, change: f64| Difference {
                base: DoubleDouble::from(base),
                change: DoubleDouble::from(change),
            };
            let ramp = &mut |x, epsilon| smooth_ramp(x, epsilon);
            let by_difference =
                whole(law.acceleration(|_| number(s, u), |j| number(v, [w, w_ahead][j as usize]), &mut |x, e| {
                    smooth_ramp(x, e)
                }));
            let part = |base: f64, rest: f64| Parted { base, rest };
            let by_parts =
                law.acceleration(|_| part(s, u), |j| part(v, [w, w_ahead][j as usize]), &mut |x, e| smooth_ramp(x, e));
            let plain: f64 = law.acceleration(|_| s + u, |j| v + [w, w_ahead][j as usize], ramp);
            assert!((f64::from(by_difference) - plain).abs() < 2e-14, "{law:?}");
            assert!((by_parts.whole() - plain).abs() < 2e-14, "{law:?}");
        }
    }
}

#[test]
fn kinks_keep_the_digits_of_differences() {
    for (base, change) in [(0.3, 1e-30), (-0.3, 1e-30), (0.3, -0.5), (-0.3, 0.5), (0.0, -1e-30), (0.0, 1e-30)] {
        let x = Difference { base, change };
        let size = f64::abs(base + change) - f64::abs(base);
        let expected = if f64::abs(change) > 1e-20 { size } else { if base < 0.0 { -change } else { change } };
        let expected = if base == 0.0 { f64::abs(change) } else { expected };
        assert!((x.size().change - expected).abs() <= 1e-16 * expected.abs(), "|{base} + {change}|");
        // |x| is the larger of x and -x, and the smaller one's negative
        assert_eq!(x.larger(-x), x.size(), "{base} + {change}");
        assert_eq!((-x.smaller(-x)).whole(), x.size().whole(), "{base} + {change}");
    }
}

#[test]
fn a_small_room_keeps_its_digits_in_parts() {
    let law = Formula::Algebraic { mu: 1.0, delta: 0.0, q: 2.0, a_v: 0.0, epsilon: 0.1, v0: 1.0 };
    let (s, v) = (Parted { base: 2.0, rest: 1e-40 }, Parted { base: 0.0, rest: 0.0 });
    assert_eq!(law.room(|_| s, |_| v).whole(), 1e-40);
}
