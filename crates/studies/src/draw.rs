//! Reproducible random numbers.

/// Knuth's linear congruential generator of 64 bits, from a fixed beginning.
#[derive(Clone, Debug)]
pub struct Draw {
    bits: u64,
}

impl Default for Draw {
    fn default() -> Draw {
        Draw { bits: 1 }
    }
}

impl Draw {
    /// The next number, evenly spread over [`low`, `high`).
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        self.bits = self.bits.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        // the upper 53 bits are the better ones, and as many as a double holds
        low + (high - low) * ((self.bits >> 11) as f64 / (1_u64 << 53) as f64)
    }
}
