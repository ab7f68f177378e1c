//! The models of tab:model as members of the algebraic class.

use super::Algebraic;

/// A model of the literature, `<mu, delta, q, a_v>`; `None` is left to the user.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Preset {
    /// The name in the paper and in scene files.
    pub name: &'static str,
    /// `mu`.
    pub strength: Option<f64>,
    /// `delta`.
    pub relative: f64,
    /// `q`.
    pub power: f64,
    /// `a_v`.
    pub widening: Option<f64>,
}

/// CFM, GCFM, HFV, SEY and GUO. In CFM `mu = 0`: its force comes from the smooth ramp alone (`gamma = eps ln 2`).
pub const PRESETS: [Preset; 5] = [
    Preset { name: "CFM", strength: Some(0.0), relative: 1.0, power: 1.0, widening: Some(0.0) },
    Preset { name: "GCFM", strength: None, relative: 1.0, power: 1.0, widening: None },
    Preset { name: "HFV", strength: None, relative: 0.0, power: 2.0, widening: Some(0.0) },
    Preset { name: "SEY", strength: None, relative: 0.0, power: 2.0, widening: None },
    Preset { name: "GUO", strength: None, relative: 0.0, power: 1.0, widening: Some(0.0) },
];

impl Preset {
    /// The law with this preset's terms; `strength` and `widening` count where the preset leaves them open.
    pub fn law(&self, strength: f64, widening: f64, epsilon: f64, desired_speed: f64) -> Algebraic {
        Algebraic {
            strength: self.strength.unwrap_or(strength),
            relative: self.relative,
            power: self.power,
            widening: self.widening.unwrap_or(widening),
            epsilon,
            desired_speed,
        }
    }
}
