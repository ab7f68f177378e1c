//! The quantities that the figures draw.

use math::simd::{Kernel, dispatch};

/// The standard deviation over the pedestrians (at least one), in the unit of the values, divided by `N` (not `N - 1`): first
/// the mean, then the squares of the differences from it; 0 for equal numbers. Sums run in eight lanes, `n` modulo 8, which are
/// then added in pairs, so the order is the same for any vector width.
pub fn speed_std(speeds: &[f64]) -> f64 {
    // the mean of equal numbers is rounded
    if speeds.iter().all(|speed| *speed == speeds[0]) {
        return 0.0;
    }
    let std = |scale: f64| dispatch(Std::<true> { values: speeds, scale });
    match dispatch(Std::<false> { values: speeds, scale: 1.0 }) {
        // squares of tiny or huge numbers are no longer doubles, or not with all digits: powers of 2 cost none
        found if found < TINY => std(UP),
        found if found > HUGE => std(DOWN),
        found => found,
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

/// The standard deviation, computed in units of `1 / scale`, which is 1 if it is not `SCALED`.
struct Std<'a, const SCALED: bool> {
    values: &'a [f64],
    scale: f64,
}

impl<const SCALED: bool> Kernel for Std<'_, SCALED> {
    type Output = f64;

    #[inline(always)]
    fn run(self) -> f64 {
        let Std { values, scale } = self;
        let count = values.len() as f64;
        let lanes = InLanes::new(values);
        let mean = lanes.sum(|value| value) / count;
        let squares = lanes.sum(|value| {
            let rest = if SCALED { scale * (value - mean) } else { value - mean };
            rest * rest
        });
        let spread = (squares / count).sqrt();
        if SCALED { spread / scale } else { spread }
    }
}

/// Numbers in eight lanes.
struct InLanes<'a> {
    whole: std::slice::ChunksExact<'a, f64>,
    /// What is left of them, filled up.
    last: [f64; LANES],
    /// How many are left.
    left: usize,
}

impl InLanes<'_> {
    #[inline(always)]
    fn new(values: &[f64]) -> InLanes<'_> {
        let (whole, mut last) = (values.chunks_exact(LANES), [0.0; LANES]);
        let left = whole.remainder().len();
        last[..left].copy_from_slice(whole.remainder());
        InLanes { whole, last, left }
    }

    /// The sum of `map` over them.
    #[inline(always)]
    fn sum(&self, map: impl Fn(f64) -> f64) -> f64 {
        let mut sums = [0.0; LANES];
        for chunk in self.whole.clone() {
            for (sum, value) in sums.iter_mut().zip(chunk) {
                *sum += map(*value);
            }
        }
        for (lane, (sum, value)) in sums.iter_mut().zip(self.last).enumerate() {
            let next = *sum + map(value);
            *sum = if lane < self.left { next } else { *sum };
        }
        let [a, b, c, d, e, f, g, h] = sums;
        ((a + b) + (c + d)) + ((e + f) + (g + h))
    }
}
