//! Instants of a run at which a second one is compared with it: the ends of its last steps, since at the end of
//! the run alone the errors of two methods may agree by chance, and its events.

use crate::events::{Event, EventKind};
use crate::ring::Ring;
use crate::run::{Run, RunObserver, Sight};
use crate::states::{RingSystem, StateVariables};
use ode::Step;
use std::collections::VecDeque;

/// Number of instants kept.
const KEPT: usize = 3;

/// States at the ends of the last steps and at events, with their times.
#[derive(Clone, Debug, Default)]
pub(super) struct Recent {
    states: VecDeque<(f64, Vec<f64>)>,
    events: Vec<(f64, Vec<f64>)>,
    rates: Vec<Crossing>,
}

/// How fast the quantity that falls through 0 in an event does so.
#[derive(Clone, Copy, Debug)]
struct Crossing {
    kind: EventKind,
    pedestrian: usize,
    rate: f64,
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

    /// Keeps the events of a step, all but blow-ups, whose rate means nothing.
    pub fn push_events(&mut self, step: &mut Step<'_>, sight: &mut Sight<'_, '_>) {
        let is_crossing = |event: &&Event| !matches!(event.kind, EventKind::BlowUp | EventKind::Undefined);
        for event in sight.new.iter().filter(is_crossing) {
            // in a uniform flow it happens to all at once
            if self.events.last().is_none_or(|(time, _)| *time != event.time) {
                let mut state = vec![0.0; step.after().len()];
                step.seen_at(event.time, &mut state);
                self.events.push((event.time, state));
            }
            let Some((_, state)) = self.events.last() else { continue };
            let mut rates = vec![0.0; state.len()];
            step.rates_of(state, &mut rates);
            let Event { kind, pedestrian, .. } = *event;
            self.rates.push(Crossing { kind, pedestrian, rate: sight.watch.change(kind, pedestrian, state, &rates) });
        }
    }

    /// How fast the quantity falls through 0 in this event.
    pub fn rate(&self, event: &Event) -> Option<f64> {
        let same = self.rates.iter().find(|one| (one.kind, one.pedestrian) == (event.kind, event.pedestrian));
        same.map(|crossing| crossing.rate)
    }

    /// The instants of this run, in order of time.
    pub fn instants(&self, run: &Run) -> Vec<Instant> {
        let new = |is_last| move |(time, state): &(f64, Vec<f64>)| Instant::new(*time, state, run.form, run, is_last);
        let last = self.states.iter().map(new(true));
        let mut all: Vec<Instant> = last.chain(self.events.iter().map(new(false))).collect();
        all.sort_by(|a, b| a.time.total_cmp(&b.time));
        all
    }
}

/// The state of a ring at a time.
#[derive(Clone, Debug)]
pub(super) struct Instant {
    pub time: f64,
    /// Whether it is the end of one of the last steps; else it is that of an event.
    pub is_last: bool,
    pub positions: Vec<f64>,
    pub spacings: Vec<f64>,
    pub speeds: Vec<f64>,
    /// The speeds, less that of the first: of any form, and exactly 0 where all are equal.
    pub relative_speeds: Vec<f64>,
}

impl Instant {
    /// Reads a state; a run in deviations may have continued in spacings.
    fn new(time: f64, state: &[f64], form: StateVariables, run: &Run, is_last: bool) -> Instant {
        let Ring { pedestrians, .. } = run.ring;
        let form = form.build(&run.model, run.ring);
        let near_walls: Box<dyn RingSystem> = StateVariables::Spacings.build(&run.model, run.ring);
        let form = if form.dimension() == state.len() { form } else { near_walls };
        let [mut positions, mut spacings, mut speeds] = [(); 3].map(|()| vec![0.0; pedestrians]);
        form.read(state, &mut spacings, &mut speeds);
        form.write_positions(state, &mut positions);
        let own = &state[form.speeds()];
        let relative_speeds = own.iter().map(|speed| speed - own[0]).collect();
        Instant { time, is_last, positions, spacings, speeds, relative_speeds }
    }
}

/// Observes the second run, stores its state at the instants of the first, and passes it on to another observer.
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
            self.second.push(Instant::new(instant.time, &state, self.run.form, self.run, instant.is_last));
        }
    }

    fn sampled(&mut self, sample: &crate::run::Sample<'_>) {
        self.onlooker.sampled(sample);
    }

    fn between(&mut self, underway: &crate::run::PartialRun<'_>) {
        self.onlooker.between(underway);
    }

    fn next_instant(&self) -> f64 {
        self.first.get(self.second.len()).map_or(f64::INFINITY, |instant| instant.time)
    }

    fn is_done(&self) -> bool {
        self.onlooker.is_done()
    }
}
