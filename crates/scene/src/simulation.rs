//! Running a scene: the tables of its standard deviation and trajectories, its events, its statistics.

use crate::checkpoint::{Checkpoint, Underway};
use crate::run::Scene;
use files::table::Table;
use jam::events::{Event, Happening, Watch};
use jam::jams;
use jam::states::{Form, FormKind, gaps_state};
use ode::{Control, Mark, Observer, Problem, Sampler, Statistics, Step, integrate, resume};
use std::ops::ControlFlow;

/// What a run gives.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// `t, std`: up to the first stop.
    pub std: Table,
    /// `t, n, x, v`: up to the first stop; empty when the scene does not keep them.
    pub trajectories: Table,
    /// The first event of each kind, in order of time; those after a stop belong to the continued run.
    pub events: Vec<Happening>,
    /// Steps, evaluations, the time reached.
    pub statistics: Statistics,
    /// Positions and speeds at the time reached.
    pub positions: Vec<f64>,
    /// See `positions`.
    pub speeds: Vec<f64>,
    /// The jams at the last sample before the end or the first stop, and how they got there; nothing when the scene does
    /// not keep trajectories.
    pub drift: jams::Drift,
}

impl Outcome {
    /// The first event that ends the drawn part of the run.
    pub fn stop(&self) -> Option<&Happening> {
        self.events.iter().find(|happening| happening.event.is_stop())
    }
}

/// A run that could not go on.
#[derive(Clone, Debug, PartialEq)]
pub struct Broken {
    /// Why, with the time reached and the step.
    pub failure: ode::Failure,
    /// Who had the least room in the last state that was reached; `None` when no step was tried.
    pub narrowest: Option<Place>,
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
        self.narrowest.map_or(Ok(()), |Place { pedestrian, gap, room, speed }| {
            write!(f, "; least room then: pedestrian {pedestrian}, gap {gap:?}, room {room:?}, speed {speed:?}")
        })
    }
}

impl std::error::Error for Broken {}

/// Looks on while a scene runs; the run does not depend on it.
pub trait Onlooker {
    /// Sees every accepted step of adaptive length; of fixed ones, those that the run needs to see.
    fn after(&mut self, _step: &Step<'_>) {}

    /// Sees the run every few thousand steps, where these are of fixed length. A run by adaptive steps takes seconds and is
    /// not shown.
    fn between(&mut self, _underway: &Underway<'_>) {}
}

/// Nobody looks on.
impl Onlooker for () {}

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
/// As [`run`]; or a checkpoint for a scene by adaptive steps.
pub fn run_from(scene: &Scene, from: Option<Checkpoint>, onlooker: &mut dyn Onlooker) -> Result<Outcome, Broken> {
    let form = scene.form.build(&scene.model, scene.ring);
    let near_walls = FormKind::Gaps.build(&scene.model, scene.ring);
    let mut recorder = Recorder::new(scene, &*form, onlooker);
    let mut statistics = match from {
        Some(checkpoint) => recorder.resume(&*form, checkpoint)?,
        None => {
            let start = form.start(scene.start);
            recorder.record.take(0.0, &start);
            recorder.leg(&*form, 0.0, &start)?
        }
    };
    let mut last: &dyn Form = &*form;
    let count = scene.ring.pedestrians;
    let (mut positions, mut gaps, mut speeds) = (vec![0.0; count], vec![0.0; count], vec![0.0; count]);
    if recorder.is_near_walls {
        form.write_positions(&statistics.state, &mut positions);
        form.read(&statistics.state, &mut gaps, &mut speeds);
        let state = gaps_state(&scene.model, &gaps, &speeds, positions[0]);
        recorder.change_form(&*near_walls);
        let first_leg = statistics;
        statistics = recorder.leg(&*near_walls, first_leg.time, &state)?;
        statistics.steps += first_leg.steps;
        statistics.rejected += first_leg.rejected;
        statistics.evaluations += first_leg.evaluations;
        last = &*near_walls;
    }
    last.write_positions(&statistics.state, &mut positions);
    last.read(&statistics.state, &mut gaps, &mut speeds);
    let Recorder { watch, record, .. } = recorder;
    let events = watch.found().to_vec();
    Ok(Outcome {
        std: record.std,
        trajectories: record.trajectories,
        events,
        statistics,
        positions,
        speeds,
        drift: record.drift,
    })
}

/// Where the least room falls below this part of that in the uniform flow, the clearances become the state: they keep all
/// digits however small they are; deviations from the uniform flow have lost three of them there.
const NEAR_WALLS: f64 = 1e-3;

/// Takes samples and looks for events, step by step.
struct Recorder<'a> {
    scene: &'a Scene,
    sampler: Sampler,
    watch: Watch<'a>,
    record: Record<'a>,
    onlooker: &'a mut dyn Onlooker,
    is_stopped: bool,
    is_near_walls: bool,
    narrowest: Option<Place>,
}

impl<'a> Recorder<'a> {
    fn new(scene: &'a Scene, form: &'a dyn Form, onlooker: &'a mut dyn Onlooker) -> Recorder<'a> {
        Recorder {
            scene,
            sampler: Sampler::new(scene.sample, form.dimension()),
            watch: Watch::new(scene.model, form, scene.ring.pedestrians),
            record: Record::new(scene, form),
            onlooker,
            is_stopped: false,
            is_near_walls: false,
            narrowest: None,
        }
    }

    /// Integrates from this time and state to the end of the run, or until an event or the walls break it off.
    fn leg(&mut self, form: &dyn Form, begin: f64, state: &[f64]) -> Result<Statistics, Broken> {
        integrate(&self.problem(form, begin, state), self).map_err(|failure| self.broken(failure))
    }

    /// Goes on from a checkpoint as [`Recorder::leg`] would have.
    fn resume(&mut self, form: &dyn Form, checkpoint: Checkpoint) -> Result<Statistics, Broken> {
        let Checkpoint { place, statistics, state, found, std, trajectories, drift } = checkpoint;
        // one sample for each multiple of the interval, from 0; none after a stop
        self.sampler.resume(std.len() as u64);
        self.is_stopped = found.iter().any(|happening| happening.event.is_stop());
        self.watch.resume(found);
        (self.record.std, self.record.trajectories, self.record.drift) = (std, trajectories, drift);
        let mark = Mark { place, statistics: &statistics, state: &state };
        resume(&self.problem(form, 0.0, &state), &mark, self).map_err(|failure| self.broken(failure))
    }

    fn broken(&self, failure: ode::Failure) -> Broken {
        Broken { failure, narrowest: self.narrowest }
    }

    fn problem<'b>(&self, form: &'b dyn Form, begin: f64, start: &'b [f64]) -> Problem<'b> {
        let Scene { t_end: end, method, control, .. } = *self.scene;
        Problem { system: form, start, begin, end, method, control }
    }

    /// Goes on in another form of the same state.
    fn change_form(&mut self, form: &'a dyn Form) {
        self.watch.change_form(form);
        self.record.form = form;
        self.sampler.change_dimension(form.dimension());
    }

    /// Whether the leg in deviations ends here. Fixed steps stay in the form they were asked for.
    fn comes_near_walls(&self) -> bool {
        let scene = self.scene;
        let is_open = !self.is_near_walls && scene.form == FormKind::Deviations && scene.model.is_singular();
        let least = NEAR_WALLS * scene.model.room(scene.ring.headway(), scene.steady_speed, scene.steady_speed);
        is_open
            && matches!(scene.control, Control::Adaptive { .. })
            && self.watch.rooms().iter().any(|&room| room < least)
    }
}

impl Observer for Recorder<'_> {
    fn after(&mut self, step: &mut Step<'_>) -> ControlFlow<()> {
        self.onlooker.after(step);
        let new = self.watch.look(step);
        if !self.is_stopped {
            let stop = new.iter().find(|happening| happening.event.is_stop());
            let until = stop.map_or(self.scene.t_end, |happening| happening.time);
            let record = &mut self.record;
            self.sampler.within(step, until, &mut |t, state| record.take(t, state));
            self.is_stopped = stop.is_some();
        }
        if self.comes_near_walls() {
            self.is_near_walls = true;
            return ControlFlow::Break(());
        }
        let happened = |event: Event| self.watch.found().iter().any(|happening| happening.event == event);
        let continues = !self.scene.model.is_singular();
        let is_over = happened(Event::BlowUp)
            || self.is_stopped && (!continues || happened(Event::NegativeSpeed) && happened(Event::Exchange));
        if is_over { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    fn next_sample(&self) -> f64 {
        self.sampler.next()
    }

    fn most_steps(&self) -> u64 {
        self.scene.most_steps
    }

    fn stuck(&mut self, state: &[f64]) {
        let Record { form, gaps, speeds, .. } = &mut self.record;
        form.read(state, gaps, speeds);
        let places = (0..gaps.len()).map(|n| {
            let (gap, speed, ahead) = (gaps[n], speeds[n], speeds[(n + 1) % speeds.len()]);
            Place { pedestrian: n, gap, room: self.scene.model.room(gap, speed, ahead), speed }
        });
        self.narrowest = places.min_by(|a, b| a.room.total_cmp(&b.room));
    }

    fn between(&mut self, mark: &Mark<'_>) {
        let Record { std, trajectories, drift, .. } = &self.record;
        let found = self.watch.found();
        self.onlooker.between(&Underway { scene: self.scene, mark, found, std, trajectories, drift });
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
    form: &'a dyn Form,
    std: Table,
    trajectories: Table,
    positions: Vec<f64>,
    gaps: Vec<f64>,
    speeds: Vec<f64>,
    drift: jams::Drift,
}

impl<'a> Record<'a> {
    fn new(scene: &'a Scene, form: &'a dyn Form) -> Record<'a> {
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
        let (desired, length) = (self.scene.model.desired_speed(), self.scene.ring.length);
        let found = jams::threshold(&self.speeds, desired)
            .map_or(Vec::new(), |threshold| jams::find(&self.positions, &self.speeds, length, threshold));
        self.drift.follow(&found, length, self.scene.sample);
    }
}
