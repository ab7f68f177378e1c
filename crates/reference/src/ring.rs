//! The ring of pedestrians as a system of ordinary differential equations.

use crate::laws::{Law, algebraic, exponential, logarithmic};
use math::double_double::DoubleDouble;
use math::simd::{Kernel, dispatch};

/// `N` pedestrians under a law. State: `[c_0 .. c_{N-1}, v_0 .. v_{N-1}, x_0]` with clearances `c_n`, the gaps less
/// [`Law::contact`], so that a clearance near a wall keeps its digits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ring {
    /// The law of motion.
    pub law: Law,
    /// `N >= 2`.
    pub pedestrians: usize,
}

impl Ring {
    /// How many numbers a state has: `2 N + 1`.
    pub fn dimension(&self) -> usize {
        2 * self.pedestrians + 1
    }

    /// Equal gaps of a ring of length `length`, all speeds 0, pedestrian 0 moved forward by `shift`.
    pub fn start(&self, length: f64, shift: DoubleDouble) -> Vec<DoubleDouble> {
        let n = self.pedestrians;
        let mut state = vec![DoubleDouble::ZERO; self.dimension()];
        state[..n].fill(DoubleDouble::from(length) / n as f64 - self.law.contact());
        state[0] = state[0] - shift;
        state[n - 1] = state[n - 1] + shift;
        state[2 * n] = shift;
        state
    }

    /// The time derivatives of a state.
    pub fn rates(&self, state: &[DoubleDouble], rates: &mut [DoubleDouble]) {
        let n = self.pedestrians;
        let (clearances, speeds) = (&state[..n], &state[n..2 * n]);
        let (of_clearances, of_speeds) = rates.split_at_mut(n);
        for (rate, pair) in of_clearances.iter_mut().zip(speeds.windows(2)) {
            *rate = pair[1] - pair[0];
        }
        of_clearances[n - 1] = speeds[0] - speeds[n - 1];
        of_speeds[n] = speeds[0];
        dispatch(Accelerations { law: self.law, clearances, speeds, rates: &mut of_speeds[..n] });
    }
}

/// The accelerations of all pedestrians.
struct Accelerations<'a> {
    law: Law,
    clearances: &'a [DoubleDouble],
    speeds: &'a [DoubleDouble],
    rates: &'a mut [DoubleDouble],
}

impl Kernel for Accelerations<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        // plain loops: an iterator's closure would be compiled apart, for the narrow registers
        let each = self.rates.iter_mut().zip(self.clearances).zip(self.speeds);
        match self.law {
            Law::Algebraic { strength: mu, desired_speed: v0 } => {
                for ((rate, d), v) in each {
                    *rate = algebraic(mu, v0, *d, *v);
                }
            }
            Law::Exponential { strength: a, range: b, desired_speed: v0 } => {
                for ((rate, d), v) in each {
                    *rate = exponential(a, b, v0, *d, *v);
                }
            }
            Law::Logarithmic { desired_speed: v0, epsilon } => {
                for ((rate, s), v) in each {
                    *rate = logarithmic(v0, epsilon, *s, *v);
                }
            }
        }
    }
}
