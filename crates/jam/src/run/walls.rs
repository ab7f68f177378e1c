//! Ends of a run that no step shows: a wall of the force, and states at which the law has no value.

use super::recorder::Recorder;
use super::{Run, has_deviations};
use crate::errors::loses_shift;
use crate::events::{Event, EventKind};
use crate::states::StateVariables;
use ode::Control;

/// Where the smallest effective gap falls below this part of that in the uniform flow, spacings become the state: they
/// keep all digits however small they are; deviations from the uniform flow have lost three of them there. They do,
/// too, where deviations lead no further.
const NEAR_WALLS: f64 = 1e-3;

/// Where the law is steep, roundings of the state keep steps from ever meeting a tolerance below this.
const NEAR_ROUNDING: f64 = 1e-11;

/// If no shorter step is possible at a wall and the effective gap is below this, a pedestrian has come closer to the
/// wall than a double can resolve, and the force exceeds every double.
const NO_GAP: f64 = 1e-200;

impl Recorder<'_> {
    /// Whether a run ends because a pedestrian comes closer to a wall than a double can resolve; this is then an event.
    pub(super) fn is_at_wall(&mut self, failure: &ode::Failure, time: f64, state: &[f64]) -> bool {
        let Some(narrowest) = self.narrowest else { return false };
        let is_singular = self.run.model.is_singular() && self.is_in_spacings();
        let is_stuck = matches!(failure, ode::Failure::StepTooSmall { .. });
        let left = self.effective_gaps(state)[narrowest.pedestrian];
        let is_at_wall = is_singular && is_stuck && left < NO_GAP;
        if is_at_wall {
            let (pedestrian, gap) = (narrowest.pedestrian, narrowest.spacing);
            self.watch.add(Event { kind: EventKind::BlowUp, time, pedestrian, gap, step: 0.0 });
        }
        is_at_wall
    }

    /// Whether a run ends since its law has no value a little further on; then that is an event.
    pub(super) fn is_undefined(&mut self, failure: &ode::Failure, time: f64, state: &[f64]) -> bool {
        if !self.run.model.may_be_undefined() {
            return false;
        }
        let form = self.record.form;
        let mut rates = vec![0.0; form.dimension()];
        form.rates(state, &mut rates);
        // as far as a step that fails would go at least, and one of fixed length goes
        let (least, step) = (1e-9 * if time > 1.0 { time } else { 1.0 }, step_of(failure));
        let further = if step > least { step } else { least };
        let next: Vec<f64> = state.iter().zip(&rates).map(|(x, rate)| x + further * rate).collect();
        let (mut spacings, mut accelerations) = (self.record.spacings.clone(), self.record.speeds.clone());
        // a step of fixed length over a wall is too long
        let is_over = step > 0.0 && !form.in_domain(&next);
        for tried in [state, if is_over { state } else { &next }] {
            form.rates(tried, &mut rates);
            form.read_rates(&rates, &mut spacings, &mut accelerations);
            let Some(pedestrian) = accelerations.iter().position(|a| !a.is_finite()) else { continue };
            form.read(state, &mut spacings, &mut accelerations);
            let gap = spacings[pedestrian];
            self.watch.add(Event { kind: EventKind::Undefined, time, pedestrian, gap, step });
            return true;
        }
        false
    }

    /// The effective gaps, with all the digits that the form has.
    pub(super) fn effective_gaps(&self, state: &[f64]) -> Vec<f64> {
        let mut gaps = self.watch.effective_gaps_in(state);
        if self.is_in_spacings() && self.run.model.gap_per_speed() == 0.0 {
            gaps.copy_from_slice(&state[..self.run.ring.pedestrians]);
        }
        gaps
    }

    fn is_in_spacings(&self) -> bool {
        self.is_near_walls || self.run.form == StateVariables::Spacings
    }

    /// Whether a run in deviations may continue in spacings. Runs with fixed steps keep their form.
    pub(super) fn can_turn(&self) -> bool {
        let is_adaptive = matches!(self.run.control, Control::Adaptive { .. });
        !self.is_near_walls && self.run.form == StateVariables::Deviations && is_adaptive
    }

    /// Whether the leg in deviations ends here.
    pub(super) fn comes_near_walls(&self) -> bool {
        let run = self.run;
        let Some(speed) = run.steady_speed else { return false };
        let least = NEAR_WALLS * run.model.effective_gap(run.ring.headway(), speed, speed);
        let is_near = !self.watch.is_quiet() && run.model.is_singular() && self.can_turn();
        is_near && self.watch.effective_gaps().iter().any(|&gap| gap < least)
    }
}

/// The length of the step of fixed length that failed; 0 for others.
fn step_of(failure: &ode::Failure) -> f64 {
    match failure {
        ode::Failure::NotFinite { step, .. } => *step,
        _ => 0.0,
    }
}

/// What helps a run that broke.
pub(crate) fn advice(failure: &ode::Failure, run: &Run) -> Option<&'static str> {
    match failure {
        ode::Failure::TooManySteps { .. }
            if run.form == StateVariables::Positions && run.most_steps < ode::MOST_STEPS =>
        {
            Some(
                "raise most_steps or the tolerance, or use state = \"deviations\", which keeps more digits of small gaps",
            )
        }
        ode::Failure::TooManySteps { .. } if run.most_steps < ode::MOST_STEPS => {
            Some("raise most_steps or the tolerance")
        }
        ode::Failure::TooManySteps { .. } => Some("raise the tolerance"),
        ode::Failure::NotFinite { .. } => Some("a smaller step may help"),
        ode::Failure::NotConfirmed { .. }
            if loses_shift(run) && has_deviations(&run.model, run.ring, run.steady_speed) =>
        {
            Some("the shift is lost beside the spacings: state = \"deviations\" keeps it")
        }
        ode::Failure::NotConfirmed { .. } => match run.control {
            Control::Fixed { .. } => Some("a smaller step may help"),
            Control::Adaptive { .. } if run.form == StateVariables::Positions => {
                Some("a smaller tolerance may help, or state = \"deviations\", which keeps more digits of small gaps")
            }
            Control::Adaptive { .. } => Some("a smaller tolerance may help"),
        },
        ode::Failure::StepTooSmall { .. } if run.form == StateVariables::Positions => {
            Some("state = \"deviations\" keeps more digits of small gaps")
        }
        ode::Failure::StepTooSmall { .. } => match run.control {
            Control::Adaptive { tolerance } if tolerance < NEAR_ROUNDING => {
                Some("raise the tolerance: it is near the rounding of the state")
            }
            _ => None,
        },
        _ => None,
    }
}
