//! Case 9: velocity-dependent size: `a_v >= 1` is stable for any force; negative speeds make `a_n + a_{n+1}` vanish.

use super::Tables;
use super::fixed_steps::name;
use super::rows::{Rows, row};
use super::run::{Case, Leg, difference, two_methods};
use figures::failure::Failure;
use jam::laws::{Algebraic, Exponential, Logarithmic, Model};
use jam::observe::speed_std;
use jam::ring::Ring;
use jam::states::{StateVariables, gaps_state};
use jam::uniform::steady_speed;

fn algebraic(strength: f64, widening: f64) -> Model {
    let power = 2.0;
    Model::Algebraic(Algebraic { mu: strength, delta: 0.0, q: power, a_v: widening, epsilon: 0.1, v0: 3.0 })
}

fn exponential(strength: f64, widening: f64) -> Model {
    let (range, contact) = (0.5, 0.0);
    Model::Exponential(Exponential { a: strength, b: range, c: contact, a_v: widening, epsilon: 0.1, v0: 3.0 })
}

/// Stability against `a_v`, and what a pair does that walks backwards.
pub fn tables(quick: bool) -> Result<Tables, Failure> {
    Ok(vec![("widening", stability(quick)?), ("widening_negative", negative()), ("widening_run", backwards()?)])
}

/// The strength grows: below `a_v = 1` some strength makes waves grow, from 1 on none does.
fn stability(quick: bool) -> Result<Rows, Failure> {
    let mut rows = Rows::new(&[
        "law",
        "a_v",
        "strength",
        "speed",
        "phi",
        "long_wave_margin",
        "growth_rate",
        "std_20",
        "uncertainty",
    ]);
    for widening in [0.0, 0.5, 0.9, 1.0, 1.5] {
        for strength in [1.0, 5.0, 25.0] {
            for model in [algebraic(strength, widening), exponential(strength, widening)] {
                let ring = Ring { pedestrians: 20, length: 20.0 * 4.0 };
                let Ok(speed) = steady_speed(&model, ring.headway()) else { continue };
                let linear = model.linearise(ring.headway(), speed);
                // gaps keep their digits at the walls to which an unstable run comes
                let case = Case { model: model.clone(), ring, kind: StateVariables::Spacings };
                let mut gaps = [ring.headway(); 20];
                (gaps[0], gaps[19]) = (gaps[0] - 1e-6, gaps[19] + 1e-6);
                let start = gaps_state(&model, &gaps, &[speed; 20], 1e-6);
                let end = if quick { 5.0 } else { 20.0 };
                let run = |(method, control)| case.run_from(&start, Leg { method, control, begin: 0.0, end });
                let [one, two] = two_methods(1e-11).map(run);
                let is_whole = one.stop.is_none() && two.stop.is_none();
                let std = is_whole.then(|| speed_std(&one.speeds));
                let off = is_whole.then(|| difference(&one.speeds, &two.speeds));
                let (margin, growth) = (linear.long_wave_margin(), linear.fastest(1000).0);
                rows.push(row![model.name(), widening, strength, speed, linear.phi, margin, growth, std, off]);
            }
        }
    }
    Ok(rows)
}

/// The acceleration of a pair with gap 2.5 and equal speeds `v` about `-1 / a_v`, where `a_n + a_{n+1} = 0`.
fn negative() -> Rows {
    let mut rows = Rows::new(&["law", "v", "space", "room", "acceleration"]);
    let a_v = 0.5;
    let logarithmic = Model::Logarithmic(Logarithmic { v0: 3.0, a_v, epsilon: 0.01 });
    for model in [algebraic(0.55, a_v), exponential(3.0, a_v), logarithmic] {
        for off in [1.0, 1e-1, 1e-3, 1e-6, 0.0, -1e-6, -1e-3, -1e-1, -1.0] {
            let v = -1.0 / a_v + off;
            let space = 2.0 + 2.0 * a_v * v;
            let acceleration = model.acceleration(2.5, v, v);
            let finite = acceleration.is_finite().then_some(acceleration);
            rows.push(row![model.name(), v, space, model.effective_gap(2.5, v, v), finite]);
        }
    }
    rows
}

/// Five pedestrians that start backwards, so fast that `a_n + a_{n+1} < 0`: they turn round and walk on, or not.
fn backwards() -> Result<Rows, Failure> {
    let mut rows =
        Rows::new(&["law", "state", "start_speed", "event", "t", "n", "gap", "least_speed_at_10", "uncertainty"]);
    let a_v = 0.5;
    let logarithmic = Model::Logarithmic(Logarithmic { v0: 1.0, a_v, epsilon: 0.01 });
    for model in [algebraic(0.55, a_v), exponential(1.0, a_v), logarithmic] {
        for speed in [-1.0, -4.0] {
            let ring = Ring { pedestrians: 5, length: 30.0 };
            let case = Case { model: model.clone(), ring, kind: StateVariables::Spacings };
            let start = gaps_state(&model, &[6.0, 5.5, 6.5, 6.0, 6.0], &[speed; 5], 0.0);
            let run = |(method, control)| case.run_from(&start, Leg { method, control, begin: 0.0, end: 10.0 });
            let [one, two] = two_methods(1e-12).map(run);
            let is_whole = one.stop.is_none() && two.stop.is_none();
            let least = one.speeds.iter().copied().fold(f64::INFINITY, math::smaller);
            let off = is_whole.then(|| difference(&one.state, &two.state));
            let stop = one.stop.as_ref();
            rows.push(row![
                model.name(),
                name(case.kind),
                speed,
                stop.map_or("none", |stop| stop.name),
                stop.map(|stop| stop.time),
                stop.map(|stop| stop.pedestrian),
                stop.map(|stop| stop.gap),
                is_whole.then_some(least),
                off
            ]);
        }
    }
    Ok(rows)
}
