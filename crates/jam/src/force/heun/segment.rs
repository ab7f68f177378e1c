//! A segment of the ring, in which each pedestrian follows the next element, and the two halves of a Heun step.

use crate::force::compiled::{Row, accelerations};
use crate::laws::Law;
use math::row::LENGTH;
use math::simd::Width;
use std::ops::Range;

/// Positions and speeds in order along the segment.
pub(super) struct Places {
    pub(super) positions: Vec<f64>,
    pub(super) speeds: Vec<f64>,
}

impl Places {
    fn new(size: usize) -> Places {
        Places { positions: vec![0.0; size], speeds: vec![0.0; size] }
    }

    /// Fills a place with the ghost of the pedestrian in another place, shifted ahead by the given distance.
    #[inline(always)]
    pub(super) fn fill_ghost(&mut self, image: usize, of: usize, ahead: f64) {
        self.positions[image] = self.positions[of] + ahead;
        self.speeds[image] = self.speeds[of];
    }
}

/// A segment with room for a step.
pub(super) struct Segment {
    /// The pedestrians, and one place more for whom the last one follows.
    pub(super) now: Places,
    /// Where an Euler step leads.
    pub(super) guess: Places,
    accelerations: Vec<f64>,
    /// Net gaps of some pedestrians, and their accelerations.
    net_gaps: [f64; LENGTH],
    row: [f64; LENGTH],
}

/// A law at work: how, and with which length of a step.
#[derive(Clone, Copy)]
pub(super) struct Scheme<'a, L> {
    /// The law.
    pub(super) law: &'a L,
    /// Whether accelerations are computed in a function of its own, blocks of pedestrians at a time, with registers no
    /// wider than this; short laws are computed where they are used.
    pub(super) in_rows: Option<Width>,
    /// Length of a step.
    pub(super) h: f64,
}

impl Segment {
    /// A segment for a number of pedestrians.
    pub(super) fn new(size: usize) -> Segment {
        let (now, guess) = (Places::new(size + 1), Places::new(size + 1));
        Segment { now, guess, accelerations: vec![0.0; size], net_gaps: [0.0; LENGTH], row: [0.0; LENGTH] }
    }

    /// The accelerations now, and the state that an Euler step would reach. False if one of these pedestrians has no
    /// room or a negative speed; what is not a number may pass for quiet.
    #[inline(always)]
    pub(super) fn predict<L: Law>(&mut self, scheme: Scheme<'_, L>, range: Range<usize>) -> bool {
        let Segment { now, guess, accelerations, net_gaps, row } = self;
        let mut signs = 0;
        for begin in range.clone().step_by(LENGTH) {
            let (here, next) = (begin..range.end.min(begin + LENGTH), begin + 1..range.end.min(begin + LENGTH) + 1);
            let (x, ahead) = (&now.positions[here.clone()], &now.positions[next.clone()]);
            let (v, v_ahead) = (&now.speeds[here.clone()], &now.speeds[next.clone()]);
            accelerate(scheme, (x, ahead), &now.speeds[begin..next.end], net_gaps, row);
            let (x_guess, v_guess) = (&mut guess.positions[here.clone()], &mut guess.speeds[here.clone()]);
            signs |= euler(scheme, x, ahead, v, v_ahead, row, &mut accelerations[here], x_guess, v_guess);
        }
        signs >> 63 == 0
    }

    /// The step with the mean of the rates at both ends.
    #[inline(always)]
    pub(super) fn correct<L: Law>(&mut self, scheme: Scheme<'_, L>, range: Range<usize>) {
        let Segment { now, guess, accelerations, net_gaps, row } = self;
        for begin in range.clone().step_by(LENGTH) {
            let (here, next) = (begin..range.end.min(begin + LENGTH), begin + 1..range.end.min(begin + LENGTH) + 1);
            let (x_guess, ahead) = (&guess.positions[here.clone()], &guess.positions[next.clone()]);
            let (v_guess, v_ahead) = (&guess.speeds[here.clone()], &guess.speeds[next.clone()]);
            accelerate(scheme, (x_guess, ahead), &guess.speeds[begin..next.end], net_gaps, row);
            let (x, v) = (&mut now.positions[here.clone()], &mut now.speeds[here.clone()]);
            heun(scheme, x_guess, ahead, v_guess, v_ahead, row, &accelerations[here], x, v);
        }
    }
}

/// For a law in rows, fills a row with accelerations; others are computed where they are used. The speeds are one more.
#[inline(always)]
fn accelerate<L: Law>(
    scheme: Scheme<'_, L>,
    (x, ahead): (&[f64], &[f64]),
    speeds: &[f64],
    net_gaps: &mut [f64; LENGTH],
    row: &mut [f64; LENGTH],
) {
    if let Some(limit) = scheme.in_rows {
        let n = x.len();
        for ((net_gap, x), ahead) in net_gaps.iter_mut().zip(x).zip(ahead) {
            *net_gap = ahead - x - L::CONTACT;
        }
        let own = Row { net_gaps: &net_gaps[..n], speeds, ahead_of_last: speeds[n] };
        accelerations(scheme.law, limit, own, &mut row[..n]);
    }
}

/// An Euler step from `x`, `v`. The sign bit of the result is set if a gap is closed or a speed is negative: combining
/// signs is cheaper than comparing.
#[inline(always)]
#[expect(clippy::too_many_arguments, reason = "only slices that are arguments are known not to overlap")]
fn euler<L: Law>(
    scheme: Scheme<'_, L>,
    x: &[f64],
    ahead: &[f64],
    v: &[f64],
    v_ahead: &[f64],
    row: &[f64; LENGTH],
    accelerations: &mut [f64],
    x_guess: &mut [f64],
    v_guess: &mut [f64],
) -> u64 {
    let Scheme { law, in_rows, h } = scheme;
    let n = x.len();
    let (ahead, v, v_ahead, row) = (&ahead[..n], &v[..n], &v_ahead[..n], &row[..n]);
    let (accelerations, x_guess, v_guess) = (&mut accelerations[..n], &mut x_guess[..n], &mut v_guess[..n]);
    let mut signs = 0;
    for i in 0..n {
        let net_gap = ahead[i] - x[i] - L::CONTACT;
        let a = if in_rows.is_some() { row[i] } else { law.acceleration(net_gap, v[i], v_ahead[i]) };
        accelerations[i] = a;
        x_guess[i] = x[i] + h * v[i];
        v_guess[i] = v[i] + h * a;
        signs |= law.effective_gap(net_gap, v[i], v_ahead[i]).to_bits() | v[i].to_bits();
    }
    signs
}

/// The step of `x`, `v` with the mean of the accelerations there and at the guess.
#[inline(always)]
#[expect(clippy::too_many_arguments, reason = "only slices that are arguments are known not to overlap")]
fn heun<L: Law>(
    scheme: Scheme<'_, L>,
    x_guess: &[f64],
    ahead: &[f64],
    v_guess: &[f64],
    v_ahead: &[f64],
    row: &[f64; LENGTH],
    accelerations: &[f64],
    x: &mut [f64],
    v: &mut [f64],
) {
    let Scheme { law, in_rows, h } = scheme;
    let n = x.len();
    let (x_guess, v_guess, accelerations) = (&x_guess[..n], &v_guess[..n], &accelerations[..n]);
    let (ahead, v_ahead, row, v) = (&ahead[..n], &v_ahead[..n], &row[..n], &mut v[..n]);
    for i in 0..n {
        let net_gap = ahead[i] - x_guess[i] - L::CONTACT;
        let a = if in_rows.is_some() { row[i] } else { law.acceleration(net_gap, v_guess[i], v_ahead[i]) };
        x[i] += h * (0.5 * v[i] + 0.5 * v_guess[i]);
        v[i] += h * (0.5 * accelerations[i] + 0.5 * a);
    }
}
