//! The laws, written twice, agree to the rounding of a double.

use jam::laws::{Algebraic, Exponential, Logarithmic, Model};
use math::twofold::Twofold;
use reference::scenes::{NAMES, Parameters, scene};

/// The same law in double precision, parameters as the figures' scene files have them.
fn model(name: &str) -> Model {
    let desired_speed = 3.0;
    let algebraic = |strength| {
        Model::Algebraic(Algebraic { strength, relative: 0.0, power: 2.0, widening: 0.0, epsilon: 0.1, desired_speed })
    };
    let exponential = |strength| {
        Model::Exponential(Exponential {
            strength,
            range: 1.5,
            contact: 0.0,
            widening: 0.0,
            epsilon: 0.1,
            desired_speed,
        })
    };
    match name {
        "algebraic_stable" => algebraic(0.45),
        "algebraic_unstable" => algebraic(0.55),
        "exponential_stable" => exponential(1.5),
        "exponential_unstable" => exponential(3.0),
        _ => Model::Logarithmic(Logarithmic { desired_speed: 1.0, widening: 0.0, epsilon: 0.01 }),
    }
}

#[test]
fn accelerations_are_those_of_jam_to_rounding() {
    for name in NAMES {
        let (scene, model) = (scene(name, Parameters::Doubles).expect("a scene"), model(name));
        let (ring, n) = (scene.ring, scene.ring.pedestrians);
        let mut state = vec![Twofold::ZERO; ring.dimension()];
        for i in 0..n {
            // gaps from near contact to far, speeds of both signs
            let gap = 2.125 + 0.0625 * i as f64;
            state[i] = Twofold::from(if ring.law.contact() == 0.0 { gap - 1.5 } else { gap - 2.0 });
            state[n + i] = Twofold::from(1.0 - i as f64 / 32.0);
        }
        let mut rates = state.clone();
        ring.rates(&state, &mut rates);
        for i in 0..n {
            let (gap, speed) = (state[i].hi + ring.law.contact(), state[n + i].hi);
            let expected = model.acceleration(gap, speed, state[n + (i + 1) % n].hi);
            // every term is below the force at contact or the drive; a few units in the last place of the largest, and of
            // exp(-x / eps), whose argument of up to 270 has a relative error of two units
            let largest = expected.abs().max(speed.abs()).max(3.0);
            let allowed = largest * (8.0 * f64::EPSILON + 2.0 * f64::EPSILON);
            assert!((rates[n + i] - expected).hi.abs() <= allowed, "{name}, {i}: {} for {expected}", rates[n + i].hi);
        }
    }
}

#[test]
fn parameters_are_the_doubles_or_the_decimals_of_the_scenes() {
    let shift = |name, parameters| scene(name, parameters).expect("a scene").shift;
    assert_eq!(shift("logarithmic", Parameters::Doubles), Twofold::from(0.1));
    assert_eq!(shift("algebraic_stable", Parameters::Doubles), Twofold::from(1e-4));
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
        let sum = start[..n].iter().fold(Twofold::ZERO, |sum, c| sum + *c + scene.ring.law.contact());
        // each of the 2N additions rounds a number below 200 at 2^-104
        assert!((sum - 200.0).hi.abs() < 2.0 * n as f64 * 200.0 * 5e-32, "{name}: {:e}", (sum - 200.0).hi);
    }
}
