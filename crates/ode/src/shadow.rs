//! Propagates the error of a solution by Taylor's method along with the solution.
//!
//! Each step estimates its own error by the difference at its end between the slope of its series and the right-hand
//! side. The linearised equations propagate these errors ([`crate::linear`]), if the system provides them. Otherwise a
//! neighbouring second solution is used; near enough, it needs few orders of the series and not every step, so it costs
//! a small part of the first one.

use crate::dense::Step;
use crate::linear::Linear;
use crate::system::{Measure, System};
use crate::taylor::{Change, forced};
use crate::vector::largest;
use math::simd::{Kernel, dispatch};
use std::ops::Range;

/// The error of a solution, step by step.
#[derive(Clone, Debug)]
pub struct Shadow {
    /// The error where the shadow was expanded last.
    error: Vec<f64>,
    /// What the steps since then have added, the last one included.
    added: Vec<f64>,
    /// What the last step has added.
    own: Vec<f64>,
    /// The orders of the shadow's difference from the solution, as series in time since then, after a row of no
    /// meaning.
    rows: Vec<f64>,
    /// Whether there is an error that they follow.
    has_rows: bool,
    /// How many orders.
    orders: usize,
    /// How large the error is, and how much larger the difference.
    size: f64,
    scale: f64,
    /// The unit of time of the series.
    unit: f64,
    /// The time from then to the end of the last step, and how far the series reach.
    elapsed: f64,
    reach: f64,
    /// The length of the step of the expansion.
    expanded: f64,
    /// The length of the last step, and the power of it with which its own error grows.
    length: f64,
    power: usize,
    is_sure: bool,
    /// Propagates the error over each step separately, if the system provides its linearised equations.
    linear: Option<Linear>,
    is_linear_known: bool,
    /// The error at the end of the step looked at last, if it is carried so.
    after: Vec<f64>,
    /// What the next rounding is drawn by.
    lot: u64,
    /// The components with a force.
    forced: Vec<Range<usize>>,
}

/// Orders of the series of the difference at first, how many more where these do not reach over a step, and the fewest.
const ORDERS: usize = 6;
const MORE: usize = 2;
const FEWEST: usize = 4;

/// Number of steps that an expansion should cover; with more, the errors of the first of them would be added too late.
const MARGIN: f64 = 1.15;

/// So many steps an expansion lasts at most: what they add is carried on from the next one only.
const LASTS: f64 = 6.0;

/// Steps that have become shorter by this factor show something that the series does not: a sharp bend of the law.
const SHORTER: f64 = 0.5;

/// What steps have added is carried on once it is this part of the error.
const FRESH: f64 = 0.25;

/// The part of the difference that may be lost.
const REST: f64 = 0.005;

/// So far beyond their reach series are believed: the last two terms are then a few tenths of the difference at most.
const BEYOND: f64 = 1.5;

/// The shadow is as far from the solution as this part of it, so that neither curvature nor rounding counts.
const DISTANCE: f64 = 1e-9;

/// Fewer numbers than that are not worth a kernel.
const FEW: usize = 8;

/// What rounding adds in each step, relative to the change. Taken for an error that grows always.
const ROUNDING: f64 = 0.5 * f64::EPSILON;

impl Shadow {
    /// Of a solution that begins with this error, computed less exact: one number for each component, in its unit.
    pub fn new(error: Vec<f64>) -> Shadow {
        let zeros = vec![0.0; error.len()];
        Shadow {
            added: zeros.clone(),
            own: zeros,
            error,
            rows: Vec::new(),
            has_rows: false,
            orders: ORDERS,
            size: 0.0,
            scale: 0.0,
            unit: 1.0,
            elapsed: 0.0,
            reach: 0.0,
            expanded: 0.0,
            length: 0.0,
            power: 1,
            is_sure: true,
            linear: None,
            is_linear_known: false,
            after: Vec::new(),
            lot: 0,
            forced: Vec::new(),
        }
    }

    /// Follows a step in which the rates have the given rounding errors (one for each component with a force), and all
    /// forces are off by the same part of themselves, as they are by rounded constants; false for a method whose steps
    /// give no error estimate.
    pub fn follow(&mut self, step: &mut Step<'_>, rounding: f64, part: f64) -> bool {
        if !step.stepper.own_error(step.system, &step.ends, &mut self.own) {
            return false;
        }
        self.advance(step);
        self.power = step.stepper.error_power() + 1;
        self.round(rounding);
        self.strengthen(step, part);
        if !self.arrive(step, ROUNDING) {
            let (before, after) = (step.ends.before, step.ends.after);
            dispatch(Rounded { before, after, error: &self.error, own: &mut self.own });
            self.added.iter_mut().zip(&self.own).for_each(|(added, own)| *added += own);
        }
        true
    }

    /// Roundings of rates are as if drawn by lot: a step pushes each component one way or the other.
    fn round(&mut self, rounding: f64) {
        if rounding == 0.0 {
            return;
        }
        let push = self.length * rounding;
        for range in &self.forced {
            for own in self.own[range.clone()].chunks_mut(u64::BITS as usize) {
                dispatch(Pushed { lot: drawn(&mut self.lot), push, own });
            }
        }
    }

    /// Forces that are off by a part push with the same sign in all steps: what they do adds up.
    fn strengthen(&mut self, step: &Step<'_>, part: f64) {
        let (part, relaxation) = (part * self.length, step.system.relaxation_rate());
        for range in &self.forced {
            let (states, rates) = (&step.after()[range.clone()], &step.rates_after()[range.clone()]);
            let strengthened = Strengthened { part, relaxation, states, rates, own: &mut self.own[range.clone()] };
            // of a few, a call would take longer than the work
            if range.len() < FEW { strengthened.run() } else { dispatch(strengthened) }
        }
    }

    /// Whether the series of the error have reached over every step so far. Where motion is much stiffer for an error
    /// than for the solution, they do not, and the error says nothing.
    pub fn is_sure(&self) -> bool {
        self.is_sure
    }

    /// Goes along with a step that adds nothing: of the errors before it alone.
    pub fn carry(&mut self, step: &mut Step<'_>) {
        self.advance(step);
        self.own.fill(0.0);
        self.arrive(step, 0.0);
    }

    /// Computes the error at the end of a step that is propagated separately.
    fn arrive(&mut self, step: &Step<'_>, rounding: f64) -> bool {
        let Some(linear) = self.linear.as_ref().filter(|_| self.has_rows) else { return false };
        linear.end(step, &self.own, rounding, &self.error, &mut self.after);
        true
    }

    fn advance(&mut self, step: &mut Step<'_>) {
        let h = step.length();
        if !self.is_linear_known {
            (self.linear, self.is_linear_known) = (Linear::new(step.system), true);
            self.forced = forced(step.system);
        }
        if self.linear.is_some() {
            self.expand_linear(step);
            self.length = h;
            return;
        }
        let adds_much = relative(step.system, step.ends.before, &self.added) > FRESH * self.size;
        if adds_much || self.elapsed + h > self.reach || h < SHORTER * self.expanded {
            self.expand(step);
            (self.elapsed, self.expanded) = (0.0, h);
        }
        self.elapsed += h;
        self.length = h;
    }

    /// Carries the error over the step by the linearised equations.
    fn expand_linear(&mut self, step: &Step<'_>) {
        if self.has_rows {
            std::mem::swap(&mut self.error, &mut self.after);
        } else {
            self.after.clone_from(&self.error);
        }
        if let Some(linear) = &mut self.linear {
            self.has_rows = linear.carry(step, &self.error, &mut self.after);
            self.is_sure &= self.has_rows;
        }
    }

    /// Expands the difference about the start of a step.
    fn expand(&mut self, step: &mut Step<'_>) {
        let mut near = vec![0.0; self.error.len()];
        self.sum(1.0, &mut near);
        self.error.copy_from_slice(&near);
        self.added.fill(0.0);
        let h = step.length();
        // what the first steps add is carried on from the next one
        self.reach = h;
        self.size = relative(step.system, step.ends.before, &self.error);
        self.scale = DISTANCE / self.size;
        self.has_rows = self.scale.is_finite() && self.scale > 0.0;
        if !self.has_rows {
            return;
        }
        near.iter_mut().zip(step.ends.before).for_each(|(near, state)| *near = state + self.scale * *near);
        loop {
            self.unit = step.stepper.difference(step.system, &near, self.orders, &mut self.rows);
            let made = self.rows.len() / near.len() - 1;
            let is_whole = made < self.orders;
            let reach = self.convergent(step, made);
            if reach < h && !is_whole {
                // a stiff system: the step itself is nearly as long as all its orders allow
                self.orders += MORE;
                continue;
            }
            self.is_sure &= h < BEYOND * reach;
            // of all orders the step itself is made
            let reach = if reach > h { reach } else { h };
            self.reach = if reach < LASTS * h { reach } else { LASTS * h };
            self.adapt(step, made, reach);
            return;
        }
    }

    /// The orders of the next expansion: one more where these do not reach over [`MARGIN`] steps, one less where one
    /// less does.
    fn adapt(&mut self, step: &Step<'_>, made: usize, reach: f64) {
        let enough = MARGIN * step.length();
        self.orders = made;
        if reach < enough {
            self.orders += 1;
        } else if made > FEWEST && self.convergent(step, made - 1) > enough {
            self.orders -= 1;
        }
    }

    /// The distance over which the given number of orders of the series is useful: to where the last two terms are as
    /// large as [`REST`] of the difference.
    fn convergent(&self, step: &Step<'_>, last: usize) -> f64 {
        let n = self.error.len();
        let limit = |k: usize| {
            let term = relative(step.system, step.ends.before, &self.rows[k * n..(k + 1) * n]);
            if term > 0.0 { math::pow(REST * DISTANCE / term, 1.0 / k as f64) } else { f64::INFINITY }
        };
        self.unit * math::smaller(limit(last), limit(last - 1))
    }

    /// Writes the error at the fraction `theta` of the step looked at last, component by component.
    pub fn at(&self, step: &mut Step<'_>, theta: f64, result: &mut [f64]) {
        match self.linear.as_ref().filter(|_| self.has_rows) {
            Some(_) if theta == 1.0 => result.copy_from_slice(&self.after),
            Some(linear) => {
                linear.at(step, theta, &self.error, result);
                let share = self.own_share(theta);
                result.iter_mut().zip(&self.own).for_each(|(result, own)| *result += share * own);
            }
            None => self.sum(theta, result),
        }
    }

    /// Writes the error at the end of the step looked at last.
    pub fn at_end(&self, result: &mut [f64]) {
        match self.linear.as_ref().filter(|_| self.has_rows) {
            Some(_) => result.copy_from_slice(&self.after),
            None => self.sum(1.0, result),
        }
    }

    /// The error given by the series of the last steps.
    fn sum(&self, theta: f64, result: &mut [f64]) {
        if self.has_rows {
            let h = (self.elapsed - (1.0 - theta) * self.length) / self.unit;
            dispatch(Change::<false> { rows: &self.rows, n: result.len(), from: 0, h, result });
            let share = 1.0 / self.scale;
            result.iter_mut().for_each(|result| *result *= share);
        } else {
            result.fill(0.0);
        }
        // what lies before the own error of the step has been added whole
        let rest = 1.0 - self.own_share(theta);
        let errors = self.error.iter().zip(&self.added).zip(&self.own);
        for (result, ((error, added), own)) in result.iter_mut().zip(errors) {
            *result += error + (added - rest * own);
        }
    }

    /// The part of a step's own error that has accrued at the fraction `theta` of it.
    fn own_share(&self, theta: f64) -> f64 {
        (0..self.power).fold(1.0, |power, _| power * theta)
    }

    /// The error at the end of the last step, when each step is propagated separately.
    pub fn after(&self) -> Option<&[f64]> {
        self.linear.as_ref().filter(|_| self.has_rows).map(|_| &self.after[..])
    }

    /// The error at the start of the last step, when each step is propagated separately.
    pub fn before(&self) -> Option<&[f64]> {
        self.linear.as_ref().filter(|_| self.has_rows).map(|_| &self.error[..])
    }

    /// How many components it has.
    pub fn dimension(&self) -> usize {
        self.error.len()
    }
}

/// Adds what rounding makes of the change in a step, with the sign of the error.
struct Rounded<'a> {
    before: &'a [f64],
    after: &'a [f64],
    error: &'a [f64],
    own: &'a mut [f64],
}

impl Kernel for Rounded<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let states = self.before.iter().zip(self.after);
        for ((error, own), (before, after)) in self.error.iter().zip(self.own).zip(states) {
            *own += (ROUNDING * (after - before).abs()).copysign(*error);
        }
    }
}

/// The next 64 bits drawn by lot: Vigna's SplitMix64.
fn drawn(lot: &mut u64) -> u64 {
    *lot = lot.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let mixed = (*lot ^ (*lot >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    mixed ^ (mixed >> 31)
}

/// Pushes up to 64 components, each one way or the other as its bit says.
struct Pushed<'a> {
    lot: u64,
    push: f64,
    own: &'a mut [f64],
}

impl Kernel for Pushed<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        for (bit, own) in (0..u64::BITS).zip(self.own) {
            let sign = (self.lot >> bit) << (u64::BITS - 1);
            *own += f64::from_bits(self.push.to_bits() ^ sign);
        }
    }
}

/// Adds this part of the forces.
struct Strengthened<'a> {
    part: f64,
    relaxation: f64,
    states: &'a [f64],
    rates: &'a [f64],
    own: &'a mut [f64],
}

impl Kernel for Strengthened<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        for (own, (rate, state)) in self.own.iter_mut().zip(self.rates.iter().zip(self.states)) {
            *own += self.part * (rate + self.relaxation * state);
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
