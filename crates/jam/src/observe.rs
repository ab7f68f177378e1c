//! The quantities that the figures draw.

use math::simd::{Kernel, dispatch};

/// The standard deviation over the pedestrians (at least one), in the unit of the values, divided by `N` (not `N - 1`):
/// first the mean, then the squares of the differences from it; 0 for equal numbers. Sums run in eight lanes, `n`
/// modulo 8, which are then added in pairs, so the order is the same for any vector width.
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
        let (whole, rest) = values.as_chunks::<LANES>();
        let (count, last) = (values.len() as f64, filled_up(values));
        let counts = &COUNTS[LANES - rest.len()..][..LANES];
        let mut sums = [0.0; LANES];
        for chunk in whole {
            for lane in 0..LANES {
                sums[lane] += chunk[lane];
            }
        }
        for lane in 0..LANES {
            sums[lane] += f64::from_bits(last[lane].to_bits() & counts[lane]);
        }
        let mean = in_pairs(sums) / count;
        let square = |value: f64| {
            let rest = if SCALED { scale * (value - mean) } else { value - mean };
            rest * rest
        };
        let mut sums = [0.0; LANES];
        for chunk in whole {
            for lane in 0..LANES {
                sums[lane] += square(chunk[lane]);
            }
        }
        for lane in 0..LANES {
            sums[lane] += f64::from_bits(square(last[lane]).to_bits() & counts[lane]);
        }
        let spread = (in_pairs(sums) / count).sqrt();
        if SCALED { spread / scale } else { spread }
    }
}

/// From its place `LANES - n` on, all bits for `n` lanes and none for the others. A sum that begins at 0 is never -0:
/// to add 0 to it changes nothing.
const COUNTS: [u64; 2 * LANES] = {
    let mut counts = [0; 2 * LANES];
    let mut lane = 0;
    while lane < LANES {
        counts[lane] = u64::MAX;
        lane += 1;
    }
    counts
};

/// What is left behind whole chunks; then the last value, so that no length is unknown.
#[inline(always)]
fn filled_up(values: &[f64]) -> [f64; LANES] {
    let (end, whole) = (values.len() - 1, values.len() / LANES * LANES);
    let mut last = [0.0; LANES];
    for (lane, place) in last.iter_mut().enumerate() {
        let index = whole + lane;
        *place = values[if index < end { index } else { end }];
    }
    last
}

/// The sum of all lanes.
#[inline(always)]
fn in_pairs([a, b, c, d, e, f, g, h]: [f64; LANES]) -> f64 {
    ((a + b) + (c + d)) + ((e + f) + (g + h))
}
