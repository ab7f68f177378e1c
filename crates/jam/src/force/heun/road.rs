//! A stretch of road: pedestrians of whom each follows the next element, and the two halves of a step of Heun's scheme.

use crate::laws::Law;
use math::lanes::Lanes;
use std::ops::Range;

/// Positions and speeds in order along the road.
pub(super) struct Places {
    pub(super) positions: Vec<f64>,
    pub(super) speeds: Vec<f64>,
}

impl Places {
    fn new(size: usize) -> Places {
        Places { positions: vec![0.0; size], speeds: vec![0.0; size] }
    }

    /// Fills a place with the image of somebody in another place, that much further ahead.
    #[inline(always)]
    pub(super) fn put_image(&mut self, image: usize, of: usize, ahead: f64) {
        self.positions[image] = self.positions[of] + ahead;
        self.speeds[image] = self.speeds[of];
    }
}

/// A stretch of road with room for a step.
pub(super) struct Road {
    /// The pedestrians, and one place more for whom the last one follows.
    pub(super) now: Places,
    /// Where an Euler step leads.
    pub(super) guess: Places,
    accelerations: Vec<f64>,
}

/// So many pedestrians at a time.
pub(super) const W: usize = 4;

impl Road {
    /// A road for so many pedestrians.
    pub(super) fn new(size: usize) -> Road {
        Road { now: Places::new(size + 1), guess: Places::new(size + 1), accelerations: vec![0.0; size] }
    }

    /// The accelerations now, and the state that an Euler step would reach. False if one of these pedestrians has no room
    /// or a negative speed; what is not a number may pass for quiet.
    #[inline(always)]
    pub(super) fn predict<L: Law>(&mut self, law: &L, h: f64, range: Range<usize>) -> bool {
        let Road { now, guess, accelerations } = self;
        let (here, next) = (range.clone(), range.start + 1..range.end + 1);
        let (x, ahead) = (&now.positions[here.clone()], &now.positions[next.clone()]);
        let (v, v_ahead) = (&now.speeds[here.clone()], &now.speeds[next]);
        let (x_guess, v_guess) = (&mut guess.positions[here.clone()], &mut guess.speeds[here.clone()]);
        euler(law, h, x, ahead, v, v_ahead, &mut accelerations[here], x_guess, v_guess) >> 63 == 0
    }

    /// The step with the mean of the rates at both ends.
    #[inline(always)]
    pub(super) fn correct<L: Law>(&mut self, law: &L, h: f64, range: Range<usize>) {
        let Road { now, guess, accelerations } = self;
        let (here, next) = (range.clone(), range.start + 1..range.end + 1);
        let (x_guess, ahead) = (&guess.positions[here.clone()], &guess.positions[next.clone()]);
        let (v_guess, v_ahead) = (&guess.speeds[here.clone()], &guess.speeds[next]);
        let (x, v) = (&mut now.positions[here.clone()], &mut now.speeds[here.clone()]);
        heun(law, h, x_guess, ahead, v_guess, v_ahead, &accelerations[here], x, v);
    }
}

/// An Euler step from `x`, `v`. The sign bit of what it returns is set if one of the pedestrians has no room or a negative
/// speed: gathering signs is cheaper than comparing.
#[inline(always)]
#[expect(clippy::too_many_arguments, reason = "only slices that are arguments are known not to overlap")]
fn euler<L: Law>(
    law: &L,
    h: f64,
    x: &[f64],
    ahead: &[f64],
    v: &[f64],
    v_ahead: &[f64],
    accelerations: &mut [f64],
    x_guess: &mut [f64],
    v_guess: &mut [f64],
) -> u64 {
    let n = x.len();
    let (ahead, v, v_ahead) = (&ahead[..n], &v[..n], &v_ahead[..n]);
    let (accelerations, x_guess, v_guess) = (&mut accelerations[..n], &mut x_guess[..n], &mut v_guess[..n]);
    let whole = n - n % W;
    let mut signs = [0; W];
    let own = lanes(x).zip(lanes(ahead)).zip(lanes(v)).zip(lanes(v_ahead));
    let results = lanes_mut(accelerations).zip(lanes_mut(x_guess)).zip(lanes_mut(v_guess));
    for ((((x, ahead), v), v_ahead), ((acceleration, x_guess), v_guess)) in own.zip(results) {
        let (x, v, v_ahead) = (Lanes(*x), Lanes(*v), Lanes(*v_ahead));
        let net_gap = Lanes(*ahead) - x - L::CONTACT;
        let a = law.acceleration(net_gap, v, v_ahead);
        *acceleration = a.0;
        *x_guess = (v * h + x).0;
        *v_guess = (a * h + v).0;
        let room = law.effective_gap(net_gap, v, v_ahead);
        for lane in 0..W {
            signs[lane] |= room.0[lane].to_bits() | v.0[lane].to_bits();
        }
    }
    for i in whole..n {
        let net_gap = ahead[i] - x[i] - L::CONTACT;
        let a = law.acceleration(net_gap, v[i], v_ahead[i]);
        accelerations[i] = a;
        x_guess[i] = x[i] + h * v[i];
        v_guess[i] = v[i] + h * a;
        signs[0] |= law.effective_gap(net_gap, v[i], v_ahead[i]).to_bits() | v[i].to_bits();
    }
    signs.into_iter().fold(0, |all, sign| all | sign)
}

/// The step of `x`, `v` with the mean of the accelerations there and at the guess.
#[inline(always)]
#[expect(clippy::too_many_arguments, reason = "only slices that are arguments are known not to overlap")]
fn heun<L: Law>(
    law: &L,
    h: f64,
    x_guess: &[f64],
    ahead: &[f64],
    v_guess: &[f64],
    v_ahead: &[f64],
    accelerations: &[f64],
    x: &mut [f64],
    v: &mut [f64],
) {
    let n = x.len();
    let (x_guess, v_guess, accelerations) = (&x_guess[..n], &v_guess[..n], &accelerations[..n]);
    let (ahead, v_ahead, v) = (&ahead[..n], &v_ahead[..n], &mut v[..n]);
    let whole = n - n % W;
    let guess = lanes(x_guess).zip(lanes(ahead)).zip(lanes(v_guess)).zip(lanes(v_ahead)).zip(lanes(accelerations));
    for (((((x_guess, ahead), v_guess), v_ahead), acceleration), (x, v)) in guess.zip(lanes_mut(x).zip(lanes_mut(v))) {
        let v_guess = Lanes(*v_guess);
        let a = law.acceleration(Lanes(*ahead) - Lanes(*x_guess) - L::CONTACT, v_guess, Lanes(*v_ahead));
        *x = (Lanes(*x) + (Lanes(*v) * 0.5 + v_guess * 0.5) * h).0;
        *v = (Lanes(*v) + (Lanes(*acceleration) * 0.5 + a * 0.5) * h).0;
    }
    for i in whole..n {
        let a = law.acceleration(ahead[i] - x_guess[i] - L::CONTACT, v_guess[i], v_ahead[i]);
        x[i] += h * (0.5 * v[i] + 0.5 * v_guess[i]);
        v[i] += h * (0.5 * accelerations[i] + 0.5 * a);
    }
}

/// The whole blocks of a row.
#[inline(always)]
fn lanes(row: &[f64]) -> std::slice::Iter<'_, [f64; W]> {
    row.as_chunks().0.iter()
}

/// The same, to be written.
#[inline(always)]
fn lanes_mut(row: &mut [f64]) -> std::slice::IterMut<'_, [f64; W]> {
    row.as_chunks_mut().0.iter_mut()
}
