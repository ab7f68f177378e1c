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
const WIDE: usize = 32;
/// A wide block that takes another register along.
const WIDER: usize = WIDE + NARROW;

/// How a formula is carried out for a row.
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

/// Applies the function to everybody in a row. The last one's next entry of the second row is `closing`, on a ring the first;
/// that row may hold it, too.
#[inline(always)]
pub fn along<B: Block>(block: &B, pace: Pace, first: &[f64], second: &[f64], closing: f64, result: &mut [f64]) {
    let n = first.len();
    let mut begin = 0;
    match pace {
        Pace::Single => return singly(block, first, second, closing, result),
        Pace::Narrow => {}
        Pace::Wide => {
            while n - begin > WIDER || n - begin == WIDE && second.len() > n {
                begin = inside::<WIDE, B>(block, begin, first, second, result);
            }
            if begin == n {
                return;
            }
            if n >= WIDER && n - begin > WIDE {
                return last_of_many::<WIDER, B>(block, (first, second, closing), result);
            }
        }
    }
    while n - begin > NARROW {
        begin = inside::<NARROW, B>(block, begin, first, second, result);
    }
    last::<NARROW, B>(block, begin, (first, second, closing), result);
}

/// One after the other.
#[inline(always)]
fn singly<B: Block>(block: &B, first: &[f64], second: &[f64], closing: f64, result: &mut [f64]) {
    let last = first.len() - 1;
    for (((result, first), own), ahead) in result.iter_mut().zip(first).zip(second).zip(&second[1..]) {
        *result = block.value(Lanes([*first]), Lanes([*own]), Lanes([*ahead])).0[0];
    }
    result[last] = block.value(Lanes([first[last]]), Lanes([second[last]]), Lanes([closing])).0[0];
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

/// The last block of a row that is longer. It begins earlier rather than be cut, since what is written twice is the same.
#[inline(always)]
fn last_of_many<const W: usize, B: Block>(
    block: &B,
    (first, second, closing): (&[f64], &[f64], f64),
    result: &mut [f64],
) {
    let from = first.len() - W;
    let mut ahead = [closing; W];
    ahead[..W - 1].copy_from_slice(&second[from + 1..first.len()]);
    let value = block.value(Lanes::of(&first[from..]), Lanes::of(&second[from..]), Lanes(ahead));
    result[from..].copy_from_slice(&value.0);
}

/// The last block. It begins earlier rather than be cut, since what is written twice is the same; in a row of fewer it is
/// filled up.
#[inline(always)]
fn last<const W: usize, B: Block>(
    block: &B,
    begin: usize,
    (first, second, closing): (&[f64], &[f64], f64),
    result: &mut [f64],
) {
    let n = first.len();
    let [filler, speed] = B::FILLER;
    let (mut own, mut speeds, mut ahead) = ([filler; W], [speed; W], [speed; W]);
    let is_whole = n >= W;
    if is_whole {
        // lengths that the compiler knows
        let from = n - W;
        own.copy_from_slice(&first[from..]);
        speeds.copy_from_slice(&second[from..n]);
        ahead[..W - 1].copy_from_slice(&second[from + 1..first.len()]);
        ahead[W - 1] = closing;
    } else {
        let rest = n - begin;
        own[..rest].copy_from_slice(&first[begin..]);
        speeds[..rest].copy_from_slice(&second[begin..n]);
        ahead[..rest - 1].copy_from_slice(&second[begin + 1..n]);
        ahead[rest - 1] = closing;
    }
    let value = block.value(Lanes(own), Lanes(speeds), Lanes(ahead));
    if is_whole {
        result[n - W..].copy_from_slice(&value.0);
    } else {
        result[begin..].copy_from_slice(&value.0[..n - begin]);
    }
}
