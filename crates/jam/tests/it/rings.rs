//! The long-wave margin of random laws against every wave of a ring.

use crate::sample::{Random, algebraic, exponential, logarithmic};
use jam::laws::Model;
use jam::stability::Linear;
use jam::uniform::steady_speed;

/// A wave so long that only laws next to the threshold tell it from `k -> 0`.
const LONG: f64 = 1e-3;

/// A random law about a random uniform flow; which law goes round with `i`.
fn random_linear(i: usize, random: &mut Random) -> Linear {
    match i % 3 {
        0 => algebraic(random).linearise(random.uniform(0.2, 3.0)),
        1 => exponential(random).linearise(random.uniform(0.0, 3.0)),
        _ => {
            let law = logarithmic(random);
            let headway = random.uniform(0.3, 3.0);
            let speed = steady_speed(&Model::Logarithmic(law), headway).expect("the force is finite");
            law.linearise(headway, speed)
        }
    }
}

/// How much smaller than the long-wave margin that of the wave [`LONG`] can be: they differ by
/// `(1 - cos k) (phi - (1 + 2 kappa) (beta - kappa))`, and `1 - cos k <= k^2 / 2`.
fn blur(linear: &Linear) -> f64 {
    0.5 * LONG * LONG * (linear.phi + (1.0 + 2.0 * linear.kappa) * (linear.beta + linear.kappa))
}

#[test]
fn the_criterion_holds_for_every_wave_of_a_ring() {
    let mut random = Random(30);
    let (mut stable, mut unstable, mut open) = ([0; 3], [0; 3], 0);
    for i in 0..100_000 {
        let linear = random_linear(i, &mut random);
        let count = 3 + (random.bits() % 198) as usize;
        let margin = linear.long_wave_margin();
        if margin <= 0.0 {
            let (rate, l) = linear.fastest(count);
            assert!(rate < 0.0, "{linear:?}: margin {margin}, but wave {l} of {count} grows at {rate:e}");
            stable[i % 3] += 1;
        } else if margin > blur(&linear) {
            let rate = linear.growth_rate(LONG);
            assert!(rate > 0.0, "{linear:?}: margin {margin}, but k = {LONG} decays at {rate:e}");
            unstable[i % 3] += 1;
        } else {
            open += 1;
        }
    }
    println!("stable {stable:?}, unstable {unstable:?}, too close to tell {open}");
    assert!(stable.iter().chain(&unstable).all(|&laws| laws > 2_000), "{stable:?} {unstable:?}");
    // a band of 1e-6 about the threshold
    assert!(open < 10, "{open}");
}
