//! Taylor coefficients of a motion.
//!
//! With spacings `s_n = sum u_k t^k` and speeds `v_n = sum w_k t^k`, the equations give `(k + 1) u_{k+1} = w_k(ahead) - w_k`
//! and `(k + 1) w_{k+1} = a_k`, where `a_k` is the coefficient of the acceleration along the motion, which the formula
//! gives from those of spacing and speeds up to the order `k` ([`math::series`]). An order costs a few sums of products;
//! no stage is evaluated.
//!
//! The sums read all that the operations have kept, so this has to stay in the first-level cache. A ring for which it does
//! goes through order by order. A larger one is cut into pieces, each of which goes through all orders: it needs those of
//! the pedestrian ahead of it and nothing else, so the pieces follow each other against the direction of walking. The
//! first of them needs those of pedestrian 0: these come from a piece for which nobody is known to be ahead. What is unknown
//! there spoils one pedestrian more with every order, and does not come to pedestrian 0.

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

/// Pedestrians per iteration; more than there are orders, so that what spoils a pedestrian an order does not come through.
const W: usize = 24;

/// As many operations that are not linear as a compiled formula has at most.
const OPERATIONS: usize = 4;

/// The first-level cache. The rows of a piece that are read for every order fit in it, unless those of one block do not.
const CACHE: usize = 32 << 10;

/// So many of the rows of an operation are read for every order.
const READ: usize = 3;

/// Memory that is kept from step to step. Rows are whole blocks: behind the last pedestrian of a ring the first follows,
/// as the neighbour ahead, and numbers without meaning that nothing reads but others of their kind.
#[derive(Clone, Debug, Default)]
pub struct Memory {
    /// What the operations keep, one block of pedestrians after another.
    histories: Vec<Block<W>>,
    /// Coefficients of one order, and of the next; of speeds one more, for the neighbour ahead of the last lane.
    spacings: Vec<f64>,
    speeds: Vec<f64>,
    next_speeds: Vec<f64>,
}

/// Who is ahead of the last pedestrian of a piece.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Ahead {
    /// Its first: the piece is the ring.
    First,
    /// Somebody whose coefficients are there.
    Known,
    /// Somebody whose coefficients are not there yet; of the piece only the first pedestrian is wanted.
    Unknown,
}

/// Neighbours whose coefficients are computed together.
#[derive(Clone, Copy)]
struct Piece {
    from: usize,
    count: usize,
    ahead: Ahead,
}

/// The coefficients under a law that is compiled, which has so many operations that keep something.
pub(super) fn compiled<L: Law>(law: L, operations: usize, motion: Motion<'_>, memory: &mut Memory) {
    assert!(motion.order <= W, "what is unknown of a piece spoils no more than {W} orders");
    dispatch(Coefficients { law, operations, motion, memory });
}

struct Coefficients<'a, 'b, L> {
    law: L,
    operations: usize,
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
    fn of(mut self, law: &L) {
        let (n, order) = (self.motion.pedestrians, self.motion.order);
        let used = self.operations * READ * order * size_of::<Block<W>>();
        let fitting = if used < CACHE { CACHE / used } else { 1 };
        let size = fitting * W;
        let is_whole = n <= size;
        let count = if is_whole { n } else { size };
        // counted from the last piece; the last that is carried out begins with pedestrian 0, and may do some once more
        let pieces = if is_whole { 0 } else { n.div_ceil(size) };
        let mut piece = Piece {
            from: 0,
            count: if is_whole { n } else { W },
            ahead: if is_whole { Ahead::First } else { Ahead::Unknown },
        };
        // one place in the program for all of them
        for next in 0..pieces + 1 {
            self.piece(law, piece);
            let from = n.saturating_sub((next + 1) * size);
            piece = Piece { from, count, ahead: Ahead::Known };
        }
    }

    /// Writes the coefficients of a piece, from order 2 on.
    #[inline(always)]
    fn piece(&mut self, law: &L, piece: Piece) {
        let Piece { from, count, ahead } = piece;
        let Motion { flow, pedestrians: n, order, unit, dimension, .. } = self.motion;
        let (coefficients, memory) = (&mut *self.motion.coefficients, &mut *self.memory);
        let blocks = count.div_ceil(W);
        let size = OPERATIONS * ROWS * order;
        let next = if from + count < n { from + count } else { 0 };
        let written = if ahead == Ahead::Unknown { 1 } else { count };
        let (states, rates) = coefficients.split_at_mut(dimension);
        memory.start(blocks, size, &rates[from..from + count], &rates[n + from..n + from + count], rates[n + next]);
        for (block, histories) in memory.histories.chunks_exact(size).take(blocks).enumerate() {
            let (spacing, speed, ahead) = start(&states[..n], &states[n..2 * n], from + block * W);
            let place = Place::new(histories, order, 0);
            let [s, v, w] = [spacing + flow.net_gap, speed + flow.speed, ahead + flow.speed];
            law.acceleration::<Jet<W, true>>(place.variable(s), place.variable(v), place.variable(w));
        }
        for k in 1..order {
            let share = unit / (k + 1) as f64;
            let (spacings, speeds) = coefficients[(k + 1) * dimension..].split_at_mut(n);
            for (block, histories) in memory.histories.chunks_exact(size).take(blocks).enumerate() {
                let lane = block * W;
                let place = Place::new(histories, order, k);
                let s = place.variable::<false>(Lanes::of(&memory.spacings[lane..]));
                let v = place.variable(Lanes::of(&memory.speeds[lane..]));
                let w = place.variable(Lanes::of(&memory.speeds[lane + 1..]));
                let acceleration = law.acceleration(s, v, w).coefficient();
                memory.next_speeds[lane..lane + W].copy_from_slice(&(acceleration * share).0);
            }
            speeds[from..from + written].copy_from_slice(&memory.next_speeds[..written]);
            let speed_ahead = match ahead {
                Ahead::First => memory.next_speeds[0],
                Ahead::Known => speeds[next],
                Ahead::Unknown => 0.0,
            };
            memory.advance(share, count, speed_ahead);
            spacings[from..from + written].copy_from_slice(&memory.spacings[..written]);
        }
    }
}

impl Memory {
    /// Takes row 1 of the coefficients.
    #[inline(always)]
    fn start(&mut self, blocks: usize, size: usize, spacings: &[f64], speeds: &[f64], ahead: f64) {
        let count = spacings.len();
        if self.histories.len() < blocks * size {
            self.histories.resize(blocks * size, Block::default());
        }
        self.spacings.resize(blocks * W, 0.0);
        self.speeds.resize(blocks * W + 1, 0.0);
        self.next_speeds.resize(blocks * W + 1, 0.0);
        self.spacings[..count].copy_from_slice(spacings);
        self.speeds[..count].copy_from_slice(speeds);
        self.speeds[count] = ahead;
    }

    /// Goes on to the next order, whose speeds are there, and the speed ahead of the last.
    #[inline(always)]
    fn advance(&mut self, share: f64, count: usize, ahead: f64) {
        let pairs = self.speeds.iter().zip(&self.speeds[1..]);
        for (spacing, (own, ahead)) in self.spacings.iter_mut().zip(pairs) {
            *spacing = (ahead - own) * share;
        }
        std::mem::swap(&mut self.speeds, &mut self.next_speeds);
        self.speeds[count] = ahead;
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
