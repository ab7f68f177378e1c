//! Events against those of the second integration: when, whose, at which spacing, and whether any is missed.

use super::numbers::Compared;
use super::{Verdict, is_beyond};
use crate::answer::Answer;
use crate::bound::{self, Bound};
use crate::stated::{self, Stated};
use jam::events::{Event, EventKind};
use jam::run::Outcome;
use math::larger;
use reference::solution::{Crossing, End, Kind};
use scene::run::Scene;

/// What becomes negative in an event.
pub fn kind(event: EventKind) -> Option<Kind> {
    match event {
        EventKind::Overlap => Some(Kind::Overlap),
        EventKind::NegativeSpeed => Some(Kind::NegativeSpeed),
        EventKind::Exchange => Some(Kind::Exchange),
        EventKind::Undefined | EventKind::BlowUp => None,
    }
}

/// Compares every event, with the error of its time that the run states.
pub(super) fn compare(
    verdict: &mut Verdict,
    scene: &Scene,
    outcome: &Outcome,
    answer: &Answer,
    (bound, stated): (&Bound, &Stated),
) {
    if is_beyond(scene, outcome) {
        return;
    }
    for (happening, &stated) in outcome.events.iter().zip(&stated.events) {
        let allowed = bound::FACTOR * stated;
        match kind(happening.kind) {
            Some(kind) => crossing(verdict, (happening, allowed), kind, scene, answer, bound),
            None => blow_up(verdict, (happening, allowed), answer, scene.ring.length, bound),
        }
    }
    missed(verdict, scene, outcome, answer, bound);
}

/// Events that the run does not name.
fn missed(verdict: &mut Verdict, scene: &Scene, outcome: &Outcome, answer: &Answer, bound: &Bound) {
    for kind in Kind::ALL {
        let crossings = answer.crossings(kind);
        let Some(&(pedestrian, time, _, rate)) = crossings.first() else { continue };
        let is_named = |n: usize| {
            let mut events = outcome.events.iter();
            events.any(|happening| happening.kind.name() == kind.name() && happening.pedestrian == n)
        };
        let at_start = crossings.iter().filter(|(_, time, _, rate)| *time < 1e-15 * scene.t_end && *rate > 1e-9);
        if let Some((n, ..)) = at_start.into_iter().find(|(n, ..)| !is_named(*n)) {
            verdict.findings.push(format!("{} by pedestrian {n} at the start is not reported", kind.name()));
        }
        let is_known = outcome.events.iter().any(|happening| happening.kind.name() == kind.name());
        let latest = outcome.statistics.time - bound.moment(kind, rate);
        if !is_known && time < latest {
            let depth = answer.least(kind).0;
            // a dip below 0 that is shallower than the error allowed
            let allowed = bound.value(kind);
            let text = format!(
                "no {} by pedestrian {pedestrian} at t = {time:?} (rate {rate:e}, least value {depth:e})",
                kind.name()
            );
            if depth.abs() > allowed { verdict.findings.push(text) } else { verdict.undecided.push(text) }
        }
    }
}

fn crossing(
    verdict: &mut Verdict,
    (happening, allowed): (&Event, f64),
    kind: Kind,
    scene: &Scene,
    answer: &Answer,
    bound: &Bound,
) {
    let (name, found) = (kind.name(), happening.time);
    let crossings = answer.crossings(kind);
    let Some(&(_, time, uncertainty, _)) = crossings.first() else {
        let (least, when) = answer.least(kind);
        let text = format!(
            "{name} at t = {found:?} by {}, but the least value is {least:e} at {when:?}",
            happening.pedestrian
        );
        let is_later = answer.solution.time < found;
        if is_later || least < bound.value(kind) {
            verdict.undecided.push(text);
        } else {
            verdict.findings.push(text);
        }
        return;
    };
    // the second integration finds no crossing more exactly
    let allowed = allowed + stated::FINEST * scene.t_end;
    Compared { what: "event", time, found, right: time, uncertainty, allowed, range: scene.t_end }.note(verdict);
    if let Some(crossings) = answer.crossing(kind, happening.pedestrian) {
        gap((happening, allowed), crossings, bound, scene.ring.headway()).note(verdict);
    }
    let is_first = crossings.iter().any(|(n, t, ..)| *n == happening.pedestrian && t - time <= 2.0 * allowed)
        || answer.solution.time - time <= 2.0 * allowed;
    if !is_first {
        let first: Vec<_> = crossings.iter().take(4).collect();
        verdict.findings.push(format!("{name} at t = {found:?} by {}; right: {first:?}", happening.pedestrian));
    }
}

/// The spacing at an event beside that of the second integration and of its twin: as exact as positions are, at a time
/// as exact as it is.
fn gap(
    (happening, allowed): (&Event, f64),
    (right, twin): (&Crossing, &Crossing),
    bound: &Bound,
    headway: f64,
) -> Compared {
    Compared {
        what: "gap",
        time: happening.time,
        found: happening.gap,
        right: right.spacing,
        uncertainty: (right.spacing - twin.spacing).abs(),
        allowed: bound.value(Kind::Exchange) + right.opening.abs() * allowed,
        range: headway,
    }
}

/// Speeds double at every throw, so the end is as near as the ring is long over the speed reached.
fn blow_up(verdict: &mut Verdict, (happening, allowed): (&Event, f64), answer: &Answer, length: f64, bound: &Bound) {
    let solution = &answer.solution;
    let found = happening.time;
    let allowed = length / larger(solution.fastest, 1.0) + ITS_OWN * solution.time + allowed;
    let is_end = matches!(solution.end, End::BlownUp | End::Singular);
    if !is_end || (found - solution.time).abs() > allowed {
        let text = format!(
            "blow-up at t = {found:?}; right: {:?} at {:?} with speeds of {:e}",
            solution.end, solution.time, solution.fastest
        );
        let is_unfinished = solution.end == End::Unfinished && solution.time < found + allowed;
        // a run whose own error leads it out of the domain of its formula, and whose second run does not follow
        let is_unsure = happening.kind == EventKind::Undefined && bound.std.is_infinite();
        let is_unknown = is_unfinished || is_unsure;
        if is_unknown { verdict.undecided.push(text) } else { verdict.findings.push(text) }
    }
}

/// The part of the time of a blow-up to which the second integration knows it.
const ITS_OWN: f64 = 1e-6;
