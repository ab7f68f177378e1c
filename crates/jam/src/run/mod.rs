//! A run from start to end: samples, events, cost, final state, outcome.
//!
//! [`Run`] says what is integrated and what is kept, [`run`] does it, [`Outcome`] is what it gives. A [`RunObserver`]
//! observes the run. A [`Checkpoint`] is the serialised state between two steps, from which [`run_from`] resumes with
//! the same bits.

mod checkpoint;
mod form;
mod observer;
mod outcome;
mod record;
mod recorder;
mod samples;
mod walls;

pub use checkpoint::{Checkpoint, PartialRun};
pub use form::{fitting, has_deviations, too_wide, usual_method, without_value};
pub use observer::{Judging, RunObserver, Sight};
pub use outcome::{Broken, Narrowest, Outcome, Statistics};
pub use recorder::{run, run_from};
pub use samples::{Sample, Samples};

pub(crate) use recorder::{run_off, untried};
pub(crate) use walls::advice;

use crate::events::EventKind;
use crate::laws::Model;
use crate::ring::{Ring, Start};
use crate::states::{RingSystem, StateVariables};
use crate::uniform::{self, NoUniformFlow};
use ode::{Control, Method};

/// What is integrated, how, and what is kept of it. Times are in the unit of the law (`tau` for those of the paper),
/// lengths too (`a_0`).
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// The law of motion.
    pub model: Model,
    /// The ring.
    pub ring: Ring,
    /// The initial state.
    pub start: Start,
    /// Alternative initial state, also at rest: the displacement of each pedestrian from equal spacings. If empty,
    /// `start` applies.
    pub displacements: Vec<f64>,
    /// The time at which it ends, above 0.
    pub t_end: f64,
    /// The time between samples, above 0; the first is taken at 0.
    pub sample: f64,
    /// The method of integration.
    pub method: Method,
    /// The rule for the steps.
    pub control: Control,
    /// As many steps of adaptive length as it may try, rejected ones included.
    pub most_steps: u64,
    /// The form of the state. A run in deviations that comes close to a wall of the force continues in spacings.
    pub form: StateVariables,
    /// Whether positions and speeds of all pedestrians are kept at every sample, and jams are followed.
    pub keeps_trajectories: bool,
    /// The speed of the uniform flow, in units of length over time; `None` if there is none.
    pub steady_speed: Option<f64>,
    /// Whether an overlap ends the samples.
    pub at_overlap: AtOverlap,
}

/// What happens to a run in which two pedestrians overlap.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AtOverlap {
    /// Its samples end there.
    Stop,
    /// It continues, if the law allows it: if its force acts in contact, for instance.
    Continue,
}

/// The tolerance of a run that names none.
pub const TOLERANCE: f64 = 1e-10;

impl Run {
    /// A run up to `t_end` by the [usual method](usual_method) with a tolerance of [`TOLERANCE`], in deviations from
    /// the uniform flow where there is one, that keeps a sample at every unit of time and the trajectories. Other
    /// choices replace its fields.
    ///
    /// # Errors
    /// Fewer than two pedestrians, or fewer than the law looks at; a length or time that is not above 0; gaps that are
    /// closed at the start; an acceleration that has no value there; several steady speeds.
    pub fn new(model: Model, ring: Ring, start: Start, t_end: f64) -> Result<Run, String> {
        let Ring { pedestrians, length } = ring;
        let is_size = |number: f64| number > 0.0 && number.is_finite();
        if pedestrians < 2 || !is_size(length) || !is_size(t_end) {
            return Err(format!(
                "{pedestrians} pedestrians on a ring of length {length:?} up to t = {t_end:?}; there must be at least 2, length and time must be above 0 and finite"
            ));
        }
        if let Some(problem) = too_wide(&model, ring) {
            return Err(problem);
        }
        let gap = model.effective_gap(ring.headway(), 0.0, 0.0);
        if !(gap > 0.0 && start.shift.abs() < gap) {
            return Err(format!(
                "a shift of {:?} at a headway of {:?} closes a gap at the start; the effective gap at rest is {gap:?}, the shift must be smaller in size",
                start.shift,
                ring.headway()
            ));
        }
        let steady_speed = flow(&model, ring, None).map_err(|error| error.to_string())?;
        let form = fitting(None, &model, ring, steady_speed);
        let method = usual_method(form, &model);
        if let Some((pedestrian, value)) = without_value(&*form.build(&model, ring), start, ring) {
            return Err(format!(
                "the acceleration of pedestrian {pedestrian} is {value:?} at the start; must be finite"
            ));
        }
        Ok(Run {
            model,
            ring,
            start,
            displacements: Vec::new(),
            t_end,
            sample: 1.0,
            method,
            control: Control::Adaptive { tolerance: TOLERANCE },
            most_steps: ode::MOST_STEPS,
            form,
            keeps_trajectories: true,
            steady_speed,
            at_overlap: AtOverlap::Stop,
        })
    }

    /// The state at the start, in this form.
    fn initial(&self, form: &dyn RingSystem) -> Vec<f64> {
        if self.displacements.is_empty() { form.start(self.start) } else { form.start_displaced(&self.displacements) }
    }

    /// Whether an event ends the samples.
    pub(crate) fn stops(&self, kind: EventKind) -> bool {
        stops(kind, self.at_overlap)
    }
}

/// Whether an event ends the samples of a run.
fn stops(kind: EventKind, at_overlap: AtOverlap) -> bool {
    kind.is_stop() && (kind != EventKind::Overlap || at_overlap == AtOverlap::Stop)
}

/// The speed of the uniform flow of a ring; of a formula or a law of your own the one next to `wanted`, `None` if it
/// has none.
///
/// # Errors
/// A law of the paper has none; or any other several, and none is wanted.
pub fn flow(model: &Model, ring: Ring, wanted: Option<f64>) -> Result<Option<f64>, NoUniformFlow> {
    if model.is_of_paper() {
        return uniform::steady_speed(model, ring.headway()).map(Some);
    }
    match uniform::nearest(model, ring.headway(), wanted) {
        Err(error) if error.speeds.is_empty() => Ok(None),
        found => found.map(Some),
    }
}
