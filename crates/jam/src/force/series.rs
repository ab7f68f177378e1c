//! Taylor coefficients of a motion.
//!
//! With spacings `s_n = sum u_k t^k` and speeds `v_n = sum w_k t^k`, the equations give `(k + 1) u_{k+1} = w_k(ahead) - w_k`
//! and `(k + 1) w_{k+1} = a_k`, where `a_k` is the coefficient of the acceleration along the motion, which the formula
//! gives from those of spacing and speeds up to the order `k` ([`math::series`]). An order costs a few sums of products;
//! no stage is evaluated.

use super::compiled::WIDEST;
use super::{Flow, NOTHING};
use crate::laws::Law;
use math::lanes::Lanes;
use math::series::{Block, Jet, Place, ROWS};
use math::simd::{Kernel, dispatch, dispatch_up_to};

/// The coefficients of spacings and speeds of a ring, from their rows 0 and 1.
#[derive(Debug)]
pub struct Motion<'a> {
    /// What is added to spacings and speeds of order 0: those of the uniform flow, if the rows hold deviations from it.
    pub flow: Flow,
    /// Where in a row the speed of that flow stands, whose coefficients are then written, too, and those of the deviations
    /// without cancellation. `None` where the flow is steady, or the force does not depend on speeds.
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

/// Pedestrians per iteration.
const W: usize = 24;

/// Memory that is kept from step to step. Rows are whole blocks: behind the last pedestrian the first follows, as the
/// neighbour ahead, and numbers without meaning that nothing reads but others of their kind.
#[derive(Clone, Debug, Default)]
pub struct Memory {
    /// What the operations keep, one block of pedestrians after another.
    histories: Vec<Block<Lanes<W>>>,
    /// Coefficients of one order, and of the next.
    spacings: Vec<f64>,
    speeds: Vec<f64>,
    next_speeds: Vec<f64>,
}

impl Memory {
    /// Makes room for so many blocks, with histories of this size.
    fn reserve(&mut self, blocks: usize, size: usize) {
        if self.histories.len() < blocks * size {
            self.histories.resize(blocks * size, Block::default());
        }
        self.spacings.resize(blocks * W, 0.0);
        // one more, for the neighbour ahead of the last lane
        self.speeds.resize(blocks * W + 1, 0.0);
        self.next_speeds.resize(blocks * W + 1, 0.0);
    }

    /// Takes a row of the coefficients, to which something is added; behind the last pedestrian, once more the last.
    #[inline(always)]
    fn take(&mut self, spacings: &[f64], speeds: &[f64], flow: Flow) {
        let n = spacings.len();
        for (own, spacing) in self.spacings.iter_mut().zip(spacings) {
            *own = spacing + flow.net_gap;
        }
        for (own, speed) in self.speeds.iter_mut().zip(speeds) {
            *own = speed + flow.speed;
        }
        let last = self.spacings[n - 1];
        self.spacings[n..].fill(last);
        self.speeds[n..].fill(speeds[0] + flow.speed);
    }

    /// Spacings, speeds and speeds ahead of a block.
    #[inline(always)]
    fn variables(&self, from: usize) -> [Lanes<W>; 3] {
        [&self.spacings[from..], &self.speeds[from..], &self.speeds[from + 1..]].map(Lanes::of)
    }

    /// Goes on to the next order, whose speeds are there; writes its spacings to `row`, too.
    #[inline(always)]
    fn advance(&mut self, share: f64, row: &mut [f64]) {
        let n = row.len();
        let pairs = self.speeds.iter().zip(&self.speeds[1..]);
        for ((spacing, written), (own, ahead)) in self.spacings.iter_mut().zip(row).zip(pairs) {
            *spacing = (ahead - own) * share;
            *written = *spacing;
        }
        let pairs = self.speeds.iter().zip(&self.speeds[1..]);
        for (spacing, (own, ahead)) in self.spacings.iter_mut().zip(pairs).skip(n) {
            *spacing = (ahead - own) * share;
        }
        std::mem::swap(&mut self.speeds, &mut self.next_speeds);
        self.speeds[n] = self.speeds[0];
    }
}

/// The coefficients under a law, of which so many operations keep something.
pub(super) fn compiled<L: Law>(law: L, operations: usize, motion: Motion<'_>, memory: &mut Memory) {
    if law.plain().is_some() {
        dispatch(Coefficients::<L, true> { law, operations, motion, memory });
    } else {
        dispatch_up_to(WIDEST, Coefficients::<L, false> { law, operations, motion, memory });
    }
}

/// Under the law in its [plain](Law::plain) form if `PLAIN`.
struct Coefficients<'a, 'b, L, const PLAIN: bool> {
    law: L,
    operations: usize,
    motion: Motion<'b>,
    memory: &'a mut Memory,
}

impl<L: Law, const PLAIN: bool> Kernel for Coefficients<'_, '_, L, PLAIN> {
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

impl<L: Law, const PLAIN: bool> Coefficients<'_, '_, L, PLAIN> {
    #[inline(always)]
    fn of(self, law: &L) {
        let Motion { flow, pedestrians: n, order, unit, dimension, coefficients, .. } = self.motion;
        let (memory, blocks, size) = (self.memory, n.div_ceil(W), self.operations * ROWS * order);
        let (states, rates) = coefficients.split_at_mut(dimension);
        memory.reserve(blocks, size);
        memory.take(&states[..n], &states[n..2 * n], flow);
        for block in 0..blocks {
            let place = Place::new(&memory.histories[block * size..(block + 1) * size], order, 0);
            let [s, v, w] = memory.variables(block * W);
            law.acceleration::<Jet<Lanes<W>, true>>(place.variable(s), place.variable(v), place.variable(w));
        }
        memory.take(&rates[..n], &rates[n..2 * n], NOTHING);
        for k in 1..order {
            let share = unit / (k + 1) as f64;
            let (spacings, speeds) = coefficients[(k + 1) * dimension..].split_at_mut(n);
            for block in 0..blocks {
                let place = Place::new(&memory.histories[block * size..(block + 1) * size], order, k);
                let [s, v, w] = memory.variables(block * W);
                let (s, v, w) = (place.variable::<false>(s), place.variable(v), place.variable(w));
                let next = law.acceleration(s, v, w).coefficient() * share;
                memory.next_speeds[block * W..(block + 1) * W].copy_from_slice(&next.0);
            }
            speeds[..n].copy_from_slice(&memory.next_speeds[..n]);
            memory.advance(share, spacings);
        }
    }
}
