//! Numbers that the figures draw.

use math::simd::{Kernel, dispatch};

/// The standard deviation over the pedestrians, divided by `N` (not `N - 1`): the mean first, then the squares of what
/// is left. Sums run in eight lanes, `n` modulo 8, which are then added in pairs: one fixed order for any vector width.
pub fn spread(values: &[f64]) -> f64 {
    let count = values.len() as f64;
    let mean = dispatch(Sum { values, map: |value| value }) / count;
    let squares = dispatch(Sum { values, map: |value| (value - mean) * (value - mean) });
    (squares / count).sqrt()
}

/// So many sums run at a time.
const LANES: usize = 8;

/// The sum of `map` over the values.
struct Sum<'a, F> {
    values: &'a [f64],
    map: F,
}

impl<F: Fn(f64) -> f64> Kernel for Sum<'_, F> {
    type Output = f64;

    #[inline(always)]
    fn run(self) -> f64 {
        let mut sums = [0.0; LANES];
        let chunks = self.values.chunks_exact(LANES);
        let rest = chunks.remainder();
        for chunk in chunks {
            for (sum, value) in sums.iter_mut().zip(chunk) {
                *sum += (self.map)(*value);
            }
        }
        for (sum, value) in sums.iter_mut().zip(rest) {
            *sum += (self.map)(*value);
        }
        let [a, b, c, d, e, f, g, h] = sums;
        ((a + b) + (c + d)) + ((e + f) + (g + h))
    }
}
