//! The result of a run, and the reasons why one can end early.

use super::{AtOverlap, Samples, stops};
use crate::events::Event;
use crate::jams::Drift;
use crate::outcome::Verdict;

/// What a run gives.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// Up to the first stop.
    pub samples: Samples,
    /// The first event of each kind, with all pedestrians to whom it happens at that time, in order of time; events
    /// after a stop belong to the continued run.
    pub events: Vec<Event>,
    /// What it cost, and how far it came.
    pub statistics: Statistics,
    /// The end of the last step: of a run that an event ends a little behind that, else the time reached.
    pub last_step: f64,
    /// Positions at the time reached, unwrapped.
    pub positions: Vec<f64>,
    /// Speeds at the time reached.
    pub speeds: Vec<f64>,
    /// The jams at the end or the first stop, and how they got there; nothing where trajectories are not kept.
    pub drift: Drift,
    /// What an overlap does.
    pub at_overlap: AtOverlap,
    /// The outcome of the run, if an observer asked for it (see [`RunObserver::judging`](super::RunObserver::judging)).
    pub verdict: Option<Verdict>,
}

impl Outcome {
    /// The first event that ends the samples.
    pub fn stop(&self) -> Option<&Event> {
        self.events.iter().find(|event| stops(event.kind, self.at_overlap))
    }

    /// Whether the time reached is that of an event, after which there was nothing more to find.
    pub fn ends_at_event(&self) -> bool {
        self.last_step > self.statistics.time
    }
}

/// What a run cost, and how far it came.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Statistics {
    /// Accepted steps.
    pub steps: u64,
    /// Steps that were tried and made again smaller.
    pub rejected: u64,
    /// Evaluations of the right-hand side, those for samples and events included.
    pub evaluations: u64,
    /// The time reached: that of the event that ends the run, if one does.
    pub time: f64,
}

/// A run that could not continue.
#[derive(Clone, Debug)]
pub struct Broken {
    /// What it gave until then.
    pub outcome: Box<Outcome>,
    /// Why, with the time reached and the step.
    pub failure: ode::Failure,
    /// Who had the smallest effective gap in the last state that was reached; `None` when no step was tried.
    pub narrowest: Option<Narrowest>,
    /// What helps, if anything does.
    pub advice: Option<&'static str>,
}

/// The pedestrian with the smallest effective gap at one instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Narrowest {
    /// Who, counted from 0.
    pub pedestrian: usize,
    /// The spacing `s_n`.
    pub spacing: f64,
    /// The effective gap, which must stay positive (see [`Law::effective_gap`](crate::laws::Law::effective_gap)).
    pub effective_gap: f64,
    /// The speed `v_n`.
    pub speed: f64,
}

impl std::fmt::Display for Broken {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}", self.failure)?;
        self.advice.map_or(Ok(()), |advice| write!(f, "; {advice}"))?;
        self.narrowest.map_or(Ok(()), |Narrowest { pedestrian, spacing, effective_gap, speed }| {
            write!(
                f,
                "; smallest effective gap then: {effective_gap:?}, of pedestrian {pedestrian}, spacing {spacing:?}, speed {speed:?}"
            )
        })
    }
}

impl std::error::Error for Broken {}
