//! A checkpoint of a run, serialised so that the run can be resumed bit-identically. The module opens no file: the
//! caller decides where and how often to write one.
//!
//! The bytes are 64-bit words, low byte first, numbers by their bits: place, counts, state, pace, events, samples,
//! jams, what the judge has seen. What follows from the run and the rest is left out: the times of the trajectories,
//! and whether the run has come to a stop. Nothing guards them against damage; a file should hold their hash.

use super::{Run, Sample, Samples, Statistics};
use crate::events::{Event, EventKind};
use crate::jams::{Drift, Jam};
use crate::outcome::{Judge, Memory};
use crate::states::StateVariables;
use ode::{Control, Pace, ResumePoint, StepPosition};

/// A run between two of its steps.
#[derive(Clone, Copy, Debug)]
pub struct PartialRun<'a> {
    pub(crate) run: &'a Run,
    pub(crate) mark: &'a ResumePoint<'a>,
    pub(crate) found: &'a [Event],
    pub(crate) samples: &'a Samples,
    pub(crate) drift: &'a Drift,
    /// When the jams were looked at last.
    pub(crate) followed: f64,
    /// When the leg near the walls began, if it has.
    pub(crate) near_walls: Option<f64>,
    pub(crate) earlier: Statistics,
    /// The judge of its outcome, if there is one.
    pub(crate) judge: Option<&'a Judge>,
}

impl PartialRun<'_> {
    /// The part of its time that is done, 0 to 1.
    pub fn fraction(&self) -> f64 {
        fraction(self.run, self.mark.position.step, self.mark.statistics.time)
    }

    /// Everything that [`Checkpoint::parse`] needs.
    pub fn to_bytes(&self) -> Vec<u8> {
        let ResumePoint { position, statistics, state, pace } = *self.mark;
        let mut words = Words::default();
        words.whole(&[
            position.step,
            position.slow_until,
            statistics.steps,
            statistics.rejected,
            statistics.evaluations,
        ]);
        words.numbers(&[statistics.time]);
        words.count(state.len());
        words.numbers(state);
        words.count(usize::from(pace.is_some()));
        if let Some(pace) = pace {
            words.numbers(pace.rates);
            words.numbers(pace.compensation);
            words.numbers(&[pace.time[0], pace.time[1], pace.step, pace.error, pace.unit]);
        }
        words.whole(&[self.earlier.steps, self.earlier.rejected, self.earlier.evaluations]);
        words.numbers(&[self.followed]);
        words.count(usize::from(self.near_walls.is_some()));
        words.numbers(&[self.near_walls.unwrap_or(0.0)]);
        words.count(self.found.len());
        for event in self.found {
            words.count(EventKind::ALL.iter().take_while(|kind| **kind != event.kind).count());
            words.numbers(&[event.time, event.gap, event.step]);
            words.count(event.pedestrian);
        }
        words.count(self.samples.len());
        self.samples.iter().for_each(|sample| words.numbers(&[sample.time, sample.std]));
        words.count(self.samples.positions.len());
        self.samples.iter().for_each(|sample| {
            sample.positions.iter().zip(sample.speeds).for_each(|(x, v)| words.numbers(&[*x, *v]));
        });
        words.numbers(&[self.drift.distance, self.drift.time]);
        words.count(self.drift.before.len());
        for jam in &self.drift.before {
            words.count(jam.first);
            words.count(jam.pedestrians);
            words.numbers(&[jam.extent, jam.centre]);
        }
        let memory = self.judge.map_or(Vec::new(), |judge| judge.remember().to_numbers());
        words.count(memory.len());
        words.numbers(&memory);
        words.0
    }
}

/// A run to resume.
#[derive(Clone, Debug, PartialEq)]
pub struct Checkpoint {
    pub(crate) position: StepPosition,
    pub(crate) statistics: ode::Statistics,
    pub(crate) state: Vec<f64>,
    pub(crate) pace: Option<Remembered>,
    pub(crate) earlier: Statistics,
    pub(crate) followed: f64,
    pub(crate) near_walls: Option<f64>,
    pub(crate) found: Vec<Event>,
    pub(crate) samples: Samples,
    pub(crate) drift: Drift,
    pub(crate) memory: Option<Memory>,
}

/// What adaptive steps remember (see [`Pace`]).
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Remembered {
    rates: Vec<f64>,
    compensation: Vec<f64>,
    time: [f64; 2],
    step: f64,
    error: f64,
    unit: f64,
}

impl Remembered {
    pub(crate) fn pace(&self) -> Pace<'_> {
        let Remembered { rates, compensation, time, step, error, unit } = self;
        Pace { rates, compensation, time: *time, step: *step, error: *error, unit: *unit }
    }
}

impl Checkpoint {
    /// Reads what [`PartialRun::to_bytes`] wrote for this run; `None` for anything of another form.
    pub fn parse(bytes: &[u8], run: &Run) -> Option<Checkpoint> {
        let mut words = Reader { words: bytes.chunks_exact(8) };
        let position = StepPosition { step: words.whole()?, slow_until: words.whole()? };
        let (steps, rejected, evaluations) = (words.whole()?, words.whole()?, words.whole()?);
        let statistics = ode::Statistics { steps, rejected, evaluations, time: words.number()?, state: Vec::new() };
        let count = words.count()?;
        let state = (0..count).map(|_| words.number()).collect::<Option<Vec<f64>>>()?;
        let pace = if words.count()? == 1 { Some(words.pace(state.len())?) } else { None };
        let earlier =
            Statistics { steps: words.whole()?, rejected: words.whole()?, evaluations: words.whole()?, time: 0.0 };
        let (followed, is_near_walls, begin) = (words.number()?, words.count()? == 1, words.number()?);
        let near_walls = is_near_walls.then_some(begin);
        let count = words.count()?;
        let found = (0..count).map(|_| words.event()).collect::<Option<Vec<Event>>>()?;
        let samples = words.samples(run)?;
        let (distance, time, count) = (words.number()?, words.number()?, words.count()?);
        let before = (0..count).map(|_| words.jam()).collect::<Option<Vec<Jam>>>()?;
        let count = words.count()?;
        let memory = match (0..count).map(|_| words.number()).collect::<Option<Vec<f64>>>()? {
            numbers if numbers.is_empty() => None,
            numbers => Some(Memory::parse(&numbers)?),
        };
        let is_whole = words.words.next().is_none() && words.words.remainder().is_empty();
        let kind = if is_near_walls { StateVariables::Spacings } else { run.form };
        let fits = state.len() == kind.build(&run.model, run.ring).dimension()
            && pace.is_some() == matches!(run.control, Control::Adaptive { .. });
        let drift = Drift { before, distance, time };
        (is_whole && fits).then_some(Checkpoint {
            position,
            statistics,
            state,
            pace,
            earlier,
            followed,
            near_walls,
            found,
            samples,
            drift,
            memory,
        })
    }

    /// Steps that need not be made again.
    pub fn steps(&self) -> u64 {
        self.earlier.steps + self.position.step
    }

    /// The fraction of the run's time that need not be repeated, 0 to 1.
    pub fn fraction(&self, run: &Run) -> f64 {
        fraction(run, self.position.step, self.statistics.time)
    }
}

fn fraction(run: &Run, step: u64, time: f64) -> f64 {
    match run.control {
        Control::Fixed { step: h } => step as f64 * h / run.t_end,
        Control::Adaptive { .. } => time / run.t_end,
    }
}

/// Words under way to bytes.
#[derive(Default)]
struct Words(Vec<u8>);

impl Words {
    fn whole(&mut self, values: &[u64]) {
        values.iter().for_each(|value| self.0.extend_from_slice(&value.to_le_bytes()));
    }

    fn count(&mut self, count: usize) {
        self.whole(&[count as u64]);
    }

    fn numbers(&mut self, values: &[f64]) {
        values.iter().for_each(|value| self.0.extend_from_slice(&value.to_bits().to_le_bytes()));
    }
}

/// Words under way from bytes.
struct Reader<'a> {
    words: std::slice::ChunksExact<'a, u8>,
}

impl Reader<'_> {
    fn whole(&mut self) -> Option<u64> {
        self.words.next()?.try_into().ok().map(u64::from_le_bytes)
    }

    fn count(&mut self) -> Option<usize> {
        usize::try_from(self.whole()?).ok()
    }

    fn number(&mut self) -> Option<f64> {
        self.whole().map(f64::from_bits)
    }

    fn pace(&mut self, dimension: usize) -> Option<Remembered> {
        let rates = (0..dimension).map(|_| self.number()).collect::<Option<Vec<f64>>>()?;
        let compensation = (0..dimension).map(|_| self.number()).collect::<Option<Vec<f64>>>()?;
        let time = [self.number()?, self.number()?];
        Some(Remembered {
            rates,
            compensation,
            time,
            step: self.number()?,
            error: self.number()?,
            unit: self.number()?,
        })
    }

    fn event(&mut self) -> Option<Event> {
        let kind = *EventKind::ALL.get(self.count()?)?;
        let (time, gap, step) = (self.number()?, self.number()?, self.number()?);
        Some(Event { kind, time, pedestrian: self.count()?, gap, step })
    }

    fn jam(&mut self) -> Option<Jam> {
        let (first, pedestrians) = (self.count()?, self.count()?);
        Some(Jam { first, pedestrians, extent: self.number()?, centre: self.number()? })
    }

    /// As many pedestrians for each sample as are kept, or none at all.
    fn samples(&mut self, run: &Run) -> Option<Samples> {
        let pedestrians = if run.keeps_trajectories { run.ring.pedestrians } else { 0 };
        let mut samples = Samples::new(pedestrians);
        for _ in 0..self.count()? {
            samples.push(Sample {
                time: self.number()?,
                std: self.number()?,
                positions: &[],
                speeds: &[],
                spacings: &[],
            });
        }
        if self.count()? != samples.len() * pedestrians {
            return None;
        }
        for _ in 0..samples.len() * pedestrians {
            samples.positions.push(self.number()?);
            samples.speeds.push(self.number()?);
        }
        Some(samples)
    }
}
