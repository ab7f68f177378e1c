//! Integrates a [`Flow`] by [`crate::collocation`], with steps adapted to the error that never cross a kink unnoticed.

use crate::collocation::{Collocation, combine, rates_at, weights_at};
use crate::flow::Flow;
use crate::number::Real;
use math::double_double::DoubleDouble;
use math::{larger, smaller};

/// How carefully a solution is made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Care {
    /// Nodes of a step.
    pub nodes: usize,
    /// Largest error of the solution within a step: relative to the perturbation, to the least room near a singular
    /// force, to the desired speed for the uniform flow.
    pub tolerance: f64,
    /// As many accelerations of single pedestrians as may be computed.
    pub most_work: u64,
}

/// The reason why a solution ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stuck {
    /// The steps tend to 0: the solution ends here.
    Singular,
    /// The work allowed is used up.
    Work,
}

/// A kink is felt as far as this from it, in units of its width: `e^-40` is 4e-18.
const FELT: f64 = 40.0;
/// Within that distance the argument of a ramp changes by no more than this from node to node.
const STRIDE: f64 = 4.0;
/// Iterations of a step, at most; slow ones ask for a shorter step.
const ITERATIONS: usize = 40;
/// Orders of the last step's polynomial that are carried on, up to steps longer by this factor.
const GUESSED: usize = 6;
const LONGEST_GUESS: f64 = 1.7;
/// Shorter steps mean that there is no solution beyond.
const SHORTEST: f64 = 1e-290;

/// A solution at its present time, and the step that led there.
#[derive(Clone, Debug)]
pub struct Solver<T> {
    /// The ring.
    pub flow: Flow<T>,
    /// The present time.
    pub time: DoubleDouble,
    /// The state at that time.
    pub state: Vec<T>,
    /// The time at the start of the last step.
    pub start: DoubleDouble,
    /// Its length.
    pub length: f64,
    /// The work so far.
    pub work: u64,
    care: Care,
    method: Collocation<T>,
    next: f64,
    carry: Vec<T>,
    before: Vec<T>,
    rates: Vec<T>,
    kinks: Vec<f64>,
    /// Of the rates in the last step.
    coefficients: Vec<Vec<T>>,
    trial: Vec<Vec<T>>,
    stages: Vec<Stage<T>>,
    stage_rates: Vec<Vec<T>>,
    end: Stage<T>,
    end_rates: Vec<T>,
}

/// What is known at a place in a step.
#[derive(Clone, Debug)]
struct Stage<T> {
    change: Vec<T>,
    state: Vec<T>,
    kinks: Vec<f64>,
}

impl<T: Real> Stage<T> {
    fn new(dimension: usize) -> Stage<T> {
        let zeros = vec![T::from(0.0); dimension];
        Stage { change: zeros.clone(), state: zeros, kinks: Vec::new() }
    }

    fn move_from(&mut self, state: &[T]) {
        for ((here, before), change) in self.state.iter_mut().zip(state).zip(&self.change) {
            *here = *before + *change;
        }
    }
}

impl<T: Real> Solver<T> {
    /// At time 0 in this state.
    pub fn new(flow: Flow<T>, state: Vec<T>, care: Care) -> Solver<T> {
        let dimension = flow.dimension();
        let zeros = vec![T::from(0.0); dimension];
        let rows = vec![zeros.clone(); care.nodes];
        let (mut rates, mut kinks) = (zeros.clone(), Vec::new());
        flow.rates(&state, &mut rates, &mut kinks);
        Solver {
            flow,
            time: DoubleDouble::ZERO,
            before: state.clone(),
            state,
            start: DoubleDouble::ZERO,
            length: 0.0,
            work: 0,
            care,
            method: Collocation::new(care.nodes),
            next: 1e-3,
            carry: zeros.clone(),
            rates,
            kinks,
            coefficients: rows.clone(),
            trial: rows.clone(),
            stages: vec![Stage::new(dimension); care.nodes],
            stage_rates: rows,
            end: Stage::new(dimension),
            end_rates: zeros,
        }
    }

    /// Goes on with clearances for its state.
    pub fn change_form(&mut self) {
        let (flow, state) = self.flow.by_clearances(&self.state);
        let (time, next, work) = (self.time, self.next, self.work);
        *self = Solver { time, next, work, ..Solver::new(flow, state, self.care) };
    }

    /// Takes one step, at most to `limit`, which it then reaches exactly.
    ///
    /// # Errors
    /// [`Stuck`].
    pub fn advance(&mut self, limit: f64) -> Result<(), Stuck> {
        loop {
            let left = f64::from(DoubleDouble::from(limit) - self.time);
            let is_last = self.next >= left;
            let h = if is_last { left } else { self.next };
            if h < SHORTEST {
                return Err(Stuck::Singular);
            }
            if self.work > self.care.most_work {
                return Err(Stuck::Work);
            }
            let verdict = self.try_step(h);
            if verdict < 1.0 {
                self.next = h * verdict;
                continue;
            }
            self.accept(h);
            if is_last {
                self.time = DoubleDouble::from(limit);
                // a step that a limit has cut says little about longer ones
                self.next = larger(self.next, h * verdict);
            } else {
                self.next = h * verdict;
            }
            return Ok(());
        }
    }

    /// Tries a step; the factor for the next one, below 1 where this one must be made again.
    fn try_step(&mut self, h: f64) -> f64 {
        let scales = self.scales();
        if !self.iterate(h, &scales) {
            return 0.4;
        }
        if let Some(factor) = self.over_a_kink() {
            return factor;
        }
        let error = self.error(h, &scales);
        if !error.is_finite() || self.leaves_domain() {
            return 0.2;
        }
        let power = 1.0 / (self.care.nodes as f64 + 1.0);
        let factor = 0.8 * math::pow(larger(error / self.care.tolerance, 1e-20), -power);
        if error <= self.care.tolerance { factor.clamp(1.0, 3.0) } else { factor.clamp(0.1, 0.9) }
    }

    /// What errors are compared with, component by component: spacings and speeds with the largest of both, spacings
    /// near a singular force with their own room, the uniform flow with the desired speed.
    fn scales(&self) -> Vec<f64> {
        let (n, flow, state) = (self.flow.pedestrians, &self.flow, &self.state);
        let size = larger(flow.size(state), f64::MIN_POSITIVE);
        let uniform = larger(flow.formula.desired_speed(), state[2 * n + 2].value().abs());
        let mut scales = vec![size; 2 * n];
        if flow.formula.is_singular() {
            scales[..n]
                .iter_mut()
                .enumerate()
                .for_each(|(i, scale)| *scale = smaller(size, flow.room(state, i).value()));
        }
        scales.extend([larger(size, state[2 * n].value().abs()), uniform, uniform]);
        scales
    }

    /// The largest of these numbers in those units.
    fn norm(&self, values: impl Iterator<Item = T>, scales: &[f64]) -> f64 {
        let mut largest = 0.0;
        for (value, scale) in values.zip(scales) {
            let size = value.value().abs() / scale;
            if size.is_nan() {
                return f64::INFINITY;
            }
            largest = if size > largest { size } else { largest };
        }
        largest
    }

    /// Finds the rates at the nodes; false if they do not settle.
    fn iterate(&mut self, h: f64, scales: &[f64]) -> bool {
        self.guess(h);
        let settled = larger(4.0 * T::ROUNDING, 1e-3 * self.care.tolerance);
        let mut new = vec![T::from(0.0); self.flow.dimension()];
        let mut last = f64::INFINITY;
        for _ in 0..ITERATIONS {
            let mut moved = 0.0_f64;
            for i in 0..self.care.nodes {
                let stage = &mut self.stages[i];
                self.method.change_at_node(i, T::from(h), &self.stage_rates, &mut stage.change);
                stage.move_from(&self.state);
                self.flow.rates(&stage.state, &mut new, &mut stage.kinks);
                let differences = new.iter().zip(&self.stage_rates[i]).map(|(new, old)| *new - *old);
                moved = larger(moved, h * self.norm(differences, scales));
                std::mem::swap(&mut new, &mut self.stage_rates[i]);
            }
            self.work += (self.care.nodes * self.flow.pedestrians) as u64;
            if !moved.is_finite() {
                return false;
            }
            if moved <= settled || (moved < 0.1 * self.care.tolerance && moved >= 0.5 * last) {
                self.finish(h);
                return true;
            }
            last = moved;
        }
        false
    }

    /// Initial rates: the low orders of the last step's polynomial, extrapolated.
    fn guess(&mut self, h: f64) {
        let ratio = h / self.length;
        for i in 0..self.care.nodes {
            if ratio < LONGEST_GUESS {
                let weights = rates_at(GUESSED, T::from(1.0 + ratio * self.method.node(i)));
                combine(T::from(1.0), &weights[..GUESSED], &self.coefficients, &mut self.stage_rates[i]);
            } else {
                self.stage_rates[i].copy_from_slice(&self.rates);
            }
        }
    }

    /// The end of a step from its nodes.
    fn finish(&mut self, h: f64) {
        self.method.coefficients(&self.stage_rates, &mut self.trial);
        // all but the first polynomial integrate to 0
        for (change, rate) in self.end.change.iter_mut().zip(&self.trial[0]) {
            *change = T::from(h) * *rate;
        }
        self.end.move_from(&self.state);
        self.flow.rates(&self.end.state, &mut self.end_rates, &mut self.end.kinks);
    }

    /// How far the rates are from their polynomial at both ends, as an error of the solution. The polynomial's defect
    /// is a multiple of the next Legendre polynomial, largest at the ends; its integral is at most about a tenth of
    /// that.
    fn error(&self, h: f64, scales: &[f64]) -> f64 {
        let defect = |rates: &[T], sign: f64| {
            let differences = (0..rates.len()).map(|i| {
                let (mut sum, mut factor) = (-rates[i], 1.0);
                for row in &self.trial {
                    sum = sum + row[i] * T::from(factor);
                    factor *= sign;
                }
                sum
            });
            self.norm(differences, scales)
        };
        let (first, last) = (defect(&self.rates, -1.0), defect(&self.end_rates, 1.0));
        0.1 * h * if first > last { first } else { last }
    }

    /// Whether the argument of a ramp jumps where the kink is felt: the factor for a shorter step.
    fn over_a_kink(&self) -> Option<f64> {
        let mut factor: Option<f64> = None;
        for k in 0..self.kinks.len() {
            let (mut place, mut value) = (0.0, self.kinks[k]);
            for i in 0..=self.care.nodes {
                let (next_place, stage) = match i {
                    i if i == self.care.nodes => (1.0, &self.end),
                    _ => (self.method.node(i), &self.stages[i]),
                };
                let next = stage.kinks[k];
                let is_felt = smaller(value, next) < FELT && larger(value, next) > -FELT;
                let jump = (next - value).abs();
                if is_felt && jump > STRIDE {
                    // up to where it is felt; from there on in strides
                    let outside = larger(value.abs() - FELT, 0.0) / jump;
                    let near = place + (next_place - place) * outside;
                    let shorter = if near > 0.05 { near } else { 0.9 * STRIDE / jump };
                    let shorter = shorter.clamp(1e-3, 0.9);
                    factor = Some(factor.map_or(shorter, |known: f64| smaller(known, shorter)));
                    break;
                }
                (place, value) = (next_place, next);
            }
        }
        factor
    }

    fn leaves_domain(&self) -> bool {
        let flow = &self.flow;
        let closed = |state: &[T]| flow.least_room(state) <= 0.0;
        flow.formula.is_singular() && (closed(&self.end.state) || self.stages.iter().any(|stage| closed(&stage.state)))
    }

    /// Takes the step; what is lost in the sums is carried over.
    fn accept(&mut self, h: f64) {
        std::mem::swap(&mut self.before, &mut self.state);
        for (i, state) in self.state.iter_mut().enumerate() {
            let change = self.end.change[i] + self.carry[i];
            *state = self.before[i] + change;
            self.carry[i] = change - (*state - self.before[i]);
        }
        self.start = self.time;
        self.time = self.time + h;
        self.length = h;
        std::mem::swap(&mut self.coefficients, &mut self.trial);
        std::mem::swap(&mut self.rates, &mut self.end_rates);
        std::mem::swap(&mut self.kinks, &mut self.end.kinks);
    }

    /// Fractions of the last step at which its states are known, with 0 and 1.
    pub fn places(&self) -> Vec<f64> {
        let nodes = (0..self.care.nodes).map(|i| self.method.node(i));
        std::iter::once(0.0).chain(nodes).chain([1.0]).collect()
    }

    /// The states there.
    pub fn states(&self) -> Vec<&[T]> {
        let stages = self.stages.iter().map(|stage| &stage.state[..]);
        std::iter::once(&self.before[..]).chain(stages).chain([&self.state[..]]).collect()
    }

    /// The state at a fraction of the last step.
    pub fn at(&self, theta: f64) -> Vec<T> {
        if theta >= 1.0 {
            return self.state.clone();
        }
        let mut change = vec![T::from(0.0); self.state.len()];
        let weights = weights_at(self.care.nodes, T::from(theta));
        combine(T::from(self.length), &weights, &self.coefficients, &mut change);
        self.before.iter().zip(&change).map(|(before, change)| *before + *change).collect()
    }

    /// Writes some components of that state.
    pub fn write_at(&self, theta: f64, components: &[usize], state: &mut [T]) {
        let weights = weights_at(self.care.nodes, T::from(theta));
        for &i in components {
            let terms = weights.iter().zip(&self.coefficients).map(|(weight, row)| *weight * row[i]);
            let sum = terms.fold(T::from(0.0), |sum, term| sum + term);
            state[i] = self.before[i] + T::from(self.length) * sum;
        }
    }
}
