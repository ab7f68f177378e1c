//! The two implementations of the laws agree to rounding.

use jam::laws::{Algebraic, Exponential, Logarithmic, Model};
use math::double_double::{DoubleDouble, decimal};
use reference::scenes::{NAMES, Parameters, scene};

/// The same law in double precision, parameters as the figures' scene files have them.
fn model(name: &str) -> Model {
    let desired_speed = 3.0;
    let algebraic = |strength| {
        Model::Algebraic(Algebraic { mu: strength, delta: 0.0, q: 2.0, a_v: 0.0, epsilon: 0.1, v0: desired_speed })
    };
    let exponential = |strength| {
        Model::Exponential(Exponential { a: strength, b: 1.5, c: 0.0, a_v: 0.0, epsilon: 0.1, v0: desired_speed })
    };
    match name {
        "algebraic_stable" => algebraic(0.45),
        "algebraic_unstable" => algebraic(0.55),
        "exponential_stable" => exponential(1.5),
        "exponential_unstable" => exponential(3.0),
        _ => Model::Logarithmic(Logarithmic { v0: 1.0, a_v: 0.0, epsilon: 0.01 }),
    }
}

#[test]
fn accelerations_are_those_of_jam_to_rounding() {
    for name in NAMES {
        let (scene, model) = (scene(name, Parameters::Doubles).expect("a scene"), model(name));
        let (ring, n) = (scene.ring, scene.ring.pedestrians);
        let mut state = vec![DoubleDouble::ZERO; ring.dimension()];
        for i in 0..n {
            // gaps from near contact to far, speeds of both signs
            let gap = 2.125 + 0.0625 * i as f64;
            state[i] = DoubleDouble::from(if ring.law.contact() == 0.0 { gap - 1.5 } else { gap - 2.0 });
            state[n + i] = DoubleDouble::from(1.0 - i as f64 / 32.0);
        }
        let mut rates = state.clone();
        ring.rates(&state, &mut rates);
        for i in 0..n {
            let (gap, speed) = (state[i].hi + ring.law.contact(), state[n + i].hi);
            let expected = model.acceleration(gap, speed, state[n + (i + 1) % n].hi);
            // in doubles at most eight roundings of half a unit of the largest term, half of them in a function of two
            // units
            let largest = math::larger(math::larger(expected.abs(), speed.abs()), 3.0);
            let allowed = 8.0 * f64::EPSILON * largest;
            assert!((rates[n + i] - expected).hi.abs() <= allowed, "{name}, {i}: {} for {expected}", rates[n + i].hi);
        }
    }
}

#[test]
fn accelerations_are_those_of_the_formulas_to_30_digits() {
    // scene, gap, acceleration at the speed 1/2 (`laws.py`)
    let table = [
        ("algebraic_unstable", 2.75, "1.962222222222222135378110073765529"),
        ("exponential_unstable", 2.75, "0.6804080208620997291886013950264586"),
        ("logarithmic", 0.75, "-0.2294434981736844094336116603607219"),
        ("logarithmic", 2.0625, "0.4992614274470694992658303432970979"),
        ("logarithmic", 1.96875, "0.4703266129463340293770422332706964"),
    ];
    for (name, gap, expected) in table {
        let ring = scene(name, Parameters::Doubles).expect("a scene").ring;
        let mut state = vec![DoubleDouble::from(0.5); ring.dimension()];
        state[..ring.pedestrians].fill(DoubleDouble::from(gap - ring.law.contact()));
        let mut rates = state.clone();
        ring.rates(&state, &mut rates);
        let error = (rates[ring.pedestrians] - decimal::parse(expected).expect("a number")).hi.abs();
        // functions have a relative error of 2^-100 or 8e-31, terms are below 3
        assert!(error < 5e-30, "{name} at the gap {gap}: error {error:e}");
    }
}

#[test]
fn parameters_are_the_doubles_or_the_decimals_of_the_scenes() {
    let shift = |name, parameters| scene(name, parameters).expect("a scene").shift;
    assert_eq!(shift("logarithmic", Parameters::Doubles), DoubleDouble::from(0.1));
    assert_eq!(shift("algebraic_stable", Parameters::Doubles), DoubleDouble::from(1e-4));
    let tenth = shift("logarithmic", Parameters::Decimals);
    assert!((tenth * 10.0 - 1.0).hi.abs() < 1e-31 && tenth.lo != 0.0, "{tenth:?}");
    assert_eq!(scene("no such", Parameters::Doubles), None);
}

#[test]
fn gaps_add_up_to_the_length_of_the_ring() {
    for name in NAMES {
        let scene = scene(name, Parameters::Doubles).expect("a scene");
        let n = scene.ring.pedestrians;
        let start = scene.ring.start(200.0, scene.shift);
        let sum = start[..n].iter().fold(DoubleDouble::ZERO, |sum, c| sum + *c + scene.ring.law.contact());
        // each of the 2N additions rounds a number below 200 at 2^-104
        assert!((sum - 200.0).hi.abs() < 2.0 * n as f64 * 200.0 * 5e-32, "{name}: {:e}", (sum - 200.0).hi);
    }
}
