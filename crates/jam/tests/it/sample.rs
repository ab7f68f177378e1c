//! Reproducible random numbers, and random laws with every combination of terms.

#[path = "../../../math/src/random.rs"]
mod random;

use jam::force::Flow;
use jam::laws::{Algebraic, Exponential, Logarithmic, Model};

pub use random::Random;

impl Random {
    /// A number between the two, all equally likely.
    pub fn uniform(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * ((self.bits() >> 11) as f64 / (1u64 << 53) as f64)
    }

    /// Zero or a number between the two.
    pub fn perhaps(&mut self, low: f64, high: f64) -> f64 {
        if self.bits() & 1 == 0 { 0.0 } else { self.uniform(low, high) }
    }

    /// `10^x` with `x` between the two.
    pub fn magnitude(&mut self, low: f64, high: f64) -> f64 {
        math::pow(10.0, self.uniform(low, high))
    }
}

/// Every variant of the algebraic law: with and without each term, `q` = 1, 2, 3 and another.
pub fn algebraic(random: &mut Random) -> Algebraic {
    let power = [1.0, 2.0, 3.0, random.uniform(0.5, 3.5)][(random.bits() % 4) as usize];
    Algebraic {
        mu: random.uniform(0.1, 1.5),
        delta: random.perhaps(0.2, 2.0),
        q: power,
        a_v: random.perhaps(0.05, 0.4),
        epsilon: random.uniform(0.05, 0.5),
        v0: random.uniform(0.5, 3.0),
    }
}

/// Every variant of the exponential law.
pub fn exponential(random: &mut Random) -> Exponential {
    Exponential {
        a: random.uniform(0.5, 8.0),
        b: random.uniform(0.3, 4.0),
        c: random.perhaps(0.5, 10.0),
        a_v: random.perhaps(0.05, 0.4),
        epsilon: random.uniform(0.05, 0.5),
        v0: random.uniform(0.5, 3.0),
    }
}

/// Both variants of the logarithmic law.
pub fn logarithmic(random: &mut Random) -> Logarithmic {
    Logarithmic { v0: random.uniform(0.5, 3.0), a_v: random.perhaps(0.05, 0.4), epsilon: random.magnitude(-2.0, -0.5) }
}

/// Laws of each kind with every combination of terms, the rest at random: one of each.
pub fn variants(random: &mut Random) -> Vec<Model> {
    let mut all = Vec::new();
    for widening in [0.0, random.uniform(0.05, 0.4)] {
        for relative in [0.0, random.uniform(0.2, 2.0)] {
            for power in [1.0, 2.0, 3.0, random.uniform(0.5, 3.5)] {
                all.push(Model::Algebraic(Algebraic { delta: relative, a_v: widening, q: power, ..algebraic(random) }));
            }
        }
        for contact in [0.0, random.uniform(0.5, 10.0)] {
            all.push(Model::Exponential(Exponential { c: contact, a_v: widening, ..exponential(random) }));
        }
        all.push(Model::Logarithmic(Logarithmic { a_v: widening, ..logarithmic(random) }));
    }
    all
}

/// One law of each kind.
pub fn laws(random: &mut Random) -> [Model; 3] {
    [
        Model::Algebraic(algebraic(random)),
        Model::Exponential(exponential(random)),
        Model::Logarithmic(logarithmic(random)),
    ]
}

/// A law of each kind with the paper's parameters, all unstable at [`HEADWAYS`].
pub fn paper_laws() -> [Model; 3] {
    [
        Model::Algebraic(Algebraic { mu: 0.55, delta: 0.0, q: 2.0, a_v: 0.0, epsilon: 0.1, v0: 3.0 }),
        Model::Exponential(Exponential { a: 3.0, b: 1.5, c: 0.0, a_v: 0.0, epsilon: 0.1, v0: 3.0 }),
        Model::Logarithmic(Logarithmic { v0: 1.0, a_v: 0.0, epsilon: 0.01 }),
    ]
}

/// Headways that go with [`paper_laws`].
pub const HEADWAYS: [f64; 3] = [200.0 / 67.0, 200.0 / 57.0, 200.0 / 133.0];

/// The acceleration as a difference from that of the uniform flow with this gap and speed, for deviations of gap, own
/// speed and speed ahead.
pub fn deviation(model: &Model, gap: f64, speed: f64, from: [f64; 3]) -> f64 {
    let flow = Flow { net_gap: gap - model.contact(), speed };
    let mut accelerations = [0.0; 2];
    model.force().deviations(flow, &[from[0], 0.0], &[from[1], from[2]], &mut accelerations);
    accelerations[0]
}
