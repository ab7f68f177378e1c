//! Taylor coefficients of a motion, for laws whose force depends on the gap alone.
//!
//! With gaps `s_n = sum u_k t^k` and speeds `v_n = sum w_k t^k`, the equations give `(k + 1) u_{k+1} = w_k(ahead) - w_k`
//! and `(k + 1) w_{k+1} = f_k - w_k`, where `f_k` is the coefficient of the force along the motion (drive included). A law
//! finds it by recurrence from those of the gap, as an elementary function solves a differential equation of its own
//! (R. E. Moore, *Interval Analysis*, 1966, chapter 11; E. Hairer, S. P. Norsett, G. Wanner, *Solving Ordinary
//! Differential Equations I*, section I.8). An order costs a law a few sums of products; no stage is evaluated.

use crate::laws::Law;
use math::simd::Kernel;

/// So many pedestrians are worked on at a time.
pub const LANES: usize = 16;

/// One number for each of them.
pub type Block = [f64; LANES];

/// Applies a function lane by lane.
#[inline(always)]
pub fn lanes(value: impl Fn(usize) -> f64) -> Block {
    let mut block = [0.0; LANES];
    for (lane, own) in block.iter_mut().enumerate() {
        *own = value(lane);
    }
    block
}

/// `a_1 b_{k-1} + ... + a_{k-1} b_1` where the terms are those of orders 0 to k - 1: the `k`-th coefficient of the
/// product of two series, less its ends.
#[inline(always)]
pub fn inner_product<T>(terms: &[T], a: impl Fn(&T) -> &Block, b: impl Fn(&T) -> &Block) -> Block {
    let mut sum = [0.0; LANES];
    for (there, back) in terms[1..].iter().zip(terms[1..].iter().rev()) {
        let (a, b) = (a(there), b(back));
        for ((sum, a), b) in sum.iter_mut().zip(a).zip(b) {
            *sum += a * b;
        }
    }
    sum
}

/// The coefficients of gaps and speeds of a ring from their rows 0 and 1.
pub(crate) struct Motion<'a, L: Law> {
    pub(crate) law: L,
    pub(crate) pedestrians: usize,
    /// What is added to a gap coefficient of order 0 to make a clearance.
    pub(crate) clearance: f64,
    pub(crate) order: usize,
    /// Unit of time: coefficients are those of powers of the time divided by it.
    pub(crate) unit: f64,
    /// Length of a row.
    pub(crate) dimension: usize,
    /// Rows `[u_0 .. u_{N-1}, w_0 .. w_{N-1}, ...]`, one for each order: 0 and 1 are given, the others written.
    pub(crate) coefficients: &'a mut [f64],
    pub(crate) workspace: &'a mut Workspace<L::Terms>,
}

/// Room that is kept from step to step. Rows are whole blocks: behind the last pedestrian the first follows, as the
/// neighbour ahead, and numbers without meaning that nothing reads but others of their kind.
#[derive(Clone, Debug, Default)]
pub(crate) struct Workspace<T> {
    /// The terms of one block of pedestrians after another.
    terms: Vec<T>,
    /// Coefficients of one order, and of the next.
    gaps: Vec<f64>,
    speeds: Vec<f64>,
    next_speeds: Vec<f64>,
}

impl<T: Copy + Default> Workspace<T> {
    /// Takes row 1 of the coefficients.
    fn start(&mut self, order: usize, gaps: &[f64], speeds: &[f64]) {
        let n = gaps.len();
        let blocks = n.div_ceil(LANES);
        self.terms.resize(blocks * order, T::default());
        self.gaps.resize(blocks * LANES, 0.0);
        // one more, for the neighbour ahead of the last lane
        self.speeds.resize(blocks * LANES + 1, 0.0);
        self.next_speeds.resize(blocks * LANES + 1, 0.0);
        self.gaps[..n].copy_from_slice(gaps);
        self.speeds[..n].copy_from_slice(speeds);
        self.speeds[n] = speeds[0];
    }

    /// Goes on to the next order, whose speeds are there.
    #[inline(always)]
    fn advance(&mut self, n: usize, share: f64) {
        for ((gap, own), ahead) in self.gaps.iter_mut().zip(&self.speeds).zip(&self.speeds[1..]) {
            *gap = (ahead - own) * share;
        }
        std::mem::swap(&mut self.speeds, &mut self.next_speeds);
        self.speeds[n] = self.speeds[0];
    }
}

impl<L: Law> Kernel for Motion<'_, L> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Motion { law, pedestrians: n, clearance, order, unit, dimension, coefficients, workspace } = self;
        let (states, rates) = coefficients.split_at(dimension);
        workspace.start(order, &rates[..n], &rates[n..2 * n]);
        for (block, terms) in workspace.terms.chunks_exact_mut(order).enumerate() {
            let rest = &states[block * LANES..n];
            // behind the last pedestrian, once more the last
            let clearances = lanes(|lane| rest[if lane < rest.len() { lane } else { rest.len() - 1 }] + clearance);
            law.start_terms(&clearances, &mut terms[0]);
        }
        for k in 1..order {
            let share = unit / (k + 1) as f64;
            let (gaps, _) = workspace.gaps.as_chunks::<LANES>();
            let (speeds, _) = workspace.speeds.as_chunks::<LANES>();
            let (next_speeds, _) = workspace.next_speeds.as_chunks_mut::<LANES>();
            let blocks = workspace.terms.chunks_exact_mut(order).zip(gaps).zip(speeds).zip(next_speeds);
            for (((terms, gap), speed), next_speed) in blocks {
                let (earlier, later) = terms.split_at_mut(k);
                let force = law.next_terms(earlier, gap, &mut later[0]);
                *next_speed = lanes(|lane| (force[lane] - speed[lane]) * share);
            }
            workspace.advance(n, share);
            let row = &mut coefficients[(k + 1) * dimension..];
            row[..n].copy_from_slice(&workspace.gaps[..n]);
            row[n..2 * n].copy_from_slice(&workspace.speeds[..n]);
        }
    }
}
