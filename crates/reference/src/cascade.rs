//! The end of the unstable algebraic run, in which pedestrians throw each other back, each twice as fast as the one
//! before.

use crate::events::{Event, EventKind, next};
use crate::run::{Run, Stuck};
use math::double_double::DoubleDouble;

/// Speeds up to which the throw-backs are followed: some sixty doublings, not once around the ring.
const FASTEST: f64 = 1e18;

/// The time `T*` at which infinitely many throw-backs have happened.
#[derive(Clone, Debug, PartialEq)]
pub struct BlowUp {
    /// `T*`, extrapolated.
    pub time: DoubleDouble,
    /// How much the last throw-back has changed the extrapolation.
    pub change: f64,
    /// The throw-backs up to then.
    pub throws: Vec<Event>,
}

/// Follows the throw-backs. The times between them tend to halve; Aitken's extrapolation of the last three ends them.
///
/// # Errors
/// [`Stuck`].
pub fn follow(run: &mut Run) -> Result<BlowUp, Stuck> {
    let mut throws = Vec::new();
    let (mut time, mut change) = (run.time, f64::INFINITY);
    loop {
        let throw = next(run, EventKind::ThrowBack)?;
        throws.push(throw);
        if let [.., a, b, c] = throws.as_slice() {
            let (first, second) = (b.time - a.time, c.time - b.time);
            let limit = c.time + second * second / (first - second);
            change = (limit - time).hi.abs();
            time = limit;
        }
        if throw.fastest > FASTEST {
            return Ok(BlowUp { time, change, throws });
        }
    }
}
