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

/// Applies the function to all pedestrians of a row. For the last one, the next entry of the second row is `closing`
/// (on a ring, the first entry), which that row may also contain.
#[inline(always)]
pub fn along<B: Block>(block: &B, pace: Pace, first: &[f64], second: &[f64], closing: f64, result: &mut [f64]) {
    let (n, all) = (first.len(), (first, second, closing));
    let mut rest = Rest { first, second, result };
    match pace {
        Pace::Single => return singly(block, first, second, closing, rest.result),
        Pace::Narrow => {}
        Pace::Wide => {
            while rest.first.len() > WIDER || rest.first.len() == WIDE && second.len() > n {
                rest.take::<WIDE, B>(block);
            }
            match rest.first.len() {
                0 => return,
                left if n >= WIDER && left > WIDE => return last_of_many::<WIDER, B>(block, all, result),
                _ => {}
            }
        }
    }
    while rest.first.len() > NARROW {
        rest.take::<NARROW, B>(block);
    }
    last::<NARROW, B>(block, all, result);
}

/// What is left of the rows.
struct Rest<'a> {
    first: &'a [f64],
    second: &'a [f64],
    result: &'a mut [f64],
}

impl Rest<'_> {
    /// A block whose neighbours ahead are in the row.
    #[inline(always)]
    fn take<const W: usize, B: Block>(&mut self, block: &B) {
        // split off, not indexed: one comparison for each
        let (first, rest_of_first) = self.first.split_at(W);
        let ahead = Lanes::of(&self.second[1..]);
        let (second, rest_of_second) = self.second.split_at(W);
        let (result, rest_of_result) = std::mem::take(&mut self.result).split_at_mut(W);
        result.copy_from_slice(&block.value(Lanes::of(first), Lanes::<W>::of(second), ahead).0);
        *self = Rest { first: rest_of_first, second: rest_of_second, result: rest_of_result };
    }
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

/// The last block of a row that is longer. It begins earlier rather than be cut, since what is written twice is the
/// same.
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

/// The last block. It begins earlier rather than be cut, since what is written twice is the same; a row of fewer is
/// filled up.
#[inline(always)]
fn last<const W: usize, B: Block>(block: &B, (first, second, closing): (&[f64], &[f64], f64), result: &mut [f64]) {
    let n = first.len();
    let [filler, speed] = B::FILLER;
    let (mut own, mut speeds, mut ahead) = ([filler; W], [speed; W], [speed; W]);
    let is_whole = n >= W;
    if is_whole {
        // lengths that the compiler knows
        let from = n - W;
        own.copy_from_slice(&first[from..]);
        speeds.copy_from_slice(&second[from..n]);
        ahead[..W - 1].copy_from_slice(&second[from + 1..n]);
        ahead[W - 1] = closing;
    } else {
        own[..n].copy_from_slice(first);
        speeds[..n].copy_from_slice(&second[..n]);
        ahead[..n - 1].copy_from_slice(&second[1..n]);
        ahead[n - 1] = closing;
    }
    let value = block.value(Lanes(own), Lanes(speeds), Lanes(ahead));
    if is_whole {
        result[n - W..].copy_from_slice(&value.0);
    } else {
        result.copy_from_slice(&value.0[..n]);
    }
}
