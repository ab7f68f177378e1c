//! The outcome of one run for each preset of the algebraic law (tab:model), beyond the threshold of its uniform flow if
//! it has one.

use super::GAP;
use crate::hard::rows::{Rows, row};
use figures::failure::Failure;
use jam::laws::Model;
use jam::laws::presets::{PRESETS, Preset};
use jam::ring::{Ring, Start};
use jam::run::{Judging, run_from};
use jam::stability::Waves;
use jam::states::StateVariables;
use jam::uniform::{headway_of_gap, steady_speed};
use ode::{Control, Method};
use scene::run::{AtOverlap, Scene};

/// Pedestrians, as in the runs of the source.
const PEDESTRIANS: usize = 67;
/// The widening of presets that leave it open.
const WIDENING: f64 = 0.1;
/// How far beyond the threshold a run is.
const BEYOND: f64 = 1.15;
/// The threshold is searched on a grid of strengths up to this one.
const STEPS: u32 = 100;
const STRONGEST: f64 = 2.0;
/// The strength of the run of a preset whose uniform flow is stable with all of them.
const OTHERWISE: f64 = 1.0;

/// The rows of all presets.
///
/// # Errors
/// There is no uniform flow at the gap, or a run failed.
pub(super) fn table() -> Result<Rows, Failure> {
    let mut rows =
        Rows::new(&["preset", "mu", "delta", "q", "a_v", "margin", "outcome", "t", "least_gap", "least_speed", "std"]);
    for preset in PRESETS {
        let strength = match preset.mu {
            Some(strength) => strength,
            None => threshold(&preset)?.map_or(OTHERWISE, |threshold| BEYOND * threshold),
        };
        let law = preset.law(strength, WIDENING, 0.1, 3.0);
        let model = Model::Algebraic(law);
        let headway = headway_of_gap(&model, GAP).map_err(Failure::work)?;
        let scene = Scene {
            steady_speed: Some(steady_speed(&model, headway).map_err(Failure::work)?),
            model,
            ring: Ring { pedestrians: PEDESTRIANS, length: headway * PEDESTRIANS as f64 },
            start: Start { shift: 0.1 },
            displacements: Vec::new(),
            t_end: 6000.0,
            sample: 6000.0,
            method: Method::Dop853,
            control: Control::Adaptive { tolerance: 1e-8 },
            most_steps: 1_000_000_000,
            form: StateVariables::Spacings,
            keeps_trajectories: false,
            at_overlap: AtOverlap::Stop,
        };
        let outcome = run_from(&scene, None, &mut Judging::UntilCertain).map_err(Failure::work)?;
        let verdict = outcome.verdict.ok_or_else(|| Failure::work("a run without an outcome"))?;
        rows.push(row![
            preset.name,
            law.mu,
            law.delta,
            law.q,
            law.a_v,
            margin(&preset, strength)?,
            verdict.class.name(),
            verdict.time,
            verdict.least_gap,
            verdict.least_speed,
            verdict.std
        ]);
    }
    Ok(rows)
}

/// The margin of stability of the uniform flow of the ring at this strength.
fn margin(preset: &Preset, strength: f64) -> Result<f64, Failure> {
    let model = Model::Algebraic(preset.law(strength, WIDENING, 0.1, 3.0));
    let headway = headway_of_gap(&model, GAP).map_err(Failure::work)?;
    let speed = steady_speed(&model, headway).map_err(Failure::work)?;
    let response = model.response(headway, speed).ok_or_else(|| Failure::work("no linearised law"))?;
    Ok(response.margin(Waves::Ring(PEDESTRIANS)).0)
}

/// The least strength looked at whose uniform flow is unstable, halved down to the threshold; `None` if all are stable.
fn threshold(preset: &Preset) -> Result<Option<f64>, Failure> {
    let (mut low, mut high) = (0.0, f64::INFINITY);
    for step in 1..=STEPS {
        let strength = STRONGEST * f64::from(step) / f64::from(STEPS);
        if margin(preset, strength)? > 0.0 {
            high = strength;
            break;
        }
        low = strength;
    }
    if high.is_infinite() {
        return Ok(None);
    }
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        if margin(preset, middle)? > 0.0 { high = middle } else { low = middle }
    }
    Ok(Some(high))
}
