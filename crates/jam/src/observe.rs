//! Numbers that the figures draw.

use math::simd::{Kernel, dispatch};

/// The standard deviation over the pedestrians (at least one), in the unit of the values, divided by `N` (not `N - 1`): the mean first, then the squares of what
/// is left; 0 of numbers that are all equal. Sums run in eight lanes, `n` modulo 8, which are then added in pairs: one fixed order for any vector width.
pub fn spread(values: &[f64]) -> f64 {
    // the mean of equal numbers is rounded
    if values.iter().all(|value| *value == values[0]) {
        return 0.0;
    }
    let count = values.len() as f64;
    let mean = dispatch(Sum { values, map: |value| value }) / count;
    let squares = |scale: f64| {
        let map = |value| {
            let rest = scale * (value - mean);
            rest * rest
        };
        (dispatch(Sum { values, map }) / count).sqrt() / scale
    };
    match squares(1.0) {
        // squares of tiny or huge numbers are no longer doubles, or not with all digits: powers of 2 cost none
        spread if spread < TINY => squares(UP),
        spread if spread > HUGE => squares(DOWN),
        spread => spread,
    }
}

/// 2^600 and 2^-600.
const UP: f64 = f64::from_bits((1023 + 600) << 52);
const DOWN: f64 = f64::from_bits((1023 - 600) << 52);
/// The square of less has lost digits.
const TINY: f64 = 1e-130;
/// The square of more may be too large.
const HUGE: f64 = 1e130;

/// Number of running sums.
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
        let mut last = [0.0; LANES];
        last[..rest.len()].copy_from_slice(rest);
        for (lane, (sum, value)) in sums.iter_mut().zip(last).enumerate() {
            let next = *sum + (self.map)(value);
            *sum = if lane < rest.len() { next } else { *sum };
        }
        let [a, b, c, d, e, f, g, h] = sums;
        ((a + b) + (c + d)) + ((e + f) + (g + h))
    }
}
