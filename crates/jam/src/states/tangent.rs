//! The linearised equations where the force depends on a pedestrian's own spacing and speed alone: `du_n/dt = w_{n+1} -
//! w_n`, `dw_n/dt = phi_n u_n - w_n`, with the slopes `phi_n` of the acceleration along the solution.
//!
//! The difference is carried by its series in time, in single precision: two digits are asked for.

use math::lane;
use math::simd::{Kernel, dispatch};
use ode::Tangent;

/// The middle of the eigenvalues: for equal slopes, those of a wave add up to -1. Without the fading that all have in common
/// series need fewer orders.
const FADING: f64 = -0.5;

/// About how far from their middle eigenvalues `z` lie at most: that of the relaxation, or, for the steepest slope `phi`,
/// those of its shortest waves, for which `(z + 1/2)^2 = 1/4 - 2 phi`. Slopes are not equal; a tenth is added for that.
pub(super) fn fastest(slopes: &[f64]) -> f64 {
    let shortest = 2.0 * ode::largest(slopes) - FADING * FADING;
    1.1 * math::larger(shortest, FADING * FADING).sqrt()
}

/// A series reaches at most so far, in units of the time in which differences move: terms of a longer one would cancel.
const LONGEST: f64 = 10.0;

/// Carries a difference of spacings and speeds; returns the way that the first one's speed adds.
pub(super) fn carry(tangent: Tangent<'_>, difference: &mut [f64]) -> f64 {
    let n = tangent.start.len();
    if n >= LANES {
        return dispatch(Carry { tangent, difference });
    }
    // of fewer than eight, what is repeated along a longer ring is the same
    let laps = LANES.div_ceil(n);
    let [start, end] = [tangent.start, tangent.end].map(|row| row.repeat(laps));
    let (spacings, speeds) = difference.split_at_mut(n);
    let mut longer = [spacings.repeat(laps), speeds.repeat(laps)].concat();
    let way = dispatch(Carry { tangent: Tangent { start: &start, end: &end, ..tangent }, difference: &mut longer });
    spacings.copy_from_slice(&longer[..n]);
    speeds.copy_from_slice(&longer[n * laps..][..n]);
    way
}

/// Numbers per iteration.
const LANES: usize = 8;
type Eight = [f32; LANES];

/// What is known of eight pedestrians: one row for each of the following. The last block begins earlier rather than be cut: what
/// is there twice is the same.
type Block = [Eight; ROWS];
const ROWS: usize = 7;
const SLOPE: usize = 0;
const GROWTH: usize = 1;
/// The term of the series made last.
const SPACING: usize = 2;
const SPEED: usize = 3;
/// That of spacings before it.
const EARLIER: usize = 4;
/// Sums of all terms.
const SPACINGS: usize = 5;
const SPEEDS: usize = 6;

/// A term of the series that is smaller than this part of the sum ends it: an error is asked to a factor of 3.
const REST: f32 = 1e-2;

/// The same where slopes change: who is thrown back by a wall goes on with a small difference of what came.
const REST_IF_GROWS: f32 = 1e-3;

/// Smaller differences are carried in this unit.
const LEAST: f64 = 1e-290;

struct Carry<'a> {
    tangent: Tangent<'a>,
    difference: &'a mut [f64],
}

impl Kernel for Carry<'_> {
    type Output = f64;

    #[inline(always)]
    fn run(self) -> f64 {
        if self.tangent.end.is_empty() { self.along::<false>() } else { self.along::<true>() }
    }
}

impl Carry<'_> {
    /// Carries piece by piece, along which slopes change if it `GROWS`.
    #[inline(always)]
    fn along<const GROWS: bool>(self) -> f64 {
        let Carry { tangent: Tangent { start, end, length, fastest, room }, difference } = self;
        let pieces = math::larger((fastest * length / LONGEST).ceil(), 1.0);
        let unit = length / pieces;
        let (turns, left) = ((fastest * unit) as f32, lane::exp(FADING * unit));
        let n = start.len();
        room.resize(n.div_ceil(LANES) * ROWS * LANES, 0.0);
        let blocks = room.as_chunks_mut::<LANES>().0.as_chunks_mut::<ROWS>().0;
        fill(blocks, [SLOPE], start, unit * unit);
        if GROWS {
            fill_growth(blocks, [start, end], unit * unit / pieces);
        }
        let (spacings, speeds) = difference.split_at_mut(n);
        let mut way = 0.0;
        for piece in 0..pieces as usize {
            let size = math::larger(largest(spacings), largest(speeds) * unit);
            if size == 0.0 {
                break;
            }
            if GROWS && piece > 0 {
                for block in &mut *blocks {
                    let [slope, growth, ..] = block;
                    slope.iter_mut().zip(growth).for_each(|(slope, growth)| *slope += *growth);
                }
            }
            // in units of the largest; the least doubles have no inverse
            let size = math::larger(size, LEAST);
            fill(blocks, [SPACING, SPACINGS], spacings, 1.0 / size);
            fill(blocks, [SPEED, SPEEDS], speeds, unit / size);
            let moved = sum::<GROWS>(blocks, n, unit, turns);
            let size = left * size;
            spill(blocks, SPACINGS, spacings, size);
            spill(blocks, SPEEDS, speeds, size / unit);
            way += f64::from(moved) * size;
        }
        way
    }
}

/// Sums the series, in units of a piece for time; returns that of the way of the first one.
#[inline(always)]
fn sum<const GROWS: bool>(blocks: &mut [Block], n: usize, unit: f64, turns: f32) -> f32 {
    if GROWS {
        blocks.iter_mut().for_each(|block| block[EARLIER] = [0.0; LANES]);
    }
    let (half, new) = ((-FADING * unit) as f32, blocks.len() * LANES - n);
    let (mut moved, mut way, mut order, mut least) = (0.0, 0.0, 0.0, f32::INFINITY);
    while order < MOST_TERMS {
        order += 1.0;
        let share = 1.0 / order;
        moved = (blocks[0][SPEED][0] + half * moved) * share;
        way += moved;
        next_term::<GROWS>(blocks, new, [half, share]);
        if order >= FIRST_LOOK * turns {
            if least.is_infinite() {
                least = if GROWS { REST_IF_GROWS } else { REST } * size(blocks, [SPACINGS, SPEEDS]);
            }
            if size(blocks, [SPACING, SPEED]) <= least {
                break;
            }
        }
    }
    way
}

/// Makes the next term of the series and adds it to the sums. From the last block to the first: a block needs the speed of
/// the first one in the block ahead, which in the last block is the first new one.
#[inline(always)]
fn next_term<const GROWS: bool>(blocks: &mut [Block], new: usize, factors: [f32; 2]) {
    let ahead = blocks[0][SPEED][0];
    let Some((last, others)) = blocks.split_last_mut() else { return };
    let mut following = last[SPEED][new % LANES];
    advance::<GROWS>(last, ahead, factors);
    for block in others.iter_mut().rev() {
        let ahead = following;
        following = block[SPEED][0];
        advance::<GROWS>(block, ahead, factors);
    }
}

/// The eight of a block, of at least eight numbers.
#[inline(always)]
fn eight(numbers: &[f64], index: usize) -> [f64; LANES] {
    let mut eight = [0.0; LANES];
    eight.copy_from_slice(&numbers[(index * LANES).min(numbers.len() - LANES)..][..LANES]);
    eight
}

/// Stores numbers, multiplied by a factor, in single precision.
#[inline(always)]
fn fill<const COPIES: usize>(blocks: &mut [Block], rows: [usize; COPIES], numbers: &[f64], factor: f64) {
    for (index, block) in blocks.iter_mut().enumerate() {
        let eight = eight(numbers, index).map(|number| (number * factor) as f32);
        for row in rows {
            block[row] = eight;
        }
    }
}

/// Stores by how much slopes grow in a piece.
#[inline(always)]
fn fill_growth(blocks: &mut [Block], [start, end]: [&[f64]; 2], factor: f64) {
    for (index, block) in blocks.iter_mut().enumerate() {
        let (start, mut end) = (eight(start, index), eight(end, index));
        for i in 0..LANES {
            end[i] -= start[i];
        }
        block[GROWTH] = end.map(|growth| (growth * factor) as f32);
    }
}

/// Does the opposite of [`fill`].
#[inline(always)]
fn spill(blocks: &[Block], row: usize, numbers: &mut [f64], factor: f64) {
    let most = numbers.len() - LANES;
    for (index, block) in blocks.iter().enumerate() {
        let eight = block[row].map(|own| f64::from(own) * factor);
        numbers[(index * LANES).min(most)..][..LANES].copy_from_slice(&eight);
    }
}

/// The largest absolute value of at least eight; NaN counts for nothing.
#[inline(always)]
fn largest(numbers: &[f64]) -> f64 {
    let mut most = [0.0; LANES];
    for index in 0..numbers.len().div_ceil(LANES) {
        let eight = eight(numbers, index);
        for i in 0..LANES {
            let size = eight[i].abs();
            most[i] = if size > most[i] { size } else { most[i] };
        }
    }
    most.into_iter().fold(0.0, |most, one| if one > most { one } else { most })
}

/// Terms grow up to the order that `turns` is, and are looked at from this multiple of it on.
const FIRST_LOOK: f32 = 1.5;

/// More terms than any finite series over a piece needs.
const MOST_TERMS: f32 = 100.0;

/// Makes the next term of eight pedestrians; the speed ahead of the last of them is given.
#[inline(always)]
fn advance<const GROWS: bool>(block: &mut Block, ahead_of_last: f32, [half, share]: [f32; 2]) {
    // borrowed, not copied: the compiler would load copies in halves
    let [slope, growth, spacing, speed, earlier, spacings, speeds] = block;
    let ahead = [speed[1], speed[2], speed[3], speed[4], speed[5], speed[6], speed[7], ahead_of_last];
    let [mut closing, mut pushed, mut closed, mut gained] = [[0.0; LANES]; 4];
    for i in 0..LANES {
        closing[i] = ((ahead[i] - speed[i]) + half * spacing[i]) * share;
        let push = slope[i] * spacing[i] - half * speed[i];
        pushed[i] = if GROWS { push + growth[i] * earlier[i] } else { push } * share;
        closed[i] = spacings[i] + closing[i];
        gained[i] = speeds[i] + pushed[i];
    }
    if GROWS {
        *earlier = *spacing;
    }
    (*spacing, *speed, *spacings, *speeds) = (closing, pushed, closed, gained);
}

/// The largest sum of two rows' absolute values.
#[inline(always)]
fn size(blocks: &[Block], [one, other]: [usize; 2]) -> f32 {
    let mut most = [0.0; LANES];
    for block in blocks {
        for i in 0..LANES {
            most[i] = larger(most[i], block[one][i].abs() + block[other][i].abs());
        }
    }
    most.into_iter().fold(0.0, larger)
}

#[inline(always)]
fn larger(one: f32, other: f32) -> f32 {
    if other > one { other } else { one }
}

/// Takes their mean from numbers.
pub(super) struct Centred<'a>(pub(super) &'a mut [f64]);

impl Kernel for Centred<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let mut sums = [0.0; LANES];
        let (blocks, rest) = self.0.as_chunks::<LANES>();
        for block in blocks {
            for (sum, number) in sums.iter_mut().zip(block) {
                *sum += number;
            }
        }
        for (sum, number) in sums.iter_mut().zip(rest) {
            *sum += number;
        }
        let mean = sums.iter().sum::<f64>() / self.0.len() as f64;
        self.0.iter_mut().for_each(|number| *number -= mean);
    }
}
