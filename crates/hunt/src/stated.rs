//! The errors that a run states, compared with its true errors.

use crate::answer::Answer;
use crate::judge::{Ratio, is_beyond, is_blown_up, kind};
use jam::errors;
use jam::errors::Propagated;
use jam::run::{Broken, Outcome, run};
use jam::states::StateVariables;
use ode::{Control, Method};
use scene::run::Scene;

/// The errors that a run states. Infinite: it states none.
#[derive(Clone, Debug, PartialEq)]
pub struct Stated {
    /// The largest of the standard deviations in the table.
    pub std: f64,
    /// The largest of the positions and of the speeds in the table.
    pub table: [f64; 2],
    /// The largest of the positions and of the speeds at the end.
    pub end: [f64; 2],
    /// Of the time of each event.
    pub events: Vec<f64>,
    /// What it cost to know them: right-hand sides over those of the run.
    pub cost: f64,
}

/// True errors over stated ones: of std, of positions and speeds at the end, of the time of each event.
pub fn ratios(scene: &Scene, outcome: &Outcome, answer: &Answer, stated: &Stated) -> Vec<Ratio> {
    let end = outcome.statistics.time;
    if is_beyond(scene, outcome) || !answer.is_settled(end) {
        return Vec::new();
    }
    let mut ratios = Vec::new();
    let rows: Vec<_> =
        outcome.samples.iter().filter_map(|sample| Some((sample.std, answer.at(sample.time)?))).collect();
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
            ("final positions", &outcome.positions, &right.positions, &twin.positions, stated.end[0]),
            ("final speeds", &outcome.speeds, &right.speeds, &twin.speeds, stated.end[1]),
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
        let Some(kind) = kind(happening.kind) else { continue };
        let crossings = answer.crossings(kind);
        // of everybody, the first one: who it is, is another question
        if let Some((_, time, uncertainty, _)) = crossings.into_iter().next() {
            let off = (happening.time - time).abs();
            // the second integration finds no crossing more exactly, at the start of its first step above all
            let error = if off < FINEST * scene.t_end { 0.0 } else { off };
            ratios.push(Ratio { what: "events", error, allowed: *allowed, uncertainty, range: scene.t_end });
        }
    }
    // what the second integration does not know well enough says nothing
    ratios.retain(|ratio| {
        ratio.allowed.is_infinite() || ratio.uncertainty <= 0.1 * math::larger(ratio.error, ratio.allowed)
    });
    ratios
}

/// The part of a run that places within steps are known to: half a rounding.
pub(crate) const FINEST: f64 = 1e-16;

/// What a run states, and the run up to there if its check does not confirm all of it; of the table of trajectories, of
/// which it states nothing, the difference from a second run.
pub fn of(scene: &Scene, outcome: &Outcome, propagated: &Propagated) -> (Option<Broken>, Stated) {
    let (errors, refused) = errors::checked(scene, outcome, Some(propagated), &mut (), &mut ());
    let cost = errors.cost;
    let outcome = refused.as_ref().map_or(outcome, |broken| &*broken.outcome);
    let or_none = |error: Option<f64>| error.unwrap_or(f64::INFINITY);
    let end = [or_none(errors.positions), or_none(errors.speeds)];
    let table = difference(scene, outcome).table;
    // the last row of the table is the end; two methods may agree by chance. A run whose check ended elsewhere states
    // nothing
    let with_end = |i: usize| match errors.std {
        None => f64::INFINITY,
        Some(_) if end[i].is_finite() => math::larger(table[i], end[i]),
        Some(_) => table[i],
    };
    let table = [with_end(0), with_end(1)];
    let events = errors.events.into_iter().map(or_none).collect();
    (refused, Stated { std: or_none(errors.std), end, events, table, cost })
}

/// A run's difference from a second one by the same code, by extrapolation (`dop853` if it is that) at a
/// tenth of the tolerance, or with half the step; and the roundings that both have in common.
fn difference(scene: &Scene, outcome: &Outcome) -> Stated {
    let end = outcome.last_step;
    let mut other = Scene { t_end: end, ..scene.clone() };
    let factor = match scene.control {
        Control::Adaptive { tolerance } => {
            let tighter = 0.1 * tolerance;
            // rounding may keep a tighter tolerance from ever being met
            other.most_steps = outcome.statistics.evaluations / 16 + 1000;
            other.method = if scene.method == Method::Extrapolation { Method::Dop853 } else { Method::Extrapolation };
            other.control = Control::Adaptive { tolerance: if tighter > 1e-15 { tighter } else { 1e-15 } };
            1.0
        }
        Control::Fixed { step } => {
            // a step longer than the run is cut
            other.control = Control::Fixed { step: 0.5 * if step < scene.t_end { step } else { scene.t_end } };
            2.0
        }
    };
    let other = match run(&other) {
        Ok(other) => other,
        Err(broken) => *broken.outcome,
    };
    let is_whole = if outcome.ends_at_event() { other.ends_at_event() } else { other.statistics.time == end };
    let apart = |a: &[f64], b: &[f64]| {
        if a.len() > b.len() { f64::INFINITY } else { factor * largest(a.iter().zip(b).map(|(a, b)| a - b)) }
    };
    let (stds, other_stds) = (&outcome.samples.std, &other.samples.std);
    let (x, v) = (largest(outcome.positions.iter().copied()), largest(outcome.speeds.iter().copied()));
    // of what std is the difference of, and of positions in every fixed step
    let shared = if scene.form == StateVariables::Deviations { largest(stds.iter().copied()) } else { v };
    let gathered = match scene.control {
        Control::Fixed { .. } => 0.5 * f64::EPSILON * outcome.statistics.steps as f64,
        Control::Adaptive { .. } => 0.0,
    };
    let events = outcome.events.iter().map(|happening| {
        let is_twin =
            |twin: &&jam::events::Event| (twin.kind, twin.pedestrian) == (happening.kind, happening.pedestrian);
        let twin = other.events.iter().find(is_twin);
        twin.map_or(f64::INFINITY, |twin| factor * (twin.time - happening.time).abs() + ROUNDING * happening.time)
    });
    let rounded = [(ROUNDING + gathered) * x, ROUNDING * v];
    let (samples, others) = (&outcome.samples, &other.samples);
    let table = [apart(&samples.positions, &others.positions), apart(&samples.speeds, &others.speeds)];
    let ends = [apart(&outcome.positions, &other.positions), apart(&outcome.speeds, &other.speeds)];
    Stated {
        std: apart(stds, other_stds) + ROUNDING * shared + f64::MIN_POSITIVE,
        table: [table[0] + rounded[0], table[1] + rounded[1]],
        end: if is_whole { [ends[0] + rounded[0], ends[1] + rounded[1]] } else { [f64::INFINITY; 2] },
        events: events.collect(),
        cost: f64::NAN,
    }
}

/// A few roundings.
const ROUNDING: f64 = 1e-15;

/// The largest in size; NaN if there is one.
pub(crate) fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, |largest, value| if value.abs() <= largest || largest.is_nan() { largest } else { value.abs() })
}
