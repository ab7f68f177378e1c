//! The paper's criteria against the exact margin, and the lines on which they vanish.

use crate::sample::{Random, algebraic, exponential};
use jam::criteria;
use jam::laws::{Algebraic, Exponential, Logarithmic, Model};
use jam::stability::Linear;
use jam::uniform::steady_speed;
use std::f64::consts::{LN_2, PI};

/// `Phi` of the paper from the margin: `margin / (2 (1 + 2 beta))`.
fn scaled(linear: &Linear) -> f64 {
    linear.long_wave_margin() / (2.0 * (1.0 + 2.0 * linear.beta))
}

/// Both are sums of terms of this size in some ten operations.
fn rounding(linear: &Linear) -> f64 {
    20.0 * f64::EPSILON * (1.0 + linear.phi + linear.kappa)
}

#[test]
fn criteria_are_the_exact_margin() {
    let mut random = Random(20);
    for _ in 0..20_000 {
        let gap = random.uniform(0.2, 3.0);
        let law = algebraic(&mut random);
        let linear = law.linearise(gap);
        let difference = criteria::algebraic(&law, gap) - scaled(&linear);
        assert!(difference.abs() < rounding(&linear), "{law:?} at {gap}: {difference:e}");
        // the paper's contact force is linearised at d' = 0 only: without it
        let law = Exponential { c: 0.0, ..exponential(&mut random) };
        let linear = law.linearise(gap);
        let difference = criteria::exponential(&law, gap) - scaled(&linear);
        assert!(difference.abs() < rounding(&linear), "{law:?} at {gap}: {difference:e}");
    }
}

#[test]
fn the_criterion_with_a_contact_force_is_exact_where_its_slope_is_a_half() {
    let mut random = Random(22);
    for _ in 0..2_000 {
        let law = Exponential { c: random.uniform(0.5, 10.0), ..exponential(&mut random) };
        let linear = law.linearise(0.0);
        let difference = criteria::exponential(&law, 0.0) - scaled(&linear);
        assert!(difference.abs() < rounding(&linear), "{law:?}: {difference:e}");
    }
}

#[test]
fn the_logarithmic_criterion_is_the_exact_margin_in_the_limit_of_a_sharp_ramp() {
    let mut random = Random(21);
    for _ in 0..20_000 {
        let law = Logarithmic {
            v0: random.uniform(0.1, 6.0),
            a_v: random.perhaps(0.05, 4.0),
            epsilon: random.magnitude(-3.0, -2.0),
        };
        let headway = random.uniform(0.3, 1.7);
        let speed = steady_speed(&Model::Logarithmic(law), headway).expect("there is room");
        let linear = law.linearise(headway, speed);
        let exact = scaled(&linear) / (1.0 + 2.0 * linear.beta);
        let printed = criteria::logarithmic(&law, headway, speed);
        // r_eps(x) = -x + eps exp(x / eps) to first order, and its slope -1 + exp(x / eps)
        let x = headway / law.critical_distance(speed) - 1.0;
        let allowed = rounding(&linear) + 4.0 * (1.0 + linear.phi) * math::exp(x / law.epsilon);
        assert!((exact - printed).abs() < allowed, "{law:?} at {headway}: {exact} not {printed}");
    }
}

/// Growth rate over `k^2` at two long waves: it tends to 0 as `k^2` where the long waves are marginal.
fn assert_marginal(linear: &Linear, criterion: f64, what: &str) {
    assert!(criterion.abs() < rounding(linear), "{what}: criterion {criterion:e}");
    let curvature = |k: f64| linear.growth_rate(k) / (k * k);
    let (long, longer) = (curvature(0.02), curvature(0.002));
    let ratio = long / longer;
    // the next term is smaller by k^2 times a number below 100 for these laws
    assert!((ratio / 100.0 - 1.0).abs() < 100.0 * 0.02 * 0.02, "{what}: {long:e}, {longer:e}");
    assert!(long < 0.0, "{what}: on the line the short waves decay");
}

#[test]
fn zero_lines_of_the_algebraic_law() {
    for power in [1.0, 2.0, 3.0, 2.5] {
        for gap in [0.3, 0.9851, 1.7] {
            let law = |strength: f64, relative: f64, widening: f64| Algebraic {
                mu: strength,
                delta: relative,
                q: power,
                a_v: widening,
                epsilon: 0.1,
                v0: 3.0,
            };
            let check = |law: Algebraic| {
                assert_marginal(&law.linearise(gap), criteria::algebraic(&law, gap), &format!("{law:?} at {gap}"));
            };
            let d_power = math::pow(gap, power + 1.0);
            // phi = q mu^2 / d^(q + 1) = 1/2
            check(law((d_power / (2.0 * power)).sqrt(), 0.0, 0.0));
            // phi / (1 + 2 a_v phi) = 1/2: phi = 1 / (2 (1 - a_v)), for a_v < 1
            check(law((d_power / (2.0 * power * (1.0 - 0.2))).sqrt(), 0.0, 0.2));
            // q g^2 / d^(q + 1) - g / d^q = 1/2: a quadratic in g = mu + eps ln 2
            let gamma = (gap + (gap * gap + 2.0 * power * d_power).sqrt()) / (2.0 * power);
            check(law(gamma - 0.1 * LN_2, 1.0, 0.0));
        }
    }
    // the paper's value at d' = 1 and the one at the headway of its simulations
    let critical = |gap: f64| (gap * gap * gap / 4.0).sqrt();
    assert_eq!(critical(1.0), 0.5);
    assert!((critical(200.0 / 67.0 - 2.0) - 0.4888).abs() < 5e-5);
}

#[test]
fn zero_lines_of_the_exponential_law() {
    for range in [0.5, 1.5, 4.0] {
        for gap in [0.0, 0.5, 1.5, 2.5] {
            for widening in [0.0, 0.15, 0.9] {
                // (a / b) exp(-d / b) = 1 / (2 (1 - a_v)); a_v = 0: a = b / 2 exp(d / b)
                let strength = range * math::exp(gap / range) / (2.0 * (1.0 - widening));
                let law = Exponential { a: strength, b: range, c: 0.0, a_v: widening, epsilon: 0.1, v0: 3.0 };
                assert_marginal(&law.linearise(gap), criteria::exponential(&law, gap), &format!("{law:?} at {gap}"));
            }
        }
    }
}

#[test]
fn wide_pedestrians_are_always_stable() {
    // phi / (1 + 2 a_v phi) < 1 / (2 a_v) <= 1/2 from a_v = 1 on, whatever the force
    for strength in [0.1, 1.0, 10.0, 1000.0] {
        for gap in [0.01, 0.1, 1.0] {
            let law = Algebraic { mu: strength, delta: 0.0, q: 2.0, a_v: 1.0, epsilon: 0.1, v0: 3.0 };
            assert!(criteria::algebraic(&law, gap) < 0.0 && law.linearise(gap).long_wave_margin() < 0.0);
            let law = Exponential { a: strength, b: 0.5, c: 0.0, a_v: 1.0, epsilon: 0.1, v0: 3.0 };
            assert!(criteria::exponential(&law, gap) < 0.0 && law.linearise(gap).long_wave_margin() < 0.0);
        }
    }
}

#[test]
fn the_logarithmic_law_without_widening_is_stable_below_xi_one_half() {
    let headway = 1.5;
    // xi = c v_0 / (2 (1 + c (1 - headway / 2))) = 1/2
    let c = jam::laws::C;
    let critical = (1.0 + c * (1.0 - 0.5 * headway)) / c;
    for (factor, stable) in [(0.999_999, true), (1.000_001, false)] {
        let law = Logarithmic { v0: factor * critical, a_v: 0.0, epsilon: 0.01 };
        let speed = steady_speed(&Model::Logarithmic(law), headway).expect("there is room");
        let linear = law.linearise(headway, speed);
        assert_eq!(linear.phi < 0.5, stable);
        assert_eq!(criteria::logarithmic(&law, headway, speed) < 0.0, stable);
        assert_eq!(linear.long_wave_margin() < 0.0, stable);
    }
}

#[test]
fn a_panel_of_figure_14_is_stable_everywhere() {
    // <0.5, 1, 1, 0.1>
    let law = Algebraic { mu: 0.5, delta: 1.0, q: 1.0, a_v: 0.1, epsilon: 0.1, v0: 3.0 };
    for i in 0..=360 {
        let gap = 0.2 + 0.005 * f64::from(i);
        let linear = law.linearise(gap);
        assert!(linear.long_wave_margin() < 0.0 && criteria::algebraic(&law, gap) < 0.0, "d' = {gap}");
        for l in 1..=200 {
            let k = PI * f64::from(l) / 200.0;
            assert!(linear.growth_rate(k) < 0.0, "d' = {gap}, k = {k}");
        }
    }
}
