//! Random numbers that depend on the seed alone.

/// A generator of what scenes are drawn from.
#[derive(Clone, Debug)]
pub struct Random(math::random::Random);

impl Random {
    /// The generator of this seed.
    pub fn new(seed: u64) -> Random {
        Random(math::random::Random(seed))
    }

    /// Between these two.
    pub fn between(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * ((self.0.bits() >> 11) as f64 / (1_u64 << 53) as f64)
    }

    /// A power of ten, the exponent between these two.
    pub fn decades(&mut self, from: f64, to: f64) -> f64 {
        math::pow(10.0, self.between(from, to))
    }

    /// True with this probability.
    pub fn chance(&mut self, probability: f64) -> bool {
        self.between(0.0, 1.0) < probability
    }

    /// One of these.
    pub fn pick<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[(self.0.bits() % choices.len() as u64) as usize]
    }
}
