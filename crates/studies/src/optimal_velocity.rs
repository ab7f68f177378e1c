//! The laws as optimal-velocity models: without relative speed and widening each reads `x'' = V(s) - x'`. What a change of
//! the desired speed does then, and from which desired speed on the logarithmic law is unstable in spite of a widening.

use crate::hard::rows::{Rows, row};
use crate::hard::run::{Case, Leg, Stop, two_methods};
use crate::thresholds::critical::exponential;
use figures::failure::Failure;
use jam::events::{Event, Happening};
use jam::laws::{Algebraic, Logarithmic, Model};
use jam::ring::Ring;
use jam::states::FormKind;
use jam::uniform::steady_speed;

/// The laws whose `V(s)` is tabled.
fn laws() -> [(&'static str, Model); 5] {
    [
        ("algebraic_stable", algebraic(0.45, 2.0, 3.0)),
        ("algebraic", algebraic(0.55, 2.0, 3.0)),
        ("exponential", exponential_at(3.0, 3.0)),
        ("logarithmic", logarithmic(1.0, 0.0)),
        ("logarithmic_3", logarithmic(3.0, 0.0)),
    ]
}

fn algebraic(strength: f64, power: f64, desired_speed: f64) -> Model {
    let (relative, widening, epsilon) = (0.0, 0.0, 0.1);
    Model::Algebraic(Algebraic { strength, relative, power, widening, epsilon, desired_speed })
}

fn exponential_at(strength: f64, desired_speed: f64) -> Model {
    let mut law = exponential(strength, 1.5, 0.0);
    law.desired_speed = desired_speed;
    Model::Exponential(law)
}

fn logarithmic(desired_speed: f64, widening: f64) -> Model {
    Model::Logarithmic(Logarithmic { desired_speed, widening, epsilon: 0.01 })
}

/// The optimal velocity `V(s)` of each law and its slope, over headways from contact of the bodies (of the centres for the
/// logarithmic law) on.
///
/// # Errors
/// There is no uniform flow at a headway.
pub fn velocities() -> Result<Rows, Failure> {
    let mut rows = Rows::new(&["law", "headway", "velocity", "slope"]);
    for (name, model) in laws() {
        let contact = model.contact();
        for step in 1..=200 {
            let headway = contact + 0.02 * f64::from(step);
            let velocity = steady_speed(&model, headway).map_err(Failure::work)?;
            rows.push(row![name, headway, velocity, model.linearise(headway, velocity).phi]);
        }
    }
    Ok(rows)
}

/// The unstable runs of figures 4 and 7 with other desired speeds and other strengths, and one with a force whose potential
/// is finite at contact: when somebody first walks backwards, and what ends the run.
///
/// # Errors
/// Two methods disagree about what ended a run.
pub fn events() -> Result<Rows, Failure> {
    let mut rows =
        Rows::new(&["law", "q", "strength", "v0", "negative_t", "negative_t_error", "stop", "stop_t", "stop_t_error"]);
    let speeds = [1.0, 2.0, 2.5, 3.0, 4.0, 5.0];
    let mut cases: Vec<(Model, usize, [f64; 3])> = Vec::new();
    cases.extend(speeds.map(|v0| (algebraic(0.55, 2.0, v0), 67, [2.0, 0.55, v0])));
    cases.push((algebraic(1.2, 0.5, 3.0), 67, [0.5, 1.2, 3.0]));
    cases.extend(speeds.map(|v0| (exponential_at(3.0, v0), 57, [f64::NAN, 3.0, v0])));
    cases.extend([3.5, 4.0, 5.0].map(|a| (exponential_at(a, 3.0), 57, [f64::NAN, a, 3.0])));
    for (model, pedestrians, [q, strength, v0]) in cases {
        let case = Case { model, ring: Ring { pedestrians, length: 200.0 }, kind: FormKind::Gaps };
        let [one, two] = two_methods(1e-12).map(|how| seen(&case, how));
        let off = |pick: fn(&Seen) -> Option<f64>| pick(&one).zip(pick(&two)).map(|(a, b)| (a - b).abs());
        let (Some(stop), Some(other)) = (&one.stop, &two.stop) else {
            return Err(Failure::work(format!("{} with strength {strength}: no stop", case.model.name())));
        };
        if stop.name != other.name {
            return Err(Failure::work(format!("stops differ: {} and {}", stop.name, other.name)));
        }
        let q = Some(q).filter(|q| q.is_finite());
        let (negative, stop_off) = (one.negative, (stop.time - other.time).abs());
        let negative_off = off(|seen| seen.negative);
        rows.push(row![case.model.name(), q, strength, v0, negative, negative_off, stop.name, stop.time, stop_off]);
    }
    Ok(rows)
}

struct Seen {
    /// When somebody first walks backwards, at the stop or up to [`AFTER`] later.
    negative: Option<f64>,
    stop: Option<Stop>,
}

/// How long an exponential run goes on after its overlap.
const AFTER: f64 = 60.0;

fn seen(case: &Case, (method, control): (ode::Method, ode::Control)) -> Seen {
    let ended = case.run(1e-4, Leg { method, control, begin: 0.0, end: 2000.0 });
    let first = |events: &[Happening]| events.iter().find(|one| one.event == Event::NegativeSpeed).map(|one| one.time);
    let mut negative = first(&ended.events);
    let is_smooth = matches!(case.model, Model::Exponential(_));
    if let (None, Some(stop), true) = (negative, &ended.stop, is_smooth) {
        // on from the end of the step that went through contact: the force is defined there
        let mut after = ended.state.clone();
        let mut time = stop.time;
        let end = time + AFTER;
        while negative.is_none() && time < end {
            let next = case.run_from(&after, Leg { method, control, begin: time, end });
            negative = first(&next.events);
            time = next.stop.as_ref().map_or(end, |stop| stop.time);
            after = next.state;
        }
    }
    Seen { negative, stop: ended.stop }
}

/// The desired speed from which on the logarithmic law is unstable, at the headway of its maps, for a widening.
///
/// # Errors
/// There is no uniform flow where one is needed.
pub fn critical() -> Result<Rows, Failure> {
    const HEADWAY: f64 = 1.5;
    let mut rows = Rows::new(&["a_v", "critical_v0", "error"]);
    for a_v in [0.0, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0] {
        let margin = |v0: f64| {
            let model = logarithmic(v0, a_v);
            let speed = steady_speed(&model, HEADWAY).map_err(Failure::work)?;
            Ok::<f64, Failure>(model.linearise(HEADWAY, speed).long_wave_margin())
        };
        let (mut low, mut high) = (0.1, 1000.0);
        if margin(low)? >= 0.0 || margin(high)? <= 0.0 {
            return Err(Failure::work(format!("no critical desired speed at a_v = {a_v}")));
        }
        while high - low > 1e-9 * high {
            let middle = 0.5 * (low + high);
            if margin(middle)? > 0.0 { high = middle } else { low = middle }
        }
        rows.push(row![a_v, 0.5 * (low + high), 0.5 * (high - low)]);
    }
    Ok(rows)
}
