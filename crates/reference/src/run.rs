//! A run from the start of a scene through a list of times.

use crate::extrapolation::Extrapolation;
use crate::ring::Ring;
use crate::scenes::{LENGTH, Scene};
use math::double_double::DoubleDouble;
use math::larger;

/// How a run is made: two runs that differ in both share little.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Precision {
    /// The largest difference between the results of a step with all rows and with one less: relative for clearances
    /// where the force is singular, else absolute or relative, whichever is larger.
    pub tolerance: f64,
    /// Rows of the extrapolation; the order is twice this.
    pub rows: usize,
}

/// A run at its present time.
#[derive(Clone, Debug)]
pub struct Run {
    /// The ring.
    pub ring: Ring,
    /// The time.
    pub time: DoubleDouble,
    /// The state at that time (see [`Ring`]).
    pub state: Vec<DoubleDouble>,
    /// Its time derivatives.
    pub rates: Vec<DoubleDouble>,
    /// Evaluations of the rates so far.
    pub evaluations: u64,
    method: Extrapolation,
    tolerance: f64,
    /// The step that the last errors suggest.
    h: f64,
}

/// The run cannot continue: steps became too short for the time to advance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stuck {
    /// Where.
    pub time: f64,
    /// The length of the step that was rejected last.
    pub step: f64,
}

impl std::fmt::Display for Stuck {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "at t = {} a step of {:e} was too long; a larger tolerance or other rows help", self.time, self.step)
    }
}

impl std::error::Error for Stuck {}

/// Shorter steps are not tried; at the fastest throw-backs of the algebraic force, steps of 1e-56 are accepted.
const SHORTEST: f64 = 1e-80;

impl Run {
    /// The scene at its start.
    pub fn new(scene: &Scene, precision: Precision) -> Run {
        Run::from_state(scene.ring, scene.ring.start(LENGTH, scene.shift), precision)
    }

    /// A ring at time 0 in this state.
    pub fn from_state(ring: Ring, state: Vec<DoubleDouble>, precision: Precision) -> Run {
        let mut rates = vec![DoubleDouble::ZERO; ring.dimension()];
        ring.rates(&state, &mut rates);
        Run {
            ring,
            time: DoubleDouble::ZERO,
            state,
            rates,
            evaluations: 1,
            method: Extrapolation::new(precision.rows, ring.dimension()),
            tolerance: precision.tolerance,
            h: 0.01,
        }
    }

    /// Goes on to this time, which it reaches exactly.
    ///
    /// # Errors
    /// [`Stuck`].
    pub fn advance_to(&mut self, time: f64) -> Result<(), Stuck> {
        while self.time != DoubleDouble::from(time) {
            self.advance(time)?;
        }
        Ok(())
    }

    /// Takes one step, at most to `limit`; returns its length.
    ///
    /// # Errors
    /// [`Stuck`].
    pub fn advance(&mut self, limit: f64) -> Result<DoubleDouble, Stuck> {
        loop {
            let left = -(self.time - limit);
            // two equal steps rather than a long and a short one
            let (is_last, is_near) = (left.hi <= self.h, left.hi < 2.0 * self.h);
            let h = if is_last {
                left
            } else if is_near {
                left.times(0.5)
            } else {
                DoubleDouble::from(self.h)
            };
            self.try_step(h);
            let error = self.error();
            // the estimate is that of the result with one row less
            let power = 1.0 / (self.method.order() - 1) as f64;
            if error <= 1.0 && self.is_inside() {
                self.accept(h);
                if is_last {
                    self.time = DoubleDouble::from(limit);
                }
                // no memory of earlier errors: near the noise of rounding a trend means nothing
                let factor = 0.9 * math::pow(larger(error, 1e-20), -power);
                // a step that a limit has cut says little about longer ones
                self.h = larger(h.hi * factor.clamp(0.2, 4.0), if is_near { self.h } else { 0.0 });
                return Ok(h);
            }
            let factor = if error.is_finite() { 0.9 * math::pow(error, -power) } else { 0.2 };
            self.h = h.hi * factor.clamp(0.2, 0.9);
            if self.h < SHORTEST {
                return Err(Stuck { time: self.time.into(), step: h.hi });
            }
        }
    }

    /// The state after a step of length `h` from the present one, which stays; accurate as a step that is taken, for an
    /// `h` up to the length of the next.
    pub fn peek(&mut self, h: DoubleDouble) -> Vec<DoubleDouble> {
        self.try_step(h);
        self.state.iter().zip(&self.method.result).map(|(state, change)| *state + *change).collect()
    }

    fn try_step(&mut self, h: DoubleDouble) {
        self.method.step(&self.ring, &self.state, &self.rates, h);
        self.evaluations += self.method.evaluations();
    }

    fn accept(&mut self, h: DoubleDouble) {
        for (state, change) in self.state.iter_mut().zip(&self.method.result) {
            *state = *state + *change;
        }
        self.time = self.time + h;
        self.ring.rates(&self.state, &mut self.rates);
    }

    /// The estimated error of the step just tried, in units of the tolerance; infinite if it is NaN.
    fn error(&self) -> f64 {
        let n = self.ring.pedestrians;
        let is_singular = self.ring.law.is_singular();
        let mut largest = 0.0_f64;
        for (i, (state, difference)) in self.state.iter().zip(&self.method.difference).enumerate() {
            let floor = if is_singular && i < n { 0.0 } else { 1.0 };
            let error = difference.hi.abs() / (larger(state.hi.abs(), floor) * self.tolerance);
            if !error.is_finite() {
                return f64::INFINITY;
            }
            largest = larger(largest, error);
        }
        largest
    }

    /// Whether the step just tried ends on this side of the wall.
    fn is_inside(&self) -> bool {
        let n = self.ring.pedestrians;
        let changes = self.state.iter().zip(&self.method.result).take(n);
        !self.ring.law.is_singular() || changes.into_iter().all(|(state, change)| state.hi + change.hi > 0.0)
    }
}
