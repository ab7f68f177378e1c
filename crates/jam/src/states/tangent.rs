//! The linearised equations of a ring: `du_n/dt = w_{n+1} - w_n`, `dw_n/dt = phi_n u_n - a_n w_n + c_n w_{n+1}`, with the
//! slopes of the acceleration by the own spacing, the own speed and that ahead, along the solution. Where the force depends on
//! the own spacing alone, `a_n = 1` and `c_n = 0`, and only the first ones are kept.
//!
//! The difference is carried by its series in time, in single precision: two digits are asked for.

use crate::force::{Dependence, Flow, Force, Rows};
use math::lane;
use math::simd::{Kernel, dispatch};
use ode::Tangent;

/// The middle of the eigenvalues where the force depends on the spacing alone: for equal slopes, those of a wave add up to -1.
/// Without the fading that all have in common series need fewer orders.
const FADING: f64 = -0.5;

/// About how far from their middle eigenvalues `z` lie at most: that of the relaxation, or, for the steepest slope `phi`,
/// those of its shortest waves, for which `(z + 1/2)^2 = 1/4 - 2 phi`. Slopes are not equal; a tenth is added for that.
fn fastest(slopes: &[f64]) -> f64 {
    let shortest = 2.0 * ode::largest(slopes) - FADING * FADING;
    1.1 * math::larger(shortest, FADING * FADING).sqrt()
}

/// How many coefficients the linearised equations of so many pedestrians have: the rows of slopes, and behind three rows the
/// middle of the eigenvalues.
pub(super) fn size(force: &dyn Force, pedestrians: usize) -> usize {
    match force.dependence() {
        Dependence::Spacing => pedestrians,
        Dependence::Speeds => 3 * pedestrians + 1,
        Dependence::Unknown => 0,
    }
}

/// Writes them, and returns how fast the fastest difference moves: the largest distance of an eigenvalue from the middle, and
/// NaN where a slope has no value.
pub(super) fn write(force: &dyn Force, flow: Flow, now: Rows<'_>, tangent: &mut [f64]) -> f64 {
    let n = now.spacings.len();
    if tangent.len() == n {
        force.slopes(flow, now, tangent);
        return fastest(tangent);
    }
    let (slopes, middle) = tangent.split_at_mut(3 * n);
    force.slopes(flow, now, slopes);
    let (by_spacing, by_speeds) = slopes.split_at(n);
    let (own, ahead) = by_speeds.split_at(n);
    let fading = dispatch(Middle { own });
    middle[0] = fading;
    dispatch(Farthest { by_spacing, own, ahead, fading })
}

/// The middle of the eigenvalues of all pedestrians by themselves, which are 0 and the slopes by their own speeds.
struct Middle<'a> {
    own: &'a [f64],
}

impl Kernel for Middle<'_> {
    type Output = f64;

    #[inline(always)]
    fn run(self) -> f64 {
        let mut least = [0.0; LANES];
        let (eights, rest) = self.own.as_chunks::<LANES>();
        for eight in eights {
            for lane in 0..LANES {
                least[lane] = if eight[lane] < least[lane] { eight[lane] } else { least[lane] };
            }
        }
        let all = least.iter().chain(rest);
        0.5 * all.fold(0.0, |least, own| if *own < least { *own } else { least })
    }
}

/// A bound on the distances of the eigenvalues from their middle `-m`. These are the eigenvalues of
///
/// ```text
/// B = | m    D |    D: w_{n+1} - w_n    P: phi_n u_n    G: (m - a_n) w_n + c_n w_{n+1}
///     | P    G |
/// ```
///
/// and their squares those of `B^2`. In the norm of the largest component, speeds in units of any `1/sigma`, the rows of `B^2`
/// are at most `m^2 + 2 p + 2 sigma g` and `q^2 + 2 p + p g / sigma`, with the largest `p` of `|phi_n|`, `q` of `|m - a_n| +
/// |c_n|` and `g` of `|2 m - a_n| + |c_n|`. The bound is least for the `sigma` that makes both equal.
struct Farthest<'a> {
    by_spacing: &'a [f64],
    own: &'a [f64],
    ahead: &'a [f64],
    fading: f64,
}

impl Kernel for Farthest<'_> {
    type Output = f64;

    #[inline(always)]
    fn run(self) -> f64 {
        let Farthest { by_spacing, own, ahead, fading } = self;
        // largest values pass over NaN, this sum does not
        let (mut most, mut nothing) = ([[0.0; LANES]; 3], [0.0; LANES]);
        let mut take = |lane: usize, by_spacing: f64, own: f64, ahead: f64| {
            let aside = ahead.abs();
            let sizes = [by_spacing.abs(), (own - fading).abs() + aside, (own - 2.0 * fading).abs() + aside];
            for (most, size) in most.iter_mut().zip(sizes) {
                most[lane] = if size > most[lane] { size } else { most[lane] };
            }
            nothing[lane] += 0.0 * (by_spacing + own + ahead);
        };
        let (by_spacings, rest) = by_spacing.as_chunks::<LANES>();
        let (owns, own_rest) = own.as_chunks::<LANES>();
        let (aheads, ahead_rest) = ahead.as_chunks::<LANES>();
        for ((by_spacing, own), ahead) in by_spacings.iter().zip(owns).zip(aheads) {
            for lane in 0..LANES {
                take(lane, by_spacing[lane], own[lane], ahead[lane]);
            }
        }
        for ((by_spacing, own), ahead) in rest.iter().zip(own_rest).zip(ahead_rest) {
            take(0, *by_spacing, *own, *ahead);
        }
        let [p, q, g] = most.map(|most| most.into_iter().fold(0.0, |most, one| if one > most { one } else { most }));
        let (m, q) = (fading * fading, q * q);
        let (middle, half) = (0.5 * (m + q), 0.5 * (m - q));
        (2.0 * p + middle + (half * half + 2.0 * p * g * g).sqrt()).sqrt() + nothing.iter().sum::<f64>()
    }
}

/// A series reaches at most so far, in units of the time in which differences move: terms of a longer one would cancel.
const LONGEST: f64 = 10.0;

/// Carries a difference of spacings and speeds of so many pedestrians; returns the way that the first one's speed adds.
pub(super) fn carry(tangent: Tangent<'_>, n: usize, difference: &mut [f64]) -> f64 {
    if n >= LANES {
        return dispatch(Carry { tangent, n, difference });
    }
    // of fewer than eight, what is repeated along a longer ring is the same
    let laps = LANES.div_ceil(n);
    let repeated = |row: &[f64]| {
        let (rows, rest) = row.split_at(row.len() / n * n);
        let mut longer: Vec<f64> = rows.chunks(n).flat_map(|row| row.repeat(laps)).collect();
        longer.extend(rest);
        longer
    };
    let [start, end, mut longer] = [tangent.start, tangent.end, difference].map(repeated);
    let tangent = Tangent { start: &start, end: &end, ..tangent };
    let way = dispatch(Carry { tangent, n: n * laps, difference: &mut longer });
    for (row, longer) in difference.chunks_mut(n).zip(longer.chunks(n * laps)) {
        row.copy_from_slice(&longer[..n]);
    }
    way
}

/// Numbers per iteration.
const LANES: usize = 8;
type Eight = [f32; LANES];

/// What is known of eight pedestrians: one row for each of the following. The last block begins earlier rather than be cut: what
/// is there twice is the same.
type Block<const ALL: usize> = [Eight; ALL];
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
/// So many rows if the force depends on speeds: those, and
const ROWS_OF_SPEEDS: usize = 12;
/// the slopes by the own speed, less the middle of the eigenvalues, and by that ahead, and how these grow,
const OWN: usize = 7;
const OWN_GROWTH: usize = 8;
const AHEAD: usize = 9;
const AHEAD_GROWTH: usize = 10;
/// and the term of speeds before the last one.
const EARLIER_SPEED: usize = 11;

/// A term of the series that is smaller than this part of the sum ends it: an error is asked to a factor of 3.
const REST: f32 = 1e-2;

/// The same where slopes change: who is thrown back by a wall goes on with a small difference of what came.
const REST_IF_GROWS: f32 = 1e-3;

/// Smaller differences are carried in this unit.
const LEAST: f64 = 1e-290;

struct Carry<'a> {
    tangent: Tangent<'a>,
    n: usize,
    difference: &'a mut [f64],
}

impl Kernel for Carry<'_> {
    type Output = f64;

    #[inline(always)]
    fn run(self) -> f64 {
        let has_speeds = self.tangent.start.len() > self.n;
        match (has_speeds, self.tangent.end.is_empty()) {
            (false, true) => self.along::<ROWS, false>(),
            (false, false) => self.along::<ROWS, true>(),
            (true, true) => self.along::<ROWS_OF_SPEEDS, false>(),
            (true, false) => self.along::<ROWS_OF_SPEEDS, true>(),
        }
    }
}

impl Carry<'_> {
    /// Carries piece by piece, along which slopes change if it `GROWS`.
    #[inline(always)]
    fn along<const ALL: usize, const GROWS: bool>(self) -> f64 {
        let Carry { tangent: Tangent { start, end, length, fastest, room }, n, difference } = self;
        let has_speeds = const { ALL > ROWS };
        let (fading, fastest) = match (has_speeds, GROWS) {
            (false, _) => (FADING, fastest),
            (true, false) => (start[3 * n], fastest),
            // the middle moves
            (true, true) => (0.5 * (start[3 * n] + end[3 * n]), fastest + 0.5 * (end[3 * n] - start[3 * n]).abs()),
        };
        let pieces = math::larger((fastest * length / LONGEST).ceil(), 1.0);
        let unit = length / pieces;
        let (turns, left) = ((fastest * unit) as f32, lane::exp(fading * unit));
        let half = (-fading * unit) as f32;
        room.resize(n.div_ceil(LANES) * ALL * LANES, 0.0);
        let blocks = room.as_chunks_mut::<LANES>().0.as_chunks_mut::<ALL>().0;
        fill(blocks, [SLOPE], &start[..n], unit * unit);
        if GROWS {
            fill_growth(blocks, GROWTH, [&start[..n], &end[..n]], unit * unit / pieces);
        }
        if has_speeds {
            let (own, ahead) = (n..2 * n, 2 * n..3 * n);
            fill(blocks, [OWN], &start[own.clone()], unit);
            fill(blocks, [AHEAD], &start[ahead.clone()], unit);
            blocks.iter_mut().for_each(|block| block[OWN].iter_mut().for_each(|own| *own += half));
            if GROWS {
                fill_growth(blocks, OWN_GROWTH, [&start[own.clone()], &end[own]], unit / pieces);
                fill_growth(blocks, AHEAD_GROWTH, [&start[ahead.clone()], &end[ahead]], unit / pieces);
            }
        }
        let (spacings, speeds) = difference.split_at_mut(n);
        let mut way = 0.0;
        for piece in 0..pieces as usize {
            let size = math::larger(largest(spacings), largest(speeds) * unit);
            if size == 0.0 {
                break;
            }
            if GROWS && piece > 0 {
                blocks.iter_mut().for_each(grow);
            }
            // in units of the largest; the least doubles have no inverse
            let size = math::larger(size, LEAST);
            fill(blocks, [SPACING, SPACINGS], spacings, 1.0 / size);
            fill(blocks, [SPEED, SPEEDS], speeds, unit / size);
            let moved = sum::<ALL, GROWS>(blocks, n, half, turns);
            let size = left * size;
            spill(blocks, SPACINGS, spacings, size);
            spill(blocks, SPEEDS, speeds, size / unit);
            way += f64::from(moved) * size;
        }
        way
    }
}

/// Lets slopes grow by what they do in a piece.
#[inline(always)]
fn grow<const ALL: usize>(block: &mut Block<ALL>) {
    let mut by = |row: usize, growth: usize| {
        let growth = block[growth];
        block[row].iter_mut().zip(growth).for_each(|(slope, growth)| *slope += growth);
    };
    by(SLOPE, GROWTH);
    if const { ALL > ROWS } {
        by(OWN, OWN_GROWTH);
        by(AHEAD, AHEAD_GROWTH);
    }
}

/// Sums the series, in units of a piece for time; returns that of the way of the first one.
#[inline(always)]
fn sum<const ALL: usize, const GROWS: bool>(blocks: &mut [Block<ALL>], n: usize, half: f32, turns: f32) -> f32 {
    if GROWS {
        blocks.iter_mut().for_each(|block| block[EARLIER] = [0.0; LANES]);
        if const { ALL > ROWS } {
            blocks.iter_mut().for_each(|block| block[EARLIER_SPEED] = [0.0; LANES]);
        }
    }
    let new = blocks.len() * LANES - n;
    let (mut moved, mut way, mut order, mut least) = (0.0, 0.0, 0.0, f32::INFINITY);
    while order < MOST_TERMS {
        order += 1.0;
        let share = 1.0 / order;
        moved = (blocks[0][SPEED][0] + half * moved) * share;
        way += moved;
        next_term::<ALL, GROWS>(blocks, new, [half, share]);
        if order >= FIRST_LOOK * turns {
            if least.is_infinite() {
                least = if GROWS { REST_IF_GROWS } else { REST } * size_of(blocks, [SPACINGS, SPEEDS]);
            }
            if size_of(blocks, [SPACING, SPEED]) <= least {
                break;
            }
        }
    }
    way
}

/// Makes the next term of the series and adds it to the sums. From the last block to the first: a block needs the speed of
/// the first one in the block ahead, which in the last block is the first new one.
#[inline(always)]
fn next_term<const ALL: usize, const GROWS: bool>(blocks: &mut [Block<ALL>], new: usize, factors: [f32; 2]) {
    let ahead = Ahead::of::<ALL, GROWS>(&blocks[0], 0);
    let Some((last, others)) = blocks.split_last_mut() else { return };
    let mut following = Ahead::of::<ALL, GROWS>(last, new % LANES);
    advance::<ALL, GROWS>(last, ahead, factors);
    for block in others.iter_mut().rev() {
        let ahead = following;
        following = Ahead::of::<ALL, GROWS>(block, 0);
        advance::<ALL, GROWS>(block, ahead, factors);
    }
}

/// What a block needs of the one ahead of its last: the last term of the speed, and where that counts the one before.
#[derive(Clone, Copy)]
struct Ahead {
    speed: f32,
    earlier: f32,
}

impl Ahead {
    #[inline(always)]
    fn of<const ALL: usize, const GROWS: bool>(block: &Block<ALL>, place: usize) -> Ahead {
        let earlier = if const { ALL > ROWS && GROWS } { block[EARLIER_SPEED][place] } else { 0.0 };
        Ahead { speed: block[SPEED][place], earlier }
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
fn fill<const ALL: usize, const COPIES: usize>(
    blocks: &mut [Block<ALL>],
    rows: [usize; COPIES],
    numbers: &[f64],
    factor: f64,
) {
    for (index, block) in blocks.iter_mut().enumerate() {
        let eight = eight(numbers, index).map(|number| (number * factor) as f32);
        for row in rows {
            block[row] = eight;
        }
    }
}

/// Stores by how much slopes grow in a piece.
#[inline(always)]
fn fill_growth<const ALL: usize>(blocks: &mut [Block<ALL>], row: usize, [start, end]: [&[f64]; 2], factor: f64) {
    for (index, block) in blocks.iter_mut().enumerate() {
        let (start, mut end) = (eight(start, index), eight(end, index));
        for i in 0..LANES {
            end[i] -= start[i];
        }
        block[row] = end.map(|growth| (growth * factor) as f32);
    }
}

/// Does the opposite of [`fill`].
#[inline(always)]
fn spill<const ALL: usize>(blocks: &[Block<ALL>], row: usize, numbers: &mut [f64], factor: f64) {
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

/// Those ahead of eight, that of the last of them given.
#[inline(always)]
fn shifted(row: &Eight, last: f32) -> Eight {
    [row[1], row[2], row[3], row[4], row[5], row[6], row[7], last]
}

/// Makes the next term of eight pedestrians; what is ahead of the last of them is given.
#[inline(always)]
fn advance<const ALL: usize, const GROWS: bool>(block: &mut Block<ALL>, last: Ahead, [half, share]: [f32; 2]) {
    // borrowed, not copied: the compiler would load copies in halves
    let Some((all, of_speeds)) = block.split_first_chunk_mut::<ROWS>() else { return };
    let [slope, growth, spacing, speed, earlier, spacings, speeds] = all;
    let ahead = shifted(speed, last.speed);
    let [mut closing, mut pushed, mut closed, mut gained] = [[0.0; LANES]; 4];
    for i in 0..LANES {
        closing[i] = ((ahead[i] - speed[i]) + half * spacing[i]) * share;
        closed[i] = spacings[i] + closing[i];
    }
    if let [by_own, own_growth, by_ahead, ahead_growth, earlier_speed] = of_speeds {
        for i in 0..LANES {
            pushed[i] = slope[i] * spacing[i] + by_own[i] * speed[i] + by_ahead[i] * ahead[i];
        }
        if GROWS {
            let earlier_ahead = shifted(earlier_speed, last.earlier);
            for i in 0..LANES {
                let by_speeds = own_growth[i] * earlier_speed[i] + ahead_growth[i] * earlier_ahead[i];
                pushed[i] += growth[i] * earlier[i] + by_speeds;
            }
            *earlier_speed = *speed;
        }
        pushed.iter_mut().for_each(|pushed| *pushed *= share);
    } else {
        for i in 0..LANES {
            let push = slope[i] * spacing[i] - half * speed[i];
            pushed[i] = if GROWS { push + growth[i] * earlier[i] } else { push } * share;
        }
    }
    for i in 0..LANES {
        gained[i] = speeds[i] + pushed[i];
    }
    if GROWS {
        *earlier = *spacing;
    }
    (*spacing, *speed, *spacings, *speeds) = (closing, pushed, closed, gained);
}

/// The largest sum of two rows' absolute values.
#[inline(always)]
fn size_of<const ALL: usize>(blocks: &[Block<ALL>], [one, other]: [usize; 2]) -> f32 {
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
