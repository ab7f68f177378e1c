//! A run with its correct values, for a third integration by `checks/hunt.py`.

use crate::answer::{Answer, Numbers};
use crate::bound::Bound;
use crate::{draw, judge, question, stated};
use files::scene_file;
use jam::errors::run_propagated;
use reference::solution::Kind;
use serde_json::{Value, json};

/// Smaller shifts, as parts of the headway, are lost beside the spacings.
const LEAST_SHIFT: f64 = 1e-7;

/// The runs of a scene that end well, as the first and the second integration have them.
pub fn of(seed: u64) -> Vec<Value> {
    let text = draw::scene(seed);
    let Ok(scene_file) = scene_file::parse("scene.toml", &text) else { return Vec::new() };
    scene_file.panels.iter().filter_map(|panel| case(seed, &text, panel)).collect()
}

fn case(seed: u64, text: &str, panel: &scene_file::Panel) -> Option<Value> {
    let scene = scene::run::read("scene.toml", &panel.tables).ok()?;
    let (made, propagated) = run_propagated(&scene, &mut ());
    let outcome = made.ok()?;
    let (refused, stated) = stated::of(&scene, &outcome, &propagated);
    if refused.is_some() {
        return None;
    }
    let mut question = question::read(text, &panel.name).ok()?;
    question.times = judge::times(&scene, &outcome);
    let answer = Answer::new(&question, Numbers::Doubles);
    // what a comment says, a third reader of the scene does not see
    let is_visible = question.displacements.is_empty() && scene.start.shift.abs() > LEAST_SHIFT * scene.ring.headway();
    if !is_visible || !answer.is_settled(outcome.statistics.time) {
        return None;
    }
    let end = outcome.statistics.time;
    let (right, _) = answer.at(end)?;
    let bound = Bound::new(&stated);
    let std = scene::tables::std(&outcome.samples);
    let rows: Vec<&[f64]> = std.rows().filter(|row| row[0] > 0.0).collect();
    let right_std: Vec<f64> = rows.iter().filter_map(|row| Some(answer.at(row[0])?.0.std)).collect();
    let events: Vec<Value> = outcome
        .events
        .iter()
        .map(|happening| json!([happening.kind.name(), happening.time, happening.pedestrian]))
        .collect();
    let right_events: Vec<Value> = Kind::ALL
        .into_iter()
        .filter_map(|kind| answer.crossings(kind).first().map(|(n, t, ..)| json!([kind.name(), t, n])))
        .collect();
    Some(json!({
        "seed": seed,
        "panel": panel.name,
        "text": text,
        "times": rows.iter().map(|row| row[0]).collect::<Vec<f64>>(),
        "end": end,
        "first": {
            "std": rows.iter().map(|row| row[1]).collect::<Vec<f64>>(),
            "x": outcome.positions,
            "v": outcome.speeds,
                        "events": events,
        },
        "second": { "std": right_std, "x": right.positions, "v": right.speeds, "events": right_events },
        "allowed": { "std": bound.std, "x": bound.end[0], "v": bound.end[1] },
    }))
}
