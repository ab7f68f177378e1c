//! Reproducible random numbers.

#[path = "../../../../crates/math/src/random.rs"]
mod splitmix;

pub use splitmix::Random;

impl Random {
    /// From 0 to `bound - 1`.
    pub fn below(&mut self, bound: usize) -> usize {
        (self.bits() % bound.max(1) as u64) as usize
    }

    /// From 0 to 1.
    pub fn part(&mut self) -> f64 {
        self.bits() as f64 / u64::MAX as f64
    }
}
