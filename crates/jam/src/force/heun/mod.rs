//! Many steps of Heun's scheme in positions and speeds at once. This is the scheme of the paper, whose runs have up to
//! 3e8 steps.
//!
//! The same sums in the same order as the general method makes them, so the same bits. What makes it fast: all steps of
//! a batch run in one function, on arrays that stay in the first-level cache ([`segment`]). Rings too large for a cache
//! go through it block by block, each many steps at a time ([`blocks`]).

mod blocks;
mod segment;

pub use blocks::Cut;

use super::Steps;
use crate::laws::{Law, Model};
use crate::ring::Ring;
use blocks::in_blocks;
use math::row::LANES;
use math::simd::{Kernel, Width, dispatch_up_to};
use ode::Batch;
use segment::{Scheme, Segment};

/// Makes steps of the state `[x_0 .. x_{N-1}, v_0 .. v_{N-1}]`. An eventful batch leaves the state untouched.
pub(super) fn batch<L: Law>(law: &L, steps: Steps, cut: Option<Cut>, state: &mut [f64]) -> Batch {
    let mut new = state.to_vec();
    let is_quiet_within = match cut {
        Some(cut) => in_blocks(*law, steps, cut, &mut new),
        None => dispatch_up_to(steps.limit, InOne { law: *law, steps, state: &mut new }),
    };
    if is_quiet_within && is_quiet(law, steps.length, &new) {
        state.copy_from_slice(&new);
        Batch::Done
    } else {
        Batch::NeedsInspection
    }
}

/// Makes `count` steps of length `h` of the state `[x_0 .. x_{N-1}, v_0 .. v_{N-1}]` of a ring in one piece or cut,
/// with registers no wider than `limit`. For tests and measurements: neither affects a bit, and
/// [`Positions`](crate::states::Positions) chooses the best.
pub fn heun_steps(
    model: &Model,
    ring: Ring,
    (h, count): (f64, u64),
    state: &mut [f64],
    cut: Option<Cut>,
    limit: Width,
) -> Batch {
    model.force().heun(Steps { length: ring.length, h, count, limit }, cut, state)
}

/// All pedestrians at once. Behind the last stand images of the first ones, one ring length ahead, so that the
/// neighbour ahead is the next element, and the elements fill whole registers: the loops have no exception and no
/// remainder. Before every evaluation two images are renewed: the one whom the last pedestrian follows, and the last
/// one; those between follow that. They are not used, but are close enough to their true places not to trigger an
/// event.
struct InOne<'a, L> {
    law: L,
    steps: Steps,
    state: &'a mut [f64],
}

impl<L: Law> Kernel for InOne<'_, L> {
    type Output = bool;

    #[inline(always)]
    fn run(self) -> bool {
        let law = self.law;
        match law.plain() {
            Some(plain) if !plain.is_long() => self.steps(&plain, None),
            _ => {
                let in_rows = Some(self.steps.limit);
                self.steps(&law, in_rows)
            }
        }
    }
}

impl<L: Law> InOne<'_, L> {
    #[inline(always)]
    fn steps(self, law: &L, in_rows: Option<Width>) -> bool {
        let Steps { length, h, count, .. } = self.steps;
        let scheme = Scheme { law, in_rows, h };
        let n = self.state.len() / 2;
        let size = n.next_multiple_of(LANES);
        let mut segment = Segment::new(size);
        let (positions, speeds) = self.state.split_at_mut(n);
        segment.now.positions[..n].copy_from_slice(positions);
        segment.now.speeds[..n].copy_from_slice(speeds);
        let place = |image: usize| (image % n, (image / n) as f64 * length);
        for image in n..size {
            segment.now.fill_ghost(image, place(image).0, place(image).1);
        }
        let (last, turns) = place(size);
        for _ in 0..count {
            segment.now.fill_ghost(n, 0, length);
            segment.now.fill_ghost(size, last, turns);
            if !segment.predict(scheme, 0..size) {
                return false;
            }
            segment.guess.fill_ghost(n, 0, length);
            segment.guess.fill_ghost(size, last, turns);
            segment.correct(scheme, 0..size);
        }
        positions.copy_from_slice(&segment.now.positions[..n]);
        speeds.copy_from_slice(&segment.now.speeds[..n]);
        true
    }
}

/// Whether all gaps are open and no speed is negative; false for NaN.
fn is_quiet<L: Law>(law: &L, length: f64, state: &[f64]) -> bool {
    let (x, v) = state.split_at(state.len() / 2);
    let last = x.len() - 1;
    let is_quiet = |i: usize, ahead: f64, v_ahead: f64| {
        let room = law.effective_gap(ahead - x[i] - L::CONTACT, v[i], v_ahead);
        (room >= 0.0) & (v[i] >= 0.0)
    };
    (0..last).all(|i| is_quiet(i, x[i + 1], v[i + 1])) && is_quiet(last, x[0] + length, v[0])
}
