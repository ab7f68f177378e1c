//! A ring of pedestrians as its uniform flow and the differences from it.

use crate::formula::{Formula, smooth_ramp};
use crate::number::{Difference, Real};

/// A ring under a law.
///
/// A state is `[u_0 .. u_{N-1}, w_0 .. w_{N-1}, y_0, X, V]`: spacings `L/N + u_n`, speeds `V + w_n`, and the position
/// `X + y_0` of pedestrian 0, where `X` and `V` are those of the uniform flow that starts at rest.
#[derive(Clone, Copy, Debug)]
pub struct Flow<T> {
    /// The law.
    pub formula: Formula,
    /// `N`.
    pub pedestrians: usize,
    /// `L / N`.
    pub headway: T,
}

impl<T: Real> Flow<T> {
    /// A ring of this length.
    pub fn new(formula: Formula, pedestrians: usize, length: f64) -> Flow<T> {
        Flow { formula, pedestrians, headway: T::from(length) / T::from(pedestrians as f64) }
    }

    /// How many numbers a state has.
    pub fn dimension(&self) -> usize {
        2 * self.pedestrians + 3
    }

    /// Equal spacings, all at rest, pedestrian 0 moved forward.
    pub fn start(&self, shift: f64) -> Vec<T> {
        let (n, shift) = (self.pedestrians, T::from(shift));
        let mut state = vec![T::from(0.0); self.dimension()];
        state[0] = state[0] - shift;
        state[n - 1] = state[n - 1] + shift;
        state[2 * n] = shift;
        state
    }

    /// The spacing and the speeds, own and ahead, of pedestrian `n`.
    fn seen(&self, state: &[T], n: usize) -> [Difference<T>; 3] {
        let count = self.pedestrians;
        let base = state[2 * count + 2];
        let speed = |i: usize| Difference { base, change: state[count + i] };
        let next = if n + 1 == count { 0 } else { n + 1 };
        [Difference { base: self.headway, change: state[n] }, speed(n), speed(next)]
    }

    /// Writes the rates of a state and, for each ramp in the law, how far its argument is from the kink, in units of its
    /// width.
    pub fn rates(&self, state: &[T], rates: &mut [T], kinks: &mut Vec<f64>) {
        let n = self.pedestrians;
        kinks.clear();
        for i in 0..n {
            let [s, v, ahead] = self.seen(state, i);
            let mut ramp = |x: Difference<T>, epsilon: f64| {
                kinks.push(x.whole().value() / epsilon);
                smooth_ramp(x, epsilon)
            };
            let acceleration = self.formula.acceleration(s, v, ahead, &mut ramp);
            rates[i] = ahead.change - v.change;
            rates[n + i] = acceleration.change;
            rates[2 * n + 2] = acceleration.base;
        }
        rates[2 * n] = state[n];
        rates[2 * n + 1] = state[2 * n + 2];
    }

    /// The room of pedestrian `n`.
    pub fn room(&self, state: &[T], n: usize) -> T {
        let [s, v, ahead] = self.seen(state, n);
        // the large parts first: a small room keeps the digits that its parts have
        let (mut base, mut change) = (s.base, s.change);
        if let Formula::Algebraic { a_v, .. } | Formula::Exponential { a_v, .. } = self.formula {
            base = base - T::from(2.0) - T::from(a_v) * (v.base + ahead.base);
            change = change - T::from(a_v) * (v.change + ahead.change);
        }
        base + change
    }

    /// The spacing of pedestrian `n`.
    pub fn spacing(&self, state: &[T], n: usize) -> T {
        self.headway + state[n]
    }

    /// The speed of pedestrian `n`.
    pub fn speed(&self, state: &[T], n: usize) -> T {
        state[2 * self.pedestrians + 2] + state[self.pedestrians + n]
    }

    /// The unwrapped positions.
    pub fn positions(&self, state: &[T]) -> Vec<T> {
        let n = self.pedestrians;
        let mut behind = T::from(0.0);
        (0..n)
            .map(|i| {
                let position = state[2 * n + 1] + state[2 * n] + (self.headway * T::from(i as f64) + behind);
                behind = behind + state[i];
                position
            })
            .collect()
    }

    /// The standard deviation of the speeds, divided by `N`. Scaled: speeds of 1e-200 have squares.
    pub fn std(&self, state: &[T]) -> T {
        let changes = &state[self.pedestrians..2 * self.pedestrians];
        let largest = changes.iter().fold(0.0_f64, |largest, w| largest.max(w.value().abs()));
        if largest == 0.0 || !largest.is_finite() {
            return T::from(largest);
        }
        let (count, scale) = (T::from(changes.len() as f64), T::from(largest));
        let scaled: Vec<T> = changes.iter().map(|w| *w / scale).collect();
        let mean = scaled.iter().fold(T::from(0.0), |sum, w| sum + *w) / count;
        let squares = scaled.iter().fold(T::from(0.0), |sum, w| sum + (*w - mean) * (*w - mean));
        (squares / count).root() * scale
    }

    /// The size of the perturbation.
    pub fn perturbation(&self, state: &[T]) -> f64 {
        let parts = &state[..2 * self.pedestrians];
        parts.iter().fold(0.0_f64, |largest, part| largest.max(part.value().abs()))
    }

    /// The least room.
    pub fn least_room(&self, state: &[T]) -> f64 {
        (0..self.pedestrians).fold(f64::INFINITY, |least, n| least.min(self.room(state, n).value()))
    }
}
