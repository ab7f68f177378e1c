//! The last steps of a run by steps of adaptive length, at whose ends a second run is compared with it besides the end of both:
//! at one instant the errors of two methods may be alike by chance.

use crate::ring::Ring;
use crate::run::{Run, RunObserver, Sight};
use crate::states::{RingSystem, StateVariables};
use ode::Step;
use std::collections::VecDeque;

/// So many instants are kept.
const KEPT: usize = 3;

/// States at the ends of the last steps, with their times.
#[derive(Clone, Debug, Default)]
pub(super) struct Recent {
    states: VecDeque<(f64, Vec<f64>)>,
}

impl Recent {
    /// Keeps the end of a step.
    pub fn push(&mut self, step: &Step<'_>) {
        let mut oldest =
            if self.states.len() < KEPT { None } else { self.states.pop_front() }.unwrap_or((0.0, Vec::new()));
        oldest.0 = step.end;
        oldest.1.clear();
        oldest.1.extend_from_slice(step.after());
        self.states.push_back(oldest);
    }

    /// The instants, with positions and speeds, of this run.
    pub fn instants(&self, run: &Run) -> Vec<Instant> {
        self.states.iter().map(|(time, state)| Instant::new(*time, state, run.form, run)).collect()
    }
}

/// The standard deviation of the speeds, positions and speeds at a time.
#[derive(Clone, Debug)]
pub(super) struct Instant {
    pub time: f64,
    pub std: f64,
    pub positions: Vec<f64>,
    pub speeds: Vec<f64>,
}

impl Instant {
    /// Reads a state; a run in deviations may have gone on in spacings.
    fn new(time: f64, state: &[f64], form: StateVariables, run: &Run) -> Instant {
        let Ring { pedestrians, .. } = run.ring;
        let form = form.build(&run.model, run.ring);
        let near_walls: Box<dyn RingSystem> = StateVariables::Spacings.build(&run.model, run.ring);
        let form = if form.dimension() == state.len() { form } else { near_walls };
        let (mut positions, mut speeds) = (vec![0.0; pedestrians], vec![0.0; pedestrians]);
        form.read(state, &mut positions, &mut speeds);
        form.write_positions(state, &mut positions);
        Instant { time, std: form.speed_std(state), positions, speeds }
    }
}

/// Looks on while the second run is made, and keeps it at the instants of the first. Somebody else may look on, too.
pub(super) struct Compared<'a> {
    pub run: &'a Run,
    pub first: &'a [Instant],
    pub second: Vec<Instant>,
    pub onlooker: &'a mut dyn RunObserver,
}

impl RunObserver for Compared<'_> {
    fn after(&mut self, step: &Step<'_>) {
        self.onlooker.after(step);
    }

    fn seen(&mut self, step: &mut Step<'_>, sight: &mut Sight<'_, '_>) {
        self.onlooker.seen(step, sight);
        let mut state = Vec::new();
        while let Some(instant) = self.first.get(self.second.len()).filter(|instant| instant.time <= step.end) {
            state.resize(step.before().len(), 0.0);
            step.at(instant.time, &mut state);
            self.second.push(Instant::new(instant.time, &state, self.run.form, self.run));
        }
    }

    fn sampled(&mut self, sample: &crate::run::Sample<'_>) {
        self.onlooker.sampled(sample);
    }

    fn between(&mut self, underway: &crate::run::PartialRun<'_>) {
        self.onlooker.between(underway);
    }

    fn is_done(&self) -> bool {
        self.onlooker.is_done()
    }
}
