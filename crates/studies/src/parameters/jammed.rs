//! One run of the logarithmic law as figures 11 to 13 show it, and the numbers that describe its jams.

use crate::draw::Draw;
use figures::failure::Failure;
use jam::events::Watch;
use jam::jams::{self, Drift};
use jam::laws::{Logarithmic, Model};
use jam::ring::Ring;
use jam::states::{RingSystem, StateVariables};
use ode::{Control, Method, Observer, Problem, Sampler, Step, integrate};
use std::ops::ControlFlow;

/// How the uniform flow is disturbed at the start, all speeds being 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Start {
    /// Pedestrian 0 moved forward by this much, as in the paper.
    One(f64),
    /// Everybody moved by a number drawn evenly from minus to plus this much.
    Random(f64),
}

/// What can be changed of the run of figures 11 to 13; by default it is that run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Run {
    /// `N >= 2`.
    pub pedestrians: usize,
    /// `L > 0`, in units of `a_0`.
    pub length: f64,
    /// `v_0' > 0`.
    pub desired_speed: f64,
    /// `eps > 0`.
    pub epsilon: f64,
    /// The disturbance.
    pub start: Start,
    /// The time at which it ends.
    pub end: f64,
    /// The time between samples.
    pub sample: f64,
}

impl Default for Run {
    fn default() -> Run {
        Run {
            pedestrians: 133,
            length: 200.0,
            desired_speed: 1.0,
            epsilon: 0.01,
            start: Start::One(0.1),
            end: 3000.0,
            sample: 1.0,
        }
    }
}

impl Run {
    /// The law.
    pub fn model(&self) -> Model {
        let (desired_speed, epsilon) = (self.desired_speed, self.epsilon);
        Model::Logarithmic(Logarithmic { desired_speed, widening: 0.0, epsilon })
    }

    /// The ring.
    pub fn ring(&self) -> Ring {
        Ring { pedestrians: self.pedestrians, length: self.length }
    }

    /// The state at the start, in deviations from the uniform flow.
    pub fn state(&self, form: &dyn RingSystem) -> Vec<f64> {
        match self.start {
            Start::One(shift) => form.start(jam::ring::Start { shift }),
            Start::Random(size) => {
                let (count, mut draw) = (self.pedestrians, Draw::default());
                let places: Vec<f64> = (0..count).map(|_| draw.between(-size, size)).collect();
                let mut state = form.start(jam::ring::Start { shift: 0.0 });
                for n in 0..count {
                    state[n] += places[(n + 1) % count] - places[n];
                }
                state[2 * count] += places[0];
                state
            }
        }
    }
}

/// What a run shows. The last [`LATE`] of its time count as late; a run that an overlap ends shows only its events and,
/// if it got so far, its onset.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Jammed {
    /// The first event that the law has no meaning after, and when.
    pub stop: Option<(&'static str, f64)>,
    /// Jams at the end (see [`jams::find`]).
    pub jams: Option<f64>,
    /// How fast they travel, negative backwards: over the time since their number changed last, if that is at least
    /// [`FOLLOWED`].
    pub jam_speed: Option<f64>,
    /// Mean over the pedestrians and the late time.
    pub mean_speed: Option<f64>,
    /// Pedestrians that pass a place in a unit of time: the mean speed by the headway.
    pub flow: Option<f64>,
    /// The standard deviation of the speeds, mean over the late time.
    pub plateau: Option<f64>,
    /// When the standard deviation of the speeds passes [`ONSET`], linear between samples.
    pub onset: Option<f64>,
    /// The least speed of anybody in the late time, at samples.
    pub slowest: Option<f64>,
    /// The largest.
    pub fastest: Option<f64>,
}

/// How much of the end of a run is late.
pub const LATE: f64 = 500.0;
/// For how long jams must have been followed for their speed to be told.
pub const FOLLOWED: f64 = 50.0;
/// The standard deviation at which jams count as formed: a tenth of the desired speed of figure 13.
pub const ONSET: f64 = 0.1;

impl Jammed {
    /// The numbers in the order of the tables' columns.
    pub const NUMBERS: [fn(&Jammed) -> Option<f64>; 8] = [
        |jammed| jammed.jams,
        |jammed| jammed.jam_speed,
        |jammed| jammed.mean_speed,
        |jammed| jammed.flow,
        |jammed| jammed.plateau,
        |jammed| jammed.onset,
        |jammed| jammed.slowest,
        |jammed| jammed.fastest,
    ];
}

/// Makes a run and looks at it.
///
/// # Errors
/// The integration failed.
pub fn run(run: &Run, (method, control): (Method, Control)) -> Result<Jammed, Failure> {
    let model = run.model();
    let form = StateVariables::Deviations.build(&model, run.ring());
    let start = run.state(&*form);
    let mut looking = Looking::new(run, model, &*form);
    looking.take(0.0, &start);
    let problem = Problem { system: &*form, start: &start, begin: 0.0, end: run.end, method, control };
    integrate(&problem, &mut looking).map_err(Failure::work)?;
    Ok(looking.conclude())
}

/// Everybody at one instant.
#[derive(Clone, Debug, PartialEq)]
pub struct Snapshot {
    /// When.
    pub time: f64,
    /// Unwrapped positions.
    pub positions: Vec<f64>,
    /// Speeds.
    pub speeds: Vec<f64>,
    /// Their standard deviation.
    pub spread: f64,
}

/// Makes a run and keeps all samples after the start.
///
/// # Errors
/// The integration failed.
pub fn snapshots(run: &Run, (method, control): (Method, Control)) -> Result<Vec<Snapshot>, Failure> {
    let form = StateVariables::Deviations.build(&run.model(), run.ring());
    let start = run.state(&*form);
    let mut keeping = Keeping { run, form: &*form, sampler: Sampler::new(run.sample, form.dimension()), kept: vec![] };
    let problem = Problem { system: &*form, start: &start, begin: 0.0, end: run.end, method, control };
    integrate(&problem, &mut keeping).map_err(Failure::work)?;
    Ok(keeping.kept)
}

struct Keeping<'a> {
    run: &'a Run,
    form: &'a dyn RingSystem,
    sampler: Sampler,
    kept: Vec<Snapshot>,
}

impl Observer for Keeping<'_> {
    fn after(&mut self, step: &mut Step<'_>) -> ControlFlow<()> {
        let (form, kept, count) = (self.form, &mut self.kept, self.run.pedestrians);
        self.sampler.within(step, self.run.end, &mut |time, state| {
            let (mut positions, mut gaps, mut speeds) = (vec![0.0; count], vec![0.0; count], vec![0.0; count]);
            form.write_positions(state, &mut positions);
            form.read(state, &mut gaps, &mut speeds);
            kept.push(Snapshot { time, positions, speeds, spread: form.speed_deviation(state) });
        });
        ControlFlow::Continue(())
    }

    fn next_sample(&self) -> f64 {
        self.sampler.next()
    }
}

struct Looking<'a> {
    run: &'a Run,
    form: &'a dyn RingSystem,
    watch: Watch<'a>,
    sampler: Sampler,
    seen: Seen,
    positions: Vec<f64>,
    gaps: Vec<f64>,
    speeds: Vec<f64>,
    stop: Option<(&'static str, f64)>,
}

/// What the samples so far say.
#[derive(Default)]
struct Seen {
    drift: Drift,
    before: Option<(f64, f64)>,
    onset: Option<f64>,
    late: Late,
}

/// Sums over the samples of the late time.
#[derive(Default)]
struct Late {
    samples: f64,
    spread: f64,
    /// Mean positions at its first and last sample, with the times.
    places: Option<[(f64, f64); 2]>,
    slowest: Option<f64>,
    fastest: Option<f64>,
}

impl<'a> Looking<'a> {
    fn new(run: &'a Run, model: Model, form: &'a dyn RingSystem) -> Looking<'a> {
        let zeros = || vec![0.0; run.pedestrians];
        Looking {
            run,
            form,
            watch: Watch::new(model, form, run.pedestrians),
            sampler: Sampler::new(run.sample, form.dimension()),
            seen: Seen::default(),
            positions: zeros(),
            gaps: zeros(),
            speeds: zeros(),
            stop: None,
        }
    }

    fn take(&mut self, t: f64, state: &[f64]) {
        let spread = self.form.speed_deviation(state);
        let passed = self.seen.before.filter(|before| before.1 < ONSET && spread >= ONSET);
        if let (None, Some((earlier, less))) = (self.seen.onset, passed) {
            self.seen.onset = Some(earlier + (t - earlier) * (ONSET - less) / (spread - less));
        }
        self.seen.before = Some((t, spread));
        self.form.write_positions(state, &mut self.positions);
        self.form.read(state, &mut self.gaps, &mut self.speeds);
        let length = self.run.length;
        let found = jams::threshold(&self.speeds, self.run.desired_speed)
            .map_or(Vec::new(), |threshold| jams::find(&self.positions, &self.speeds, length, threshold));
        self.seen.drift.follow(&found, length, self.run.sample);
        if t >= self.run.end - LATE {
            self.seen.late.take(t, spread, &self.positions, &self.speeds);
        }
    }

    fn conclude(self) -> Jammed {
        let Seen { drift, onset, late, .. } = self.seen;
        let stop = self.stop;
        if stop.is_some() {
            return Jammed { stop, onset, ..Jammed::default() };
        }
        let mean_speed = late.places.map(|[(t0, x0), (t1, x1)]| (x1 - x0) / (t1 - t0));
        Jammed {
            stop,
            jams: Some(drift.jams().len() as f64),
            jam_speed: drift.speed().filter(|(_, time)| *time >= FOLLOWED).map(|(speed, _)| speed),
            mean_speed,
            flow: mean_speed.map(|speed| speed / self.run.ring().headway()),
            plateau: Some(late.spread / late.samples),
            onset,
            slowest: late.slowest,
            fastest: late.fastest,
        }
    }
}

impl Late {
    fn take(&mut self, t: f64, spread: f64, positions: &[f64], speeds: &[f64]) {
        self.samples += 1.0;
        self.spread += spread;
        let place = (t, positions.iter().sum::<f64>() / positions.len() as f64);
        self.places = Some([self.places.map_or(place, |places| places[0]), place]);
        for &v in speeds {
            self.slowest = Some(self.slowest.map_or(v, |least| math::smaller(least, v)));
            self.fastest = Some(self.fastest.map_or(v, |most| math::larger(most, v)));
        }
    }
}

impl Observer for Looking<'_> {
    fn after(&mut self, step: &mut Step<'_>) -> ControlFlow<()> {
        let new = self.watch.look(step);
        let stop = new.iter().find(|happening| happening.kind.is_stop());
        let until = stop.map_or(self.run.end, |happening| happening.time);
        // the sampler lends its buffer while this one takes what it gives
        let mut sampler = std::mem::replace(&mut self.sampler, Sampler::new(self.run.sample, 0));
        sampler.within(step, until, &mut |t, state| self.take(t, state));
        self.sampler = sampler;
        self.stop = stop.map(|happening| (happening.kind.name(), happening.time));
        if self.stop.is_some() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    fn next_sample(&self) -> f64 {
        self.sampler.next()
    }
}
