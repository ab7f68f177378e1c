//! Heun's scheme in four variants: standard, with compensated sums, in positions wrapped into the ring, and in
//! double-double arithmetic.

use figures::failure::Failure;
use jam::states::RingSystem;
use math::double_double::DoubleDouble;
use math::simd::{Kernel, dispatch};
use ode::{Control, Method, Problem, Step, integrate};
use reference::ring::Ring as ExactRing;
use std::ops::ControlFlow;

/// A state under way: every component is `state + carry`, of which the equations see `state` alone.
#[derive(Clone, Debug)]
pub struct Sum {
    /// What the equations see.
    pub state: Vec<f64>,
    /// What rounding dropped of it; all 0 for plain sums.
    pub carry: Vec<f64>,
}

/// How steps are added up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Adding {
    /// In doubles.
    Plain,
    /// What rounding drops of a sum is added to the next step (Kahan 1965).
    Compensated,
}

impl Sum {
    /// This state, exactly.
    pub fn new(state: Vec<f64>) -> Sum {
        Sum { carry: vec![0.0; state.len()], state }
    }

    /// Goes on for a time that is a multiple of the step `h`.
    ///
    /// # Errors
    /// The state is no longer finite.
    pub fn advance(&mut self, form: &dyn RingSystem, h: f64, time: f64, adding: Adding) -> Result<(), Failure> {
        match adding {
            Adding::Plain => {
                let (start, control) = (&self.state, Control::Fixed { step: h });
                let problem = Problem { system: form, start, begin: 0.0, end: time, method: Method::Heun, control };
                let quiet = &mut |_: &mut Step<'_>| ControlFlow::Continue(());
                self.state = integrate(&problem, quiet).map_err(Failure::work)?.state;
            }
            Adding::Compensated => self.compensated(form, h, (time / h).round() as u64),
        }
        Ok(())
    }

    fn compensated(&mut self, form: &dyn RingSystem, h: f64, count: u64) {
        let size = self.state.len();
        let (mut stage, mut first, mut second) = (vec![0.0; size], vec![0.0; size], vec![0.0; size]);
        for _ in 0..count {
            form.rates(&self.state, &mut first);
            dispatch(Predict { state: &self.state, rates: &first, h, stage: &mut stage });
            form.rates(&stage, &mut second);
            dispatch(Correct { sum: self, rates: [&first, &second], half: 0.5 * h });
        }
    }
}

/// Positions in `[0, L)` and speeds, as a program writes them that puts each pedestrian back by `L` once it has gone
/// round.
pub struct Wrapped<'a> {
    /// The equations in gaps; positions are turned into these for each evaluation.
    pub gaps: &'a dyn RingSystem,
    /// The headway at contact, which a clearance lacks.
    pub contact: f64,
    /// `L`.
    pub length: f64,
}

impl Wrapped<'_> {
    /// Goes on for a time that is a multiple of the step `h`.
    pub fn advance(&self, sum: &mut Sum, h: f64, time: f64, adding: Adding) {
        let size = sum.state.len();
        let (mut stage, mut first, mut second) = (vec![0.0; size], vec![0.0; size], vec![0.0; size]);
        let mut inner = [vec![0.0; self.gaps.dimension()], vec![0.0; self.gaps.dimension()]];
        for _ in 0..(time / h).round() as u64 {
            self.rates(&sum.state, &mut first, &mut inner);
            dispatch(Predict { state: &sum.state, rates: &first, h, stage: &mut stage });
            self.rates(&stage, &mut second, &mut inner);
            match adding {
                Adding::Plain => {
                    for ((state, a), b) in sum.state.iter_mut().zip(&first).zip(&second) {
                        *state += 0.5 * h * (a + b);
                    }
                }
                Adding::Compensated => dispatch(Correct { sum, rates: [&first, &second], half: 0.5 * h }),
            }
            for place in &mut sum.state[..size / 2] {
                // exact: both are within a factor of 2
                *place = if *place >= self.length { *place - self.length } else { *place };
            }
        }
    }

    /// Speeds and accelerations; `inner` has room for a state in gaps and its rates.
    fn rates(&self, state: &[f64], rates: &mut [f64], [gaps, of_gaps]: &mut [Vec<f64>; 2]) {
        let count = state.len() / 2;
        for (n, clearance) in gaps[..count].iter_mut().enumerate() {
            *clearance = self.headway(state, n) - self.contact;
        }
        gaps[count..2 * count].copy_from_slice(&state[count..]);
        self.gaps.rates(gaps, of_gaps);
        rates[..count].copy_from_slice(&state[count..]);
        rates[count..].copy_from_slice(&of_gaps[count..2 * count]);
    }

    /// The headway of a pedestrian.
    fn headway(&self, state: &[f64], n: usize) -> f64 {
        let ahead = if n + 1 < state.len() / 2 { state[n + 1] } else { state[0] };
        let apart = ahead - state[n];
        if apart < 0.0 { apart + self.length } else { apart }
    }
}

/// `stage = state + h rates`.
struct Predict<'a> {
    state: &'a [f64],
    rates: &'a [f64],
    h: f64,
    stage: &'a mut [f64],
}

impl Kernel for Predict<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        for ((stage, state), rate) in self.stage.iter_mut().zip(self.state).zip(self.rates) {
            *stage = state + self.h * rate;
        }
    }
}

/// `state + carry` grows by `half (rates_0 + rates_1)`.
struct Correct<'a> {
    sum: &'a mut Sum,
    rates: [&'a [f64]; 2],
    half: f64,
}

impl Kernel for Correct<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let rates = self.rates[0].iter().zip(self.rates[1]);
        for ((state, carry), (first, second)) in self.sum.state.iter_mut().zip(&mut self.sum.carry).zip(rates) {
            let new = DoubleDouble::sum(*state, self.half * (first + second) + *carry);
            (*state, *carry) = (new.hi, new.lo);
        }
    }
}

/// `count` steps of length `h` of the scheme in numbers of 106 bits: its truncation without its rounding.
pub fn without_rounding(ring: &ExactRing, state: &mut [DoubleDouble], h: DoubleDouble, count: u64) {
    let size = ring.dimension();
    let (mut stage, mut first, mut second) =
        (vec![DoubleDouble::ZERO; size], vec![DoubleDouble::ZERO; size], vec![DoubleDouble::ZERO; size]);
    let half = h.times(0.5);
    for _ in 0..count {
        ring.rates(state, &mut first);
        for ((stage, state), rate) in stage.iter_mut().zip(&*state).zip(&first) {
            *stage = *state + h * *rate;
        }
        ring.rates(&stage, &mut second);
        for ((state, first), second) in state.iter_mut().zip(&first).zip(&second) {
            *state = *state + half * (*first + *second);
        }
    }
}
