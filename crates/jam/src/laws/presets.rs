//! The models of tab:model as members of the algebraic class.

use super::Algebraic;

/// A model of the literature, `<mu, delta, q, a_v>`; `None` is left to the user.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Preset {
    /// The name in the paper and in scene files.
    pub name: &'static str,
    /// `mu`.
    pub mu: Option<f64>,
    /// `delta`.
    pub delta: f64,
    /// `q`.
    pub q: f64,
    /// `a_v`.
    pub a_v: Option<f64>,
}

/// CFM, GCFM, HFV, SEY and GUO. In CFM `mu = 0`: its force comes from the smooth ramp alone (`gamma = eps ln 2`).
pub const PRESETS: [Preset; 5] = [
    Preset { name: "CFM", mu: Some(0.0), delta: 1.0, q: 1.0, a_v: Some(0.0) },
    Preset { name: "GCFM", mu: None, delta: 1.0, q: 1.0, a_v: None },
    Preset { name: "HFV", mu: None, delta: 0.0, q: 2.0, a_v: Some(0.0) },
    Preset { name: "SEY", mu: None, delta: 0.0, q: 2.0, a_v: None },
    Preset { name: "GUO", mu: None, delta: 0.0, q: 1.0, a_v: Some(0.0) },
];

impl Preset {
    /// The law with this preset's terms; `mu` and `a_v` count where the preset leaves them open.
    pub fn law(&self, mu: f64, a_v: f64, epsilon: f64, v0: f64) -> Algebraic {
        let Preset { delta, q, .. } = *self;
        Algebraic { mu: self.mu.unwrap_or(mu), delta, q, a_v: self.a_v.unwrap_or(a_v), epsilon, v0 }
    }
}
