//! The allowed errors of a run: ten times the stated ones, and no limit where none is stated.

use crate::stated::Stated;
use reference::solution::Kind;

/// The errors that a run may have.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bound {
    /// Of standard deviations.
    pub std: f64,
    /// Of positions and of speeds in the table.
    pub table: [f64; 2],
    /// Of positions and of speeds at the end.
    pub end: [f64; 2],
}

/// Times the stated error.
pub const FACTOR: f64 = 10.0;

impl Bound {
    /// The errors of a run that states these.
    pub fn new(stated: &Stated) -> Bound {
        let times = |error: f64| FACTOR * error;
        Bound { std: times(stated.std), table: stated.table.map(times), end: stated.end.map(times) }
    }

    /// Of what becomes negative in an event.
    pub fn value(&self, kind: Kind) -> f64 {
        let larger = |i: usize| if self.end[i] > self.table[i] { self.end[i] } else { self.table[i] };
        let (position, speed) = (larger(0), larger(1));
        match kind {
            Kind::Overlap => 2.0 * (position + speed),
            Kind::NegativeSpeed => speed,
            Kind::Exchange => 2.0 * position,
        }
    }

    /// Of the time of an event at which the value falls at this rate.
    pub fn moment(&self, kind: Kind, rate: f64) -> f64 {
        self.value(kind) / rate.abs()
    }
}
