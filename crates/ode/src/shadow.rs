//! The error of a solution by Taylor's method, carried along with it.
//!
//! Each step tells its own error: how far the slope of its series is, at its end, from what the law says there. What
//! becomes of these errors later a second solution would show that lies close by; near enough, it needs few orders of the
//! series and not every step, so it costs a small part of the first one.

use crate::dense::Step;
use crate::system::{Measure, System};
use crate::vector::largest;

/// The error of a solution, step by step.
#[derive(Clone, Debug)]
pub struct Shadow {
    /// The error where the shadow was expanded last.
    error: Vec<f64>,
    /// What the steps since then have added.
    added: Vec<f64>,
    /// The orders of the shadow's difference from the solution, as series in time since then; none before the first error.
    rows: Vec<f64>,
    /// How many orders.
    orders: usize,
    /// How much larger the difference is than the error.
    scale: f64,
    /// The unit of time of the series.
    unit: f64,
    /// The time since then, and how far the series reach.
    elapsed: f64,
    reach: f64,
    /// The error at the end of the last step.
    now: Vec<f64>,
    own: Vec<f64>,
}

/// Orders of the series of the difference at first, and how many more where these do not reach over a step.
const ORDERS: usize = 6;
const MORE: usize = 4;

/// So many steps an expansion lasts at most: what they add is carried on from the next one only.
const LASTS: f64 = 6.0;

/// The part of the difference that may be lost.
const REST: f64 = 0.05;

/// The shadow is as far from the solution as this part of it, so that neither curvature nor rounding counts.
const DISTANCE: f64 = 1e-6;

/// What rounding adds in each step, relative to the change. Taken for an error that grows always.
const ROUNDING: f64 = 0.5 * f64::EPSILON;

impl Shadow {
    /// Of a solution that begins with this error.
    pub fn new(error: Vec<f64>) -> Shadow {
        let zeros = vec![0.0; error.len()];
        Shadow {
            added: zeros.clone(),
            now: error.clone(),
            own: zeros,
            error,
            rows: Vec::new(),
            orders: ORDERS,
            scale: 0.0,
            unit: 1.0,
            elapsed: 0.0,
            reach: 0.0,
        }
    }

    /// The error at the end of the step looked at last, component by component.
    pub fn now(&self) -> &[f64] {
        &self.now
    }

    /// Goes along with a step; false for a method whose steps do not tell their error.
    pub fn follow(&mut self, step: &mut Step<'_>) -> bool {
        let h = step.length();
        if !step.stepper.own_error(step.system, &step.ends, &mut self.own) {
            return false;
        }
        if self.elapsed + h > self.reach {
            self.expand(step);
            self.elapsed = 0.0;
        }
        self.elapsed += h;
        let states = step.ends.before.iter().zip(step.ends.after);
        let errors = self.error.iter().zip(&self.own);
        for ((added, (error, own)), (before, after)) in self.added.iter_mut().zip(errors).zip(states) {
            *added += own + (ROUNDING * (after - before).abs()).copysign(*error);
        }
        self.evaluate();
        true
    }

    /// Expands the difference about the start of a step.
    fn expand(&mut self, step: &mut Step<'_>) {
        self.error.copy_from_slice(&self.now);
        self.added.fill(0.0);
        self.rows.clear();
        let h = step.length();
        self.reach = LASTS * h;
        let size = relative(step.system, step.ends.before, &self.error);
        if size == 0.0 || !size.is_finite() {
            return;
        }
        self.scale = DISTANCE / size;
        let near: Vec<f64> =
            step.ends.before.iter().zip(&self.error).map(|(state, error)| state + self.scale * error).collect();
        loop {
            self.unit = step.stepper.difference(step.system, &near, self.orders, &mut self.rows);
            let is_whole = self.rows.len() / self.error.len() < self.orders;
            let reach = self.convergent(step);
            if reach < h && !is_whole {
                // a stiff system: the step itself is nearly as long as all its orders allow
                self.orders += MORE;
                continue;
            }
            self.orders -= if reach > 2.0 * h && self.orders > ORDERS { MORE } else { 0 };
            // of all orders the step itself is made
            let reach = if reach > h { reach } else { h };
            self.reach = if reach < self.reach { reach } else { self.reach };
            return;
        }
    }

    /// How far the series are worth while: to where the last two terms are as large as [`REST`] of the difference.
    fn convergent(&self, step: &Step<'_>) -> f64 {
        let n = self.error.len();
        let last = self.rows.len() / n;
        let limit = |k: usize| {
            let term = relative(step.system, step.ends.before, &self.rows[(k - 1) * n..k * n]);
            if term > 0.0 { math::pow(REST * DISTANCE / term, 1.0 / k as f64) } else { f64::INFINITY }
        };
        self.unit * math::smaller(limit(last), limit(last - 1))
    }

    /// The error at the present time.
    fn evaluate(&mut self) {
        let n = self.error.len();
        if self.rows.is_empty() {
            for ((now, error), added) in self.now.iter_mut().zip(&self.error).zip(&self.added) {
                *now = error + added;
            }
            return;
        }
        let h = self.elapsed / self.unit;
        self.now.fill(0.0);
        for row in self.rows.rchunks_exact(n) {
            for (now, coefficient) in self.now.iter_mut().zip(row) {
                *now = (*now + coefficient) * h;
            }
        }
        let share = 1.0 / self.scale;
        for ((now, error), added) in self.now.iter_mut().zip(&self.error).zip(&self.added) {
            *now = (error + added) + share * *now;
        }
    }
}

/// The largest error in units of what the tolerance is compared with.
fn relative(system: &dyn System, state: &[f64], error: &[f64]) -> f64 {
    let mut all = 0.0;
    for group in system.groups() {
        let (states, errors) = (&state[group.range.clone()], &error[group.range]);
        let part = match group.measure {
            Measure::Largest => {
                let states = largest(states);
                largest(errors) / if states > group.floor { states } else { group.floor }
            }
            Measure::Smallest => states.iter().zip(errors).fold(0.0, |part, (state, error)| {
                let size = if state.abs() > group.floor { state.abs() } else { group.floor };
                let own = error.abs() / size;
                if own <= part { part } else { own }
            }),
        };
        all = if part <= all { all } else { part };
    }
    all
}
