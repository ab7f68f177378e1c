//! Contacts under the logarithmic law: how the speed relaxes once force and drive cancel, when pedestrians first touch,
//! and from which desired speed on.

use crate::hard::rows::{Rows, row};
use crate::hard::run::{Case, Leg, two_methods};
use crate::parameters::jammed::Run;
use figures::failure::Failure;
use jam::events::{Event, EventKind};
use jam::ring::Ring;
use jam::run::{RunObserver, Sample, Sight, run_from};
use jam::states::StateVariables;
use ode::{Control, Method, Step};

/// The desired speed 1.2 m/s times the relaxation time 0.5 s of the source, in metres: `v_0' = 0.6 m / a_0`.
const REACH: f64 = 0.6;

/// A ring whose gaps are (all but) 0 in uniform motion at the desired speed: force and drive cancel, speeds relax. The
/// rate between t = 1 and 2, and what is walked from then on until rest.
///
/// # Errors
/// A run failed.
pub fn relaxation() -> Result<Rows, Failure> {
    let mut rows = Rows::new(&["v0", "rate", "error", "way", "way_error"]);
    for v0 in [0.6, 1.0, 2.0, 3.0, 10.0, 100.0] {
        let run = Run { desired_speed: v0, ..Run::default() };
        // so small that the force differs from the drive by rounding, and still no overlap
        let case =
            Case { model: run.model(), ring: Ring { pedestrians: 2, length: 1e-20 }, kind: StateVariables::Spacings };
        let start = jam::states::gaps_state(&case.model, &[5e-21; 2], &[v0; 2], 0.0);
        let [one, two] = two_methods(1e-13).map(|(method, control)| {
            let at = |end: f64| case.run_from(&start, Leg { method, control, begin: 0.0, end });
            let (first, second, rest) = (at(1.0).whole()?, at(2.0).whole()?, at(60.0).whole()?);
            let rate = math::ln(first.speeds[0] / second.speeds[0]);
            Ok::<(f64, f64), Failure>((rate, rest.state[4]))
        });
        let (one, two) = (one?, two?);
        rows.push(row![v0, one.0, (one.0 - two.0).abs(), one.1, (one.1 - two.1).abs()]);
    }
    Ok(rows)
}

/// The first contact of a run, and what came after.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Touched {
    time: f64,
    pedestrian: usize,
    /// Its speed then, that of the one ahead.
    speed: f64,
    ahead: f64,
    /// The time of the first negative speed, if it comes within [`AFTER`].
    negative: Option<f64>,
}

/// How long a run continues after the first contact.
const AFTER: f64 = 50.0;

/// How often the least speed is looked for.
const SAMPLE: f64 = 0.25;
/// When the start from rest is over: the speeds are within an eighth of those of the uniform flow.
const STARTED: f64 = 2.0;

/// What a run to some time shows.
struct Seen {
    touched: Option<Touched>,
    /// The least speed at multiples of [`SAMPLE`] before the first contact, from [`STARTED`] on: all start at rest.
    least: f64,
    /// The time of the first negative speed before any contact.
    negative_before: Option<f64>,
}

/// The run of figures 11 to 13 with other desired speeds, up to the first contact: when, who, how fast.
///
/// # Errors
/// A run failed.
pub fn contact() -> Result<Rows, Failure> {
    let mut rows = Rows::new(&[
        "v0",
        "a_0_in_m",
        "event",
        "contact_t",
        "contact_t_error",
        "n",
        "speed",
        "speed_error",
        "ahead",
        "least_before",
        "least_before_error",
        "negative_before_t",
        "negative_t",
        "negative_t_error",
    ]);
    for v0 in [0.6, 0.8, 1.0, 1.1, 1.2, 1.25, 1.3, 1.4, 1.5, 1.75, 2.0, 2.5, 3.0, 4.0, 6.0, 8.0, 10.0] {
        let run = Run { desired_speed: v0, ..Run::default() };
        let [one, two] = [Method::Taylor, Method::Dop853].map(|method| look(&run, method, 1e-10));
        let (one, two) = (one?, two?);
        let off = |value: fn(&Touched) -> Option<f64>| {
            let number = |seen: &Seen| seen.touched.as_ref().and_then(value);
            number(&one).zip(number(&two)).map(|(a, b)| (a - b).abs())
        };
        let touched = one.touched;
        rows.push(row![
            v0,
            REACH / v0,
            if touched.is_some() { "contact" } else { "none" },
            touched.map(|t| t.time),
            off(|t| Some(t.time)),
            touched.map(|t| t.pedestrian),
            touched.map(|t| t.speed),
            off(|t| Some(t.speed)),
            touched.map(|t| t.ahead),
            one.least,
            (one.least - two.least).abs(),
            one.negative_before,
            touched.and_then(|t| t.negative),
            off(|t| t.negative)
        ]);
    }
    Ok(rows)
}

/// Between which desired speeds contacts begin, for runs to several times: no contact up to `none_at`, one at
/// `contact_at`. A second method says the same of both ends (`agree` = 1). Whether contacts stay away below is not
/// proved: only the speeds that were tried are known.
///
/// # Errors
/// A run failed.
pub fn collision() -> Result<Rows, Failure> {
    let mut rows = Rows::new(&[
        "pedestrians",
        "shift",
        "t_end",
        "none_at",
        "contact_at",
        "value",
        "error",
        "a_0_in_m",
        "contact_t",
        "contact_t_error",
        "agree",
    ]);
    let rings = [(133, 0.1, 300.0), (133, 0.1, 1000.0), (133, 0.1, 3000.0), (133, 1e-4, 3000.0), (66, 0.1, 3000.0)];
    for (pedestrians, shift, end) in rings {
        let main = Run::default();
        let length = if pedestrians == 133 { main.length } else { 1.5 * pedestrians as f64 };
        let start = crate::parameters::jammed::Start::One(shift);
        let found =
            bracket(|v0| Run { desired_speed: v0, pedestrians, length, start, end, ..main }, (1.0, 3.0), 0.003)?;
        let (low, high, value, error) = (found.none_at, found.contact_at, found.middle(), found.half());
        let a_0_in_m = REACH / value;
        let (time, off, agree) = (found.time, found.time_error, usize::from(found.agree));
        rows.push(row![pedestrians, shift, end, low, high, value, error, a_0_in_m, time, off, agree]);
    }
    Ok(rows)
}

/// Two desired speeds, and what two methods say of them.
pub(super) struct Bracket {
    /// The larger one tried without a contact.
    pub none_at: f64,
    /// The smaller one tried with a contact.
    pub contact_at: f64,
    /// When that contact comes.
    pub time: Option<f64>,
    /// By how much a second method differs from it.
    pub time_error: Option<f64>,
    /// Whether that method sees a contact at the one and none at the other.
    pub agree: bool,
}

impl Bracket {
    pub fn middle(&self) -> f64 {
        0.5 * (self.none_at + self.contact_at)
    }

    pub fn half(&self) -> f64 {
        0.5 * (self.contact_at - self.none_at)
    }
}

/// Halves an interval of desired speeds, with a contact at its upper end and none at its lower end, down to a width.
///
/// # Errors
/// A run failed.
pub(super) fn bracket(at: impl Fn(f64) -> Run, (low, high): (f64, f64), width: f64) -> Result<Bracket, Failure> {
    let touches = |v0: f64, method| look(&at(v0), method, 1e-9).map(|seen| seen.touched);
    let (mut low, mut high) = (low, high);
    while high - low > width {
        let middle = 0.5 * (low + high);
        if touches(middle, Method::Taylor)?.is_some() { high = middle } else { low = middle }
    }
    let time = |method| Ok::<Option<f64>, Failure>(touches(high, method)?.map(|touched| touched.time));
    let (time, other) = (time(Method::Taylor)?, time(Method::Dop853)?);
    let time_error = time.zip(other).map(|(one, other)| (one - other).abs());
    let agree = touches(low, Method::Dop853)?.is_none() && other.is_some();
    Ok(Bracket { none_at: low, contact_at: high, time, time_error, agree })
}

fn look(run: &Run, method: Method, tolerance: f64) -> Result<Seen, Failure> {
    let run = jam::run::Run { sample: SAMPLE, ..run.made_by(method, Control::Adaptive { tolerance })? };
    let seen = Seen { touched: None, least: f64::INFINITY, negative_before: None };
    let mut looking = Looking { seen, reached: 0.0 };
    run_from(&run, None, &mut looking).map_err(Failure::work)?;
    Ok(looking.seen)
}

struct Looking {
    seen: Seen,
    /// The end of the step looked at last.
    reached: f64,
}

impl RunObserver for Looking {
    fn seen(&mut self, step: &mut Step<'_>, sight: &mut Sight<'_, '_>) {
        let find = |kind: EventKind| sight.new.iter().find(|event| event.kind == kind);
        let (overlap, negative) = (find(EventKind::Overlap), find(EventKind::NegativeSpeed).map(|event| event.time));
        let seen = &mut self.seen;
        match (seen.touched, overlap) {
            (None, Some(&Event { time, pedestrian, .. })) => {
                let [_, speeds] = sight.watch.everybody_at(step, time);
                let (speed, ahead) = (speeds[pedestrian], speeds[(pedestrian + 1) % speeds.len()]);
                let later = negative.filter(|&negative| negative > time);
                seen.negative_before = seen.negative_before.or(negative.filter(|&negative| negative <= time));
                seen.touched = Some(Touched { time, pedestrian, speed, ahead, negative: later });
            }
            (None, None) => seen.negative_before = seen.negative_before.or(negative),
            (Some(touched), _) => {
                seen.touched = Some(Touched { negative: touched.negative.or(negative), ..touched });
            }
        }
        self.reached = step.end;
    }

    /// Up to the first contact.
    fn sampled(&mut self, sample: &Sample<'_>) {
        if sample.time >= STARTED {
            self.seen.least = sample.speeds.iter().copied().fold(self.seen.least, math::smaller);
        }
    }

    fn is_done(&self) -> bool {
        self.seen.touched.is_some_and(|t| t.negative.is_some() || self.reached > t.time + AFTER)
    }
}
