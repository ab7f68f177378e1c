//! Runs of a ring for the hard cases: any form, any method, and the reason why each ended.

use figures::failure::Failure;
use jam::events::{Event, Watch};
use jam::laws::{Algebraic, Model};
use jam::ring::{Ring, Start};
use jam::states::{RingSystem, StateVariables};
use ode::{Control, Method, Observer, Problem, Statistics, Step, integrate};
use std::ops::ControlFlow;

/// A law on a ring, in a form of the state.
#[derive(Clone, Debug)]
pub struct Case {
    /// The law.
    pub model: Model,
    /// The ring.
    pub ring: Ring,
    /// The form.
    pub kind: StateVariables,
}

/// How a case is integrated, and from when to when.
#[derive(Clone, Copy, Debug)]
pub struct Leg {
    /// The method.
    pub method: Method,
    /// The rule for the steps.
    pub control: Control,
    /// From this time.
    pub begin: f64,
    /// To this time, or the first stop (see [`jam::events::EventKind::is_stop`]).
    pub end: f64,
}

/// What ended a run before its time.
#[derive(Clone, Debug)]
pub struct Stop {
    /// The name of the event, or of the failure.
    pub name: &'static str,
    /// When.
    pub time: f64,
    /// Who: to whom the event happened, or who had the least room.
    pub pedestrian: usize,
    /// The gap ahead of that pedestrian.
    pub gap: f64,
    /// The length of the step.
    pub step: f64,
}

/// A run that has ended.
#[derive(Clone, Debug)]
pub struct HardRun {
    /// Why before its time; `None` where it reached its end.
    pub stop: Option<Stop>,
    /// The first event of each kind.
    pub events: Vec<Event>,
    /// The last state.
    pub state: Vec<f64>,
    /// The gaps then.
    pub gaps: Vec<f64>,
    /// The speeds then.
    pub speeds: Vec<f64>,
    /// Accepted steps.
    pub steps: u64,
    /// Evaluations of the right-hand side; 0 where the integration failed.
    pub evaluations: u64,
}

/// Looks for events; keeps what a failure leaves.
struct Looking<'a> {
    watch: Watch<'a>,
    steps: u64,
    last: Vec<f64>,
}

impl Observer for Looking<'_> {
    fn after(&mut self, step: &mut Step<'_>) -> ControlFlow<()> {
        self.steps += 1;
        let is_stop = self.watch.look(step).iter().any(|happening| happening.kind.is_stop());
        if is_stop { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    fn stuck(&mut self, reached: &Statistics) {
        self.last = reached.state.clone();
    }
}

/// The law of figure 4, `<mu, 0, 2, 0>`, with this `mu`.
pub fn figure_4(strength: f64) -> Model {
    let (relative, power, widening, epsilon, desired_speed) = (0.0, 2.0, 0.0, 0.1, 3.0);
    Model::Algebraic(Algebraic { mu: strength, delta: relative, q: power, a_v: widening, epsilon, v0: desired_speed })
}

impl Case {
    /// The ring in its form.
    pub fn form(&self) -> Box<dyn RingSystem> {
        self.kind.build(&self.model, self.ring)
    }

    /// The methods that suit it.
    pub fn methods(&self) -> Vec<Method> {
        let form = self.form();
        Method::ALL.into_iter().filter(|method| method.suits(&*form)).collect()
    }

    /// Runs from the start of the paper with this shift.
    pub fn run(&self, shift: f64, leg: Leg) -> HardRun {
        self.run_from(&self.form().start(Start { shift }), leg)
    }

    /// Runs from a state.
    pub fn run_from(&self, start: &[f64], leg: Leg) -> HardRun {
        let form = self.form();
        let count = self.ring.pedestrians;
        let mut looking = Looking { watch: Watch::new(self.model.clone(), &*form, count), steps: 0, last: Vec::new() };
        let Leg { method, control, begin, end } = leg;
        let result = integrate(&Problem { system: &*form, start, begin, end, method, control }, &mut looking);
        let events = looking.watch.found().to_vec();
        let (state, evaluations) = match &result {
            Ok(statistics) => (statistics.state.clone(), statistics.evaluations),
            Err(_) => (looking.last, 0),
        };
        let (mut gaps, mut speeds) = (vec![0.0; count], vec![0.0; count]);
        form.read(&state, &mut gaps, &mut speeds);
        let event = events.iter().find(|happening| happening.kind.is_stop());
        let stop = match (event, &result) {
            (Some(Event { kind: event, time, pedestrian, gap, step }), _) => {
                Some(Stop { name: event.name(), time: *time, pedestrian: *pedestrian, gap: *gap, step: *step })
            }
            (None, Err(failure)) => Some(self.failed(failure, &gaps, &speeds)),
            (None, Ok(_)) => None,
        };
        HardRun { stop, events, state, gaps, speeds, steps: looking.steps, evaluations }
    }

    fn failed(&self, failure: &ode::Failure, gaps: &[f64], speeds: &[f64]) -> Stop {
        let (time, step) = match failure {
            ode::Failure::NotFinite { time, step } | ode::Failure::StepTooSmall { time, step } => (*time, *step),
            ode::Failure::TooManySteps { time, .. } | ode::Failure::NotConfirmed { time } => (*time, 0.0),
            ode::Failure::NoErrorEstimate(_) | ode::Failure::NoSeries | ode::Failure::NotResumable => (0.0, 0.0),
        };
        let name = failure.name();
        let room = |n: usize| self.model.effective_gap(gaps[n], speeds[n], speeds[(n + 1) % speeds.len()]);
        let pedestrian = (0..gaps.len()).min_by(|&a, &b| room(a).total_cmp(&room(b))).unwrap_or(0);
        Stop { name, time, pedestrian, gap: gaps[pedestrian], step }
    }
}

impl HardRun {
    /// The run, if it reached its end.
    ///
    /// # Errors
    /// It was stopped: when, where and by what.
    pub fn whole(self) -> Result<HardRun, Failure> {
        match &self.stop {
            None => Ok(self),
            Some(Stop { name, time, pedestrian, gap, step }) => Err(Failure::work(format!(
                "a reference run ended in {name} at t = {time:?}, pedestrian {pedestrian}, gap {gap:?}, step {step:e}"
            ))),
        }
    }
}

/// Two methods that share no coefficients, with the tolerances at which they judge each other.
pub fn two_methods(tolerance: f64) -> [(Method, Control); 2] {
    [Method::Dop853, Method::Extrapolation].map(|method| (method, Control::Adaptive { tolerance }))
}

/// The largest difference between two lists of numbers.
pub fn difference(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(a, b)| (a - b).abs()).fold(0.0, math::larger)
}
