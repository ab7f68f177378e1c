//! Results as text: states, standard deviations, and the agreement of two runs.

use crate::ring::Ring;
use math::double_double::{DoubleDouble, decimal};
use math::larger;
use std::fmt::Write as _;

/// Significant digits of a published number.
pub const DIGITS: usize = 20;

/// The population standard deviation of the speeds of a state.
pub fn spread(ring: &Ring, state: &[DoubleDouble]) -> DoubleDouble {
    let speeds = &state[ring.pedestrians..2 * ring.pedestrians];
    let count = speeds.len() as f64;
    let mean = speeds.iter().fold(DoubleDouble::ZERO, |sum, v| sum + *v) / count;
    let squares = speeds.iter().fold(DoubleDouble::ZERO, |sum, v| sum + (*v - mean) * (*v - mean));
    (squares / count).sqrt()
}

/// The digits of `value` that a second computation confirms, at most [`DIGITS`] and at least one: the last one is worth
/// more than the difference.
pub fn confirmed(value: DoubleDouble, second: DoubleDouble) -> String {
    let relative = ((value - second).hi / value.hi).abs();
    let (mut digits, mut unit) = (DIGITS, 1e-19);
    while digits > 1 && unit < relative {
        digits -= 1;
        unit *= 10.0;
    }
    decimal::format(value, digits)
}

/// The row `t,std`.
pub fn push_std(table: &mut String, ring: &Ring, time: u32, state: &[DoubleDouble], second: &[DoubleDouble]) {
    let text = confirmed(spread(ring, state), spread(ring, second));
    // writing to a string cannot fail
    let _ = writeln!(table, "{time},{text}");
}

/// The rows `t,n,gap,speed`.
pub fn push_state(table: &mut String, ring: &Ring, time: u32, state: &[DoubleDouble], second: &[DoubleDouble]) {
    let (count, contact) = (ring.pedestrians, ring.law.contact());
    for n in 0..count {
        let gap = confirmed(state[n] + contact, second[n] + contact);
        let speed = confirmed(state[count + n], second[count + n]);
        let _ = writeln!(table, "{time},{n},{gap},{speed}");
    }
}

/// The largest differences of gaps and of speeds.
pub fn distances(ring: &Ring, state: &[DoubleDouble], second: &[DoubleDouble]) -> (f64, f64) {
    let differences: Vec<f64> = state.iter().zip(second).map(|(a, b)| (*a - *b).hi.abs()).collect();
    let largest = |values: &[f64]| values.iter().fold(0.0_f64, |largest, value| larger(largest, *value));
    let n = ring.pedestrians;
    (largest(&differences[..n]), largest(&differences[n..2 * n]))
}
