//! A ring of pedestrians, as differences from its uniform flow or as clearances.

use crate::formula::{Formula, smooth_ramp};
use crate::number::{Difference, Number, Parted, Real};
use math::{larger, smaller};

/// What the numbers of a state are differences from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// The uniform flow: a perturbation keeps its digits however small it is.
    Differences,
    /// Contact and rest: a room near a singular force keeps its digits.
    Clearances,
}

/// A ring under a law.
///
/// A state is `[u_0 .. u_{N-1}, w_0 .. w_{N-1}, y_0, X, V]`: spacings `S + u_n`, speeds `V + w_n`, and the position
/// `X + y_0` of pedestrian 0. In [`Form::Differences`] `X` and `V` are those of the uniform flow that starts at rest
/// and `S = L / N`; in [`Form::Clearances`] they stay 0 and `S` is where standing pedestrians touch.
#[derive(Clone, Debug)]
pub struct Flow<T> {
    /// The law.
    pub formula: Formula,
    /// `N`.
    pub pedestrians: usize,
    /// `L / N`.
    pub headway: T,
    /// The form of the state.
    pub form: Form,
}

impl<T: Real> Flow<T> {
    /// A ring of this length.
    pub fn new(formula: Formula, pedestrians: usize, length: f64, form: Form) -> Flow<T> {
        Flow { formula, pedestrians, headway: T::from(length) / T::from(pedestrians as f64), form }
    }

    /// How many numbers a state has.
    pub fn dimension(&self) -> usize {
        2 * self.pedestrians + 3
    }

    /// What spacings are differences from.
    fn base(&self) -> T {
        match self.form {
            Form::Differences => self.headway,
            Form::Clearances => T::from(self.formula.contact()),
        }
    }

    /// Equal spacings, all at rest, pedestrian 0 moved forward, and everybody by their displacement if there are any.
    pub fn start(&self, shift: f64, displacements: &[f64]) -> Vec<T> {
        let n = self.pedestrians;
        let mut state = vec![T::from(0.0); self.dimension()];
        state[..n].fill(self.headway - self.base());
        let all = std::iter::once((0, shift)).chain(displacements.iter().copied().enumerate());
        for (own, by) in all.filter(|(_, by)| *by != 0.0) {
            let (by, behind) = (T::from(by), (own + n - 1) % n);
            state[own] = state[own] - by;
            state[behind] = state[behind] + by;
            if own == 0 {
                state[2 * n] = state[2 * n] + by;
            }
        }
        state
    }

    /// The same ring with clearances for its state, and a state in that form.
    pub fn by_clearances(&self, state: &[T]) -> (Flow<T>, Vec<T>) {
        let n = self.pedestrians;
        let flow = Flow { form: Form::Clearances, ..self.clone() };
        let mut clearances: Vec<T> = state[..n].iter().map(|u| (self.base() - flow.base()) + *u).collect();
        clearances.extend((0..n).map(|i| self.speed(state, i)));
        clearances.extend([state[2 * n] + state[2 * n + 1], T::from(0.0), T::from(0.0)]);
        (flow, clearances)
    }

    /// Writes the rates of a state and, for each ramp in the law, how far its argument is from the kink, in units of
    /// its width.
    pub fn rates(&self, state: &[T], rates: &mut [T], kinks: &mut Vec<f64>) {
        let n = self.pedestrians;
        kinks.clear();
        let base = state[2 * n + 2];
        rates[2 * n + 2] = T::from(0.0);
        let place = |i: usize, j: i32| (i as i64 + i64::from(j)).rem_euclid(n as i64) as usize;
        for i in 0..n {
            rates[i] = state[n + place(i, 1)] - state[n + i];
            rates[n + i] = match self.form {
                Form::Differences => {
                    let spacing = |j| Difference { base: self.headway, change: state[place(i, j)] };
                    let speed = |j| Difference { base, change: state[n + place(i, j)] };
                    let ramp = &mut |x, epsilon| noted(x, epsilon, kinks);
                    let acceleration = self.formula.acceleration(spacing, speed, ramp);
                    rates[2 * n + 2] = acceleration.base;
                    acceleration.change
                }
                Form::Clearances => {
                    let (spacing, speed) = (self.spacing_parts(state, i), self.speed_parts(state, i));
                    let ramp = &mut |x, epsilon| noted(x, epsilon, kinks);
                    self.formula.acceleration(spacing, speed, ramp).whole()
                }
            };
        }
        rates[2 * n] = state[n];
        rates[2 * n + 1] = base;
    }

    /// The spacing of the pedestrian `j` places ahead of pedestrian `n`.
    fn spacing_parts<'a>(&self, state: &'a [T], n: usize) -> impl Fn(i32) -> Parted<T> + 'a {
        let (base, count) = (self.base(), self.pedestrians as i64);
        move |j| Parted { base, rest: state[(n as i64 + i64::from(j)).rem_euclid(count) as usize] }
    }

    /// The speed of the pedestrian `j` places ahead of pedestrian `n`.
    fn speed_parts<'a>(&self, state: &'a [T], n: usize) -> impl Fn(i32) -> Parted<T> + 'a {
        let (base, count) = (state[2 * self.pedestrians + 2], self.pedestrians);
        move |j| Parted { base, rest: state[count + (n as i64 + i64::from(j)).rem_euclid(count as i64) as usize] }
    }

    /// The room of pedestrian `n`.
    pub fn room(&self, state: &[T], n: usize) -> T {
        self.formula.room(self.spacing_parts(state, n), self.speed_parts(state, n)).whole()
    }

    /// The gap in the uniform flow.
    pub fn uniform_room(&self, state: &[T]) -> f64 {
        let speed = state[2 * self.pedestrians + 2];
        self.formula.room(|_| self.headway, |_| speed).value()
    }

    /// The components of a state that the room, spacing and speed of pedestrian `n` depend on.
    pub fn components(&self, n: usize) -> Vec<usize> {
        let count = self.pedestrians;
        let [behind, ahead] = self.formula.reach();
        let places = (-behind..=ahead).map(|j| (n as i64 + i64::from(j)).rem_euclid(count as i64) as usize);
        places.flat_map(|place| [place, count + place]).chain([2 * count + 2]).collect()
    }

    /// The spacing of pedestrian `n`.
    pub fn spacing(&self, state: &[T], n: usize) -> T {
        self.base() + state[n]
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
                let position = state[2 * n + 1] + state[2 * n] + (self.base() * T::from(i as f64) + behind);
                behind = behind + state[i];
                position
            })
            .collect()
    }

    /// The standard deviation of the speeds, divided by `N`. Scaled: speeds of 1e-200 have squares.
    pub fn std(&self, state: &[T]) -> T {
        let changes = &state[self.pedestrians..2 * self.pedestrians];
        let largest = changes.iter().fold(0.0_f64, |largest, w| larger(largest, w.value().abs()));
        if largest == 0.0 || !largest.is_finite() {
            return T::from(largest);
        }
        let (count, scale) = (T::from(changes.len() as f64), T::from(largest));
        let scaled: Vec<T> = changes.iter().map(|w| *w / scale).collect();
        let mean = scaled.iter().fold(T::from(0.0), |sum, w| sum + *w) / count;
        let squares = scaled.iter().fold(T::from(0.0), |sum, w| sum + (*w - mean) * (*w - mean));
        (squares / count).root() * scale
    }

    /// The largest difference of a spacing from the mean, or of speeds from each other.
    pub fn perturbation(&self, state: &[T]) -> f64 {
        let n = self.pedestrians;
        let shift = self.headway - self.base();
        let first = state[n];
        let spacings = state[..n].iter().map(|u| *u - shift);
        let speeds = state[n..2 * n].iter().map(|w| if self.form == Form::Differences { *w } else { *w - first });
        spacings.chain(speeds).fold(0.0, |largest, part| larger(largest, part.value().abs()))
    }

    /// The largest spacing or speed in the form of the state.
    pub fn size(&self, state: &[T]) -> f64 {
        let parts = &state[..2 * self.pedestrians];
        parts.iter().fold(0.0_f64, |largest, part| larger(largest, part.value().abs()))
    }

    /// The largest acceleration, in size.
    pub fn acceleration(&self, state: &[T]) -> f64 {
        let n = self.pedestrians;
        let mut rates = vec![T::from(0.0); self.dimension()];
        self.rates(state, &mut rates, &mut Vec::new());
        let of_flow = rates[2 * n + 2];
        rates[n..2 * n].iter().fold(0.0, |largest, rate| larger(largest, (of_flow + *rate).value().abs()))
    }

    /// The least room.
    pub fn least_room(&self, state: &[T]) -> f64 {
        (0..self.pedestrians).fold(f64::INFINITY, |least, n| smaller(least, self.room(state, n).value()))
    }
}

/// The smooth ramp; how far its argument is from the kink is noted.
fn noted<T: Number>(x: T, epsilon: f64, kinks: &mut Vec<f64>) -> T {
    kinks.push(x.value() / epsilon);
    smooth_ramp(x, epsilon)
}
