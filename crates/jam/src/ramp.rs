//! The smooth ramp of eq:aTheta.

use math::lane;
use math::simd::{Kernel, dispatch};

/// `r(x)`: `-x` for negative `x`, else 0; the limit of [`smooth_ramp`] for a width of 0.
pub fn ramp(x: f64) -> f64 {
    if x < 0.0 { -x } else { 0.0 }
}

/// `r_eps(x) = eps ln(1 + exp(-x / eps))`, for `eps > 0`; it overflows nowhere (eq:aTheta).
#[inline(always)]
pub fn smooth_ramp(x: f64, epsilon: f64) -> f64 {
    epsilon * lane::softplus(-x / epsilon)
}

/// Where a law's smooth ramp bends: its argument, in units of its width, as a linear function of a pedestrian's
/// clearance, own speed and speed ahead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bend {
    /// Weight of the clearance, the net gap, per `a_0`.
    pub clearance: f64,
    /// Weight of the own speed, per `a_0 / tau`.
    pub speed: f64,
    /// Weight of the speed ahead, per `a_0 / tau`.
    pub ahead: f64,
    /// The constant added; the bend is where the sum is 0.
    pub offset: f64,
}

impl Bend {
    /// Writes the part of the arguments that is proportional to clearances and speeds, and `offset` added to it.
    pub(crate) fn arguments(&self, offset: f64, clearances: &[f64], speeds: &[f64], arguments: &mut [f64]) {
        dispatch(Arguments { bend: *self, offset, clearances, speeds, arguments });
    }
}

struct Arguments<'a> {
    bend: Bend,
    offset: f64,
    clearances: &'a [f64],
    speeds: &'a [f64],
    arguments: &'a mut [f64],
}

impl Kernel for Arguments<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Bend { clearance: s, speed: own, ahead, .. } = self.bend;
        let last = self.speeds.len() - 1;
        let pairs = self.clearances.iter().zip(self.speeds.windows(2));
        for (argument, (clearance, pair)) in self.arguments.iter_mut().zip(pairs) {
            *argument = self.offset + (s * clearance + (own * pair[0] + ahead * pair[1]));
        }
        self.arguments[last] =
            self.offset + (s * self.clearances[last] + (own * self.speeds[last] + ahead * self.speeds[0]));
    }
}
