//! How honest the errors are that a run states.

use crate::answer::Answer;
use crate::judge::{Ratio, is_beyond, is_blown_up, kind};
use jam::states::FormKind;
use ode::{Control, Method};
use scene::run::Scene;
use scene::simulation::{Outcome, run};

/// The errors that a run states.
#[derive(Clone, Debug, PartialEq)]
struct Stated {
    /// The largest of the standard deviations in the table.
    std: f64,
    /// The largest of the positions at the end.
    position: f64,
    /// The largest of the speeds at the end.
    speed: f64,
    /// Of the time of each event.
    events: Vec<f64>,
}

/// True errors over stated ones: of std, of positions and speeds at the end, of the first event of each kind.
pub fn ratios(scene: &Scene, outcome: &Outcome, answer: &Answer) -> Vec<Ratio> {
    let end = outcome.statistics.time;
    if is_beyond(scene, outcome) || !answer.is_settled(end) {
        return Vec::new();
    }
    let Some(stated) = stated(scene, outcome) else { return Vec::new() };
    let mut ratios = Vec::new();
    let rows: Vec<_> = outcome.std.rows().filter_map(|row| Some((row[1], answer.at(row[0])?))).collect();
    if !rows.is_empty() {
        ratios.push(Ratio {
            what: "std",
            error: largest(rows.iter().map(|(found, (right, _))| found - right.std)),
            allowed: stated.std,
            uncertainty: largest(rows.iter().map(|(_, (right, twin))| right.std - twin.std)),
            range: largest(rows.iter().map(|(_, (right, _))| right.std)),
        });
    }
    if let Some((right, twin)) = answer.at(end).filter(|_| !is_blown_up(outcome)) {
        let states = [
            ("final positions", &outcome.positions, &right.positions, &twin.positions, stated.position),
            ("final speeds", &outcome.speeds, &right.speeds, &twin.speeds, stated.speed),
        ];
        for (what, found, right, twin, allowed) in states {
            ratios.push(Ratio {
                what,
                error: largest(found.iter().zip(right).map(|(a, b)| a - b)),
                allowed,
                uncertainty: largest(right.iter().zip(twin).map(|(a, b)| a - b)),
                range: largest(right.iter().copied()),
            });
        }
    }
    for (happening, allowed) in outcome.events.iter().zip(&stated.events) {
        let Some(kind) = kind(happening.event) else { continue };
        let crossings = answer.crossings(kind);
        if let Some((_, time, uncertainty, _)) = crossings.into_iter().find(|(n, ..)| *n == happening.pedestrian) {
            let error = (happening.time - time).abs();
            ratios.push(Ratio { what: "events", error, allowed: *allowed, uncertainty, range: scene.t_end });
        }
    }
    // what the second integration does not know well enough says nothing
    ratios.retain(|ratio| ratio.uncertainty <= 0.1 * ratio.error.max(ratio.allowed));
    ratios
}

/// A second run of the first integration: by extrapolation at a tenth of the tolerance, or with half the step.
fn stated(scene: &Scene, outcome: &Outcome) -> Option<Stated> {
    let mut other = scene.clone();
    match scene.control {
        Control::Adaptive { tolerance } => {
            let tighter = 0.1 * tolerance;
            other.method = if scene.method == Method::Extrapolation { Method::Dop853 } else { Method::Extrapolation };
            other.control = Control::Adaptive { tolerance: if tighter > 1e-15 { tighter } else { 1e-15 } };
        }
        // a step longer than the run is cut
        Control::Fixed { step } => {
            other.control = Control::Fixed { step: 0.5 * if step < scene.t_end { step } else { scene.t_end } };
        }
    }
    let other = run(&other).ok()?;
    let factor = if matches!(scene.control, Control::Fixed { .. }) { 2.0 } else { 1.0 };
    let apart = |a: &[f64], b: &[f64]| factor * largest(a.iter().zip(b).map(|(a, b)| a - b));
    let std = |outcome: &Outcome| outcome.std.rows().map(|row| row[1]).collect::<Vec<f64>>();
    let deviations = std(outcome);
    let (x, v) = (largest(outcome.positions.iter().copied()), largest(outcome.speeds.iter().copied()));
    // roundings that both runs have: of what std is the difference of, and of positions in every fixed step
    let shared = if scene.form == FormKind::Deviations { largest(deviations.iter().copied()) } else { v };
    let gathered = match scene.control {
        Control::Fixed { .. } => 0.5 * f64::EPSILON * outcome.statistics.steps as f64,
        Control::Adaptive { .. } => 0.0,
    };
    let events = outcome.events.iter().map(|happening| {
        let twin =
            other.events.iter().find(|twin| (twin.event, twin.pedestrian) == (happening.event, happening.pedestrian));
        twin.map_or(f64::INFINITY, |twin| factor * (twin.time - happening.time).abs() + ROUNDING * happening.time)
    });
    Some(Stated {
        std: apart(&deviations, &std(&other)) + ROUNDING * shared + f64::MIN_POSITIVE,
        position: apart(&outcome.positions, &other.positions) + (ROUNDING + gathered) * x,
        speed: apart(&outcome.speeds, &other.speeds) + ROUNDING * v,
        events: events.collect(),
    })
}

/// A few roundings.
const ROUNDING: f64 = 1e-15;

fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, |largest, value| if value.abs() <= largest { largest } else { value.abs() })
}
