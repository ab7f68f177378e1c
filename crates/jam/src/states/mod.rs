//! The ring as a system of equations, in three forms of the same state.
//!
//! | form | state | for |
//! |---|---|---|
//! | [`Deviations`] | gaps and speeds minus those of the uniform flow | the default: errors are relative to the perturbation |
//! | [`Gaps`] | gaps and speeds | the textbook form |
//! | [`Positions`] | unwrapped positions and speeds | the scheme of the paper, word for word |

mod deviations;
mod gaps;
mod heun;
mod positions;

pub use deviations::Deviations;
pub use gaps::Gaps;
pub use heun::{Cut, heun_steps};
pub use positions::Positions;

use crate::laws::{Law, Model, Visitor};
use crate::ring::{Ring, Start};

/// A ring in one of the forms. Pedestrian `n` follows `n + 1`, the last follows the first.
pub trait Form: ode::System {
    /// The state at the start.
    fn start(&self, start: Start) -> Vec<f64>;

    /// Writes the `N` gaps and the `N` speeds.
    fn read(&self, state: &[f64], gaps: &mut [f64], speeds: &mut [f64]);

    /// Writes the rates of the gaps and of the speeds.
    fn read_rates(&self, rates: &[f64], gaps: &mut [f64], speeds: &mut [f64]);

    /// Writes the `N` positions, unwrapped: they start in [0, L) and grow as the pedestrians walk.
    fn write_positions(&self, state: &[f64], positions: &mut [f64]);

    /// The standard deviation of the speeds over the pedestrians (divided by `N`).
    fn speed_deviation(&self, state: &[f64]) -> f64;
}

/// Perturbations and clearances keep their relative precision down to this size; below it the tolerance of their errors
/// would come near the least doubles, which have no digits.
const LEAST_SIZE: f64 = 1e-305;

/// Which form.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FormKind {
    /// See [`Deviations`].
    Deviations,
    /// See [`Gaps`].
    Gaps,
    /// See [`Positions`].
    Positions,
}

impl FormKind {
    /// The ring in this form, with the law reduced to the terms it names.
    pub fn build(self, model: &Model, ring: Ring) -> Box<dyn Form> {
        model.visit(Build { kind: self, ring })
    }
}

/// The state of the form [`Gaps`] with these gaps, speeds and position of pedestrian 0.
pub fn gaps_state(model: &Model, gaps: &[f64], speeds: &[f64], first: f64) -> Vec<f64> {
    let contact = model.contact();
    gaps.iter().map(|gap| gap - contact).chain(speeds.iter().copied()).chain([first]).collect()
}

struct Build {
    kind: FormKind,
    ring: Ring,
}

impl Visitor for Build {
    type Output = Box<dyn Form>;
    fn visit<L: Law + 'static>(self, law: L) -> Box<dyn Form> {
        match self.kind {
            FormKind::Deviations => Box::new(Deviations::new(law, self.ring)),
            FormKind::Gaps => Box::new(Gaps::new(law, self.ring)),
            FormKind::Positions => Box::new(Positions::new(law, self.ring)),
        }
    }
}

/// Writes `rate[n] = speed[n + 1] - speed[n]` around the ring.
fn closing_rates(speeds: &[f64], rates: &mut [f64]) {
    let last = speeds.len() - 1;
    for (rate, pair) in rates.iter_mut().zip(speeds.windows(2)) {
        *rate = pair[1] - pair[0];
    }
    rates[last] = speeds[0] - speeds[last];
}
