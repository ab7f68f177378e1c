//! Events of a run: overlap, negative speed, exchange of places, blow-up, each with its time and pedestrian.

use crate::laws::Model;
use crate::states::Form;
use ode::{Step, first_crossing};

/// What can happen to a pedestrian.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Event {
    /// The room is used up: `d_n < 0`, for the logarithmic law `s_n < 0`.
    Overlap,
    /// `v_n < 0`.
    NegativeSpeed,
    /// `s_n < 0`: the pedestrian has passed the one ahead.
    Exchange,
    /// `|v_n|` exceeds [`BLOW_UP`] times the desired speed (or 1): nothing stops it from growing without bound.
    BlowUp,
}

/// The factor above which a speed counts as blown up.
///
/// In a blow-up each pedestrian is thrown back twice as fast as the one before, over about one headway: at this factor
/// the remaining time to the singularity is below the rounding of the time.
pub const BLOW_UP: f64 = 1e12;

impl Event {
    /// All events.
    pub const ALL: [Event; 4] = [Event::Overlap, Event::NegativeSpeed, Event::Exchange, Event::BlowUp];

    /// The name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Event::Overlap => "overlap",
            Event::NegativeSpeed => "negative_speed",
            Event::Exchange => "exchange",
            Event::BlowUp => "blow_up",
        }
    }

    /// Whether the law has no meaning, or no solution, after it.
    pub fn is_stop(self) -> bool {
        matches!(self, Event::Overlap | Event::BlowUp)
    }
}

/// An event that happened.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Happening {
    /// What.
    pub event: Event,
    /// When.
    pub time: f64,
    /// To whom, counted from 0.
    pub pedestrian: usize,
}

/// Gaps and speeds with their rates at one instant.
#[derive(Clone, Debug)]
struct Instant {
    gaps: Vec<f64>,
    speeds: Vec<f64>,
    gap_rates: Vec<f64>,
    speed_rates: Vec<f64>,
}

/// Watches the steps of a run for the first event of each kind.
pub struct Watch<'a> {
    model: Model,
    form: &'a dyn Form,
    found: Vec<Happening>,
    before: Instant,
    after: Instant,
}

/// A step in which an event may lie is searched in this many parts.
const PARTS: u32 = 16;

impl<'a> Watch<'a> {
    /// A watch over a ring of `pedestrians` in this form.
    pub fn new(model: Model, form: &'a dyn Form, pedestrians: usize) -> Watch<'a> {
        let zeros = || vec![0.0; pedestrians];
        let instant = Instant { gaps: zeros(), speeds: zeros(), gap_rates: zeros(), speed_rates: zeros() };
        Watch { model, form, found: Vec::new(), before: instant.clone(), after: instant }
    }

    /// Goes on with the same ring in another form.
    pub fn change_form(&mut self, form: &'a dyn Form) {
        self.form = form;
    }

    /// The speeds at the end of the step looked at last.
    pub fn speeds(&self) -> &[f64] {
        &self.after.speeds
    }

    /// The first event of each kind so far, in order of time.
    pub fn found(&self) -> &[Happening] {
        &self.found
    }

    /// Looks for events in a step; returns those that are new, in order of time.
    pub fn look(&mut self, step: &mut Step<'_>) -> Vec<Happening> {
        read(self.form, step.before(), step.rates_before(), &mut self.before);
        read(self.form, step.after(), step.rates_after(), &mut self.after);
        let mut new = Vec::new();
        for event in Event::ALL {
            let is_known = self.found.iter().any(|happening| happening.event == event);
            if !is_known && self.may_lie_within(event, step.length()) {
                new.extend(self.locate(event, step));
            }
        }
        new.sort_by(|a, b| a.time.total_cmp(&b.time));
        self.found.extend(&new);
        new
    }

    /// Whether the event's value can be negative within the step. The control points of the cubic through both ends
    /// (its Bernstein coefficients) bound it from below, so this costs no interpolation.
    fn may_lie_within(&self, event: Event, h: f64) -> bool {
        let count = self.before.gaps.len();
        let value = |n: usize, at: &Instant| self.value(event, at.gaps[n], at.speeds[n], at.speeds[(n + 1) % count]);
        let rate = |n: usize, at: &Instant| {
            self.rate(event, at.speeds[n], at.gap_rates[n], at.speed_rates[n], at.speed_rates[(n + 1) % count])
        };
        (0..count).any(|n| {
            let (before, after) = (value(n, &self.before), value(n, &self.after));
            let third = h / 3.0;
            let (leaving, arriving) = (before + third * rate(n, &self.before), after - third * rate(n, &self.after));
            after < 0.0 || before < 0.0 || leaving < 0.0 || arriving < 0.0
        })
    }

    fn locate(&self, event: Event, step: &mut Step<'_>) -> Option<Happening> {
        let count = self.before.gaps.len();
        let (mut gaps, mut speeds) = (vec![0.0; count], vec![0.0; count]);
        let mut lowest = |state: &[f64]| {
            self.form.read(state, &mut gaps, &mut speeds);
            let values = (0..count).map(|n| (self.value(event, gaps[n], speeds[n], speeds[(n + 1) % count]), n));
            values.fold((f64::INFINITY, 0), |lowest, next| if next.0 < lowest.0 { next } else { lowest })
        };
        let theta = first_crossing(step, PARTS, &mut |state| lowest(state).0)?;
        let mut state = vec![0.0; step.before().len()];
        step.at_fraction(theta, &mut state);
        let (_, pedestrian) = lowest(&state);
        Some(Happening { event, time: step.start + theta * step.length(), pedestrian })
    }

    /// Negative once the event has happened.
    fn value(&self, event: Event, gap: f64, speed: f64, ahead: f64) -> f64 {
        match event {
            Event::Overlap => self.model.room(gap, speed, ahead),
            Event::NegativeSpeed => speed,
            Event::Exchange => gap,
            Event::BlowUp => self.bound() - speed.abs(),
        }
    }

    fn rate(&self, event: Event, speed: f64, gap_rate: f64, speed_rate: f64, ahead_rate: f64) -> f64 {
        match event {
            Event::Overlap => gap_rate - self.model.room_per_speed() * (speed_rate + ahead_rate),
            Event::NegativeSpeed => speed_rate,
            Event::Exchange => gap_rate,
            Event::BlowUp => -speed_rate * speed.signum(),
        }
    }

    fn bound(&self) -> f64 {
        let desired = self.model.desired_speed();
        BLOW_UP * if desired > 1.0 { desired } else { 1.0 }
    }
}

fn read(form: &dyn Form, state: &[f64], rates: &[f64], instant: &mut Instant) {
    form.read(state, &mut instant.gaps, &mut instant.speeds);
    form.read_rates(rates, &mut instant.gap_rates, &mut instant.speed_rates);
}
