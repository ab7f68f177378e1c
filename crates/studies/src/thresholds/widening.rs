//! The effect of velocity-dependent size on stability: at a given effective gap, as in the figures of the paper, and at
//! a given density, where it reduces the gap.

use super::critical::{algebraic, exponential};
use crate::hard::rows::{Rows, row};
use crate::hard::run::two_methods;
use figures::failure::Failure;
use jam::events::{Event, EventKind};
use jam::laws::{Logarithmic, Model};
use jam::ring::{Ring, Start};
use jam::run::{Run, RunObserver, Sample, Sight, run_from};
use jam::stability::Linear;
use jam::states::StateVariables;
use jam::uniform::steady_speed;
use ode::{Control, Method, Step};

/// A law for each widening.
type Widened = fn(f64) -> Model;

/// The margin for long waves (negative: stable) and the largest growth rate on the ring, with the widening from 0 to 1
/// or as far as there is a uniform flow.
pub fn table() -> Rows {
    let mut rows =
        Rows::new(&["law", "fixed", "a_v", "speed", "gap", "phi", "margin", "growth_rate", "growth_rate_error"]);
    let laws: [(&str, Widened, usize); 4] = [
        ("algebraic", |a_v| Model::Algebraic(algebraic(0.45, (0.0, 2.0, a_v))), 67),
        ("exponential", |a_v| Model::Exponential(exponential(1.5, 1.5, a_v)), 57),
        ("logarithmic", |a_v| logarithmic(1.0, a_v), 133),
        ("logarithmic_3", |a_v| logarithmic(3.0, a_v), 133),
    ];
    for (name, make, count) in laws {
        for a_v in (0..=20).map(|i| 0.05 * f64::from(i)) {
            let (model, headway) = (make(a_v), 200.0 / count as f64);
            // where the space requirement of the flow is larger than its headway there is none with room left
            let Ok(speed) = steady_speed(&model, headway) else { break };
            let at_density = model.linearise(headway, speed);
            let mut push = |fixed: &str, gap: f64, linear: &Linear| {
                let (rate, l) = linear.fastest(count);
                let refined = linear.refined_growth_rate(2.0 * std::f64::consts::PI * l as f64 / count as f64);
                let error = (rate - refined).abs();
                rows.push(row![name, fixed, a_v, speed, gap, linear.phi, linear.long_wave_margin(), rate, error]);
            };
            push("density", model.effective_gap(headway, speed, speed), &at_density);
            // the effective distance of the flow without widening
            let gap = headway - 2.0;
            match model {
                Model::Algebraic(law) => push("gap", gap, &law.linearise(gap)),
                Model::Exponential(law) => push("gap", gap, &law.linearise(gap)),
                Model::Logarithmic(_) | Model::Formula(_) | Model::Own(_) => {}
            }
        }
    }
    rows
}

/// Unstable runs with a widening, from the start of the paper: the first event, and the least space requirement `a_n' =
/// 1 + a_v v_n` until then.
///
/// # Errors
/// A run failed without an event.
pub fn runs() -> Result<Rows, Failure> {
    let mut rows = Rows::new(&[
        "law",
        "a_v",
        "strength",
        "margin",
        "stop",
        "stop_t",
        "stop_t_error",
        "negative_t",
        "negative_t_error",
        "least_speed",
        "least_size",
        "least_size_error",
    ]);
    let cases = [
        (Model::Algebraic(algebraic(0.55, (0.0, 2.0, 0.01))), 67, 0.01, 0.55),
        (Model::Algebraic(algebraic(0.55, (0.0, 2.0, 0.02))), 67, 0.02, 0.55),
        (Model::Algebraic(algebraic(0.55, (0.0, 2.0, 0.05))), 67, 0.05, 0.55),
        (Model::Algebraic(algebraic(1.0, (0.0, 2.0, 0.05))), 67, 0.05, 1.0),
        (Model::Algebraic(algebraic(0.45, (0.0, 2.0, 0.1))), 67, 0.1, 0.45),
        (Model::Algebraic(algebraic(0.45, (0.0, 2.0, 0.5))), 67, 0.5, 0.45),
        (Model::Exponential(exponential(3.0, 1.5, 0.1)), 57, 0.1, 3.0),
        (Model::Exponential(exponential(1.5, 1.5, 0.3)), 57, 0.3, 1.5),
    ];
    for (model, count, a_v, strength) in cases {
        let ring = Ring { pedestrians: count, length: 200.0 };
        let speed = steady_speed(&model, ring.headway()).map_err(Failure::work)?;
        let margin = model.linearise(ring.headway(), speed).long_wave_margin();
        let [one, two] = two_methods(1e-11).map(|how| follow(&model, ring, how));
        let (one, two) = (one?, two?);
        let size = |followed: &Followed| 1.0 + a_v * followed.least;
        let off = |a: Option<f64>, b: Option<f64>| a.zip(b).map(|(a, b)| (a - b).abs());
        rows.push(row![
            model.name(),
            a_v,
            strength,
            margin,
            one.stop.map_or("none", |stop| stop.0),
            one.stop.map(|stop| stop.1),
            off(one.stop.map(|stop| stop.1), two.stop.map(|stop| stop.1)),
            one.negative,
            off(one.negative, two.negative),
            one.least,
            size(&one),
            (size(&one) - size(&two)).abs()
        ]);
    }
    Ok(rows)
}

/// How long the runs are, and how often the least speed is looked for.
const END: f64 = 400.0;
const SAMPLE: f64 = 0.05;

/// What a run up to its first stop shows.
struct Followed {
    stop: Option<(&'static str, f64)>,
    negative: Option<f64>,
    least: f64,
}

fn follow(model: &Model, ring: Ring, (method, control): (Method, Control)) -> Result<Followed, Failure> {
    let run = Run::new(model.clone(), ring, Start { shift: 1e-4 }, END).map_err(Failure::work)?;
    // spacings keep their digits at the walls to which an unstable run comes
    let run = Run { sample: SAMPLE, method, control, form: StateVariables::Spacings, ..run };
    let mut followed = Followed { stop: None, negative: None, least: f64::INFINITY };
    run_from(&run, None, &mut followed).map_err(Failure::work)?;
    Ok(followed)
}

impl RunObserver for Followed {
    fn seen(&mut self, _step: &mut Step<'_>, sight: &mut Sight<'_, '_>) {
        let stop = sight.new.iter().find(|event| event.kind.is_stop());
        let until = stop.map_or(END, |event| event.time);
        let is_before = |event: &&Event| event.kind == EventKind::NegativeSpeed && event.time <= until;
        self.negative = self.negative.or(sight.new.iter().find(is_before).map(|event| event.time));
        self.stop = stop.map(|event| (event.kind.name(), event.time));
    }

    fn sampled(&mut self, sample: &Sample<'_>) {
        // all start at rest
        if sample.time > 0.0 {
            self.least = sample.speeds.iter().copied().fold(self.least, math::smaller);
        }
    }

    fn is_done(&self) -> bool {
        self.stop.is_some()
    }
}

/// What a smaller safety distance `a_0` and a longer `tau` do to the logarithmic law, in metres and seconds:
/// pedestrians 0.9 m apart that want to walk 1.2 m/s. Both `v_0' = v_0 tau / a_0` and the headway in units of `a_0`
/// change.
pub fn safety() -> Rows {
    let mut rows = Rows::new(&["varied", "a_0", "tau", "v0", "headway", "xi", "margin", "unstable"]);
    let mut push = |varied: &str, a_0: f64, tau: f64| {
        let (desired_speed, headway) = (1.2 * tau / a_0, 0.9 / a_0);
        let linear = Logarithmic { v0: desired_speed, a_v: 0.0, epsilon: 0.01 }.linearise(headway, 0.0);
        let margin = linear.long_wave_margin();
        rows.push(row![varied, a_0, tau, desired_speed, headway, linear.phi, margin, usize::from(margin > 0.0)]);
    };
    (8..=40).for_each(|i| push("a_0", f64::from(i) / 40.0, 0.5));
    (1..=40).for_each(|i| push("tau", 0.6, f64::from(i) / 40.0));
    rows
}

fn logarithmic(desired_speed: f64, widening: f64) -> Model {
    Model::Logarithmic(Logarithmic { v0: desired_speed, a_v: widening, epsilon: 0.01 })
}
