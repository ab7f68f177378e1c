//! Integrates a run leg by leg, step by step.

use super::checkpoint::{Checkpoint, PartialRun, Remembered};
use super::record::{FOLLOWED_EVERY, Record};
use super::walls::advice;
use super::{Broken, Judging, Narrowest, Outcome, Run, RunObserver, Sight, Statistics};
use crate::events::{EventKind, Watch};
use crate::outcome::Judge;
use crate::states::{RingSystem, StateVariables, gaps_state};
use ode::{Observer, Problem, ResumePoint, Sampler, Step, integrate, resume};
use std::ops::ControlFlow;

/// Makes a run to its end, or to the event that ends it.
///
/// # Errors
/// The integration failed before anything stopped it, with the time it reached.
///
/// # Panics
/// The time between samples, a step or a tolerance is not above 0; or there are displacements, but not one for each
/// pedestrian.
pub fn run(run: &Run) -> Result<Outcome, Broken> {
    run_from(run, None, &mut ())
}

/// As [`run`], but observed, and from a checkpoint of the same run if one is given, with the same bits.
///
/// # Errors
/// As [`run`]; or a checkpoint of a run with another rule for its steps.
///
/// # Panics
/// As [`run`].
pub fn run_from(run: &Run, from: Option<Checkpoint>, observer: &mut dyn RunObserver) -> Result<Outcome, Broken> {
    run_off(run, 0.0, from, observer)
}

/// The same with a force that is too strong by this part of itself ([`StateVariables::build_off`]).
pub(crate) fn run_off(
    run: &Run,
    off: f64,
    from: Option<Checkpoint>,
    observer: &mut dyn RunObserver,
) -> Result<Outcome, Broken> {
    assert!(run.sample > 0.0, "the time between samples is {:?}; it must be above 0", run.sample);
    let (moved, pedestrians) = (run.displacements.len(), run.ring.pedestrians);
    assert!(moved == 0 || moved == pedestrians, "{moved} displacements for {pedestrians} pedestrians");
    let form = run.form.build_off(&run.model, run.ring, off);
    let near_walls = StateVariables::Spacings.build_off(&run.model, run.ring, off);
    let mut recorder = Recorder::new(run, &*form, observer);
    let mut made = match from {
        Some(checkpoint) => recorder.resume(&*form, &*near_walls, checkpoint),
        None => {
            let start = run.initial(&*form);
            recorder.start(&start);
            recorder.leg(&*form, 0.0, &start)
        }
    };
    let is_stuck = matches!(made.failure, Some(ode::Failure::StepTooSmall { .. }));
    if recorder.turns_to_walls || is_stuck && recorder.can_turn() {
        recorder.earlier = counts(&made.statistics);
        let state = recorder.enter_walls(&*near_walls, &made.statistics.state);
        made = recorder.leg(&*near_walls, made.statistics.time, &state);
    }
    recorder.end(made)
}

/// The run before its first step.
pub(crate) fn untried(run: &Run, observer: &mut dyn RunObserver) -> Outcome {
    let form = run.form.build(&run.model, run.ring);
    let mut recorder = Recorder::new(run, &*form, observer);
    recorder.start(&run.initial(&*form));
    let made = Leg { statistics: ode::Statistics::default(), failure: None };
    recorder.end(made).unwrap_or_else(|broken| *broken.outcome)
}

/// The result of a leg: how far it got, and the reason if it failed.
struct Leg {
    statistics: ode::Statistics,
    failure: Option<ode::Failure>,
}

/// The counts of a leg, and the time that it reached.
fn counts(statistics: &ode::Statistics) -> Statistics {
    let ode::Statistics { steps, rejected, evaluations, time, .. } = *statistics;
    Statistics { steps, rejected, evaluations, time }
}

/// Takes samples and looks for events, step by step.
pub(super) struct Recorder<'a> {
    pub run: &'a Run,
    sampler: Sampler,
    pub watch: Watch<'a>,
    judge: Option<Judge>,
    pub record: Record<'a>,
    observer: &'a mut dyn RunObserver,
    is_stopped: bool,
    /// Whether the leg in deviations has ended near a wall, and the next begins.
    turns_to_walls: bool,
    pub is_near_walls: bool,
    /// What the leg before took.
    earlier: Statistics,
    reached: ode::Statistics,
    /// The time of the event that ended the run, and the state then.
    at_event: Option<(f64, Vec<f64>)>,
    pub narrowest: Option<Narrowest>,
}

impl<'a> Recorder<'a> {
    fn new(run: &'a Run, form: &'a dyn RingSystem, observer: &'a mut dyn RunObserver) -> Recorder<'a> {
        let judge = (observer.judging() != Judging::No).then(|| Judge::new(&run.model, run.ring, run.steady_speed));
        Recorder {
            run,
            judge,
            sampler: Sampler::new(run.sample, form.dimension()),
            watch: Watch::new(run.model.clone(), form, run.ring.pedestrians),
            record: Record::new(run, form),
            observer,
            is_stopped: false,
            turns_to_walls: false,
            is_near_walls: false,
            earlier: Statistics::default(),
            reached: ode::Statistics::default(),
            at_event: None,
            narrowest: None,
        }
    }

    /// Takes the first sample, and the events at the start.
    fn start(&mut self, state: &[f64]) {
        let mut rates = vec![0.0; state.len()];
        self.record.form.rates(state, &mut rates);
        let found = self.watch.start(0.0, state, &rates);
        self.is_stopped = found.iter().any(|event| self.run.stops(event.kind));
        if let Some(judge) = &mut self.judge {
            judge.start(&self.watch, &found);
        }
        self.observer.sampled(&self.record.take(0.0, state));
        self.record.follow(0.0, state);
    }

    /// Integrates from this time and state to the end of the run, or until an event or the walls break it off.
    fn leg(&mut self, form: &dyn RingSystem, begin: f64, state: &[f64]) -> Leg {
        let made = integrate(&self.problem(form, begin, state), self);
        self.made(made)
    }

    /// Continues from a checkpoint as [`Recorder::leg`] would have done.
    fn resume(&mut self, form: &dyn RingSystem, near_walls: &'a dyn RingSystem, checkpoint: Checkpoint) -> Leg {
        let Checkpoint { position, statistics, state, pace, found, samples, drift, .. } = checkpoint;
        // one sample for each multiple of the interval, from 0; none after a stop
        self.sampler.resume(samples.len() as u64);
        self.is_stopped = found.iter().any(|event| self.run.stops(event.kind));
        self.watch.resume(found);
        (self.record.samples, self.record.drift) = (samples, drift);
        (self.record.followed, self.earlier) = (checkpoint.followed, checkpoint.earlier);
        let (form, begin) = match checkpoint.near_walls {
            Some(begin) => {
                self.is_near_walls = true;
                self.change_form(near_walls);
                (near_walls, begin)
            }
            None => (form, 0.0),
        };
        self.record.begin = begin;
        if let (Some(judge), Some(memory)) = (&mut self.judge, checkpoint.memory) {
            judge.recall(memory);
        }
        let pace = pace.as_ref().map(Remembered::pace);
        let mark = ResumePoint { position, statistics: &statistics, state: &state, pace };
        let made = resume(&self.problem(form, begin, &state), &mark, self);
        self.made(made)
    }

    fn made(&mut self, made: Result<ode::Statistics, ode::Failure>) -> Leg {
        match made {
            Ok(statistics) => Leg { statistics, failure: None },
            Err(failure) => Leg { statistics: std::mem::take(&mut self.reached), failure: Some(failure) },
        }
    }

    /// Goes on in spacings; returns the state in that form.
    fn enter_walls(&mut self, near_walls: &'a dyn RingSystem, state: &[f64]) -> Vec<f64> {
        self.record.read(state);
        let Record { positions, spacings, speeds, .. } = &self.record;
        let state = gaps_state(&self.run.model, spacings, speeds, positions[0]);
        (self.turns_to_walls, self.is_near_walls) = (false, true);
        self.change_form(near_walls);
        state
    }

    /// The result of the run; if it failed, the result up to that point.
    fn end(mut self, made: Leg) -> Result<Outcome, Broken> {
        let mut statistics = counts(&made.statistics);
        statistics.steps += self.earlier.steps;
        statistics.rejected += self.earlier.rejected;
        statistics.evaluations += self.earlier.evaluations;
        let Leg { statistics: ode::Statistics { time, mut state, .. }, failure } = made;
        let last_step = time;
        if state.is_empty() {
            // no step was tried
            state = self.run.initial(self.record.form);
        }
        if !self.is_stopped {
            self.record.follow(time, &state);
        }
        let broken = failure
            .filter(|failure| !self.is_at_wall(failure, time, &state))
            .filter(|failure| !self.is_undefined(failure, time, &state));
        let (events, at_overlap) = (self.watch.found().to_vec(), self.run.at_overlap);
        let verdict = self.judge.map(|judge| judge.end(last_step, &events));
        if let Some(at_event) = self.at_event {
            (statistics.time, state) = at_event;
        }
        self.record.read(&state);
        let Record { samples, positions, speeds, drift, .. } = self.record;
        let outcome = Outcome { samples, events, statistics, last_step, positions, speeds, drift, at_overlap, verdict };
        match broken {
            None => Ok(outcome),
            Some(failure) => {
                let (advice, outcome) = (advice(&failure, self.run), Box::new(outcome));
                Err(Broken { failure, narrowest: self.narrowest, advice, outcome })
            }
        }
    }

    fn problem<'b>(&self, form: &'b dyn RingSystem, begin: f64, start: &'b [f64]) -> Problem<'b> {
        let Run { t_end: end, method, control, .. } = *self.run;
        Problem { system: form, start, begin, end, method, control }
    }

    /// Goes on in another form of the same state.
    fn change_form(&mut self, form: &'a dyn RingSystem) {
        self.watch.change_form(form);
        self.record.form = form;
        self.sampler.change_dimension(form.dimension());
    }

    /// Takes the samples in a step and follows the jams to its end, or to the event in it that ends both.
    fn record(&mut self, step: &mut Step<'_>, stop: Option<f64>) {
        let until = stop.unwrap_or(self.run.t_end);
        let (record, observer) = (&mut self.record, &mut *self.observer);
        // of the standard deviation alone the speeds are enough
        let wanted = if record.run.keeps_trajectories { 0..step.before().len() } else { record.form.speeds() };
        self.sampler.components_within(step, until, wanted, &mut |t, state| observer.sampled(&record.take(t, state)));
        self.is_stopped = stop.is_some();
        match stop {
            Some(time) => record.follow_to(time, step),
            None if step.end >= record.followed + FOLLOWED_EVERY => record.follow(step.end, step.after()),
            None => (),
        }
    }

    /// The time from which on no further event can be found: that of a blow-up, of a law without a value, of a stop
    /// from which no run continues, or of the last of all events that can follow it.
    fn over_since(&self) -> Option<f64> {
        let first = |is_wanted: &dyn Fn(EventKind) -> bool| {
            self.watch.found().iter().find(|event| is_wanted(event.kind)).map(|event| event.time)
        };
        let of = |kind: EventKind| first(&|found| found == kind);
        let stop = first(&|kind| self.run.stops(kind)).filter(|_| self.is_stopped);
        let others = of(EventKind::NegativeSpeed).zip(of(EventKind::Exchange));
        let last = |stop: f64| others.map(|(turn, pass)| math::larger(stop, math::larger(turn, pass)));
        let stop = if self.run.model.is_singular() { stop } else { stop.and_then(last) };
        [of(EventKind::BlowUp), of(EventKind::Undefined), stop].into_iter().flatten().reduce(math::smaller)
    }

    /// Ends the run at an event in this step, or in one before.
    fn end_at(&mut self, time: f64, step: &mut Step<'_>) {
        let mut state = vec![0.0; step.before().len()];
        let time = math::larger(time, step.start);
        step.at(time, &mut state);
        self.at_event = Some((time, state));
    }
}

impl Observer for Recorder<'_> {
    fn after(&mut self, step: &mut Step<'_>) -> ControlFlow<()> {
        self.observer.after(step);
        let new = match &self.judge {
            Some(_) => self.watch.look(step),
            None => self.watch.look_for_new(step),
        };
        if let Some(judge) = &mut self.judge {
            judge.look(&mut self.watch, step, &new);
            if self.observer.judging() == Judging::UntilCertain && judge.verdict().is_some() {
                return ControlFlow::Break(());
            }
        }
        let stop = new.iter().find(|event| self.run.stops(event.kind)).map(|event| event.time);
        let until = stop.unwrap_or(step.end);
        let samples = if self.is_stopped { None } else { self.sampler.span(step, until) };
        self.observer.seen(step, &mut Sight { new: &new, watch: &mut self.watch, samples });
        if !self.is_stopped {
            self.record(step, stop);
        }
        if self.comes_near_walls() {
            self.turns_to_walls = true;
            self.record.begin = step.end;
            return ControlFlow::Break(());
        }
        if let Some(time) = self.over_since() {
            self.end_at(time, step);
            return ControlFlow::Break(());
        }
        if self.observer.is_done() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    fn next_sample(&self) -> f64 {
        let sample = math::smaller(self.sampler.next(), self.observer.next_instant());
        let next = self.record.followed + FOLLOWED_EVERY;
        if self.run.keeps_trajectories && next < sample { next } else { sample }
    }

    fn most_steps(&self) -> u64 {
        self.run.most_steps
    }

    fn stuck(&mut self, reached: &ode::Statistics) {
        let gaps = self.effective_gaps(&reached.state);
        let Record { form, spacings, speeds, .. } = &mut self.record;
        form.read(&reached.state, spacings, speeds);
        let all = (0..gaps.len()).map(|n| Narrowest {
            pedestrian: n,
            spacing: spacings[n],
            effective_gap: gaps[n],
            speed: speeds[n],
        });
        self.narrowest = all.min_by(|a, b| a.effective_gap.total_cmp(&b.effective_gap));
        self.reached = reached.clone();
    }

    fn between(&mut self, mark: &ResumePoint<'_>) {
        let Record { samples, drift, followed, begin, .. } = &self.record;
        self.observer.between(&PartialRun {
            run: self.run,
            mark,
            found: self.watch.found(),
            samples,
            drift,
            followed: *followed,
            near_walls: self.is_near_walls.then_some(*begin),
            earlier: self.earlier,
            judge: self.judge.as_ref(),
        });
    }
}
