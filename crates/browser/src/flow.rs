//! Small waves on the uniform flow of a scene: growth rate against wave number, stability margin, verdict.

use crate::given::{FILE, complaint, panel};
use scene::run::Scene;
use scene::{summary, uniform::stability};
use serde_json::{Value, json};
use std::f64::consts::PI;

/// Largest number of a ring's waves that are listed; for larger rings the curve suffices.
const MOST_WAVES: usize = 500;

/// For a scene: `speed` of the uniform flow, `uniform_flow` as in `summary.json`, `k` and `rate` (`Re z^+`) for a
/// number of wave numbers in (0, pi], `waves` of its ring with `k` and `rate`, and `error`, the largest change of a
/// rate by a step of Newton's method. Without a uniform flow with a linear response the last four are null.
///
/// # Errors
/// The scene is wrong; see [`complaint`].
pub fn of(text: &str, count: usize) -> Result<Value, Value> {
    let panel = panel(text)?;
    let scene = scene::run::read_unrun(FILE, &panel.tables).map_err(|error| complaint(&error))?;
    let flow = stability(&scene);
    let rates =
        rates(&scene, count).unwrap_or_else(|| json!({ "k": null, "rate": null, "waves": null, "error": null }));
    let mut told = json!({ "speed": scene.steady_speed, "uniform_flow": summary::of_flow(flow.as_ref()) });
    if let (Value::Object(told), Value::Object(rates)) = (&mut told, rates) {
        told.extend(rates);
    }
    Ok(told)
}

fn rates(scene: &Scene, count: usize) -> Option<Value> {
    let (headway, pedestrians) = (scene.ring.headway(), scene.ring.pedestrians);
    let response = scene.model.response(headway, scene.steady_speed?)?;
    let largest = |a: f64, b: f64| if b > a { b } else { a };
    let mut error = 0.0;
    let mut over = |numbers: Vec<f64>| {
        let rates: Vec<f64> = numbers.iter().map(|k| response.growth_rate(*k)).collect();
        let pairs = numbers.iter().zip(&rates);
        error = pairs.map(|(k, rate)| (response.refined_growth_rate(*k) - rate).abs()).fold(error, largest);
        (numbers, rates)
    };
    let (k, rate) = over((1..=count).map(|i| PI * i as f64 / count as f64).collect());
    let waves = if pedestrians <= MOST_WAVES { pedestrians / 2 } else { 0 };
    let (on_ring, on_ring_rate) = over((1..=waves).map(|wave| 2.0 * PI * wave as f64 / pedestrians as f64).collect());
    Some(json!({ "k": k, "rate": rate, "waves": { "k": on_ring, "rate": on_ring_rate }, "error": error }))
}
