//! Instants of a run at which a second one is compared with it: the ends of its last steps, since at the end of the run
//! alone the errors of two methods may agree by chance; the starts of its first steps with samples, for the same
//! reason; and its events.

use super::largest;
use crate::events::{Event, EventKind};
use crate::ring::Ring;
use crate::run::{Run, RunObserver, Sight};
use crate::states::{RingSystem, StateVariables};
use ode::Step;
use std::collections::VecDeque;

/// Number of instants kept of each sort. Among more samples, the errors of two methods rarely agree by chance.
const KEPT: usize = 3;

/// States at the ends of the last steps, at the starts of the first ones with samples, and at events, with their times.
#[derive(Clone, Debug, Default)]
pub(super) struct Recent {
    states: VecDeque<(f64, Vec<f64>)>,
    sampled: Vec<(f64, Vec<f64>)>,
    events: Vec<Happening>,
    rates: Vec<Crossing>,
}

/// The state at the time of an event, and its rates.
#[derive(Clone, Debug)]
struct Happening {
    time: f64,
    state: Vec<f64>,
    rates: Vec<f64>,
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

    /// Keeps what is found in a step: its start, if it has one of the first samples, and its events, all but blow-ups,
    /// whose rate means nothing.
    pub fn push_events(&mut self, step: &mut Step<'_>, sight: &mut Sight<'_, '_>) {
        // at the start of the run there is nothing to compare
        if sight.samples.is_some() && step.start > 0.0 && self.sampled.len() < KEPT {
            self.sampled.push((step.start, step.before().to_vec()));
        }
        let is_crossing = |event: &&Event| !matches!(event.kind, EventKind::BlowUp | EventKind::Undefined);
        for event in sight.new.iter().filter(is_crossing) {
            // in a uniform flow it happens to all at once
            if self.events.last().is_none_or(|last| last.time != event.time) {
                let [mut state, mut rates] = [(); 2].map(|()| vec![0.0; step.after().len()]);
                step.seen_at(event.time, &mut state);
                step.rates_of(&state, &mut rates);
                self.events.push(Happening { time: event.time, state, rates });
            }
            let Some(Happening { state, rates, .. }) = self.events.last() else { continue };
            let Event { kind, pedestrian, .. } = *event;
            self.rates.push(Crossing { kind, pedestrian, rate: sight.watch.change(kind, pedestrian, state, rates) });
        }
    }

    /// How fast the quantity falls through 0 in this event.
    pub fn rate(&self, event: &Event) -> Option<f64> {
        let same = self.rates.iter().find(|one| (one.kind, one.pedestrian) == (event.kind, event.pedestrian));
        same.map(|crossing| crossing.rate)
    }

    /// The instants of this run, in order of time.
    pub fn instants(&self, run: &Run) -> Vec<Instant> {
        let new = |sort| move |(time, state): &(f64, Vec<f64>)| Instant::new(*time, state, run.form, run, sort);
        let of_steps = self.states.iter().map(new(Sort::Last)).chain(self.sampled.iter().map(new(Sort::Sampled)));
        let of_events = self.events.iter().map(|Happening { time, state, rates }| {
            let instant = Instant::new(*time, state, run.form, run, Sort::Event);
            Instant { acceleration: acceleration(rates, run), ..instant }
        });
        let mut all: Vec<Instant> = of_steps.chain(of_events).collect();
        all.sort_by(|a, b| a.time.total_cmp(&b.time));
        all
    }
}

/// The state of a ring at a time.
#[derive(Clone, Debug)]
pub(super) struct Instant {
    pub time: f64,
    pub sort: Sort,
    pub positions: Vec<f64>,
    pub spacings: Vec<f64>,
    pub speeds: Vec<f64>,
    /// The speeds, less that of the first: of any form, and exactly 0 where all are equal.
    pub relative_speeds: Vec<f64>,
    /// The largest acceleration in size at an event; else 0.
    pub acceleration: f64,
}

/// What an instant is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Sort {
    /// The end of one of the last steps.
    Last,
    /// The start of one of the first steps with samples.
    Sampled,
    /// The time of an event.
    Event,
}

/// The form of a state of this size: a run in deviations may have continued in spacings.
fn form_of(dimension: usize, form: StateVariables, run: &Run) -> Box<dyn RingSystem> {
    let form = form.build(&run.model, run.ring);
    if form.dimension() == dimension { form } else { StateVariables::Spacings.build(&run.model, run.ring) }
}

/// The largest acceleration in size.
fn acceleration(rates: &[f64], run: &Run) -> f64 {
    let [mut closing, mut accelerations] = [(); 2].map(|()| vec![0.0; run.ring.pedestrians]);
    form_of(rates.len(), run.form, run).read_rates(rates, &mut closing, &mut accelerations);
    largest(&accelerations)
}

impl Instant {
    /// Reads a state.
    fn new(time: f64, state: &[f64], form: StateVariables, run: &Run, sort: Sort) -> Instant {
        let Ring { pedestrians, .. } = run.ring;
        let form = form_of(state.len(), form, run);
        let [mut positions, mut spacings, mut speeds] = [(); 3].map(|()| vec![0.0; pedestrians]);
        form.read(state, &mut spacings, &mut speeds);
        form.write_positions(state, &mut positions);
        let own = &state[form.speeds()];
        let relative_speeds = own.iter().map(|speed| speed - own[0]).collect();
        Instant { time, sort, positions, spacings, speeds, relative_speeds, acceleration: 0.0 }
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
            self.second.push(Instant::new(instant.time, &state, self.run.form, self.run, instant.sort));
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
