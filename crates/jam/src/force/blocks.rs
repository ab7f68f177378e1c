//! A formula over the pedestrians of a ring, several at a time.

use math::lanes::Lanes;

/// A function of the own entries of two rows and the next one of the second, for `W` pedestrians at once. Implementations
/// must be `#[inline(always)]`, to be compiled for the registers of the kernel that they are part of.
pub trait Block<const W: usize> {
    /// What fills the last block up.
    const FILLER: [f64; 2];

    /// The value.
    fn value(&self, first: Lanes<W>, second: Lanes<W>, ahead: Lanes<W>) -> Lanes<W>;
}

/// Applies the function to everybody on the ring.
#[inline(always)]
pub fn around<const W: usize, B: Block<W>>(block: &B, first: &[f64], second: &[f64], result: &mut [f64]) {
    let n = first.len();
    let (second, result) = (&second[..n], &mut result[..n]);
    let mut begin = 0;
    while begin + W < n {
        let value = block.value(
            Lanes::of(&first[begin..begin + W]),
            Lanes::of(&second[begin..begin + W]),
            Lanes::of(&second[begin + 1..begin + 1 + W]),
        );
        result[begin..begin + W].copy_from_slice(&value.0);
        begin += W;
    }
    let rest = n - begin;
    let [filler, speed] = B::FILLER;
    let (mut own, mut speeds, mut ahead) = ([filler; W], [speed; W], [speed; W]);
    own[..rest].copy_from_slice(&first[begin..]);
    speeds[..rest].copy_from_slice(&second[begin..]);
    ahead[..rest - 1].copy_from_slice(&second[begin + 1..]);
    ahead[rest - 1] = second[0];
    let value = block.value(Lanes(own), Lanes(speeds), Lanes(ahead));
    result[begin..].copy_from_slice(&value.0[..rest]);
}
