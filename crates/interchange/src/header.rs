//! The header of both output files: the run, the ring, and the units.

use checkout::failure::Failure;
use files::reader::{POSITIVE, Reader, SceneError};
use files::scene_file::{Kind, Panel, SceneFile};
use std::ops::RangeInclusive;

/// The desired speed that the paper calls typical, in tenths of a metre a second; where `a_0` is not given it follows
/// from this one. A whole number, so that a length such as 0.2 m is not missed by a rounding.
pub const TYPICAL_SPEED: u32 = 12;

/// Frames a second that can be asked for.
pub const RATES: RangeInclusive<f64> = 1.0..=1000.0;
/// `a_0` in metres: the positions of all that lies between can be written with all their digits.
pub const LENGTHS: RangeInclusive<f64> = 1e-15..=1e9;

/// The lengths and times of the model in metres and seconds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Units {
    /// `a_0`, in metres.
    pub length: f64,
    /// `tau`, in seconds.
    pub time: f64,
    /// Whether `a_0` follows from [`TYPICAL_SPEED`].
    pub is_derived: bool,
}

/// The scene of a trajectory, and how it is written.
#[derive(Clone, Debug, PartialEq)]
pub struct Header {
    /// What it shows, in words, on one line.
    pub title: String,
    /// The label of the paper, on one line; empty for a user's scene.
    pub source: String,
    /// The SHA-256 of everything in the scene that determines numbers.
    pub scene: String,
    /// The number of pedestrians.
    pub pedestrians: u32,
    /// The length of the ring in units of `a_0`.
    pub ring: f64,
    /// The desired speed in units of `a_0 / tau`; `None` of a formula that has neither `v0` nor `scale`.
    pub desired_speed: Option<f64>,
    /// Metres and seconds.
    pub units: Units,
    /// Frames a second.
    pub rate: f64,
}

impl Header {
    /// Reads what is needed from a scene. `length` is `a_0` in metres, by default such that the desired speed is
    /// [`TYPICAL_SPEED`]; `time` is `tau` in seconds.
    ///
    /// # Errors
    /// `a_0` is out of range, the panel is no run, or its ring or desired speed is missing or out of range, with file
    /// and line.
    pub fn new(
        scene_file: &SceneFile,
        panel: &Panel,
        length: Option<f64>,
        time: f64,
        rate: f64,
    ) -> Result<Header, Failure> {
        if panel.kind != Kind::Run {
            return Err(Failure::Usage(format!("{}: has no [run], so no trajectories", scene_file.file)));
        }
        let mut tables = Reader::new(&scene_file.file, "scene", &panel.tables);
        let mut ring = Reader::new(&scene_file.file, "ring", tables.section("ring")?);
        let mut law = Reader::new(&scene_file.file, "law", tables.section("law")?);
        let desired_speed = desired_speed(&mut law)?;
        let is_derived = length.is_none();
        let length = match (length, desired_speed) {
            (Some(length), _) => length,
            (None, Some(speed)) => f64::from(TYPICAL_SPEED) * time / (10.0 * speed),
            (None, None) => return Err(law.complaint("v0", NO_SPEED).into()),
        };
        if !LENGTHS.contains(&length) {
            let (low, high) = (LENGTHS.start(), LENGTHS.end());
            return Err(Failure::Usage(format!(
                "a_0 = {length:?} m: must be from {low:e} to {high:e} m; --a0 sets it"
            )));
        }
        Ok(Header {
            title: line(&scene_file.title),
            source: line(&scene_file.source),
            scene: files::write::sha256(panel.determinants().as_bytes()),
            pedestrians: ring.count("pedestrians", 2, 10_000_000)? as u32,
            ring: ring.number("length", POSITIVE)?,
            desired_speed,
            units: Units { length, time, is_derived },
            rate,
        })
    }

    /// The time between two frames, in units of `tau`.
    pub fn interval(&self) -> f64 {
        1.0 / (self.rate * self.units.time)
    }

    /// A position in metres.
    pub fn metres(&self, x: f64) -> f64 {
        self.units.length * x
    }

    /// The length of the ring in metres.
    pub fn circumference(&self) -> f64 {
        self.metres(self.ring)
    }

    /// Name and value of all that a reader has to know to go back to the model's numbers, in a fixed order.
    pub fn facts(&self) -> Vec<(&'static str, String)> {
        let Units { length, time, is_derived } = self.units;
        let origin = match is_derived {
            true => format!("desired speed of {:?} m/s", f64::from(TYPICAL_SPEED) / 10.0),
            false => "given".to_owned(),
        };
        let speed = self.desired_speed.map(|speed| ("desired_speed", format!("{:.6} m/s", speed * length / time)));
        let facts = [
            ("title", self.title.clone()),
            ("source", self.source.clone()),
            ("scene_sha256", self.scene.clone()),
            ("pedestrians", self.pedestrians.to_string()),
            ("a_0", format!("{length:?} m")),
            ("a_0_from", origin),
            ("tau", format!("{time:?} s")),
            ("ring_length", format!("{:?} m", self.circumference())),
        ];
        let place = ("x", "unwrapped; modulo ring_length it is the place on the ring".to_owned());
        facts.into_iter().chain(speed).chain([place]).collect()
    }
}

/// What a formula without a speed of its own needs.
const NO_SPEED: &str = "the formulas have neither a number v0 nor a number scale, so that a_0 cannot follow from the desired \
                        speed; must have one of them above 0, or give --a0 METRES";

/// The parameter `v0`; of a formula else `scale`, if it has one of them.
fn desired_speed(law: &mut Reader<'_>) -> Result<Option<f64>, SceneError> {
    let is_formula = law.has("kind") && law.text("kind", "the name of a law")? == "formula";
    if !is_formula {
        return law.number("v0", POSITIVE).map(Some);
    }
    for name in ["v0", "scale"] {
        if law.is_number(name) {
            return law.number(name, POSITIVE).map(Some);
        }
    }
    Ok(None)
}

/// A text on one line.
fn line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
