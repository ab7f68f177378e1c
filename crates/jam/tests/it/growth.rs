//! Waves in simulations grow, decay and travel as the linear theory predicts.

use jam::laws::{Algebraic, Exponential, Logarithmic, Model};
use jam::ring::Ring;
use jam::stability::Response;
use jam::states::StateVariables;
use jam::uniform::steady_speed;
use jam::waves;
use ode::{Control, Method, Problem, Step, integrate};
use std::f64::consts::PI;
use std::ops::ControlFlow;

/// Small enough that quadratic terms, which feed other waves than this one, and cubic ones (1e-16) do not count.
const AMPLITUDE: f64 = 1e-8;

/// Errors of growth rate and frequency of the wave with `l` crests, relative to each of them, from a simulation.
fn errors(model: &Model, ring: Ring, l: usize) -> (f64, f64) {
    let count = ring.pedestrians;
    let speed = steady_speed(model, ring.headway()).expect("there is room");
    let k = 2.0 * PI * l as f64 / count as f64;
    let (re, im) = model.linearise(ring.headway(), speed).root(k);
    let form = StateVariables::Deviations.build(model, ring);
    let start = waves::start(count, speed, (re, im), k, AMPLITUDE);
    let time = if re.abs() > 0.02 { 4.0 / re.abs() } else { 200.0 };
    let control = Control::Adaptive { tolerance: 1e-14 };
    let problem = Problem { system: &*form, start: &start, begin: 0.0, end: time, method: Method::Dop853, control };
    let end = integrate(&problem, &mut |_: &mut Step<'_>| ControlFlow::Continue(())).expect("it runs").state;
    let before = waves::coefficient(&start[count..2 * count], k);
    let after = waves::coefficient(&end[count..2 * count], k);
    // after / before = exp(z t); turned back by the expected angle, the angle that is left is small
    let square = before.0 * before.0 + before.1 * before.1;
    let ratio =
        ((after.0 * before.0 + after.1 * before.1) / square, (after.1 * before.0 - after.0 * before.1) / square);
    let size = (ratio.0 * ratio.0 + ratio.1 * ratio.1).sqrt();
    let (cos, sin) = (math::cos(im * time), math::sin(im * time));
    let angle = (ratio.1 * cos - ratio.0 * sin) / size;
    ((math::ln(size) / time - re) / re, angle / (im * time))
}

#[test]
fn a_state_holds_half_of_a_real_wave() {
    for (count, l) in [(7, 1), (12, 5), (67, 20)] {
        let k = 2.0 * PI * l as f64 / count as f64;
        let wave: Vec<f64> = (0..count).map(|n| 3.0 + 0.5 * math::cos(k * n as f64 + 0.3)).collect();
        let (re, im) = waves::coefficient(&wave, k);
        // sums of so many terms of size 3
        let rounding = 8.0 * count as f64 * f64::EPSILON;
        assert!((re - 0.25 * math::cos(0.3)).abs() < rounding, "{re}");
        assert!((im - 0.25 * math::sin(0.3)).abs() < rounding, "{im}");
        assert!((waves::coefficient(&wave, 0.0).0 - 3.0).abs() < rounding);
    }
}

fn cases() -> Vec<(Model, f64)> {
    let algebraic = |strength: f64, relative: f64, power: f64, widening: f64| {
        let law = Algebraic { mu: strength, delta: relative, q: power, a_v: widening, epsilon: 0.1, v0: 3.0 };
        (Model::Algebraic(law), 200.0 / 67.0 + 6.0 * widening)
    };
    let exponential = |strength: f64, contact: f64, widening: f64| {
        let law = Exponential { a: strength, b: 1.5, c: contact, a_v: widening, epsilon: 0.1, v0: 3.0 };
        (Model::Exponential(law), 200.0 / 57.0 + 6.0 * widening)
    };
    let logarithmic = |desired_speed: f64, widening: f64| {
        (Model::Logarithmic(Logarithmic { v0: desired_speed, a_v: widening, epsilon: 0.01 }), 200.0 / 133.0)
    };
    vec![
        algebraic(0.45, 0.0, 2.0, 0.0),
        algebraic(0.55, 0.0, 2.0, 0.0),
        algebraic(0.5, 1.0, 1.0, 0.1),
        algebraic(0.9, 0.3, 2.5, 0.1),
        exponential(1.5, 0.0, 0.0),
        exponential(3.0, 0.0, 0.0),
        exponential(4.0, 1.0, 0.2),
        logarithmic(1.0, 0.0),
        logarithmic(0.5, 0.0),
        logarithmic(1.0, 0.3),
        logarithmic(3.0, 0.1),
    ]
}

#[test]
fn waves_grow_and_travel_as_the_linear_theory_says() {
    let (mut worst, mut growing, mut decaying) = ((0.0_f64, 0.0_f64), 0, 0);
    for (model, headway) in cases() {
        let ring = Ring { pedestrians: 48, length: 48.0 * headway };
        for l in [1, 2, 5, 12, 23] {
            let (growth, frequency) = errors(&model, ring, l);
            let speed = steady_speed(&model, headway).expect("there is room");
            let rate = model.linearise(headway, speed).growth_rate(2.0 * PI * l as f64 / 48.0);
            println!("{} l = {l}: rate {rate:.4e}, errors {growth:.1e}, {frequency:.1e}", model.name());
            // a tolerance of 1e-14 at each of some hundred steps
            assert!(growth.abs() < 1e-11 && frequency.abs() < 1e-11, "{model:?} l = {l}: {growth:e}, {frequency:e}");
            worst = (math::larger(worst.0, growth.abs()), math::larger(worst.1, frequency.abs()));
            growing += u32::from(rate > 0.0);
            decaying += u32::from(rate < 0.0);
        }
    }
    println!("largest relative errors: growth {:e}, frequency {:e}", worst.0, worst.1);
    println!("{growing} growing, {decaying} decaying waves");
    assert!(growing > 15 && decaying > 15);
}

#[test]
fn a_band_of_growing_waves_narrower_than_the_grid_is_found() {
    // kappa (V(s) - v) with V' = 1: waves with kappa < 2 cos^2(k / 2) grow, up to sin(k / 2) = sqrt(1 - kappa / 2)
    for kappa in [1.0, 1.9, 1.999_99, 1.999_999_9] {
        let response = Response { spacings: vec![(0, kappa)], speeds: vec![(0, -kappa)] };
        let edge = (1.0 - 0.5 * kappa).sqrt();
        let [(least, largest)] = response.growing_bands()[..] else {
            panic!("{kappa}: {:?}", response.growing_bands())
        };
        let ratio = math::sin(0.5 * largest) / edge;
        assert!(least == 0.0 && (ratio - 1.0).abs() < 1e-6, "{kappa}: {least} {largest}, {ratio}");
    }
}

#[test]
fn two_bands_of_growing_waves_are_two() {
    // 1.9 (V(s) - v) + 0.6 (v_2 - 2 v_1 + v), V' = 1
    let response = Response { spacings: vec![(0, 1.9)], speeds: vec![(0, -1.3), (1, -1.2), (2, 0.6)] };
    let bands = response.growing_bands();
    let [(0.0, long), (short, std::f64::consts::PI)] = bands[..] else { panic!("{bands:?}") };
    assert!(long < short, "{bands:?}");
    for (edge, outward) in [(long, 1e-6), (short, -1e-6)] {
        let [decays, grows] = [edge + outward, edge - outward].map(|k| response.growth_rate(k));
        assert!(decays < 0.0 && grows > 0.0, "{edge}: {decays} {grows}");
    }
    assert_eq!(response.growing(), Some((0.0, std::f64::consts::PI)));
}
