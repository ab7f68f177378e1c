//! Many steps of Heun's scheme in positions and speeds at once: the scheme of the paper, 3e8 steps of it a run.
//!
//! The same sums in the same order as the general method makes them, so the same bits. What makes it fast: all steps of a
//! burst run in one function, on arrays that stay in the first-level cache; the first pedestrian is repeated one ring
//! length ahead behind the last, so that the neighbour ahead is the next element and the loops have no exception.

use crate::laws::Law;
use math::simd::Kernel;
use ode::Burst;

/// `count` steps of length `h` of the state `[x_0 .. x_{N-1}, v_0 .. v_{N-1}]`.
pub(super) struct HeunSteps<'a, L: Law> {
    pub(super) law: L,
    pub(super) length: f64,
    pub(super) h: f64,
    pub(super) count: u64,
    pub(super) state: &'a mut [f64],
}

impl<L: Law> Kernel for HeunSteps<'_, L> {
    type Output = Burst;

    #[inline(always)]
    fn run(self) -> Burst {
        let HeunSteps { law, length, h, count, state } = self;
        let n = state.len() / 2;
        let mut now = Padded::new(n);
        let mut guess = Padded::new(n);
        let (mut acceleration, mut half) = (vec![0.0; n], vec![0.0; n]);
        now.positions[..n].copy_from_slice(&state[..n]);
        now.speeds[..n].copy_from_slice(&state[n..]);
        for _ in 0..count {
            now.close(length);
            predict(&law, h, &now, &mut guess, &mut acceleration, &mut half);
            guess.close(length);
            correct(&law, h, &mut now, &guess, &acceleration, &mut half);
            now.close(length);
            if !now.is_quiet(&law) {
                return Burst::Eventful;
            }
        }
        state[..n].copy_from_slice(&now.positions[..n]);
        state[n..].copy_from_slice(&now.speeds[..n]);
        Burst::Quiet
    }
}

/// Positions and speeds with the first pedestrian repeated behind the last.
struct Padded {
    positions: Vec<f64>,
    speeds: Vec<f64>,
}

impl Padded {
    fn new(n: usize) -> Padded {
        Padded { positions: vec![0.0; n + 1], speeds: vec![0.0; n + 1] }
    }

    #[inline(always)]
    fn close(&mut self, length: f64) {
        let n = self.positions.len() - 1;
        self.positions[n] = self.positions[0] + length;
        self.speeds[n] = self.speeds[0];
    }

    /// Whether everybody has room and no negative speed; false for what is not a number.
    #[inline(always)]
    fn is_quiet<L: Law>(&self, law: &L) -> bool {
        let n = self.positions.len() - 1;
        let (x, ahead) = (&self.positions[..n], &self.positions[1..=n]);
        let (v, v_ahead) = (&self.speeds[..n], &self.speeds[1..=n]);
        let mut quiet = 0;
        for i in 0..n {
            let room = law.room(ahead[i] - x[i] - L::CONTACT, v[i], v_ahead[i]);
            quiet += u64::from((room >= 0.0) & (v[i] >= 0.0));
        }
        quiet == n as u64
    }
}

/// The accelerations now, and the state that an Euler step would reach.
#[inline(always)]
fn predict<L: Law>(law: &L, h: f64, now: &Padded, guess: &mut Padded, acceleration: &mut [f64], half: &mut [f64]) {
    let n = acceleration.len();
    let (x, ahead) = (&now.positions[..n], &now.positions[1..=n]);
    let (v, v_ahead) = (&now.speeds[..n], &now.speeds[1..=n]);
    let (x_guess, v_guess) = (&mut guess.positions[..n], &mut guess.speeds[..n]);
    let half = &mut half[..n];
    if L::IN_HALVES {
        for i in 0..n {
            half[i] = law.acceleration_half(ahead[i] - x[i] - L::CONTACT, v[i], v_ahead[i]);
        }
    }
    for i in 0..n {
        let a = law.acceleration_rest(half[i], ahead[i] - x[i] - L::CONTACT, v[i], v_ahead[i]);
        acceleration[i] = a;
        x_guess[i] = x[i] + h * v[i];
        v_guess[i] = v[i] + h * a;
    }
}

/// The step with the mean of the rates at both ends.
#[inline(always)]
fn correct<L: Law>(law: &L, h: f64, now: &mut Padded, guess: &Padded, acceleration: &[f64], half: &mut [f64]) {
    let n = acceleration.len();
    let (x_guess, ahead) = (&guess.positions[..n], &guess.positions[1..=n]);
    let (v_guess, v_ahead) = (&guess.speeds[..n], &guess.speeds[1..=n]);
    let (x, v) = (&mut now.positions[..n], &mut now.speeds[..n]);
    let half = &mut half[..n];
    if L::IN_HALVES {
        for i in 0..n {
            half[i] = law.acceleration_half(ahead[i] - x_guess[i] - L::CONTACT, v_guess[i], v_ahead[i]);
        }
    }
    for i in 0..n {
        let a = law.acceleration_rest(half[i], ahead[i] - x_guess[i] - L::CONTACT, v_guess[i], v_ahead[i]);
        x[i] += h * (0.5 * v[i] + 0.5 * v_guess[i]);
        v[i] += h * (0.5 * acceleration[i] + 0.5 * a);
    }
}
