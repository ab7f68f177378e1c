//! The largest Lyapunov exponent of a run by Benettin's method: two neighbouring trajectories diverge and are
//! repeatedly brought close again.

use super::Scheme;
use crate::draw::Draw;
use crate::hard::run::{Case, Leg};
use figures::failure::Failure;

/// How far apart the two are set, the root of the sum of squares of gaps and speeds. They stay so close that products
/// of deviations do not matter, and so far that rounding does not.
const APART: f64 = 1e-6;
/// How long they run between, in units of `tau`.
const INTERVAL: f64 = 10.0;
/// So many intervals at first turn the deviation into the direction that grows fastest.
const TURNING: usize = 40;
/// Then as many batches of as many intervals give an exponent each.
const BATCHES: usize = 10;
const BATCH: usize = 20;

/// The exponents of successive batches of a run from a state, in units of `1 / tau`.
///
/// # Errors
/// The run ended before its time.
pub(super) fn exponents(case: &Case, start: &[f64], scheme: Scheme) -> Result<Vec<f64>, Failure> {
    let mut pair = Pair::beside(case, start, scheme);
    for _ in 0..TURNING {
        pair.grow()?;
    }
    (0..BATCHES)
        .map(|_| (0..BATCH).map(|_| pair.grow()).sum::<Result<f64, Failure>>().map(|rate| rate / BATCH as f64))
        .collect()
}

/// Two runs side by side, in spacings.
struct Pair<'a> {
    case: &'a Case,
    scheme: Scheme,
    one: Vec<f64>,
    other: Vec<f64>,
}

impl<'a> Pair<'a> {
    /// A state with another beside it, whose speeds deviate at random: the ring stays as long.
    fn beside(case: &'a Case, start: &[f64], scheme: Scheme) -> Pair<'a> {
        let count = case.ring.pedestrians;
        let mut draw = Draw::default();
        let mut other = start.to_vec();
        other[count..2 * count].iter_mut().for_each(|speed| *speed += draw.between(-1.0, 1.0));
        let mut pair = Pair { case, scheme, one: start.to_vec(), other };
        pair.bring_close();
        pair
    }

    fn distance(&self) -> f64 {
        // positions are of no importance: the last component is left out
        let seen = 2 * self.case.ring.pedestrians;
        let squares =
            self.one[..seen].iter().zip(&self.other[..seen]).map(|(one, other)| (one - other) * (one - other));
        squares.sum::<f64>().sqrt()
    }

    fn bring_close(&mut self) {
        // rounding lengthens the ring of the other, which no run takes back: beside what decays that would grow
        let count = self.case.ring.pedestrians;
        let longer = (0..count).map(|n| self.other[n] - self.one[n]).sum::<f64>() / count as f64;
        self.other[..count].iter_mut().for_each(|gap| *gap -= longer);
        let factor = APART / self.distance();
        let pairs = self.one.iter().zip(&mut self.other);
        pairs.for_each(|(one, other)| *other = one + factor * (*other - one));
    }

    /// Runs both for an interval; returns the rate at which they parted.
    fn grow(&mut self) -> Result<f64, Failure> {
        let (method, control) = self.scheme;
        let leg = Leg { method, control, begin: 0.0, end: INTERVAL };
        // as set, not as meant: rounding is part of the distance
        let before = self.distance();
        self.one = self.case.run_from(&self.one, leg).whole()?.state;
        self.other = self.case.run_from(&self.other, leg).whole()?.state;
        let rate = math::ln(self.distance() / before) / INTERVAL;
        self.bring_close();
        Ok(rate)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::irregular::mean;
    use jam::laws::{Algebraic, Model};
    use jam::ring::Ring;
    use jam::states::StateVariables;
    use jam::uniform::steady_speed;
    use ode::{Control, Method};

    #[test]
    fn in_a_stable_flow_the_exponent_is_the_growth_rate_of_the_slowest_wave() {
        let law = Algebraic { mu: 0.2, delta: 0.0, q: 2.0, a_v: 0.0, epsilon: 0.1, v0: 3.0 };
        let (model, ring) = (Model::Algebraic(law), Ring { pedestrians: 8, length: 24.0 });
        let speed = steady_speed(&model, 3.0).expect("a steady speed");
        let (_, rate) = model.response(3.0, speed).expect("a linearised law").of_ring(8);
        // the state has the room between bodies
        let room = 3.0 - model.contact();
        let case = Case { model, ring, kind: StateVariables::Spacings };
        let start: Vec<f64> = [room; 8].into_iter().chain([speed; 8]).chain([0.0]).collect();
        let scheme = (Method::Dop853, Control::Adaptive { tolerance: 1e-12 });
        let (exponent, error) = mean(&exponents(&case, &start, scheme).expect("exponents"));
        assert!(rate < -1e-3 && (exponent / rate - 1.0).abs() < 1e-3, "{exponent} {error} {rate}");
    }
}
