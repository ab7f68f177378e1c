//! The outcome of a run: return to the uniform flow, lasting waves, contact or blow-up; or undecided, with the reason.
//!
//! The paper leaves the question to simulations ("it has to be verified by simulations whether this instability
//! corresponds to realistic behavior"). [`Judge`] answers it for one run, step by step; the classes are [`Class`], in
//! order of precedence.

mod judge;
mod least;
mod memory;
mod repeats;
mod windows;

pub use judge::Judge;
pub use memory::Memory;

/// The outcome of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Class {
    /// Two touch at the start.
    Closed,
    /// There is no uniform flow to perturb.
    NoUniformFlow,
    /// The formula of the law has no value for a pedestrian.
    Undefined,
    /// Speeds grow without bound while every gap is open.
    BlowUp,
    /// An effective gap (of the logarithmic law: a spacing) reaches 0.
    Contact,
    /// Permanent return to the uniform flow.
    Decays,
    /// Lasting waves with backward motion.
    WavesBackwards,
    /// Lasting waves without contact or backward motion.
    Waves,
    /// None of these is certain by the end of the run.
    Undecided,
}

impl Class {
    /// All classes.
    pub const ALL: [Class; 9] = [
        Class::Closed,
        Class::NoUniformFlow,
        Class::Undefined,
        Class::BlowUp,
        Class::Contact,
        Class::Decays,
        Class::WavesBackwards,
        Class::Waves,
        Class::Undecided,
    ];

    /// The name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Class::Closed => "closed",
            Class::NoUniformFlow => "no_uniform_flow",
            Class::Undefined => "undefined",
            Class::BlowUp => "blow_up",
            Class::Contact => "contact",
            Class::Decays => "decays",
            Class::WavesBackwards => "waves_backwards",
            Class::Waves => "waves",
            Class::Undecided => "undecided",
        }
    }

    /// In words, for legends.
    pub fn in_words(self) -> &'static str {
        match self {
            Class::Closed => "closed at the start",
            Class::NoUniformFlow => "no uniform flow",
            Class::Undefined => "undefined",
            Class::BlowUp => "blow-up",
            Class::Contact => "contact",
            Class::Decays => "decays",
            Class::WavesBackwards => "waves, backwards",
            Class::Waves => "waves",
            Class::Undecided => "undecided",
        }
    }

    /// The class of this name in tables.
    pub fn of_name(name: &str) -> Option<Class> {
        Class::ALL.into_iter().find(|class| class.name() == name)
    }
}

/// What decided.
#[derive(Clone, Debug, PartialEq)]
pub enum Decision {
    /// The start itself.
    Start,
    /// An event.
    EventKind,
    /// The state is near the uniform flow, and every wave of the ring decays by the linearised law.
    Return,
    /// The perturbation is weak and falls, and every wave of the ring decays by the linearised law.
    Falling,
    /// The state repeats itself, shifted along the ring.
    Repetition,
    /// The last two windows of the run agree.
    Windows,
    /// Nothing: this is missing.
    Missing(String),
}

impl Decision {
    /// The name in `summary.json`.
    pub fn name(&self) -> &'static str {
        match self {
            Decision::Start => "start",
            Decision::EventKind => "event",
            Decision::Return => "return to the uniform flow",
            Decision::Falling => "a falling perturbation of a stable flow",
            Decision::Repetition => "the state repeats itself",
            Decision::Windows => "the last two windows agree",
            Decision::Missing(_) => "nothing",
        }
    }
}

/// The outcome of a run, with the numbers that it rests on.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    /// The outcome.
    pub class: Class,
    /// When that was certain, in units of `tau`.
    pub time: f64,
    /// What decided.
    pub decision: Decision,
    /// Whether the uniform flow itself walks backwards.
    pub backward_flow: bool,
    /// The least effective gap of the run, of the logarithmic law the least spacing, in units of `a_0`.
    pub least_gap: f64,
    /// The least speed of the run, in units of `a_0 / tau`, the start from rest ([`START`]) left out; of a shorter run,
    /// of all of it.
    pub least_speed: f64,
    /// The standard deviation of the speeds, in units of `a_0 / tau`: of waves the mean over the last window, else that
    /// at the end.
    pub std: f64,
    /// The least speed in the windows by which waves were judged; only for waves. The least speed of the whole run may
    /// occur while they grow.
    pub lasting_least_speed: Option<f64>,
    /// The speed at which waves travel along the ring, on the ground, in units of `a_0 / tau`, against the direction of
    /// walking if negative; only of waves.
    pub wave_speed: Option<f64>,
    /// How far the deciding numbers are from another verdict, in the unit of each: of waves the least of the contrast
    /// above its threshold, the least gap (both relative) and the distance of the least speed from 0; of a decay the
    /// margin of stability; of a contact the speed at which the gap closes. 0 if undecided.
    pub distance: f64,
}

impl Verdict {
    /// Of a run that was not judged.
    pub fn none() -> Verdict {
        Verdict {
            class: Class::Undecided,
            time: 0.0,
            decision: Decision::Missing("a run".to_owned()),
            backward_flow: false,
            least_gap: f64::NAN,
            least_speed: f64::NAN,
            std: f64::NAN,
            lasting_least_speed: None,
            wave_speed: None,
            distance: 0.0,
        }
    }
}

/// How long the start from rest lasts, in units of `tau`: `e^-20` of it is left, 2e-9, after 20 relaxation times.
pub const START: f64 = 20.0;

/// A state is back at the uniform flow where deviations are below this part of headway, effective gap and desired
/// speed. The linearised law is then exact to about as much, and so are its growth rates.
pub const NEAR_FLOW: f64 = 1e-3;

/// Closer to the line of stability than this, the linearised law does not distinguish decay from waves of small
/// amplitude, since terms of second order, relative [`NEAR_FLOW`], have the same size.
pub const NEAR_LINE: f64 = 1e-4;

/// Speeds that differ by less than this part of the desired speed are no waves.
pub const CONTRAST: f64 = 1e-3;

/// Windows agree where the mean standard deviation and the least gap differ by less than this part of themselves.
pub const AGREEMENT: f64 = 1e-2;
