//! A checkpoint of a run, as bytes, from which it resumes with the same bits. Pure: who writes them
//! where, and how often, is the caller's business.
//!
//! The bytes are 64-bit words, low byte first, numbers by their bits: place, counts, state, pace, events, samples, jams, what the judge has seen. What
//! follows from the scene and the rest is left out: the times and numbers in the table of trajectories, and whether the
//! run has come to a stop. Nothing guards them against damage; a file should hold their hash.

use crate::run::Scene;
use crate::simulation::Counts;
use files::table::Table;
use jam::events::{Event, EventKind};
use jam::jams::{Drift, Jam};
use jam::outcome::{Judge, Memory};
use jam::states::StateVariables;
use ode::{Control, Pace, Place, ResumePoint, Statistics};

/// A run between two of its steps.
#[derive(Clone, Copy, Debug)]
pub struct PartialRun<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) mark: &'a ResumePoint<'a>,
    pub(crate) found: &'a [Event],
    pub(crate) std: &'a Table,
    pub(crate) trajectories: &'a Table,
    pub(crate) drift: &'a Drift,
    /// When the jams were looked at last.
    pub(crate) followed: f64,
    /// When the leg near the walls began, if it has.
    pub(crate) near_walls: Option<f64>,
    pub(crate) earlier: Counts,
    /// The judge of its outcome, if there is one.
    pub(crate) judge: Option<&'a Judge>,
}

impl PartialRun<'_> {
    /// The part of its time that is done, 0 to 1.
    pub fn fraction(&self) -> f64 {
        fraction(self.scene, self.mark.place.step, self.mark.statistics.time)
    }

    /// Everything that [`Checkpoint::parse`] needs.
    pub fn to_bytes(&self) -> Vec<u8> {
        let ResumePoint { place, statistics, state, pace } = *self.mark;
        let mut words = Words::default();
        words.whole(&[place.step, place.slow_until, statistics.steps, statistics.rejected, statistics.evaluations]);
        words.numbers(&[statistics.time]);
        words.count(state.len());
        words.numbers(state);
        words.count(usize::from(pace.is_some()));
        if let Some(pace) = pace {
            words.numbers(pace.rates);
            words.numbers(pace.carry);
            words.numbers(&[pace.time[0], pace.time[1], pace.step, pace.error, pace.unit]);
        }
        words.whole(&[self.earlier.steps, self.earlier.rejected, self.earlier.evaluations]);
        words.numbers(&[self.followed]);
        words.count(usize::from(self.near_walls.is_some()));
        words.numbers(&[self.near_walls.unwrap_or(0.0)]);
        words.count(self.found.len());
        for happening in self.found {
            words.count(EventKind::ALL.iter().take_while(|event| **event != happening.kind).count());
            words.numbers(&[happening.time, happening.gap, happening.step]);
            words.count(happening.pedestrian);
        }
        words.count(self.std.len());
        self.std.rows().for_each(|row| words.numbers(row));
        words.count(self.trajectories.len());
        self.trajectories.rows().for_each(|row| words.numbers(&row[2..]));
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
    pub(crate) place: Place,
    pub(crate) statistics: Statistics,
    pub(crate) state: Vec<f64>,
    pub(crate) pace: Option<Remembered>,
    pub(crate) earlier: Counts,
    pub(crate) followed: f64,
    pub(crate) near_walls: Option<f64>,
    pub(crate) found: Vec<Event>,
    pub(crate) std: Table,
    pub(crate) trajectories: Table,
    pub(crate) drift: Drift,
    pub(crate) memory: Option<Memory>,
}

/// What adaptive steps remember (see [`Pace`]).
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Remembered {
    rates: Vec<f64>,
    carry: Vec<f64>,
    time: [f64; 2],
    step: f64,
    error: f64,
    unit: f64,
}

impl Remembered {
    pub(crate) fn pace(&self) -> Pace<'_> {
        let Remembered { rates, carry, time, step, error, unit } = self;
        Pace { rates, carry, time: *time, step: *step, error: *error, unit: *unit }
    }
}

impl Checkpoint {
    /// Reads what [`PartialRun::to_bytes`] wrote for this scene; `None` for anything of another form.
    pub fn parse(bytes: &[u8], scene: &Scene) -> Option<Checkpoint> {
        let mut words = Reader { words: bytes.chunks_exact(8) };
        let place = Place { step: words.whole()?, slow_until: words.whole()? };
        let (steps, rejected, evaluations) = (words.whole()?, words.whole()?, words.whole()?);
        let statistics = Statistics { steps, rejected, evaluations, time: words.number()?, state: Vec::new() };
        let count = words.count()?;
        let state = (0..count).map(|_| words.number()).collect::<Option<Vec<f64>>>()?;
        let pace = if words.count()? == 1 { Some(words.pace(state.len())?) } else { None };
        let earlier = Counts { steps: words.whole()?, rejected: words.whole()?, evaluations: words.whole()? };
        let (followed, is_near_walls, begin) = (words.number()?, words.count()? == 1, words.number()?);
        let near_walls = is_near_walls.then_some(begin);
        let count = words.count()?;
        let found = (0..count).map(|_| words.happening()).collect::<Option<Vec<Event>>>()?;
        let std = words.std()?;
        let trajectories = words.trajectories(scene, &std)?;
        let (distance, time, count) = (words.number()?, words.number()?, words.count()?);
        let before = (0..count).map(|_| words.jam()).collect::<Option<Vec<Jam>>>()?;
        let count = words.count()?;
        let memory = match (0..count).map(|_| words.number()).collect::<Option<Vec<f64>>>()? {
            numbers if numbers.is_empty() => None,
            numbers => Some(Memory::parse(&numbers)?),
        };
        let is_whole = words.words.next().is_none() && words.words.remainder().is_empty();
        let kind = if is_near_walls { StateVariables::Spacings } else { scene.form };
        let fits = state.len() == kind.build(&scene.model, scene.ring).dimension()
            && pace.is_some() == matches!(scene.control, Control::Adaptive { .. });
        let drift = Drift { before, distance, time };
        (is_whole && fits).then_some(Checkpoint {
            place,
            statistics,
            state,
            pace,
            earlier,
            followed,
            near_walls,
            found,
            std,
            trajectories,
            drift,
            memory,
        })
    }

    /// Steps that need not be made again.
    pub fn steps(&self) -> u64 {
        self.earlier.steps + self.place.step
    }

    /// The part of the run's time that need not be gone through again, 0 to 1.
    pub fn fraction(&self, scene: &Scene) -> f64 {
        fraction(scene, self.place.step, self.statistics.time)
    }
}

fn fraction(scene: &Scene, step: u64, time: f64) -> f64 {
    match scene.control {
        Control::Fixed { step: h } => step as f64 * h / scene.t_end,
        Control::Adaptive { .. } => time / scene.t_end,
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
        let carry = (0..dimension).map(|_| self.number()).collect::<Option<Vec<f64>>>()?;
        let time = [self.number()?, self.number()?];
        Some(Remembered { rates, carry, time, step: self.number()?, error: self.number()?, unit: self.number()? })
    }

    fn happening(&mut self) -> Option<Event> {
        let event = *EventKind::ALL.get(self.count()?)?;
        let (time, gap, step) = (self.number()?, self.number()?, self.number()?);
        Some(Event { kind: event, time, pedestrian: self.count()?, gap, step })
    }

    fn jam(&mut self) -> Option<Jam> {
        let (first, pedestrians) = (self.count()?, self.count()?);
        Some(Jam { first, pedestrians, extent: self.number()?, centre: self.number()? })
    }

    fn std(&mut self) -> Option<Table> {
        let mut table = crate::simulation::std_table();
        for _ in 0..self.count()? {
            table.push(&[self.number()?, self.number()?]);
        }
        Some(table)
    }

    /// As many rows for each sample as there are pedestrians, or none at all.
    fn trajectories(&mut self, scene: &Scene, std: &Table) -> Option<Table> {
        let pedestrians = if scene.keeps_trajectories { scene.ring.pedestrians } else { 0 };
        let mut table = crate::simulation::trajectories_table();
        if self.count()? != std.len() * pedestrians {
            return None;
        }
        for row in std.rows() {
            for n in 0..pedestrians {
                table.push(&[row[0], n as f64, self.number()?, self.number()?]);
            }
        }
        Some(table)
    }
}
