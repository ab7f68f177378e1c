//! One run of the logarithmic law as figures 11 to 13 show it, and the numbers that describe its jams.

use crate::draw::Draw;
use figures::failure::Failure;
use jam::jams::{self, Drift};
use jam::laws::{Logarithmic, Model};
use jam::ring::Ring;
use jam::run::{AtOverlap, RunObserver, Sample, Sight, run as simulate, run_from};
use jam::states::StateVariables;
use ode::{Control, Method, Step};

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
        Model::Logarithmic(Logarithmic { v0: desired_speed, a_v: 0.0, epsilon })
    }

    /// The ring.
    pub fn ring(&self) -> Ring {
        Ring { pedestrians: self.pedestrians, length: self.length }
    }

    /// The run itself, by a method.
    ///
    /// # Errors
    /// There is no uniform flow, or a gap is closed at the start.
    pub fn made_by(&self, method: Method, control: Control) -> Result<jam::run::Run, Failure> {
        let (shift, displacements) = match self.start {
            Start::One(shift) => (shift, Vec::new()),
            Start::Random(size) => {
                let mut draw = Draw::default();
                (0.0, (0..self.pedestrians).map(|_| draw.between(-size, size)).collect())
            }
        };
        let start = jam::ring::Start { shift };
        let run = jam::run::Run::new(self.model(), self.ring(), start, self.end).map_err(Failure::work)?;
        Ok(jam::run::Run {
            displacements,
            sample: self.sample,
            method,
            control,
            form: StateVariables::Deviations,
            ..run
        })
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
    /// The least speed at the samples late in the run.
    pub slowest: Option<f64>,
    /// The largest.
    pub fastest: Option<f64>,
}

/// How much of the end of a run is late.
pub const LATE: f64 = 500.0;
/// The least time for which jams must be followed to measure their speed.
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
    let mut looking = Looking::new(run);
    run_from(&run.made_by(method, control)?, None, &mut looking).map_err(Failure::work)?;
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
    // to the end, whatever happens on the way
    let run = jam::run::Run { at_overlap: AtOverlap::Continue, ..run.made_by(method, control)? };
    let outcome = simulate(&run).map_err(Failure::work)?;
    let kept = outcome.samples.iter().skip(1).map(|sample| Snapshot {
        time: sample.time,
        positions: sample.positions.to_vec(),
        speeds: sample.speeds.to_vec(),
        spread: sample.std,
    });
    Ok(kept.collect())
}

struct Looking<'a> {
    run: &'a Run,
    seen: Seen,
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

impl RunObserver for Looking<'_> {
    fn seen(&mut self, _step: &mut Step<'_>, sight: &mut Sight<'_, '_>) {
        let stop = sight.new.iter().find(|event| event.kind.is_stop());
        self.stop = stop.map(|event| (event.kind.name(), event.time));
    }

    fn sampled(&mut self, &Sample { time, std, positions, speeds, .. }: &Sample<'_>) {
        let passed = self.seen.before.filter(|before| before.1 < ONSET && std >= ONSET);
        if let (None, Some((earlier, less))) = (self.seen.onset, passed) {
            self.seen.onset = Some(earlier + (time - earlier) * (ONSET - less) / (std - less));
        }
        self.seen.before = Some((time, std));
        let length = self.run.length;
        let found = jams::threshold(speeds, self.run.desired_speed)
            .map_or(Vec::new(), |threshold| jams::find(positions, speeds, length, threshold));
        self.seen.drift.follow(&found, length, self.run.sample);
        if time >= self.run.end - LATE {
            self.seen.late.take(time, std, positions, speeds);
        }
    }

    fn is_done(&self) -> bool {
        self.stop.is_some()
    }
}

impl<'a> Looking<'a> {
    fn new(run: &'a Run) -> Looking<'a> {
        Looking { run, seen: Seen::default(), stop: None }
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
