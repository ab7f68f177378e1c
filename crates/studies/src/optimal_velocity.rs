//! The laws as optimal-velocity models: without relative speed and widening each reads `x'' = V(s) - x'`. The tables
//! show the effect of the desired speed, and from which desired speed on the logarithmic law is unstable in spite of a
//! widening.

use crate::hard::rows::{Rows, row};
use crate::thresholds::critical::exponential;
use figures::failure::Failure;
use jam::events::{EventKind, Watch};
use jam::laws::{Algebraic, Logarithmic, Model};
use jam::ring::{Ring, Start};
use jam::states::StateVariables;
use jam::uniform::steady_speed;
use ode::{Control, Method, Observer, Problem, Step, integrate};
use std::ops::ControlFlow;

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
    Model::Algebraic(Algebraic { mu: strength, delta: relative, q: power, a_v: widening, epsilon, v0: desired_speed })
}

fn exponential_at(strength: f64, desired_speed: f64) -> Model {
    let mut law = exponential(strength, 1.5, 0.0);
    law.v0 = desired_speed;
    Model::Exponential(law)
}

fn logarithmic(desired_speed: f64, widening: f64) -> Model {
    Model::Logarithmic(Logarithmic { v0: desired_speed, a_v: widening, epsilon: 0.01 })
}

/// The optimal velocity `V(s)` of each law and its slope, over headways from contact of the bodies (of the centres for
/// the logarithmic law) on.
///
/// # Errors
/// There is no uniform flow at a headway.
pub fn velocities() -> Result<Rows, Failure> {
    let mut rows = Rows::new(&["law", "headway", "velocity", "slope"]);
    for (name, model) in laws() {
        let contact = model.contact();
        for step in 1..=250 {
            let headway = contact + 0.02 * f64::from(step);
            let velocity = steady_speed(&model, headway).map_err(Failure::work)?;
            rows.push(row![name, headway, velocity, model.linearise(headway, velocity).phi]);
        }
    }
    Ok(rows)
}

/// How the runs of [`events`] are made: the second by another method and at a tenth of the tolerance of the first, so
/// that the difference of the two is about the error of the first and many times that of the second, which is tabled.
const CONTROLS: [(Method, Control); 2] = [
    (Method::Dop853, Control::Adaptive { tolerance: 1e-12 }),
    (Method::Extrapolation, Control::Adaptive { tolerance: 1e-13 }),
];

/// The unstable runs of figures 4 and 7 with other desired speeds and other strengths, and one with a force whose
/// potential is finite at contact: the time of the first negative speed, and the event that ends the run.
/// `velocity_at_contact` is `V` at `d = 0`, where the law has one. Runs of the exponential law continue after contact.
///
/// # Errors
/// A run failed, or two methods disagree about what ended it.
pub fn events() -> Result<Rows, Failure> {
    let mut rows = Rows::new(&[
        "law",
        "varied",
        "q",
        "strength",
        "v0",
        "velocity_at_contact",
        "negative_t",
        "negative_t_error",
        "stop",
        "stop_t",
        "stop_t_error",
    ]);
    let speeds = [1.0, 2.0, 2.5, 3.0, 4.0, 5.0];
    let mut cases: Vec<(Model, &str, Option<f64>, f64, f64)> = Vec::new();
    cases.extend(speeds.map(|v0| (algebraic(0.55, 2.0, v0), "speed", Some(2.0), 0.55, v0)));
    cases.push((algebraic(1.2, 0.5, 3.0), "power", Some(0.5), 1.2, 3.0));
    cases.extend(speeds.map(|v0| (exponential_at(3.0, v0), "speed", None, 3.0, v0)));
    cases.extend([3.5, 4.0, 5.0].map(|a| (exponential_at(a, 3.0), "strength", None, a, 3.0)));
    for (model, varied, q, strength, v0) in cases {
        let [two, one] = CONTROLS.map(|how| follow(&model, how));
        let (one, two) = (one?, two?);
        if one.stop.0 != two.stop.0 {
            return Err(Failure::work(format!(
                "{}: {} by one method, {} by the other",
                model.name(),
                one.stop.0,
                two.stop.0
            )));
        }
        let negative_off = one.negative.zip(two.negative).map(|(a, b)| (a - b).abs());
        let at_contact = q.is_none().then_some(v0 - strength);
        let (stop, time, off) = (one.stop.0, one.stop.1, (one.stop.1 - two.stop.1).abs());
        rows.push(row![model.name(), varied, q, strength, v0, at_contact, one.negative, negative_off, stop, time, off]);
    }
    Ok(rows)
}

/// What ended a run: contact, or speeds without bound.
struct Followed {
    negative: Option<f64>,
    stop: (&'static str, f64),
}

/// Keeps the first negative speed and the first stop; continues until both are known or neither can follow.
struct Following<'a> {
    watch: Watch<'a>,
    negative: Option<f64>,
    stop: Option<(&'static str, f64)>,
    /// Whether the force has a value beyond contact.
    goes_on: bool,
}

/// How far a run goes at most.
const END: f64 = 2000.0;
/// A room that counts as none, where the force of a finite barrier has no value beyond contact.
const CLOSED: f64 = 1e-6;

fn follow(model: &Model, (method, control): (Method, Control)) -> Result<Followed, Failure> {
    let (goes_on, pedestrians) = match model {
        Model::Exponential(_) => (true, 57),
        _ => (false, 67),
    };
    let ring = Ring { pedestrians, length: 200.0 };
    let form = StateVariables::Spacings.build(model, ring);
    let start = form.start(Start { shift: 1e-4 });
    let watch = Watch::new(model.clone(), &*form, pedestrians);
    let mut following = Following { watch, negative: None, stop: None, goes_on };
    let problem = Problem { system: &*form, start: &start, begin: 0.0, end: END, method, control };
    let ended = integrate(&problem, &mut following);
    let least = following.watch.effective_gaps().iter().copied().fold(f64::INFINITY, math::smaller);
    let stop = match (following.stop, ended) {
        (Some(stop), _) => stop,
        // a square root of the room: the steps end where the room does
        (None, Err(ode::Failure::StepTooSmall { time, .. } | ode::Failure::NotFinite { time, .. }))
            if least < CLOSED =>
        {
            (EventKind::Overlap.name(), time)
        }
        (None, Err(failure)) => return Err(Failure::work(failure)),
        (None, Ok(_)) => return Err(Failure::work(format!("{}: no stop by t = {END}", model.name()))),
    };
    Ok(Followed { negative: following.negative, stop })
}

impl Observer for Following<'_> {
    fn after(&mut self, step: &mut Step<'_>) -> ControlFlow<()> {
        let new = self.watch.look(step);
        let time = |kind: EventKind| new.iter().find(|event| event.kind == kind).map(|event| event.time);
        self.negative = self.negative.or(time(EventKind::NegativeSpeed));
        let stop = new.iter().find(|event| event.kind.is_stop());
        self.stop = self.stop.or(stop.map(|event| (event.kind.name(), event.time)));
        let is_over = self.stop.is_some() && (self.negative.is_some() || !self.goes_on);
        if is_over { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
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
