//! The six scenes, with the parameters of the figures' scene files.

use crate::laws::Law;
use crate::ring::Ring;
use math::double_double::DoubleDouble;

/// What a parameter such as 0.45 means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parameters {
    /// The double next to the decimal number: what a program in double precision reads, and what it is judged by.
    Doubles,
    /// The decimal number itself.
    Decimals,
}

impl Parameters {
    fn ratio(self, numerator: f64, denominator: f64) -> DoubleDouble {
        match self {
            Parameters::Doubles => DoubleDouble::from(numerator / denominator),
            Parameters::Decimals => DoubleDouble::from(numerator) / denominator,
        }
    }
}

/// A scene: a ring, its start, and when its solution is written down.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// As files are named.
    pub name: &'static str,
    /// Pedestrians and law.
    pub ring: Ring,
    /// The length of the ring is 200; gaps are equal but for pedestrian 0, which is this far ahead.
    pub shift: DoubleDouble,
    /// The times of the published states, whole and ascending. The standard deviation is published at every whole time
    /// up to the last of them.
    pub times: &'static [u32],
    /// Whether the run continues after the last of these times, to its events.
    pub has_events: bool,
}

/// The length of every ring.
pub const LENGTH: f64 = 200.0;

/// The names of the scenes.
pub const NAMES: [&str; 6] = [
    "algebraic_stable",
    "algebraic_unstable",
    "exponential_stable",
    "exponential_unstable",
    "logarithmic",
    "logarithmic_small_shift",
];

const STABLE: &[u32] = &[1, 10, 50, 100, 200, 300, 500, 1000, 1500, 2000];
const ALGEBRAIC: &[u32] = &[1, 10, 50, 100, 200, 400, 600, 800, 900, 940, 950, 955, 960];
const EXPONENTIAL: &[u32] = &[1, 10, 50, 100, 200, 300, 400, 440, 450, 455];
const LOGARITHMIC: &[u32] = &[1, 10, 50, 100, 200, 300, 500, 1000, 1500, 2000, 2500, 3000];

/// The scene of this name.
pub fn scene(name: &str, parameters: Parameters) -> Option<Scene> {
    let number = |numerator, denominator| parameters.ratio(numerator, denominator);
    let desired_speed = DoubleDouble::from(3.0);
    let algebraic = |hundredths| Ring {
        law: Law::Algebraic { strength: number(hundredths, 100.0), desired_speed },
        pedestrians: 67,
    };
    let exponential = |strength| Ring {
        law: Law::Exponential { strength: DoubleDouble::from(strength), range: DoubleDouble::from(1.5), desired_speed },
        pedestrians: 57,
    };
    let logarithmic = Ring {
        law: Law::Logarithmic { desired_speed: DoubleDouble::ONE, epsilon: number(1.0, 100.0) },
        pedestrians: 133,
    };
    let name = *NAMES.iter().find(|known| **known == name)?;
    let (ring, shift, times) = match name {
        "algebraic_stable" => (algebraic(45.0), 1e4, STABLE),
        "algebraic_unstable" => (algebraic(55.0), 1e4, ALGEBRAIC),
        "exponential_stable" => (exponential(1.5), 1e4, STABLE),
        "exponential_unstable" => (exponential(3.0), 1e4, EXPONENTIAL),
        "logarithmic" => (logarithmic, 10.0, LOGARITHMIC),
        "logarithmic_small_shift" => (logarithmic, 1e4, LOGARITHMIC),
        _ => return None,
    };
    Some(Scene { name, ring, shift: number(1.0, shift), times, has_events: name.ends_with("_unstable") })
}
