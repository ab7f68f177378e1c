//! Events of a run (overlap, negative speed, exchange of places, blow-up), each with its time and pedestrian.

mod quiet;

use crate::force::{Force, Rows};
use crate::laws::Model;
use crate::states::RingSystem;
use math::simd::{Kernel, dispatch};
use ode::{Step, crossing_between, first_crossing};
use quiet::Near;

/// What can happen to a pedestrian.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum EventKind {
    /// The room is used up: `d_n < 0`, for the logarithmic law `s_n < 0`. Also a step of fixed length that asks for the
    /// force beyond the wall of a singular law and comes back, which no solution does.
    Overlap,
    /// `v_n < 0`.
    NegativeSpeed,
    /// `s_n < 0`: the pedestrian has passed the one ahead.
    Exchange,
    /// The formula of the law has no value for the pedestrian: the logarithm of something negative, say. By steps of
    /// fixed length the time may be that of the start of the step in which this happens.
    Undefined,
    /// `|v_n|` exceeds [`BLOW_UP`] times the desired speed (or 1): nothing stops it from growing without bound. Also,
    /// at a singular wall, an effective gap below every double: the speeds are still finite, and the time is that of
    /// this approach, before the singularity (by about 1e-2 for the run of `GUO` with `mu = 1`).
    BlowUp,
}

/// The factor above which a speed counts as blown up.
///
/// In a blow-up each pedestrian is thrown back twice as fast as the one before, over about one headway: at this factor
/// the remaining time to the singularity is below the rounding of the time.
pub const BLOW_UP: f64 = 1e12;

impl Event {
    /// Whether the run could not follow a pedestrian any further to a wall, at a gap below every double: no step shows
    /// that.
    pub fn is_at_wall(&self) -> bool {
        self.kind == EventKind::BlowUp && self.step == 0.0 && self.time > 0.0
    }
}

impl EventKind {
    /// All events.
    pub const ALL: [EventKind; 5] =
        [EventKind::Overlap, EventKind::NegativeSpeed, EventKind::Exchange, EventKind::Undefined, EventKind::BlowUp];

    /// The events that a step can show: those with a number that falls through 0.
    const WITHIN_STEPS: [EventKind; 4] =
        [EventKind::Overlap, EventKind::NegativeSpeed, EventKind::Exchange, EventKind::BlowUp];

    /// The name in tables.
    pub fn name(self) -> &'static str {
        match self {
            EventKind::Overlap => "overlap",
            EventKind::NegativeSpeed => "negative_speed",
            EventKind::Exchange => "exchange",
            EventKind::Undefined => "undefined",
            EventKind::BlowUp => "blow_up",
        }
    }

    /// Whether the law has no meaning, or no solution, after it.
    pub fn is_stop(self) -> bool {
        matches!(self, EventKind::Overlap | EventKind::Undefined | EventKind::BlowUp)
    }
}

/// An event that happened.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Event {
    /// What.
    pub kind: EventKind,
    /// When, in units of `tau`: to the last bit of the step's interpolant.
    pub time: f64,
    /// To whom, counted from 0.
    pub pedestrian: usize,
    /// The spacing `s_n` to the pedestrian ahead then, in units of `a_0`.
    pub gap: f64,
    /// The length of the step that contains it, in units of `tau`; 0 at the start, and where a step of any length was
    /// refused.
    pub step: f64,
}

/// Spacings, speeds and effective gaps with their rates at one instant.
#[derive(Clone, Debug)]
pub(crate) struct Instant {
    pub(crate) gaps: Vec<f64>,
    pub(crate) speeds: Vec<f64>,
    pub(crate) effective_gaps: Vec<f64>,
    gap_rates: Vec<f64>,
    pub(crate) speed_rates: Vec<f64>,
    pub(crate) effective_gap_rates: Vec<f64>,
    net_gaps: Vec<f64>,
}

impl Instant {
    fn new(pedestrians: usize) -> Instant {
        let zeros = || vec![0.0; pedestrians];
        Instant {
            gaps: zeros(),
            speeds: zeros(),
            effective_gaps: zeros(),
            gap_rates: zeros(),
            speed_rates: zeros(),
            effective_gap_rates: zeros(),
            net_gaps: zeros(),
        }
    }

    fn read(&mut self, form: &dyn RingSystem, force: &dyn Force, state: &[f64], rates: &[f64]) {
        self.read_values(form, force, state);
        form.read_rates(rates, &mut self.gap_rates, &mut self.speed_rates);
        let now = Rows { spacings: &self.net_gaps, speeds: &self.speeds };
        let rates = Rows { spacings: &self.gap_rates, speeds: &self.speed_rates };
        force.effective_gap_rates(now, rates, &mut self.effective_gap_rates);
    }

    /// All but the rates.
    fn read_values(&mut self, form: &dyn RingSystem, force: &dyn Force, state: &[f64]) {
        form.read(state, &mut self.gaps, &mut self.speeds);
        self.net_gaps.clear();
        self.net_gaps.extend(self.gaps.iter().map(|gap| gap - force.contact()));
        force.effective_gaps(&self.net_gaps, &self.speeds, &mut self.effective_gaps);
    }
}

/// Watches the steps of a run for the first event of each kind.
pub struct Watch<'a> {
    model: Model,
    force: Box<dyn Force>,
    form: &'a dyn RingSystem,
    found: Vec<Event>,
    before: Instant,
    after: Instant,
    /// Within the step looked at last; its rates are of no meaning.
    within: Instant,
    state: Vec<f64>,
    /// The time that `after` shows.
    seen: Option<f64>,
    /// Whether effective gaps are spacings less a constant.
    has_plain_gaps: bool,
    /// The end of the step looked at last, as sizes of deviations.
    near: Option<Near>,
    /// Whether that step was passed over.
    is_quiet: bool,
}

/// What happens to several pedestrians within this time happens at once.
const AT_ONCE: f64 = 1e-9;

/// Number of parts in which a step that may contain an event is searched.
const PARTS: u32 = 16;

impl<'a> Watch<'a> {
    /// A watch over a ring of `pedestrians` in this form.
    pub fn new(model: Model, form: &'a dyn RingSystem, pedestrians: usize) -> Watch<'a> {
        let instant = Instant::new(pedestrians);
        let force = model.force();
        let [before, after, within] = [instant.clone(), instant.clone(), instant];
        let has_plain_gaps = model.has_plain_gaps();
        let (found, state) = (Vec::new(), Vec::new());
        let (seen, near, is_quiet) = (None, None, false);
        Watch { model, force, form, found, before, after, within, state, seen, has_plain_gaps, near, is_quiet }
    }

    /// Goes on with the same ring in another form.
    pub fn change_form(&mut self, form: &'a dyn RingSystem) {
        self.form = form;
        (self.seen, self.near) = (None, None);
    }

    /// The events at the start of a run, at time `t`, with all pedestrians concerned. A falling speed of 0 is negative
    /// at once.
    pub fn start(&mut self, t: f64, state: &[f64], rates: &[f64]) -> Vec<Event> {
        self.after.read(self.form, &*self.force, state, rates);
        self.seen = Some(t);
        let now = &self.after;
        for kind in EventKind::WITHIN_STEPS {
            for pedestrian in 0..now.gaps.len() {
                let (value, rate) = match kind {
                    EventKind::Overlap => (now.effective_gaps[pedestrian], now.effective_gap_rates[pedestrian]),
                    EventKind::NegativeSpeed => (now.speeds[pedestrian], now.speed_rates[pedestrian]),
                    EventKind::Exchange => (now.gaps[pedestrian], now.gap_rates[pedestrian]),
                    EventKind::BlowUp => (self.bound() - now.speeds[pedestrian].abs(), 0.0),
                    EventKind::Undefined => continue,
                };
                if value < 0.0 || value == 0.0 && rate < 0.0 {
                    self.found.push(Event { kind, time: t, pedestrian, gap: now.gaps[pedestrian], step: 0.0 });
                }
            }
        }
        self.found.clone()
    }

    /// Goes on where a watch stood that had found these.
    pub fn resume(&mut self, found: Vec<Event>) {
        self.found = found;
    }

    /// The start of the step looked at last.
    pub(crate) fn before(&self) -> &Instant {
        &self.before
    }

    /// Its end; at first, the start of the run.
    pub(crate) fn after(&self) -> &Instant {
        &self.after
    }

    /// A fraction of it, without rates.
    pub(crate) fn within(&mut self, step: &mut Step<'_>, theta: f64) -> &Instant {
        self.state.resize(step.before().len(), 0.0);
        step.at_fraction(theta, &mut self.state);
        self.within.read_values(self.form, &*self.force, &self.state);
        &self.within
    }

    /// The `N` spacings and the `N` speeds at a time within a step, from its start to its end.
    pub fn everybody_at(&self, step: &mut Step<'_>, time: f64) -> [Vec<f64>; 2] {
        let count = self.after.gaps.len();
        let (mut state, mut spacings, mut speeds) =
            (vec![0.0; step.before().len()], vec![0.0; count], vec![0.0; count]);
        step.at(time, &mut state);
        self.form.read(&state, &mut spacings, &mut speeds);
        [spacings, speeds]
    }

    /// The `N` speeds at the end of the step looked at last, in units of `a_0 / tau`.
    pub fn speeds(&self) -> &[f64] {
        &self.after.speeds
    }

    /// The `N` effective gaps at the end of the step looked at last, in units of `a_0`.
    pub fn effective_gaps(&self) -> &[f64] {
        &self.after.effective_gaps
    }

    /// The `N` effective gaps in any state of the form, in units of `a_0`.
    pub fn effective_gaps_in(&self, state: &[f64]) -> Vec<f64> {
        let mut instant = self.before.clone();
        instant.read(self.form, &*self.force, state, &vec![0.0; state.len()]);
        instant.effective_gaps
    }

    /// How fast what falls through 0 in an event changes, for a pedestrian in this state, if the state changes like
    /// this: its rates, or an error.
    pub fn change(&mut self, kind: EventKind, pedestrian: usize, state: &[f64], direction: &[f64]) -> f64 {
        self.before.read(self.form, &*self.force, state, direction);
        // what the next step begins with is read anew
        self.seen = None;
        let Instant { effective_gap_rates, speed_rates, gap_rates, .. } = &self.before;
        match kind {
            EventKind::Overlap => effective_gap_rates[pedestrian],
            EventKind::NegativeSpeed | EventKind::BlowUp => speed_rates[pedestrian],
            EventKind::Exchange => gap_rates[pedestrian],
            EventKind::Undefined => f64::NAN,
        }
    }

    /// Adds an event that the steps do not show.
    pub fn add(&mut self, event: Event) {
        self.found.push(event);
    }

    /// The first event of each kind so far, for all pedestrians to whom it happened at that time, in order of time.
    pub fn found(&self) -> &[Event] {
        &self.found
    }

    /// As [`Watch::look`], for those who want to know what is new and nothing else: a step near a uniform flow, in
    /// which nothing can happen, is skipped, and the watch still shows an earlier one.
    pub fn look_for_new(&mut self, step: &mut Step<'_>) -> Vec<Event> {
        self.is_quiet = self.nothing_can_happen(step);
        if self.is_quiet { Vec::new() } else { self.look(step) }
    }

    /// Whether the last step was passed over: then no room in it is less than half of that in the uniform flow.
    pub fn is_quiet(&self) -> bool {
        self.is_quiet
    }

    /// Looks for events in a step; returns those that are new, in order of time.
    pub fn look(&mut self, step: &mut Step<'_>) -> Vec<Event> {
        if self.seen == Some(step.start) {
            std::mem::swap(&mut self.before, &mut self.after);
        } else {
            self.before.read(self.form, &*self.force, step.before(), step.rates_before());
        }
        self.seen = Some(step.end);
        self.after.read(self.form, &*self.force, step.after(), step.rates_after());
        let mut new = Vec::new();
        for kind in EventKind::WITHIN_STEPS {
            let mut known = self.found.iter().filter(|event| event.kind == kind).peekable();
            let first = known.peek().map(|event| event.time);
            if first.is_none_or(|time| step.start <= time + AT_ONCE) && self.may_lie_within(kind, step.length()) {
                let known: Vec<usize> = known.map(|event| event.pedestrian).collect();
                new.extend(self.locate(kind, first, &known, step));
            }
        }
        let mut overlaps = self.found.iter().chain(&new);
        if step.is_beyond() && overlaps.all(|event| event.kind != EventKind::Overlap) {
            new.push(self.back_from_beyond(step));
        }
        new.sort_by(|a, b| a.time.total_cmp(&b.time));
        if self.model.may_be_undefined() && !self.after.speed_rates.iter().all(|rate| rate.is_finite()) {
            self.end_at_edge(step, &mut new);
        }
        self.found.extend(&new);
        new
    }

    /// Of a step at whose end the law has no value: adds where that begins, if no stop comes before or at that place,
    /// and drops what comes after it.
    fn end_at_edge(&self, step: &mut Step<'_>, new: &mut Vec<Event>) {
        let count = self.before.gaps.len();
        let rates_of = |state: &[f64]| {
            let (mut rates, mut unused, mut accelerations) =
                (vec![0.0; state.len()], vec![0.0; count], vec![0.0; count]);
            self.form.rates(state, &mut rates);
            self.form.read_rates(&rates, &mut unused, &mut accelerations);
            accelerations
        };
        let has_no_value = |acceleration: &f64| !acceleration.is_finite();
        let edge = &mut |state: &[f64]| if rates_of(state).iter().any(has_no_value) { -1.0 } else { 1.0 };
        let theta = first_crossing(step, PARTS, edge).unwrap_or(1.0);
        let (time, mut state) = (step.start + theta * step.length(), vec![0.0; step.before().len()]);
        new.retain(|event| event.time <= time + AT_ONCE);
        if new.iter().any(|event| event.kind.is_stop()) {
            return;
        }
        step.at_fraction(theta, &mut state);
        let pedestrian = rates_of(&state).iter().position(has_no_value).unwrap_or(0);
        let (mut gaps, mut speeds) = (vec![0.0; count], vec![0.0; count]);
        self.form.read(&state, &mut gaps, &mut speeds);
        let (kind, gap, step) = (EventKind::Undefined, gaps[pedestrian], step.length());
        new.push(Event { kind, time, pedestrian, gap, step });
    }

    /// Whether the event's value can be negative within the step.
    fn may_lie_within(&self, kind: EventKind, h: f64) -> bool {
        let (before, after) = (&self.before, &self.after);
        match kind {
            EventKind::Overlap => may_be_negative(
                (&before.effective_gaps, &before.effective_gap_rates),
                (&after.effective_gaps, &after.effective_gap_rates),
                h,
            ),
            EventKind::NegativeSpeed => {
                may_be_negative((&before.speeds, &before.speed_rates), (&after.speeds, &after.speed_rates), h)
            }
            EventKind::Exchange => {
                may_be_negative((&before.gaps, &before.gap_rates), (&after.gaps, &after.gap_rates), h)
            }
            EventKind::BlowUp => {
                let bound = self.bound();
                after.speeds.iter().any(|speed| speed.abs() > bound)
            }
            EventKind::Undefined => false,
        }
    }

    /// The first event of this kind in the step, for all pedestrians to whom it happens at the same time, except those
    /// in `known`; only events simultaneous with `first` are returned.
    fn locate(&self, kind: EventKind, first: Option<f64>, known: &[usize], step: &mut Step<'_>) -> Vec<Event> {
        let count = self.before.gaps.len();
        let (mut gaps, mut speeds) = (vec![0.0; count], vec![0.0; count]);
        let mut values = |state: &[f64], values: &mut [f64]| {
            self.form.read(state, &mut gaps, &mut speeds);
            self.values(kind, &mut gaps, &speeds, values);
            known.iter().for_each(|&n| values[n] = f64::INFINITY);
        };
        let mut all = vec![0.0; count];
        let lowest = &mut |state: &[f64]| {
            values(state, &mut all);
            all.iter().fold(f64::INFINITY, |lowest, &next| if next < lowest { next } else { lowest })
        };
        let Some(theta) = first_crossing(step, PARTS, lowest) else { return Vec::new() };
        let (start, length) = (step.start, step.length());
        let last = first.map_or(theta * length, |first| first - start) + AT_ONCE;
        let last = if last < length { last / length } else { 1.0 };
        let mut state = vec![0.0; step.before().len()];
        let (mut at_first, mut at_last) = (vec![0.0; count], vec![0.0; count]);
        step.at_fraction(theta, &mut state);
        values(&state, &mut at_first);
        step.at_fraction(if theta < last { last } else { theta }, &mut state);
        values(&state, &mut at_last);
        let (mut found, mut spare) = (Vec::new(), vec![0.0; count]);
        for pedestrian in (0..count).filter(|&n| theta <= last && (at_first[n] < 0.0 || at_last[n] < 0.0)) {
            let mut own = |state: &[f64]| {
                values(state, &mut all);
                all[pedestrian]
            };
            let is_first = at_first[pedestrian] < 0.0;
            let place = if is_first { theta } else { crossing_between(step, theta, last, &mut own) };
            step.at_fraction(place, &mut state);
            self.form.read(&state, &mut all, &mut spare);
            let (time, gap) = (start + place * length, all[pedestrian]);
            found.push(Event { kind, time, pedestrian, gap, step: length });
        }
        found
    }

    /// The overlap in a step that was beyond a wall at none but its stages: at its end, of the pedestrian with the
    /// least effective gap at its start.
    fn back_from_beyond(&self, step: &Step<'_>) -> Event {
        let effective_gaps = self.before.effective_gaps.iter().enumerate();
        let (pedestrian, _) =
            effective_gaps.fold((0, f64::INFINITY), |least, (n, &gap)| if gap < least.1 { (n, gap) } else { least });
        let gap = self.before.gaps[pedestrian];
        Event { kind: EventKind::Overlap, time: step.end, pedestrian, gap, step: step.length() }
    }

    /// Negative once the event has happened; the gaps are spoilt.
    fn values(&self, kind: EventKind, gaps: &mut [f64], speeds: &[f64], values: &mut [f64]) {
        match kind {
            EventKind::Overlap => {
                gaps.iter_mut().for_each(|gap| *gap -= self.force.contact());
                self.force.effective_gaps(gaps, speeds, values);
            }
            EventKind::NegativeSpeed => values.copy_from_slice(speeds),
            EventKind::Exchange => values.copy_from_slice(gaps),
            EventKind::Undefined => values.fill(f64::INFINITY),
            EventKind::BlowUp => values.iter_mut().zip(speeds).for_each(|(value, v)| *value = self.bound() - v.abs()),
        }
    }

    fn bound(&self) -> f64 {
        let desired = self.model.desired_speed();
        BLOW_UP * if desired > 1.0 { desired } else { 1.0 }
    }
}

/// Whether any of the values, given with their rates at both ends of a step of length `h`, may be negative within it.
///
/// The control points of the cubic through both ends (its Bernstein coefficients) bound it from below. The solution is
/// no cubic where the steps are long, so their spread is taken off once more; what passes here costs no interpolation.
fn may_be_negative(before: (&[f64], &[f64]), after: (&[f64], &[f64]), h: f64) -> bool {
    dispatch(MayBeNegative { before, after, h })
}

struct MayBeNegative<'a> {
    before: (&'a [f64], &'a [f64]),
    after: (&'a [f64], &'a [f64]),
    h: f64,
}

impl Kernel for MayBeNegative<'_> {
    type Output = bool;

    #[inline(always)]
    fn run(self) -> bool {
        let third = self.h / 3.0;
        let starts = self.before.0.iter().zip(self.before.1);
        let ends = self.after.0.iter().zip(self.after.1);
        // counted, not searched: a loop without an exit runs several pedestrians at a time
        let mut count = 0;
        for ((start, leaving), (end, arriving)) in starts.zip(ends) {
            let points = [*start, start + third * leaving, end - third * arriving, *end];
            let low = lower(lower(points[0], points[1]), lower(points[2], points[3]));
            let high = -lower(lower(-points[0], -points[1]), lower(-points[2], -points[3]));
            // beyond a wall a rate may be no number; the value at the end then decides
            count += u64::from(low < high - low) | u64::from(*end < 0.0);
        }
        count > 0
    }
}

/// The lower of two numbers, as a selection that vectorises.
#[inline(always)]
fn lower(a: f64, b: f64) -> f64 {
    if b < a { b } else { a }
}
