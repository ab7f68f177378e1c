//! The linearised laws and the growth rates of their waves.

use crate::sample::{Random, laws};
use jam::laws::Model;
use jam::stability::Linear;
use jam::uniform::steady_speed;
use math::double_double::DoubleDouble;
use std::f64::consts::PI;

/// The derivative of `f` at 0 from central differences with `h` and `2 h` (error of `h^4`), and how far it may be off:
/// its distance from the plain difference (error of `h^2`), and the rounding of values of this size.
fn derivative(f: impl Fn(f64) -> f64, size: f64) -> (f64, f64) {
    let h = 1e-4;
    let plain = |h: f64| (f(h) - f(-h)) / (2.0 * h);
    let (near, far) = (plain(h), plain(2.0 * h));
    let value = near + (near - far) / 3.0;
    (value, (value - near).abs() + 32.0 * f64::EPSILON * size / h)
}

#[test]
fn linearisation_is_the_slope_of_the_printed_law() {
    let mut random = Random(9);
    for _ in 0..3000 {
        for model in laws(&mut random) {
            let headway = model.contact() + random.uniform(0.5, 3.0);
            let Ok(v) = steady_speed(&model, headway) else { continue };
            let Linear { phi, beta, kappa } = model.linearise(headway, v);
            let size = model.desired_speed() + v.abs() + 2.0;
            let slopes = [
                (phi, derivative(|h| model.acceleration(headway + h, v, v), size)),
                (-beta - kappa - 1.0, derivative(|h| model.acceleration(headway, v + h, v), size)),
                (-beta + kappa, derivative(|h| model.acceleration(headway, v, v + h), size)),
            ];
            for (exact, (measured, allowed)) in slopes {
                assert!((exact - measured).abs() < allowed, "{model:?}: {exact} not {measured}, allowed {allowed:e}");
            }
        }
    }
}

/// The largest growth rate over all waves: on a ladder of long waves and evenly up to pi.
fn largest_growth(linear: &Linear) -> f64 {
    let long = (0..6).map(|i| 1e-3 * f64::from(1 << (2 * i)));
    let even = (1..=30).map(|i| PI * f64::from(i) / 30.0);
    long.chain(even).map(|k| linear.growth_rate(k)).fold(f64::NEG_INFINITY, math::larger)
}

/// A linearised law with and without each term; `phi` is `10^x` with `x` between the two.
fn linear(random: &mut Random, low: f64, high: f64) -> Linear {
    Linear { phi: random.magnitude(low, high), beta: random.perhaps(0.0, 2.0), kappa: random.perhaps(0.0, 2.0) }
}

#[test]
fn margins_tell_growth_from_decay() {
    let mut random = Random(10);
    let mut unstable = 0;
    for _ in 0..100_000 {
        let linear = linear(&mut random, -2.0, 1.0);
        assert_margins(&linear, &mut random);
        unstable += u32::from(linear.long_wave_margin() > 0.0);
    }
    println!("{unstable} of 100000 unstable");
    assert!(unstable > 20_000 && unstable < 80_000);
}

#[test]
fn margins_tell_growth_from_decay_for_the_laws() {
    let mut random = Random(11);
    for _ in 0..3000 {
        for model in laws(&mut random) {
            let headway = model.contact() + random.uniform(0.2, 3.0);
            let Ok(speed) = steady_speed(&model, headway) else { continue };
            assert_margins(&model.linearise(headway, speed), &mut random);
        }
    }
}

fn assert_margins(linear: &Linear, random: &mut Random) {
    // differences closer to the threshold than the longest wave looked at (k^2 = 1e-6 of the terms) do not count
    let size = 2.0 * linear.phi + (1.0 + 2.0 * linear.kappa) * (1.0 + 2.0 * linear.beta + linear.kappa);
    let margin = linear.long_wave_margin();
    if margin.abs() > 1e-5 * size {
        assert_eq!(largest_growth(linear) > 0.0, margin > 0.0, "{linear:?}: margin {margin}");
    }
    let k = random.uniform(1e-2, PI);
    let margin = linear.margin(k);
    if margin.abs() > 1e-9 * size {
        assert_eq!(linear.growth_rate(k) > 0.0, margin > 0.0, "{linear:?}, k = {k}: margin {margin}");
    }
}

#[test]
fn margins_of_waves_tend_to_that_of_long_ones() {
    let linear = Linear { phi: 0.6, beta: 0.1, kappa: 0.05 };
    assert!((linear.margin(1e-9) - linear.long_wave_margin()).abs() < 4.0 * f64::EPSILON);
}

/// A linearised law with and without its terms, and a wave number.
fn law_and_wave(random: &mut Random) -> (Linear, f64) {
    (linear(random, -3.0, 1.5), PI * random.magnitude(-4.0, 0.0))
}

#[test]
fn roots_solve_the_polynomial_and_are_the_larger_ones() {
    let mut random = Random(12);
    for _ in 0..20_000 {
        let (linear, k) = law_and_wave(&mut random);
        let (b, c) = linear.polynomial(k);
        let (re, im) = linear.root(k);
        let residual = (re * re - im * im + b.0 * re - b.1 * im + c.0, 2.0 * re * im + b.0 * im + b.1 * re + c.1);
        let size = re * re + im * im + (b.0.abs() + b.1.abs()) * (re.abs() + im.abs());
        // some ten operations
        assert!(residual.0.abs() + residual.1.abs() < 20.0 * f64::EPSILON * size, "{linear:?}, k = {k}: {residual:?}");
        assert!(re >= -b.0 - re, "{linear:?}, k = {k}: the other root is larger");
        let difference = (linear.refined_growth_rate(k) - re).abs();
        assert!(difference < 10.0 * f64::EPSILON * (re.abs() + im.abs()), "{linear:?}, k = {k}: {difference:e}");
    }
}

/// The root of `z^2 + b z + c` next to `z`, by Newton's method in double-double numbers: its real part.
fn exact_growth_rate(z: (f64, f64), b: (f64, f64), c: (f64, f64)) -> DoubleDouble {
    let (b, c) =
        ((DoubleDouble::from(b.0), DoubleDouble::from(b.1)), (DoubleDouble::from(c.0), DoubleDouble::from(c.1)));
    let mut z = (DoubleDouble::from(z.0), DoubleDouble::from(z.1));
    for _ in 0..3 {
        let residual =
            (z.0 * z.0 - z.1 * z.1 + b.0 * z.0 - b.1 * z.1 + c.0, z.0 * z.1 * 2.0 + b.0 * z.1 + b.1 * z.0 + c.1);
        let slope = (z.0 * 2.0 + b.0, z.1 * 2.0 + b.1);
        let size = slope.0 * slope.0 + slope.1 * slope.1;
        z.0 = z.0 - (residual.0 * slope.0 + residual.1 * slope.1) / size;
        z.1 = z.1 - (residual.1 * slope.0 - residual.0 * slope.1) / size;
    }
    z.0
}

#[test]
fn a_refined_growth_rate_is_the_double_next_to_the_exact_one() {
    let mut random = Random(30);
    let mut improved = 0;
    for _ in 0..20_000 {
        let (linear, k) = law_and_wave(&mut random);
        let (root, (b, c)) = (linear.root(k), linear.polynomial(k));
        let exact = exact_growth_rate(root, b, c);
        let refined = linear.refined_growth_rate(k);
        let error = |value: f64| (exact - DoubleDouble::from(value)).abs().hi;
        // half a unit in the last place, and the correction, some 1e-16 of the root, to a few of its digits
        let (re, im) = (root.0.abs(), root.1.abs());
        let allowed = 0.5 * f64::EPSILON * re + 64.0 * f64::EPSILON * f64::EPSILON * (re + im);
        assert!(error(refined) <= allowed, "{linear:?}, k = {k}: {:e} of {allowed:e}", error(refined));
        improved += u32::from(error(refined) < error(root.0));
    }
    assert!(improved > 10_000, "{improved}");
}

#[test]
fn a_short_ring_is_stable_where_long_waves_would_grow() {
    // the margin falls with k: phi just above 1/2 is unstable for k -> 0 but not for 2 pi / 10
    let linear = Linear { phi: 0.505, beta: 0.0, kappa: 0.0 };
    assert!(linear.long_wave_margin() > 0.0);
    assert!(linear.fastest(10).0 < 0.0 && linear.fastest(1000).0 > 0.0);
}

#[test]
fn fastest_is_the_largest_over_the_ring() {
    for phi in [0.3, 0.6, 2.0, 20.0] {
        let linear = Linear { phi, beta: 0.02, kappa: 0.01 };
        for count in [2, 3, 66, 67] {
            let rates: Vec<f64> =
                (1..=count / 2).map(|l| linear.growth_rate(2.0 * PI * l as f64 / count as f64)).collect();
            let (rate, l) = linear.fastest(count);
            assert_eq!(rate, rates.iter().copied().fold(f64::NEG_INFINITY, math::larger));
            assert_eq!(rate, rates[l - 1]);
        }
    }
}

#[test]
fn all_terms_are_reached() {
    // the random laws above have every combination of terms
    let mut random = Random(1);
    let mut seen = std::collections::BTreeSet::new();
    for _ in 0..1000 {
        for model in laws(&mut random) {
            seen.insert(match model {
                Model::Algebraic(a) => {
                    let power = if [1.0, 2.0, 3.0].contains(&a.q) { a.q as u8 } else { 0 };
                    (0, a.delta > 0.0, a.a_v > 0.0, power)
                }
                Model::Exponential(e) => (1, e.c > 0.0, e.a_v > 0.0, 0),
                Model::Logarithmic(l) => (2, l.a_v > 0.0, false, 0),
                Model::Formula(_) | Model::Own(_) => continue,
            });
        }
    }
    assert_eq!(seen.len(), 16 + 4 + 2);
}
