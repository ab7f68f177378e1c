//! Heun's scheme on rings larger than a cache: block by block, many steps per block, on several threads.
//!
//! A step of Heun's scheme asks for two pedestrians ahead, never for one behind. So a block that is to make `m` steps
//! takes `2 m` more from ahead with it as they are at the beginning, and makes some of their steps again: their last
//! two become wrong with every step, the block itself never. Blocks are done in order, the foremost last, so that those
//! ahead are still as they were. Every pedestrian is computed by the same operations as in one piece: the same bits,
//! for any cut.

use super::segment::{Scheme, Segment};
use crate::force::Steps;
use crate::laws::Law;
use math::simd::{Kernel, Width, dispatch_to_four};
use std::ops::Range;
use std::panic::resume_unwind;

/// How a ring is cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cut {
    /// Pedestrians of a block; less than the whole ring.
    pub block: usize,
    /// Steps that a block makes before the next one has its turn; `2 steps` is less than the pedestrians of a thread.
    pub steps: u64,
    /// Threads, each with a part of the ring.
    pub threads: usize,
}

/// Larger rings go in blocks: a segment takes 40 bytes for each, so these fill 160 KiB.
const LARGE: usize = 4096;
/// Rings of this size are worth a second thread: it takes as long to start as some thousand steps of a hundred.
const VERY_LARGE: usize = 131_072;

impl Cut {
    /// The cut for `n` pedestrians, which changes how long the steps take and nothing else; `None`: in one.
    pub fn of(n: usize) -> Option<Cut> {
        // asking takes as long as hundreds of steps of a small ring
        let available = || std::thread::available_parallelism().map_or(1, |threads| threads.get());
        let threads = if n >= VERY_LARGE { available().min(n / (VERY_LARGE / 2)) } else { 1 };
        (n > LARGE).then_some(Cut { block: 1024, steps: 16, threads })
    }
}

/// The steps of a batch; false if something happened in one of them.
pub(super) fn in_blocks<L: Law>(law: L, steps: Steps, cut: Cut, state: &mut [f64]) -> bool {
    let mut left = steps.count;
    while left > 0 {
        let count = left.min(cut.steps);
        if !round(law, Steps { count, ..steps }, cut, state) {
            return false;
        }
        left -= count;
    }
    true
}

/// The number of steps that a block makes at a time.
fn round<L: Law>(law: L, steps: Steps, cut: Cut, state: &mut [f64]) -> bool {
    let parts = parts(steps.count, cut.threads, state);
    if parts.len() == 1 {
        return parts.into_iter().all(|part| in_part(law, steps, cut.block, part));
    }
    std::thread::scope(|scope| {
        let work = |part| move || in_part(law, steps, cut.block, part);
        let threads: Vec<_> = parts.into_iter().map(|part| scope.spawn(work(part))).collect();
        let quiet = threads.into_iter().map(|thread| thread.join().unwrap_or_else(|panic| resume_unwind(panic)));
        quiet.collect::<Vec<_>>().into_iter().all(|is_quiet| is_quiet)
    })
}

/// The steps of the blocks of a part. A function of its own, or it would be compiled once more for the threads. Without
/// a copy for the widest registers: the rows of large rings wait for the second-level cache.
#[inline(never)]
fn in_part<L: Law>(law: L, steps: Steps, size: usize, part: Part<'_>) -> bool {
    dispatch_to_four(steps.limit, Blocks { law, steps, size, part })
}

/// The part of a ring that a thread works on.
struct Part<'a> {
    positions: &'a mut [f64],
    speeds: &'a mut [f64],
    /// Positions and speeds of those ahead of the part, as they were at the beginning.
    ahead: (Vec<f64>, Vec<f64>),
    /// Whether the first of those ahead is pedestrian 0, one ring length further on.
    is_last: bool,
}

fn parts(steps: u64, count: usize, state: &mut [f64]) -> Vec<Part<'_>> {
    let n = state.len() / 2;
    let reach = 2 * steps as usize;
    let (mut positions, mut speeds) = state.split_at_mut(n);
    let ends: Vec<usize> = (1..=count).map(|part| part * n / count).collect();
    let copies = |row: &[f64]| -> Vec<Vec<f64>> { ends.iter().map(|end| row[end % n..][..reach].to_vec()).collect() };
    let ahead = copies(positions).into_iter().zip(copies(speeds));
    let mut begin = 0;
    let mut parts = Vec::new();
    for (&end, ahead) in ends.iter().zip(ahead) {
        let (part_positions, part_speeds);
        (part_positions, positions) = positions.split_at_mut(end - begin);
        (part_speeds, speeds) = speeds.split_at_mut(end - begin);
        parts.push(Part { positions: part_positions, speeds: part_speeds, ahead, is_last: end == n });
        begin = end;
    }
    parts
}

/// The blocks of a part, one after the other.
struct Blocks<'a, L> {
    law: L,
    steps: Steps,
    size: usize,
    part: Part<'a>,
}

impl<L: Law> Kernel for Blocks<'_, L> {
    type Output = bool;

    #[inline(always)]
    fn run(self) -> bool {
        let law = self.law;
        match law.plain() {
            Some(plain) if !plain.is_long() => self.all(&plain, None),
            _ => {
                let in_rows = Some(self.steps.limit);
                self.all(&law, in_rows)
            }
        }
    }
}

impl<L: Law> Blocks<'_, L> {
    #[inline(always)]
    fn all(self, law: &L, in_rows: Option<Width>) -> bool {
        let Blocks { steps, size, mut part, .. } = self;
        let scheme = Scheme { law, in_rows, h: steps.h };
        // one place more for the image of pedestrian 0
        let mut segment = Segment::new(size + 2 * steps.count as usize + 1);
        let count = part.positions.len();
        let mut begin = 0;
        while begin < count {
            let end = count.min(begin + size);
            if !block(scheme, &steps, &mut part, begin..end, &mut segment) {
                return false;
            }
            begin = end;
        }
        true
    }
}

/// The steps of one block.
#[inline(always)]
fn block<L: Law>(
    scheme: Scheme<'_, L>,
    steps: &Steps,
    part: &mut Part<'_>,
    range: Range<usize>,
    segment: &mut Segment,
) -> bool {
    let Steps { length, count, .. } = *steps;
    let own = range.len();
    let all = own + 2 * count as usize;
    let image = part.positions.len() - range.start;
    let has_image = part.is_last && image < all;
    fill(&mut segment.now.positions, &part.positions[range.start..], &part.ahead.0, all, has_image);
    fill(&mut segment.now.speeds, &part.speeds[range.start..], &part.ahead.1, all, has_image);
    // the ghost's place is not a pedestrian's: what is computed for it is overwritten
    let end = all + usize::from(has_image);
    for _ in 0..count {
        if has_image {
            segment.now.fill_ghost(image, image + 1, length);
        }
        // those taken along become wrong, and so does what happens to them
        for (range, is_own) in [(0..own, true), (own..end, false)] {
            if !segment.predict(scheme, range) && is_own {
                return false;
            }
        }
        if has_image {
            segment.guess.fill_ghost(image, image + 1, length);
        }
        segment.correct(scheme, 0..end);
    }
    part.positions[range.clone()].copy_from_slice(&segment.now.positions[..own]);
    part.speeds[range].copy_from_slice(&segment.now.speeds[..own]);
    true
}

/// Fills the first `all` places with the rest of the part and those ahead of it; between them a place for the image of
/// pedestrian 0, if it `has_image`.
#[inline(always)]
fn fill(row: &mut [f64], part: &[f64], ahead: &[f64], all: usize, has_image: bool) {
    let inside = part.len().min(all);
    row[..inside].copy_from_slice(&part[..inside]);
    let begin = inside + usize::from(has_image);
    row[begin..begin + all - inside].copy_from_slice(&ahead[..all - inside]);
}
