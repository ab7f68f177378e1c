//! The JSON summary of a run or a map.

use crate::map::{Computed, Map};
use crate::run::Scene;
use crate::uniform::Stability;
use jam::errors::{self, Errors, Propagated};
use jam::outcome::{Decision, Verdict};
use jam::run::{Broken, Outcome, RunObserver};
use ode::Control;
use serde_json::{Value, json};

/// A run that has ended.
#[derive(Debug)]
pub struct FinishedRun {
    /// What it gave; of a run that broke, until then.
    pub outcome: Outcome,
    /// Why it went no further, if it broke.
    pub broken: Option<Broken>,
    /// Seconds of CPU in the integration, those before the run was killed included.
    pub seconds: f64,
    /// Steps that were taken from the checkpoint.
    pub resumed_steps: u64,
    /// The errors estimated by its steps, if they were requested from the start.
    pub propagated: Option<Propagated>,
}

impl FinishedRun {
    /// The errors of its numbers. Samples that the check does not confirm are left out, and the run then counts as one
    /// that broke there. `onlooker` sees a second run, if there is one, and `again` the run up to where it is
    /// confirmed.
    pub fn checked(&mut self, scene: &Scene, onlooker: &mut dyn RunObserver, again: &mut dyn RunObserver) -> Errors {
        let propagated = self.propagated.as_ref();
        let (errors, refused) = errors::checked(scene, &self.outcome, propagated, onlooker, again);
        if let Some(broken) = refused {
            self.outcome = *broken.outcome.clone();
            self.broken = Some(broken);
        }
        errors
    }
}

/// The contents of `summary.json` for a run.
pub fn of_run(scene: &Scene, ended: &FinishedRun, flow: Option<&Stability>, errors: Option<&Errors>) -> Value {
    let FinishedRun { outcome, broken, seconds, resumed_steps, .. } = ended;
    let control = match scene.control {
        Control::Fixed { step } => json!({ "dt": step }),
        Control::Adaptive { tolerance } => json!({ "tolerance": tolerance }),
    };
    let events: Vec<Value> = outcome
        .events
        .iter()
        .enumerate()
        .map(|(index, event)| {
            let mut told = json!({
                "event": event.kind.name(),
                "t": event.time,
                "n": event.pedestrian,
                "gap": event.gap,
                "step": event.step,
            });
            if let Some(errors) = errors {
                told["error"] = json!(errors.events[index]);
            }
            told
        })
        .collect();
    json!({
        "schema_version": 1,
        "law": scene.model.name(),
        "pedestrians": scene.ring.pedestrians,
        "length": scene.ring.length,
        "steady_speed": scene.steady_speed,
        "uniform_flow": of_flow(flow),
        "method": scene.method.name(),
        "control": control,
        "steps": outcome.statistics.steps,
        "resumed_steps": resumed_steps,
        "rejected": outcome.statistics.rejected,
        "right_hand_sides": outcome.statistics.evaluations,
        "seconds": seconds,
        "t": outcome.statistics.time,
        "stop": stop(outcome, broken.as_ref()),
        "reason": broken.as_ref().map(ToString::to_string),
        "events": events,
        "error": errors.map(|errors| json!({ "std": errors.std, "x": errors.positions, "v": errors.speeds })),
        "outcome": outcome.verdict.as_ref().map(of_verdict),
        "jams": scene.keeps_trajectories.then(|| jams(scene, outcome)),
    })
}

/// The outcome of a run, and its basis.
pub fn of_verdict(verdict: &Verdict) -> Value {
    let missing = match &verdict.decision {
        Decision::Missing(missing) => Some(missing),
        _ => None,
    };
    // a distance without bound has no number
    let distance = verdict.distance.is_finite().then_some(verdict.distance);
    json!({
        "class": verdict.class.name(),
        "t": verdict.time,
        "decided_by": verdict.decision.name(),
        "missing": missing,
        "backward_flow": verdict.backward_flow,
        "least_gap": verdict.least_gap,
        "least_speed": verdict.least_speed,
        "std": verdict.std,
        "wave_speed": verdict.wave_speed,
        "distance": distance,
    })
}

/// What ended the tables: an event, the end of the run, or the reason why it could not continue.
fn stop(outcome: &Outcome, broken: Option<&Broken>) -> &'static str {
    match (outcome.stop(), broken) {
        (Some(event), _) => event.kind.name(),
        (None, Some(broken)) => broken.failure.name(),
        (None, None) => "t_end",
    }
}

fn jams(scene: &Scene, outcome: &Outcome) -> Value {
    let extents: Vec<f64> = outcome.drift.jams().iter().map(|jam| jam.extent).collect();
    json!({
        "number": extents.len(),
        "extents": extents,
        "speed": outcome.drift.speed().map(|(speed, _)| speed),
        "speed_error": outcome.drift.speed_error(scene.ring.headway()),
        "measured_over": outcome.drift.speed().map(|(_, time)| time),
    })
}

/// The uniform flow; null if there is none, or none with a linear response.
pub fn of_flow(flow: Option<&Stability>) -> Value {
    flow.map_or(Value::Null, |flow| {
        json!({
            "stable": flow.margin < 0.0,
            "margin": flow.margin,
            "margin_on_ring": flow.margin_on_ring,
            "growing_k": flow.growing.first().zip(flow.growing.last()).map(|((least, _), (_, largest))| [least, largest]),
            "growing_bands": flow.growing,
            "growth_rate": flow.growth_rate,
            "waves": flow.waves,
        })
    })
}

/// Of a map, the panel `name` of its scene.
pub fn of_map(name: &str, map: &Map, computed: &Computed) -> Value {
    let [_, _, value] = map.columns();
    json!({
        "panel": name,
        "value": value,
        "cells": map.x.cells * map.y.cells,
        "unstable_share": computed.unstable_share(),
        "blank_share": computed.blank_share(),
        "blank_reason": computed.blank_reason(),
        "undefined_cells": computed.undefined,
        "error": computed.error,
    })
}
