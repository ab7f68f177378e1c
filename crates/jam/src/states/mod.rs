//! The ring as a system of equations, in three forms of the state.
//!
//! | form | state | for |
//! |---|---|---|
//! | [`Deviations`] | gaps and speeds minus those of the uniform flow | default: errors relative to the perturbation |
//! | [`Spacings`] | gaps and speeds | the textbook form |
//! | [`Positions`] | unwrapped positions and speeds | the scheme of the paper, literally |

mod deviations;
mod positions;
mod series;
mod spacings;
mod tangent;

pub use crate::force::{Cut, heun_steps};
pub use deviations::Deviations;
pub use positions::Positions;
pub use spacings::Spacings;

use crate::force::{Flow, Force};
use crate::laws::Model;
use crate::observe::speed_std;
use crate::ring::{Ring, Start};
use math::simd::{Kernel, dispatch};
use std::ops::Range;

/// A ring in one of the forms. Pedestrian `n` follows `n + 1`, the last follows the first. Positions and gaps are in
/// units of `a_0`, times in units of `tau`; rows of pedestrians have `N` numbers, states and their rates
/// [`ode::System::dimension`].
pub trait RingSystem: ode::System {
    /// The state at the start.
    fn start(&self, start: Start) -> Vec<f64>;

    /// The state at rest with each of the `N` pedestrians moved by so much from equal spacings.
    fn start_displaced(&self, displacements: &[f64]) -> Vec<f64>;

    /// Writes the `N` gaps and the `N` speeds.
    fn read(&self, state: &[f64], gaps: &mut [f64], speeds: &mut [f64]);

    /// Writes the rates of the gaps and of the speeds.
    fn read_rates(&self, rates: &[f64], gaps: &mut [f64], speeds: &mut [f64]);

    /// Writes the `N` positions, unwrapped: they start in [0, L) and grow as the pedestrians walk.
    fn write_positions(&self, state: &[f64], positions: &mut [f64]);

    /// The range of the speeds in a state, or of their deviations from one speed.
    fn speeds(&self) -> Range<usize>;

    /// For states of deviations from a uniform flow, which stand first, those of gaps before those of speeds: that
    /// flow. `None` for others.
    fn flow_along(&self, _state: &[f64], _rates: &[f64]) -> Option<FlowAlong> {
        None
    }

    /// The standard deviation of the speeds over the pedestrians (divided by `N`).
    fn speed_std(&self, state: &[f64]) -> f64 {
        speed_std(&state[self.speeds()])
    }
}

/// A uniform flow that is integrated along.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlowAlong {
    /// Its spacing less that at contact.
    pub net_gap: f64,
    /// Its speed.
    pub speed: f64,
    /// How fast that changes, in units of `a_0 / tau^2`.
    pub acceleration: f64,
}

/// Perturbations and clearances keep their relative precision down to this size; below it the tolerance of their errors
/// would come near the least doubles, which have no digits.
const LEAST_SIZE: f64 = 1e-305;

/// Which form.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StateVariables {
    /// See [`Deviations`].
    Deviations,
    /// See [`Spacings`].
    Spacings,
    /// See [`Positions`].
    Positions,
}

impl StateVariables {
    /// The ring in this form, with the law reduced to the terms it names.
    pub fn build(self, model: &Model, ring: Ring) -> Box<dyn RingSystem> {
        self.build_off(model, ring, 0.0)
    }

    /// The same with a force that rates, but not series, have too strong by this part of itself; in positions it is
    /// right.
    pub(crate) fn build_off(self, model: &Model, ring: Ring, off: f64) -> Box<dyn RingSystem> {
        let force = model.force();
        match self {
            StateVariables::Deviations => Box::new(Deviations::new(force, ring).off_by(off)),
            StateVariables::Spacings => Box::new(Spacings::new(force, ring).off_by(off)),
            StateVariables::Positions => Box::new(Positions::new(force, ring)),
        }
    }
}

/// The state of the form [`Spacings`] with these gaps, speeds and position of pedestrian 0.
pub fn gaps_state(model: &Model, gaps: &[f64], speeds: &[f64], first: f64) -> Vec<f64> {
    let contact = model.contact();
    gaps.iter().map(|gap| gap - contact).chain(speeds.iter().copied()).chain([first]).collect()
}

/// How fast speeds relax if no force acts: at rate 1 unless the law, linear in speeds, says otherwise.
fn relaxation_rate(force: &dyn Force, net_gap: f64) -> f64 {
    let linear = (!force.uses_speeds()).then(|| -force.relaxation(Flow { net_gap, speed: 0.0 }));
    linear.filter(|rate| rate.is_finite()).unwrap_or(1.0)
}

/// Adds this part of the force, which is the rate of a speed and what relaxation has taken off it.
fn strengthen(part: f64, relaxation: f64, speeds: &[f64], rates: &mut [f64]) {
    rates.iter_mut().zip(speeds).for_each(|(rate, speed)| *rate += part * (*rate + relaxation * speed));
}

/// A state of spacings, or of deviations, with each of the `N` pedestrians displaced as given: spacings come first,
/// then the speeds, then the position of the first pedestrian.
fn displace(mut state: Vec<f64>, displacements: &[f64]) -> Vec<f64> {
    let n = displacements.len();
    for own in 0..n {
        state[own] += displacements[(own + 1) % n] - displacements[own];
    }
    state[2 * n] += displacements[0];
    state
}

/// Writes `rate[n] = speed[n + 1] - speed[n]` around the ring.
fn closing_rates(speeds: &[f64], rates: &mut [f64]) {
    dispatch(ClosingRates { speeds, rates });
}

struct ClosingRates<'a> {
    speeds: &'a [f64],
    rates: &'a mut [f64],
}

impl Kernel for ClosingRates<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let ClosingRates { speeds, rates } = self;
        let last = speeds.len() - 1;
        for ((rate, own), ahead) in rates.iter_mut().zip(speeds).zip(&speeds[1..]) {
            *rate = ahead - own;
        }
        rates[last] = speeds[0] - speeds[last];
    }
}
