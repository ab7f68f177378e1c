//! Running a scene: the tables of its standard deviation and trajectories, its events, its statistics.

use crate::checkpoint::{Checkpoint, PartialRun, Remembered};
use crate::run::{AtOverlap, Scene};
use files::table::Table;
use jam::events::{Event, EventKind, Watch};
use jam::jams;
use jam::laws::Model;
use jam::outcome::{Judge, Verdict};
use jam::states::{RingSystem, StateVariables, gaps_state};
use ode::{Control, Observer, Problem, ResumePoint, Sampler, Statistics, Step, integrate, resume};
use std::ops::ControlFlow;

/// What a run gives.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// `t, std`: up to the first stop.
    pub std: Table,
    /// `t, n, x, v`: up to the first stop; empty when the scene does not keep them.
    pub trajectories: Table,
    /// The first event of each kind, with everybody to whom it happens at once, in order of time; those after a stop belong
    /// to the continued run.
    pub events: Vec<Event>,
    /// Steps, evaluations, the time reached.
    pub statistics: Statistics,
    /// Positions and speeds at the time reached.
    pub positions: Vec<f64>,
    /// See `positions`.
    pub speeds: Vec<f64>,
    /// The jams at the end or the first stop, and how they got there; nothing when the scene does not keep trajectories.
    pub drift: jams::Drift,
    /// What an overlap does.
    pub at_overlap: AtOverlap,
    /// What became of the run, if that was asked for.
    pub verdict: Option<Verdict>,
}

impl Outcome {
    /// The first event that ends the tables.
    pub fn stop(&self) -> Option<&Event> {
        self.events.iter().find(|happening| stops(happening.kind, self.at_overlap))
    }
}

/// Whether an event ends the tables.
fn stops(event: EventKind, at_overlap: AtOverlap) -> bool {
    event.is_stop() && (event != EventKind::Overlap || at_overlap == AtOverlap::Stop)
}

/// A run that could not go on.
#[derive(Clone, Debug)]
pub struct Broken {
    /// What it gave until then.
    pub outcome: Box<Outcome>,
    /// Why, with the time reached and the step.
    pub failure: ode::Failure,
    /// Who had the least room in the last state that was reached; `None` when no step was tried.
    pub narrowest: Option<Place>,
    /// What helps, if anything does.
    pub advice: Option<&'static str>,
}

/// A pedestrian at one instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Who, counted from 0.
    pub pedestrian: usize,
    /// `s_n`.
    pub gap: f64,
    /// What must stay positive (see [`jam::laws::Law::room`]).
    pub room: f64,
    /// `v_n`.
    pub speed: f64,
}

impl std::fmt::Display for Broken {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}", self.failure)?;
        self.advice.map_or(Ok(()), |advice| write!(f, "; {advice}"))?;
        self.narrowest.map_or(Ok(()), |Place { pedestrian, gap, room, speed }| {
            write!(
                f,
                "; smallest effective gap then: {room:?}, of pedestrian {pedestrian}, spacing {gap:?}, speed {speed:?}"
            )
        })
    }
}

impl std::error::Error for Broken {}

/// Looks on while a scene runs; the run does not depend on it.
pub trait RunObserver {
    /// Sees every accepted step of adaptive length; of fixed ones, those that the run needs to see.
    fn after(&mut self, _step: &Step<'_>) {}

    /// Sees the same with what was found in it.
    fn seen(&mut self, _step: &mut Step<'_>, _sight: &mut Sight<'_, '_>) {}

    /// Sees the tables whenever a sample was added to them.
    fn sampled(&mut self, _std: &Table, _trajectories: &Table) {}

    /// Sees the run every few thousand steps.
    fn between(&mut self, _underway: &PartialRun<'_>) {}

    /// Whether the outcome of the run is judged. Methods that interpolate by evaluations then make some more of them.
    fn judging(&self) -> Judging {
        Judging::No
    }
}

/// Whether the outcome of a run is judged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Judging {
    /// It is not.
    No,
    /// It is, and the run goes to its end.
    Along,
    /// It is, and the run ends where it is certain.
    UntilCertain,
}

/// What was found in a step.
#[allow(missing_debug_implementations)]
pub struct Sight<'a, 'w> {
    /// The events in it.
    pub new: &'a [Event],
    /// The watch that found them.
    pub watch: &'a mut Watch<'w>,
    /// The times of the first and the last sample that is taken in it.
    pub samples: Option<[f64; 2]>,
}

/// Nobody looks on.
impl RunObserver for () {}

/// Two look on.
impl<A: RunObserver, B: RunObserver> RunObserver for (A, B) {
    fn after(&mut self, step: &Step<'_>) {
        self.0.after(step);
        self.1.after(step);
    }

    fn seen(&mut self, step: &mut Step<'_>, sight: &mut Sight<'_, '_>) {
        self.0.seen(step, sight);
        self.1.seen(step, sight);
    }

    fn sampled(&mut self, std: &Table, trajectories: &Table) {
        self.0.sampled(std, trajectories);
        self.1.sampled(std, trajectories);
    }

    fn between(&mut self, underway: &PartialRun<'_>) {
        self.0.between(underway);
        self.1.between(underway);
    }

    /// As the first of them wants it.
    fn judging(&self) -> Judging {
        self.0.judging()
    }
}

/// Somebody else's looks.
impl<A: RunObserver> RunObserver for &mut A {
    fn after(&mut self, step: &Step<'_>) {
        (**self).after(step);
    }

    fn seen(&mut self, step: &mut Step<'_>, sight: &mut Sight<'_, '_>) {
        (**self).seen(step, sight);
    }

    fn sampled(&mut self, std: &Table, trajectories: &Table) {
        (**self).sampled(std, trajectories);
    }

    fn between(&mut self, underway: &PartialRun<'_>) {
        (**self).between(underway);
    }

    fn judging(&self) -> Judging {
        (**self).judging()
    }
}

/// Runs a scene to its end, or to the event that ends it.
///
/// # Errors
/// The integration failed before anything stopped it, with the time it reached.
pub fn run(scene: &Scene) -> Result<Outcome, Broken> {
    run_from(scene, None, &mut ())
}

/// As [`run`], from a checkpoint of the same scene to the same bits.
///
/// # Errors
/// As [`run`]; or a checkpoint of a scene with another rule for its steps.
pub fn run_from(scene: &Scene, from: Option<Checkpoint>, onlooker: &mut dyn RunObserver) -> Result<Outcome, Broken> {
    let form = scene.form.build(&scene.model, scene.ring);
    let near_walls = StateVariables::Spacings.build(&scene.model, scene.ring);
    let mut recorder = Recorder::new(scene, &*form, onlooker);
    let mut made = match from {
        Some(checkpoint) => recorder.resume(&*form, &*near_walls, checkpoint),
        None => {
            let start = form.start(scene.start);
            recorder.start(&start);
            recorder.leg(&*form, 0.0, &start)
        }
    };
    let is_stuck = matches!(made.failure, Some(ode::Failure::StepTooSmall { .. }));
    if recorder.turns_to_walls || is_stuck && recorder.can_turn() {
        recorder.earlier = made.counts();
        let state = recorder.enter_walls(&*near_walls, &made.statistics.state);
        made = recorder.leg(&*near_walls, made.statistics.time, &state);
    }
    recorder.end(made)
}

/// What became of a leg: how far it came, and why no further, if it broke.
struct Made {
    statistics: Statistics,
    failure: Option<ode::Failure>,
}

impl Made {
    fn counts(&self) -> Counts {
        let Statistics { steps, rejected, evaluations, .. } = self.statistics;
        Counts { steps, rejected, evaluations }
    }
}

/// The counts of an earlier leg.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Counts {
    pub(crate) steps: u64,
    pub(crate) rejected: u64,
    pub(crate) evaluations: u64,
}

/// Where the least room falls below this part of that in the uniform flow, the clearances become the state: they keep all
/// digits however small they are; deviations from the uniform flow have lost three of them there. They do, too, where
/// deviations lead no further.
const NEAR_WALLS: f64 = 1e-3;

/// A room below this, at a wall where no shorter step leads on, is that of a pedestrian who comes nearer to the wall than a
/// double can tell: the force has no bound that a number has.
const NO_ROOM: f64 = 1e-200;

/// The jams are followed at the first step that ends no sooner than this after the one before, in units of `tau`: they go a
/// small part of a headway in that time. The times do not depend on the samples.
const FOLLOWED_EVERY: f64 = 1.0;

/// Takes samples and looks for events, step by step.
struct Recorder<'a> {
    scene: &'a Scene,
    sampler: Sampler,
    watch: Watch<'a>,
    judge: Option<Judge>,
    record: Record<'a>,
    onlooker: &'a mut dyn RunObserver,
    is_stopped: bool,
    /// Whether the leg in deviations has ended near a wall, and the next begins.
    turns_to_walls: bool,
    is_near_walls: bool,
    /// What the leg before took.
    earlier: Counts,
    reached: Statistics,
    narrowest: Option<Place>,
}

impl<'a> Recorder<'a> {
    fn new(scene: &'a Scene, form: &'a dyn RingSystem, onlooker: &'a mut dyn RunObserver) -> Recorder<'a> {
        let judge =
            (onlooker.judging() != Judging::No).then(|| Judge::new(&scene.model, scene.ring, scene.steady_speed));
        Recorder {
            scene,
            judge,
            sampler: Sampler::new(scene.sample, form.dimension()),
            watch: Watch::new(scene.model.clone(), form, scene.ring.pedestrians),
            record: Record::new(scene, form),
            onlooker,
            is_stopped: false,
            turns_to_walls: false,
            is_near_walls: false,
            earlier: Counts::default(),
            reached: Statistics::default(),
            narrowest: None,
        }
    }

    /// Takes the first sample, and the events at the start.
    fn start(&mut self, state: &[f64]) {
        let mut rates = vec![0.0; state.len()];
        self.record.form.rates(state, &mut rates);
        let found = self.watch.start(0.0, state, &rates);
        self.is_stopped = found.iter().any(|happening| self.stops(happening));
        if let Some(judge) = &mut self.judge {
            judge.start(&self.watch, &found);
        }
        self.record.take(0.0, state);
        self.onlooker.sampled(&self.record.std, &self.record.trajectories);
        self.record.follow(0.0, state);
    }

    /// Integrates from this time and state to the end of the run, or until an event or the walls break it off.
    fn leg(&mut self, form: &dyn RingSystem, begin: f64, state: &[f64]) -> Made {
        let made = integrate(&self.problem(form, begin, state), self);
        self.made(made)
    }

    /// Goes on from a checkpoint as [`Recorder::leg`] would have.
    fn resume(&mut self, form: &dyn RingSystem, near_walls: &'a dyn RingSystem, checkpoint: Checkpoint) -> Made {
        let Checkpoint { place, statistics, state, pace, found, std, trajectories, drift, .. } = checkpoint;
        // one sample for each multiple of the interval, from 0; none after a stop
        self.sampler.resume(std.len() as u64);
        self.is_stopped = found.iter().any(|happening| self.stops(happening));
        self.watch.resume(found);
        (self.record.std, self.record.trajectories, self.record.drift) = (std, trajectories, drift);
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
        let mark = ResumePoint { place, statistics: &statistics, state: &state, pace };
        let made = resume(&self.problem(form, begin, &state), &mark, self);
        self.made(made)
    }

    fn made(&mut self, made: Result<Statistics, ode::Failure>) -> Made {
        match made {
            Ok(statistics) => Made { statistics, failure: None },
            Err(failure) => Made { statistics: std::mem::take(&mut self.reached), failure: Some(failure) },
        }
    }

    /// Goes on in clearances; returns the state in that form.
    fn enter_walls(&mut self, near_walls: &'a dyn RingSystem, state: &[f64]) -> Vec<f64> {
        let Record { form, positions, gaps, speeds, .. } = &mut self.record;
        form.write_positions(state, positions);
        form.read(state, gaps, speeds);
        let state = gaps_state(&self.scene.model, gaps, speeds, positions[0]);
        (self.turns_to_walls, self.is_near_walls) = (false, true);
        self.change_form(near_walls);
        state
    }

    /// What the run gave; or, where it broke, what it gave until then.
    fn end(mut self, made: Made) -> Result<Outcome, Broken> {
        let Made { mut statistics, failure } = made;
        statistics.steps += self.earlier.steps;
        statistics.rejected += self.earlier.rejected;
        statistics.evaluations += self.earlier.evaluations;
        if statistics.state.is_empty() {
            // no step was tried
            statistics.state = self.record.form.start(self.scene.start);
        }
        if !self.is_stopped {
            self.record.follow(statistics.time, &statistics.state);
        }
        let broken = failure
            .filter(|failure| !self.is_at_wall(failure, &statistics))
            .filter(|_| !self.is_undefined(&statistics));
        let Record { form, std, trajectories, mut positions, mut gaps, mut speeds, drift, .. } = self.record;
        form.write_positions(&statistics.state, &mut positions);
        form.read(&statistics.state, &mut gaps, &mut speeds);
        let (events, at_overlap) = (self.watch.found().to_vec(), self.scene.at_overlap);
        let verdict = self.judge.map(|judge| judge.end(statistics.time, &events));
        let outcome = Outcome { std, trajectories, events, statistics, positions, speeds, drift, at_overlap, verdict };
        match broken {
            None => Ok(outcome),
            Some(failure) => {
                let (advice, outcome) = (advice(&failure, self.scene), Box::new(outcome));
                Err(Broken { failure, narrowest: self.narrowest, advice, outcome })
            }
        }
    }

    /// Whether a run ends since a pedestrian comes nearer to a wall than any double can tell; then that is an event.
    fn is_at_wall(&mut self, failure: &ode::Failure, reached: &Statistics) -> bool {
        let Some(Place { pedestrian, gap, .. }) = self.narrowest else { return false };
        let is_singular = self.scene.model.is_singular() && self.is_in_gaps();
        let is_stuck = matches!(failure, ode::Failure::StepTooSmall { .. });
        let room = self.rooms(&reached.state)[pedestrian];
        let is_at_wall = is_singular && is_stuck && room < NO_ROOM;
        if is_at_wall {
            let time = reached.time;
            self.watch.add(Event { kind: EventKind::BlowUp, time, pedestrian, gap, step: 0.0 });
        }
        is_at_wall
    }

    /// Whether a run ends since the formula of its law has no value a little further on; then that is an event.
    fn is_undefined(&mut self, reached: &Statistics) -> bool {
        if !matches!(self.scene.model, Model::Formula(_)) {
            return false;
        }
        let form = self.record.form;
        let mut rates = vec![0.0; form.dimension()];
        form.rates(&reached.state, &mut rates);
        // as far as a step that fails would go at least
        let further = 1e-9 * if reached.time > 1.0 { reached.time } else { 1.0 };
        let next: Vec<f64> = reached.state.iter().zip(&rates).map(|(x, rate)| x + further * rate).collect();
        let (mut gaps, mut accelerations) = (self.record.gaps.clone(), self.record.speeds.clone());
        for state in [&reached.state, &next] {
            form.rates(state, &mut rates);
            form.read_rates(&rates, &mut gaps, &mut accelerations);
            let Some(pedestrian) = accelerations.iter().position(|a| !a.is_finite()) else { continue };
            form.read(&reached.state, &mut gaps, &mut accelerations);
            let (time, gap) = (reached.time, gaps[pedestrian]);
            self.watch.add(Event { kind: EventKind::Undefined, time, pedestrian, gap, step: 0.0 });
            return true;
        }
        false
    }

    /// The rooms, with all the digits that the form has.
    fn rooms(&self, state: &[f64]) -> Vec<f64> {
        let mut rooms = self.watch.rooms_of(state);
        if self.is_in_gaps() && self.scene.model.room_per_speed() == 0.0 {
            rooms.copy_from_slice(&state[..self.scene.ring.pedestrians]);
        }
        rooms
    }

    fn is_in_gaps(&self) -> bool {
        self.is_near_walls || self.scene.form == StateVariables::Spacings
    }

    fn stops(&self, happening: &Event) -> bool {
        stops(happening.kind, self.scene.at_overlap)
    }

    fn problem<'b>(&self, form: &'b dyn RingSystem, begin: f64, start: &'b [f64]) -> Problem<'b> {
        let Scene { t_end: end, method, control, .. } = *self.scene;
        Problem { system: form, start, begin, end, method, control }
    }

    /// Goes on in another form of the same state.
    fn change_form(&mut self, form: &'a dyn RingSystem) {
        self.watch.change_form(form);
        self.record.form = form;
        self.sampler.change_dimension(form.dimension());
    }

    /// Whether the run is one in deviations that may go on in clearances. Fixed steps stay in the form they were asked for.
    fn can_turn(&self) -> bool {
        let is_adaptive = matches!(self.scene.control, Control::Adaptive { .. });
        !self.is_near_walls && self.scene.form == StateVariables::Deviations && is_adaptive
    }

    /// Whether the leg in deviations ends here.
    fn comes_near_walls(&self) -> bool {
        let scene = self.scene;
        let Some(speed) = scene.steady_speed else { return false };
        let least = NEAR_WALLS * scene.model.room(scene.ring.headway(), speed, speed);
        let is_near = !self.watch.is_quiet() && scene.model.is_singular() && self.can_turn();
        is_near && self.watch.rooms().iter().any(|&room| room < least)
    }
}

/// What helps a run that broke.
fn advice(failure: &ode::Failure, scene: &Scene) -> Option<&'static str> {
    match failure {
        ode::Failure::TooManySteps { .. } if scene.most_steps < ode::MOST_STEPS => {
            Some("raise most_steps or the tolerance")
        }
        ode::Failure::TooManySteps { .. } => Some("raise the tolerance"),
        ode::Failure::NotFinite { .. } => Some("a smaller step may help"),
        ode::Failure::StepTooSmall { .. } if scene.form == StateVariables::Positions => {
            Some("state = \"deviations\" keeps more digits of small gaps")
        }
        _ => None,
    }
}

impl Observer for Recorder<'_> {
    fn after(&mut self, step: &mut Step<'_>) -> ControlFlow<()> {
        self.onlooker.after(step);
        let new = match &self.judge {
            Some(_) => self.watch.look(step),
            None => self.watch.look_for_new(step),
        };
        if let Some(judge) = &mut self.judge {
            judge.look(&mut self.watch, step, &new);
            if self.onlooker.judging() == Judging::UntilCertain && judge.verdict().is_some() {
                return ControlFlow::Break(());
            }
        }
        let stop = new.iter().find(|happening| self.stops(happening)).map(|happening| happening.time);
        let until = stop.unwrap_or(step.end);
        let samples = if self.is_stopped { None } else { self.sampler.span(step, until) };
        self.onlooker.seen(step, &mut Sight { new: &new, watch: &mut self.watch, samples });
        if !self.is_stopped {
            let until = stop.unwrap_or(self.scene.t_end);
            let (record, onlooker) = (&mut self.record, &mut *self.onlooker);
            // of the standard deviation alone the speeds are enough
            let wanted = if record.scene.keeps_trajectories { 0..step.before().len() } else { record.form.speeds() };
            self.sampler.components_within(step, until, wanted, &mut |t, state| {
                record.take(t, state);
                onlooker.sampled(&record.std, &record.trajectories);
            });
            self.is_stopped = stop.is_some();
            match stop {
                Some(time) => record.follow_to(time, step),
                None if step.end >= record.followed + FOLLOWED_EVERY => record.follow(step.end, step.after()),
                None => (),
            }
        }
        if self.comes_near_walls() {
            self.turns_to_walls = true;
            self.record.begin = step.end;
            return ControlFlow::Break(());
        }
        let happened = |event: EventKind| self.watch.found().iter().any(|happening| happening.kind == event);
        let continues = !self.scene.model.is_singular();
        let is_over = happened(EventKind::BlowUp)
            || self.is_stopped && (!continues || happened(EventKind::NegativeSpeed) && happened(EventKind::Exchange));
        if is_over { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    fn next_sample(&self) -> f64 {
        let (sample, next) = (self.sampler.next(), self.record.followed + FOLLOWED_EVERY);
        if self.scene.keeps_trajectories && next < sample { next } else { sample }
    }

    fn most_steps(&self) -> u64 {
        self.scene.most_steps
    }

    fn stuck(&mut self, reached: &Statistics) {
        let rooms = self.rooms(&reached.state);
        let Record { form, gaps, speeds, .. } = &mut self.record;
        form.read(&reached.state, gaps, speeds);
        let places = (0..gaps.len()).map(|n| Place { pedestrian: n, gap: gaps[n], room: rooms[n], speed: speeds[n] });
        self.narrowest = places.min_by(|a, b| a.room.total_cmp(&b.room));
        self.reached = reached.clone();
    }

    fn between(&mut self, mark: &ResumePoint<'_>) {
        let Record { std, trajectories, drift, followed, begin, .. } = &self.record;
        let (found, earlier, followed) = (self.watch.found(), self.earlier, *followed);
        let near_walls = self.is_near_walls.then_some(*begin);
        let scene = self.scene;
        let judge = self.judge.as_ref();
        let underway =
            PartialRun { scene, mark, found, std, trajectories, drift, followed, near_walls, earlier, judge };
        self.onlooker.between(&underway);
    }
}

/// The table of standard deviations, empty.
pub(crate) fn std_table() -> Table {
    Table::new(&["t", "std"])
}

/// The table of trajectories, empty.
pub(crate) fn trajectories_table() -> Table {
    Table::new(&["t", "n", "x", "v"])
}

/// The tables under way.
struct Record<'a> {
    scene: &'a Scene,
    form: &'a dyn RingSystem,
    std: Table,
    trajectories: Table,
    positions: Vec<f64>,
    gaps: Vec<f64>,
    speeds: Vec<f64>,
    drift: jams::Drift,
    /// When the jams were looked at last.
    followed: f64,
    /// The time at which the leg begins.
    begin: f64,
}

impl<'a> Record<'a> {
    fn new(scene: &'a Scene, form: &'a dyn RingSystem) -> Record<'a> {
        let zeros = || vec![0.0; scene.ring.pedestrians];
        Record {
            scene,
            form,
            std: std_table(),
            trajectories: trajectories_table(),
            positions: zeros(),
            gaps: zeros(),
            speeds: zeros(),
            drift: jams::Drift::default(),
            followed: 0.0,
            begin: 0.0,
        }
    }

    fn take(&mut self, t: f64, state: &[f64]) {
        self.std.push(&[t, self.form.speed_deviation(state)]);
        if !self.scene.keeps_trajectories {
            return;
        }
        self.form.write_positions(state, &mut self.positions);
        self.form.read(state, &mut self.gaps, &mut self.speeds);
        for (n, (x, v)) in self.positions.iter().zip(&self.speeds).enumerate() {
            self.trajectories.push(&[t, n as f64, *x, *v]);
        }
    }

    /// Looks where the jams are at time `t`.
    fn follow(&mut self, t: f64, state: &[f64]) {
        if !self.scene.keeps_trajectories {
            return;
        }
        self.form.write_positions(state, &mut self.positions);
        self.form.read(state, &mut self.gaps, &mut self.speeds);
        let (desired, length) = (self.scene.model.desired_speed(), self.scene.ring.length);
        let found = jams::threshold(&self.speeds, desired)
            .map_or(Vec::new(), |threshold| jams::find(&self.positions, &self.speeds, length, threshold));
        self.drift.follow(&found, length, t - self.followed);
        self.followed = t;
    }

    /// Looks where the jams are at a time within a step.
    fn follow_to(&mut self, t: f64, step: &mut Step<'_>) {
        let mut state = vec![0.0; step.before().len()];
        step.at(t, &mut state);
        self.follow(t, &state);
    }
}
