//! Events of an unstable ring, located by Newton's method on the length of a step.

use crate::ring::Ring;
use crate::run::{Run, Stuck};
use math::double_double::DoubleDouble;
use math::larger;

/// What a run is watched for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EventKind {
    /// A clearance `d_n = s_n - 2` becomes negative.
    Overlap,
    /// A speed becomes negative.
    NegativeSpeed,
    /// A gap becomes negative.
    Exchange,
    /// A pedestrian comes no nearer to the one ahead: its gap passes a minimum, with little clearance.
    ThrowBack,
}

/// An event that was located.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Event {
    /// When.
    pub time: DoubleDouble,
    /// Whose: counted from 0, the pedestrian behind where two are concerned.
    pub pedestrian: usize,
    /// The largest speed, in size, at the end of the step in which it happened.
    pub fastest: f64,
}

impl EventKind {
    /// As `data/events.csv` names it.
    pub fn name(self) -> &'static str {
        match self {
            EventKind::Overlap => "overlap",
            EventKind::NegativeSpeed => "negative_speed",
            EventKind::Exchange => "exchange",
            EventKind::ThrowBack => "throw_back",
        }
    }

    /// Negative once the event has happened to pedestrian `n`; and its time derivative.
    fn value(
        self,
        ring: &Ring,
        state: &[DoubleDouble],
        rates: &[DoubleDouble],
        n: usize,
    ) -> (DoubleDouble, DoubleDouble) {
        let (own, ahead) = (ring.pedestrians + n, ring.pedestrians + (n + 1) % ring.pedestrians);
        match self {
            EventKind::Overlap => (state[n], rates[n]),
            EventKind::NegativeSpeed => (state[own], rates[own]),
            EventKind::Exchange => (state[n] + ring.law.contact(), rates[n]),
            EventKind::ThrowBack => (-rates[n], rates[own] - rates[ahead]),
        }
    }
}

/// No event is waited for longer.
const NEVER: f64 = 1e6;
/// Newton's method doubles the digits; from a guess of one digit six iterations give all, more are for shallow dips.
const ITERATIONS: usize = 60;
/// Clearances below this count as thrown back where they pass a minimum.
const NEAR: f64 = 1e-2;

/// Goes on until the event happens for the next time; the run stands at the end of that step.
///
/// # Errors
/// [`Stuck`].
pub fn next(run: &mut Run, event: EventKind) -> Result<Event, Stuck> {
    loop {
        let mut before = run.clone();
        let h = run.advance(NEVER)?;
        let (ring, count) = (run.ring, run.ring.pedestrians);
        let fastest = run.state[count..2 * count].iter().fold(0.0_f64, |fastest, v| larger(fastest, v.hi.abs()));
        let mut first: Option<Event> = None;
        for n in 0..count {
            let start = event.value(&ring, &before.state, &before.rates, n);
            let end = event.value(&ring, &run.state, &run.rates, n);
            if start.0.hi < 0.0 || (event == EventKind::ThrowBack && run.state[n].hi > NEAR) {
                continue;
            }
            let guess = if end.0.hi < 0.0 {
                Some(h * (start.0 / (start.0 - end.0)))
            } else {
                before_dip(&mut before, event, n, [start, end], h)
            };
            let Some(guess) = guess else { continue };
            let time = before.time + crossing(&mut before, event, n, guess);
            if first.is_none_or(|known| (time - known.time).hi < 0.0) {
                first = Some(Event { time, pedestrian: n, fastest });
            }
        }
        if let Some(event) = first {
            return Ok(event);
        }
    }
}

/// Where the value is positive at both ends of a step, but has a minimum within, which is negative: a place left of the
/// crossing from where Newton's method moves towards it (the value is convex there). Bisection of the slope's sign,
/// until the tangents at both ends of the bracket meet above 0.
fn before_dip(
    run: &mut Run,
    event: EventKind,
    n: usize,
    ends: [(DoubleDouble, DoubleDouble); 2],
    h: DoubleDouble,
) -> Option<DoubleDouble> {
    let ([mut start, mut end], mut left, mut right) = (ends, 0.0, h.hi);
    let mut rates = run.rates.clone();
    while start.1.hi < 0.0 && end.1.hi > 0.0 {
        let (fall, rise) = (start.1.hi, end.1.hi);
        let meeting = (end.0.hi - start.0.hi - rise * (right - left)) / (fall - rise);
        let middle = 0.5 * (left + right);
        if start.0.hi + fall * meeting > 0.0 || middle <= left || middle >= right {
            return None;
        }
        let state = run.peek(DoubleDouble::from(middle));
        run.ring.rates(&state, &mut rates);
        let value = event.value(&run.ring, &state, &rates, n);
        if value.0.hi < 0.0 {
            return Some(DoubleDouble::from(left));
        }
        if value.1.hi < 0.0 {
            (start, left) = (value, middle);
        } else {
            (end, right) = (value, middle);
        }
    }
    None
}

/// The length of the step, near `h`, at whose end the event's value is 0.
fn crossing(run: &mut Run, event: EventKind, n: usize, h: DoubleDouble) -> DoubleDouble {
    let mut rates = run.rates.clone();
    let mut h = h;
    for _ in 0..ITERATIONS {
        let state = run.peek(h);
        run.ring.rates(&state, &mut rates);
        let (value, slope) = event.value(&run.ring, &state, &rates, n);
        let correction = value / slope;
        h = h - correction;
        // the next correction would be of the size of its square
        if correction.hi.abs() < 1e-18 * h.hi.abs() {
            break;
        }
    }
    h
}
