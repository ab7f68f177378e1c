//! The minimum of several quantities over a step: at its end, or at an interior minimum of one of them.

/// Numbers at both ends of a step, with their rates.
pub(super) struct Ends<'a> {
    pub(super) before: (&'a [f64], &'a [f64]),
    pub(super) after: (&'a [f64], &'a [f64]),
    /// The length of the step.
    pub(super) h: f64,
}

use math::simd::{Kernel, dispatch};

/// The lowest number of a list; infinity of none.
pub(super) fn lowest(numbers: &[f64]) -> f64 {
    if numbers.len() < LANES { lower(numbers) } else { dispatch(Lowest(numbers)) }
}

fn lower(numbers: &[f64]) -> f64 {
    numbers.iter().fold(f64::INFINITY, |least, &next| if next < least { next } else { least })
}

/// The highest.
pub(super) fn highest(numbers: &[f64]) -> f64 {
    dispatch(Highest(numbers))
}

/// Numbers per iteration: one after another, each would wait for the one before.
const LANES: usize = 16;

struct Lowest<'a>(&'a [f64]);

impl Kernel for Lowest<'_> {
    type Output = f64;

    #[inline(always)]
    fn run(self) -> f64 {
        let mut least = [f64::INFINITY; LANES];
        let chunks = self.0.chunks_exact(LANES);
        let rest = lower(chunks.remainder());
        for chunk in chunks {
            for (least, &next) in least.iter_mut().zip(chunk) {
                *least = if next < *least { next } else { *least };
            }
        }
        lower(&[lower(&least), rest])
    }
}

struct Highest<'a>(&'a [f64]);

impl Kernel for Highest<'_> {
    type Output = f64;

    #[inline(always)]
    fn run(self) -> f64 {
        let upper = |numbers: &[f64]| {
            numbers.iter().fold(f64::NEG_INFINITY, |most, &next| if next > most { next } else { most })
        };
        let mut most = [f64::NEG_INFINITY; LANES];
        let chunks = self.0.chunks_exact(LANES);
        let rest = upper(chunks.remainder());
        for chunk in chunks {
            for (most, &next) in most.iter_mut().zip(chunk) {
                *most = if next > *most { next } else { *most };
            }
        }
        upper(&[upper(&most), rest])
    }
}

impl Ends<'_> {
    /// The fraction of the step at which the cubic through both ends of one of the numbers has a minimum below
    /// `record`: the deepest of all. Numbers that dip within fall at the start and rise at the end.
    pub(super) fn dip(&self, record: f64) -> Option<f64> {
        let starts = self.before.0.iter().zip(self.before.1);
        let ends = self.after.0.iter().zip(self.after.1);
        let mut deepest = (record, None);
        for ((&start, &leaving), (&end, &arriving)) in starts.zip(ends) {
            if !(leaving < 0.0 && arriving > 0.0) {
                continue;
            }
            let (fall, rise) = (self.h * leaving, self.h * arriving);
            // no cubic of these slopes goes lower than the meeting of its end tangents
            let lower = if start + fall < end - rise { start + fall } else { end - rise };
            if lower >= deepest.0 {
                continue;
            }
            let theta = minimum(start, fall, end, rise);
            let value = hermite(start, fall, end, rise, theta);
            if value < deepest.0 {
                deepest = (value, Some(theta));
            }
        }
        deepest.1
    }
}

/// The cubic with these values and slopes at 0 and 1.
fn hermite(start: f64, leaving: f64, end: f64, arriving: f64, theta: f64) -> f64 {
    let change = end - start;
    let (bend, other) = (leaving - change, change - arriving);
    start + theta * (change + (1.0 - theta) * ((1.0 - theta) * bend + theta * other))
}

/// Where that cubic, falling at 0 and rising at 1, has its minimum: the root of a quadratic slope.
fn minimum(start: f64, leaving: f64, end: f64, arriving: f64) -> f64 {
    // slope: leaving + 2 b theta + 3 a theta^2
    let change = end - start;
    let a = leaving + arriving - 2.0 * change;
    let b = 3.0 * change - 2.0 * leaving - arriving;
    let root = (b * b - 3.0 * a * leaving).sqrt();
    let theta = -leaving / (b + root);
    if theta > 0.0 && theta < 1.0 { theta } else { 0.5 }
}

#[cfg(test)]
mod tests {
    use super::{Ends, lowest};

    #[test]
    fn a_dip_within_a_step_is_found_where_it_is_deepest() {
        // (t - 0.3)^2 and (t - 0.6)^2 - 0.5 over a step of length 1, and one that does not dip
        let before = (&[0.09, -0.14, 1.0][..], &[-0.6, -1.2, 1.0][..]);
        let after = (&[0.49, -0.34, 2.0][..], &[1.4, 0.8, 1.0][..]);
        let ends = Ends { before, after, h: 1.0 };
        let theta = ends.dip(lowest(after.0)).expect("a dip");
        assert!((theta - 0.6).abs() < 1e-12, "{theta}");
        assert_eq!(ends.dip(-0.6), None, "lower before");
    }
}
