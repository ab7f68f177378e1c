//! Taylor coefficients of a motion.
//!
//! With spacings `s_n = sum u_k t^k` and speeds `v_n = sum w_k t^k`, the equations give `(k + 1) u_{k+1} = w_k(ahead) -
//! w_k` and `(k + 1) w_{k+1} = a_k`, where `a_k` is the coefficient of the acceleration along the motion, which the
//! formula gives from those of spacing and speeds up to the order `k` ([`math::series`]). An order costs a few sums of
//! products; no stage is evaluated.

use super::{Flow, NOTHING};
use crate::laws::Law;
use math::lanes::Lanes;
use math::series::{self, Block, Jet, OrderMemory};
use math::simd::{Kernel, dispatch_either, dispatch_wide};

/// The coefficients of spacings and speeds of a ring, from their rows 0 and 1.
#[derive(Debug)]
pub struct Motion<'a> {
    /// What is added to spacings and speeds of order 0: those of the uniform flow, if the rows hold deviations from it.
    pub flow: Flow,
    /// Where in a row the speed of that flow stands, whose coefficients are then written, too, and those of the
    /// deviations without cancellation. `None` where the flow is steady, or the force does not depend on speeds.
    pub along: Option<usize>,
    /// How many pedestrians.
    pub pedestrians: usize,
    /// The last order.
    pub order: usize,
    /// Unit of time: coefficients are those of powers of the time divided by it.
    pub unit: f64,
    /// Length of a row.
    pub dimension: usize,
    /// Rows `[u_0 .. u_{N-1}, w_0 .. w_{N-1}, ...]`, one for each order: 0 and 1 are given, the others written.
    pub coefficients: &'a mut [f64],
}

/// Pedestrians per iteration where registers hold eight doubles: two sums over the orders and what they are made of
/// stay in registers.
const WIDE: usize = 24;
/// Where they hold fewer.
const NARROW: usize = 16;

/// Memory that is kept from step to step. Behind the last pedestrian the first follows, as the neighbour ahead; in a
/// ring of less than a block, then numbers without meaning that nothing reads but others of their kind.
#[derive(Clone, Debug, Default)]
pub struct Memory {
    narrow: InBlocks<NARROW>,
    wide: InBlocks<WIDE>,
}

/// For blocks of `W` pedestrians.
#[derive(Clone, Debug, Default)]
struct InBlocks<const W: usize> {
    /// What the operations keep, one block of pedestrians after another.
    histories: Vec<Block<Lanes<W>>>,
    /// Coefficients of one order.
    now: Row,
    /// Of the next.
    next: Row,
}

#[derive(Clone, Debug, Default)]
struct Row {
    spacings: Aligned,
    speeds: Aligned,
}

impl Row {
    fn reserve(&mut self, length: usize) {
        self.spacings.reserve(length);
        // one more, for the neighbour ahead of the last lane
        self.speeds.reserve(length + 1);
    }

    #[inline(always)]
    fn numbers(&self) -> [&[f64]; 2] {
        [&self.spacings, &self.speeds].map(Aligned::numbers)
    }

    #[inline(always)]
    fn numbers_mut(&mut self) -> [&mut [f64]; 2] {
        [&mut self.spacings, &mut self.speeds].map(Aligned::numbers_mut)
    }
}

/// Spacings, speeds and speeds ahead of a block, from those of a row.
#[inline(always)]
fn block<const W: usize>([spacings, speeds]: [&[f64]; 2], from: usize) -> [Lanes<W>; 3] {
    let speeds = &speeds[from..][..W + 1];
    [Lanes::of(&spacings[from..]), Lanes::of(speeds), Lanes::of(&speeds[1..])]
}

/// Numbers that begin where a line of the cache does: what lies across two of them is read and written in two goes.
#[derive(Clone, Debug, Default)]
struct Aligned {
    memory: Vec<f64>,
    begin: usize,
}

/// Doubles of a line.
const LINE: usize = 8;

impl Aligned {
    fn reserve(&mut self, length: usize) {
        self.memory.resize(length + LINE - 1, 0.0);
        let begin = self.memory.as_ptr().align_offset(LINE * size_of::<f64>());
        // where that is not known, anywhere will do
        self.begin = if begin < LINE { begin } else { 0 };
    }

    #[inline(always)]
    fn numbers(&self) -> &[f64] {
        &self.memory[self.begin..]
    }

    #[inline(always)]
    fn numbers_mut(&mut self) -> &mut [f64] {
        &mut self.memory[self.begin..]
    }
}

impl<const W: usize> InBlocks<W> {
    /// Allocates histories of this size for each block of `n` pedestrians.
    fn reserve(&mut self, n: usize, size: usize) {
        let needed = n.div_ceil(W) * size;
        if self.histories.len() < needed {
            self.histories.resize(needed, Block::default());
        }
        self.now.reserve(n.max(W));
        self.next.reserve(n.max(W));
    }

    /// Takes a row of the coefficients, to which something is added; behind the last pedestrian, once more the last.
    #[inline(always)]
    fn take(&mut self, spacings: &[f64], speeds: &[f64], flow: Flow) {
        let n = spacings.len();
        let [own_spacings, own_speeds] = self.now.numbers_mut();
        for (own, spacing) in own_spacings.iter_mut().zip(spacings) {
            *own = spacing + flow.net_gap;
        }
        for (own, speed) in own_speeds.iter_mut().zip(speeds) {
            *own = speed + flow.speed;
        }
        let last = own_spacings[n - 1];
        own_spacings[n..].fill(last);
        own_speeds[n..].fill(speeds[0] + flow.speed);
    }

    /// Advances to the next order, which is known, of a ring of `n` pedestrians.
    #[inline(always)]
    fn advance(&mut self, n: usize) {
        std::mem::swap(&mut self.now, &mut self.next);
        let speeds = self.now.speeds.numbers_mut();
        speeds[n] = speeds[0];
    }
}

/// The first pedestrian of a block. The last block begins earlier instead of being cut short: values computed twice are
/// equal.
#[inline(always)]
fn begin<const W: usize>(block: usize, n: usize) -> usize {
    let (from, last) = (block * W, n.saturating_sub(W));
    if from < last { from } else { last }
}

/// Writes a block to a row, if it is as long as that.
#[inline(always)]
fn write<const W: usize>(row: &mut [f64], from: usize, block: Lanes<W>) {
    if let Some(part) = row[from..].first_chunk_mut::<W>() {
        *part = block.0;
    }
}

/// The coefficients under a law, with the number of operations that store values. False, and nothing is done, where
/// they are not compiled: along a uniform flow that changes, and for laws with terms that the runs of the paper do not
/// have on a processor without wide registers.
pub(super) fn compiled<L: Law>(law: L, operations: usize, motion: &mut Motion<'_>, memory: &mut Memory) -> bool {
    if motion.along.is_some() {
        return false;
    }
    if law.plain().is_none() {
        let memory = &mut memory.narrow;
        return dispatch_wide(Coefficients::<L, false, NARROW> { law, operations, motion, memory }).is_some();
    }
    dispatch_either(
        (motion, memory),
        |(motion, memory)| {
            let memory = &mut memory.narrow;
            Coefficients::<L, true, NARROW> { law, operations, motion, memory }
        },
        |(motion, memory)| {
            let memory = &mut memory.wide;
            Coefficients::<L, true, WIDE> { law, operations, motion, memory }
        },
    );
    true
}

/// Under the law in its [plain](Law::plain) form if `PLAIN`.
struct Coefficients<'a, 'b, L, const PLAIN: bool, const W: usize> {
    law: L,
    operations: usize,
    motion: &'a mut Motion<'b>,
    memory: &'a mut InBlocks<W>,
}

impl<L: Law, const PLAIN: bool, const W: usize> Kernel for Coefficients<'_, '_, L, PLAIN, W> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let law = self.law;
        if !PLAIN {
            self.of(&law);
        } else if let Some(law) = law.plain() {
            self.of(&law);
        }
    }
}

impl<L: Law, const PLAIN: bool, const W: usize> Coefficients<'_, '_, L, PLAIN, W> {
    #[inline(always)]
    fn of(self, law: &L) {
        let Motion { flow, pedestrians: n, order, unit, dimension, .. } = *self.motion;
        let coefficients = &mut *self.motion.coefficients;
        let (memory, blocks, size) = (self.memory, n.div_ceil(W), self.operations * series::memory(order));
        let (states, rates) = coefficients.split_at_mut(dimension);
        memory.reserve(n, size);
        memory.take(&states[..n], &states[n..2 * n], flow);
        for index in 0..blocks {
            let place = OrderMemory::new(&memory.histories[index * size..(index + 1) * size], order, 0);
            let [s, v, w] = block(memory.now.numbers(), begin::<W>(index, n));
            law.acceleration::<Jet<Lanes<W>, true>>(place.variable(s), place.variable(v), place.variable(w));
        }
        memory.take(&rates[..n], &rates[n..2 * n], NOTHING);
        for (k, row) in (1..order).zip(coefficients.chunks_exact_mut(dimension).skip(2)) {
            let share = unit / (k + 1) as f64;
            let (spacings, speeds) = row[..2 * n].split_at_mut(n);
            let InBlocks { histories, now, next } = &mut *memory;
            let (now, next, mut left) = (now.numbers(), next.numbers_mut(), &histories[..]);
            for index in 0..blocks {
                // else the compiler keeps a pointer for each sum, and advances a dozen of them in memory for every
                // block
                let (own, others) = std::hint::black_box(left).split_at(size);
                left = others;
                let (from, place) = (begin::<W>(index, n), OrderMemory::new(own, order, k));
                let [s, v, w] = block::<W>(now, from);
                let next_spacings = (w - v) * share;
                let (s, v, w) = (place.variable::<false>(s), place.variable(v), place.variable(w));
                let next_speeds = law.acceleration(s, v, w).coefficient() * share;
                write(spacings, from, next_spacings);
                write(speeds, from, next_speeds);
                write(next[0], from, next_spacings);
                write(next[1], from, next_speeds);
            }
            memory.advance(n);
            if n < W {
                let [own_spacings, own_speeds] = memory.now.numbers();
                spacings.copy_from_slice(&own_spacings[..n]);
                speeds.copy_from_slice(&own_speeds[..n]);
            }
        }
    }
}
