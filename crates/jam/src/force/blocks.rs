//! Evaluates a formula over the pedestrians of a ring, several at a time.
//!
//! The operations of one pedestrian wait for each other, those of several registers do not: blocks are wide where there
//! are pedestrians enough, and a last register that would stand alone is taken along by the block before.

use math::lanes::Lanes;

/// A function of the own entries of two rows and the next one of the second, for any number of pedestrians at once.
/// Implementations must be `#[inline(always)]`, to be compiled for the registers of the kernel that they are part of.
pub trait Block {
    /// What fills the last block up.
    const FILLER: [f64; 2];

    /// The value.
    fn value<const W: usize>(&self, first: Lanes<W>, second: Lanes<W>, ahead: Lanes<W>) -> Lanes<W>;
}

/// The doubles of the widest registers.
const NARROW: usize = 8;
/// Pedestrians per iteration: enough to keep the units of a processor busy.
const WIDE: usize = 64;
/// A wide block that takes another register along.
const WIDER: usize = WIDE + NARROW;

/// How a formula is carried out for a ring.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pace {
    /// One pedestrian after the other, in a loop that the compiler turns into vector code: of short formulas without a
    /// branch.
    Single,
    /// A register at a time: of short formulas with branches, which are taken once for all its pedestrians.
    Narrow,
    /// Many at a time: of long formulas.
    Wide,
}

/// Applies the function to everybody on the ring.
#[inline(always)]
pub fn around<B: Block>(block: &B, pace: Pace, first: &[f64], second: &[f64], result: &mut [f64]) {
    let n = first.len();
    let mut begin = 0;
    match pace {
        Pace::Single => return singly(block, first, second, result),
        Pace::Narrow => {}
        Pace::Wide => {
            while n - begin > WIDER {
                begin = inside::<WIDE, B>(block, begin, first, second, result);
            }
            if n - begin > WIDE - NARROW {
                return last::<WIDER, B>(block, begin, first, second, result);
            }
        }
    }
    while n - begin > NARROW {
        begin = inside::<NARROW, B>(block, begin, first, second, result);
    }
    last::<NARROW, B>(block, begin, first, second, result);
}

/// One after the other.
#[inline(always)]
fn singly<B: Block>(block: &B, first: &[f64], second: &[f64], result: &mut [f64]) {
    let last = first.len() - 1;
    for (((result, first), own), ahead) in result.iter_mut().zip(first).zip(second).zip(&second[1..]) {
        *result = block.value(Lanes([*first]), Lanes([*own]), Lanes([*ahead])).0[0];
    }
    result[last] = block.value(Lanes([first[last]]), Lanes([second[last]]), Lanes([second[0]])).0[0];
}

/// A block whose neighbours ahead are in the row; returns where it ends.
#[inline(always)]
fn inside<const W: usize, B: Block>(
    block: &B,
    begin: usize,
    first: &[f64],
    second: &[f64],
    result: &mut [f64],
) -> usize {
    let end = begin + W;
    let (own, ahead) = (Lanes::<W>::of(&second[begin..end]), Lanes::of(&second[begin + 1..end + 1]));
    result[begin..end].copy_from_slice(&block.value(Lanes::of(&first[begin..end]), own, ahead).0);
    end
}

/// The last block, which the first pedestrian closes. It begins earlier rather than be cut, since what is written twice is the
/// same; on a ring of fewer it is filled up.
#[inline(always)]
fn last<const W: usize, B: Block>(block: &B, begin: usize, first: &[f64], second: &[f64], result: &mut [f64]) {
    let n = first.len();
    let [filler, speed] = B::FILLER;
    let (mut own, mut speeds, mut ahead) = ([filler; W], [speed; W], [speed; W]);
    let is_whole = n >= W;
    if is_whole {
        // lengths that the compiler knows
        let from = n - W;
        own.copy_from_slice(&first[from..]);
        speeds.copy_from_slice(&second[from..]);
        ahead[..W - 1].copy_from_slice(&second[from + 1..]);
        ahead[W - 1] = second[0];
    } else {
        let rest = n - begin;
        own[..rest].copy_from_slice(&first[begin..]);
        speeds[..rest].copy_from_slice(&second[begin..]);
        ahead[..rest - 1].copy_from_slice(&second[begin + 1..]);
        ahead[rest - 1] = second[0];
    }
    let value = block.value(Lanes(own), Lanes(speeds), Lanes(ahead));
    if is_whole {
        result[n - W..].copy_from_slice(&value.0);
    } else {
        result[begin..].copy_from_slice(&value.0[..n - begin]);
    }
}

/// Replaces the entries of a row by the function of them, the speed at the same place and the next one.
#[inline(always)]
pub fn along<B: Block>(block: &B, speeds: &[f64], row: &mut [f64]) {
    let (n, mut begin) = (row.len(), 0);
    while n - begin >= WIDE {
        let is_one_left = (n - begin) % WIDE == NARROW;
        begin = if is_one_left {
            in_place::<WIDER, B>(block, begin, speeds, row)
        } else {
            in_place::<WIDE, B>(block, begin, speeds, row)
        };
    }
    while n - begin >= NARROW {
        begin = in_place::<NARROW, B>(block, begin, speeds, row);
    }
    while begin < n {
        begin = in_place::<1, B>(block, begin, speeds, row);
    }
}

#[inline(always)]
fn in_place<const W: usize, B: Block>(block: &B, begin: usize, speeds: &[f64], row: &mut [f64]) -> usize {
    let end = begin + W;
    let (own, ahead) = (Lanes::<W>::of(&speeds[begin..end]), Lanes::of(&speeds[begin + 1..end + 1]));
    let value = block.value(Lanes::of(&row[begin..end]), own, ahead);
    row[begin..end].copy_from_slice(&value.0);
    end
}
