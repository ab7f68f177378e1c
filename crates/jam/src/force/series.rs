//! Taylor coefficients of a motion.
//!
//! With spacings `s_n = sum u_k t^k` and speeds `v_n = sum w_k t^k`, the equations give `(k + 1) u_{k+1} = w_k(ahead) - w_k`
//! and `(k + 1) w_{k+1} = a_k`, where `a_k` is the coefficient of the acceleration along the motion, which the formula
//! gives from those of spacing and speeds up to the order `k` ([`math::series`]). An order costs a few sums of products;
//! no stage is evaluated.

use super::Flow;
use crate::laws::Law;
use math::lanes::Lanes;
use math::series::{Block, Jet, Place, ROWS};
use math::simd::{Kernel, dispatch};

/// The coefficients of spacings and speeds of a ring, from their rows 0 and 1.
#[derive(Debug)]
pub struct Motion<'a> {
    /// What is added to spacings and speeds of order 0: those of the uniform flow, if the rows hold deviations from it.
    /// Then the speed of that flow is steady, or the force does not depend on speeds.
    pub flow: Flow,
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

/// So many pedestrians at a time.
const W: usize = 24;

/// As many operations that are not linear as a compiled formula has at most.
const OPERATIONS: usize = 4;

/// Memory that is kept from step to step. Rows are whole blocks: behind the last pedestrian the first follows, as the
/// neighbour ahead, and numbers without meaning that nothing reads but others of their kind.
#[derive(Clone, Debug, Default)]
pub struct Memory {
    /// What the operations keep, one block of pedestrians after another.
    histories: Vec<Block<W>>,
    /// Coefficients of one order, and of the next.
    spacings: Vec<f64>,
    speeds: Vec<f64>,
    next_speeds: Vec<f64>,
}

impl Memory {
    /// Takes row 1 of the coefficients.
    fn start(&mut self, order: usize, spacings: &[f64], speeds: &[f64]) {
        let n = spacings.len();
        let blocks = n.div_ceil(W);
        let histories = blocks * OPERATIONS * ROWS * order;
        if self.histories.len() < histories {
            self.histories.resize(histories, Block::default());
        }
        self.spacings.resize(blocks * W, 0.0);
        // one more, for the neighbour ahead of the last lane
        self.speeds.resize(blocks * W + 1, 0.0);
        self.next_speeds.resize(blocks * W + 1, 0.0);
        self.spacings[..n].copy_from_slice(spacings);
        self.speeds[..n].copy_from_slice(speeds);
        self.speeds[n] = speeds[0];
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

/// The coefficients under a law that is compiled.
pub(super) fn compiled<L: Law>(law: L, motion: Motion<'_>, memory: &mut Memory) {
    dispatch(Coefficients { law, motion, memory });
}

struct Coefficients<'a, 'b, L> {
    law: L,
    motion: Motion<'a>,
    memory: &'b mut Memory,
}

impl<L: Law> Kernel for Coefficients<'_, '_, L> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let law = self.law;
        match law.plain() {
            Some(plain) => self.of(&plain),
            None => self.of(&law),
        }
    }
}

impl<L: Law> Coefficients<'_, '_, L> {
    #[inline(always)]
    fn of(self, law: &L) {
        let Motion { flow, pedestrians: n, order, unit, dimension, coefficients } = self.motion;
        let memory = self.memory;
        let size = OPERATIONS * ROWS * order;
        let (states, rates) = coefficients.split_at_mut(dimension);
        memory.start(order, &rates[..n], &rates[n..2 * n]);
        let blocks = n.div_ceil(W);
        for (block, histories) in memory.histories.chunks_exact(size).take(blocks).enumerate() {
            let (spacing, speed, ahead) = start(&states[..n], &states[n..2 * n], block * W);
            let place = Place::new(histories, order, 0);
            let [s, v, w] = [spacing + flow.net_gap, speed + flow.speed, ahead + flow.speed];
            law.acceleration::<Jet<W, true>>(place.variable(s), place.variable(v), place.variable(w));
        }
        for k in 1..order {
            let share = unit / (k + 1) as f64;
            let (spacings, row) = coefficients[(k + 1) * dimension..].split_at_mut(n);
            for (block, histories) in memory.histories.chunks_exact(size).take(blocks).enumerate() {
                let from = block * W;
                let place = Place::new(histories, order, k);
                let s = place.variable::<false>(Lanes::of(&memory.spacings[from..]));
                let v = place.variable(Lanes::of(&memory.speeds[from..]));
                let w = place.variable(Lanes::of(&memory.speeds[from + 1..]));
                let acceleration = law.acceleration(s, v, w).coefficient();
                let speeds = acceleration * share;
                memory.next_speeds[from..from + W].copy_from_slice(&speeds.0);
                if let Some(written) = row[..n].get_mut(from..from + W) {
                    written.copy_from_slice(&speeds.0);
                }
            }
            let last = n - n % W;
            row[last..n].copy_from_slice(&memory.next_speeds[last..n]);
            memory.advance(share, spacings);
        }
    }
}

/// Spacings, speeds and speeds ahead of a block; behind the last pedestrian, once more the last.
#[inline(always)]
fn start(spacings: &[f64], speeds: &[f64], from: usize) -> (Lanes<W>, Lanes<W>, Lanes<W>) {
    let n = spacings.len();
    if from + W < n {
        return (Lanes::of(&spacings[from..]), Lanes::of(&speeds[from..]), Lanes::of(&speeds[from + 1..]));
    }
    let place = |lane: usize| if from + lane < n { from + lane } else { n - 1 };
    let next = |own: usize| if own + 1 < n { own + 1 } else { 0 };
    (
        Lanes(std::array::from_fn(|lane| spacings[place(lane)])),
        Lanes(std::array::from_fn(|lane| speeds[place(lane)])),
        Lanes(std::array::from_fn(|lane| speeds[next(place(lane))])),
    )
}
