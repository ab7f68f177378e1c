//! Runs a scene as its user would, and judges the result by the second integration.

use crate::answer::{Answer, Numbers};
use crate::bound::Bound;
use crate::question;
use crate::stated::{self, Stated};
use files::scene_file;
use jam::errors::{loses_shift, run_propagated};
use jam::events::{Event, EventKind};
use jam::run::{Broken, Outcome};
use jam::states::StateVariables;
use math::larger;
use reference::solution::{End, Kind, Question};
use scene::run::Scene;
use std::panic::catch_unwind;

/// The result of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    /// Of which panel.
    pub panel: String,
    /// The method and the length of steps, or the tolerance.
    pub method: String,
    /// How it ended, in a few words that are the same for all that ended so.
    pub ending: String,
    /// True errors over the errors that are allowed.
    pub ratios: Vec<Ratio>,
    /// True errors over those that the run states.
    pub stated: Vec<Ratio>,
    /// What it cost to know the errors that it states: right-hand sides over those of the run, and the latter.
    pub cost: Option<(f64, u64)>,
    /// What is wrong.
    pub findings: Vec<String>,
    /// What the second integration could not decide.
    pub undecided: Vec<String>,
}

/// A true error over the error that is allowed.
#[derive(Clone, Debug, PartialEq)]
pub struct Ratio {
    /// Of which number.
    pub what: &'static str,
    /// The true error.
    pub error: f64,
    /// That allowed.
    pub allowed: f64,
    /// That of the second integration, by its own account.
    pub uncertainty: f64,
    /// The largest size of such a number.
    pub range: f64,
}

impl Ratio {
    /// The quotient; 0 for 0 over 0.
    pub fn value(&self) -> f64 {
        if self.error == 0.0 { 0.0 } else { self.error / self.allowed }
    }
}

/// Judges every panel of a scene.
pub fn scene(text: &str) -> Vec<Verdict> {
    scene_as(text, text)
}

/// Judges every panel of a scene by what another text asks.
pub fn scene_as(text: &str, other: &str) -> Vec<Verdict> {
    match scene_file::parse("scene.toml", text) {
        Err(error) => {
            vec![Verdict { ending: "refused: not a scene".into(), findings: vec![error.to_string()], ..named("") }]
        }
        Ok(scene_file) => scene_file.panels.iter().map(|panel| judge_panel(other, panel)).collect(),
    }
}

fn named(panel: &str) -> Verdict {
    Verdict {
        panel: panel.to_owned(),
        method: String::new(),
        ending: String::new(),
        ratios: Vec::new(),
        stated: Vec::new(),
        cost: None,
        findings: Vec::new(),
        undecided: Vec::new(),
    }
}

fn judge_panel(text: &str, panel: &scene_file::Panel) -> Verdict {
    let mut verdict = named(&panel.name);
    let question = match question::read(text, &panel.name) {
        Ok(question) => question,
        Err(problem) => {
            verdict.undecided.push(problem);
            return verdict;
        }
    };
    let scene = match scene::run::read("scene.toml", &panel.tables) {
        Ok(scene) => scene,
        Err(error) => {
            refused(&mut verdict, &error.to_string(), &question);
            return verdict;
        }
    };
    verdict.method = format!("{} {:?} {:?}", scene.method.name(), scene.control, scene.form);
    match catch_unwind(|| run_propagated(&scene, &mut ())) {
        Err(_) => {
            verdict.ending = "panicked".into();
            verdict.findings.push("the run panicked".into());
        }
        Ok((made, propagated)) => {
            let (outcome, broken) = match made {
                Ok(outcome) => (outcome, None),
                Err(broken) => (*broken.outcome.clone(), Some(broken)),
            };
            let (refused, stated) = stated::of(&scene, &outcome, &propagated);
            let broken = refused.or(broken);
            let outcome = broken.as_ref().map_or(&outcome, |broken| &*broken.outcome);
            ended(&mut verdict, &scene, outcome, broken.as_ref(), (question, &stated));
        }
    }
    verdict
}

/// Refusals that the generator provokes.
fn refused(verdict: &mut Verdict, problem: &str, question: &Question) {
    let known = [
        ("no uniform flow", "refused: no uniform flow"),
        ("positions have no series", "refused: taylor has no series"),
        ("closes a gap", "refused: shift closes a gap"),
        ("gaps are closed", "refused: closed gaps"),
        ("give either dt or tolerance", "refused: dt and tolerance"),
        ("a run cannot continue", "refused: no run continues from an overlap"),
        ("several steady speeds", "refused: several steady speeds"),
    ];
    let class = known.iter().find(|(words, _)| problem.contains(words));
    verdict.ending = class.map_or("refused: other", |(_, class)| class).into();
    if class.is_none() {
        verdict.findings.push(format!("refused: {problem}"));
    }
    if problem.contains("no uniform flow") && has_uniform_flow(question) {
        verdict.findings.push(format!("there is a uniform flow: {problem}"));
    }
}

/// Whether the acceleration of the uniform flow falls through 0 at some speed with room, looked for decade by decade.
fn has_uniform_flow(question: &Question) -> bool {
    let headway = question.length / question.pedestrians as f64;
    let formula = &question.formula;
    let ramp = &mut |x, epsilon| reference::formula::smooth_ramp(x, epsilon);
    let speeds = (-1200_i32..=1200).map(|i| {
        let size = math::pow(10.0, f64::from(i.abs()) / 100.0) - 1.0;
        if i < 0 { -size * formula.desired_speed() } else { formula.desired_speed() * (f64::from(i) / 1200.0) }
    });
    let pushes: Vec<bool> = speeds
        .filter(|v| formula.room(|_| headway, |_| *v) > 0.0)
        .map(|v| formula.acceleration(|_| headway, |_| v, ramp) > 0.0)
        .collect();
    pushes.windows(2).any(|pair| pair[0] && !pair[1])
}

trait Fixed {
    fn is_fixed(&self) -> bool;
}

impl Fixed for Scene {
    fn is_fixed(&self) -> bool {
        matches!(self.control, ode::Control::Fixed { .. })
    }
}

/// A run with tables: are they right, and is its end?
fn ended(
    verdict: &mut Verdict,
    scene: &Scene,
    outcome: &Outcome,
    broken: Option<&Broken>,
    (mut question, stated): (Question, &Stated),
) {
    verdict.ending = ending(scene, outcome, broken);
    question.times = times(scene, outcome);
    // what comes after the end tells whether there is a reason for it
    let is_undefined = outcome.events.iter().any(|happening| happening.kind == EventKind::Undefined);
    if broken.is_some() || is_blown_up(outcome) || is_undefined {
        question.times.push(scene.t_end);
    }
    verdict.cost = Some((stated.cost, outcome.statistics.evaluations));
    // what faster numbers cannot decide, better ones are asked
    for numbers in [Numbers::Doubles, Numbers::DoubleDouble] {
        let answer = Answer::new(&question, numbers);
        if numbers == Numbers::Doubles || answer.is_settled(outcome.statistics.time) {
            verdict.ratios.clear();
            verdict.stated.clear();
            verdict.findings.clear();
            verdict.undecided.clear();
            let bound = Bound::new(stated);
            compare(verdict, scene, outcome, &answer, &bound);
            if broken.is_none() {
                verdict.stated = stated::ratios(scene, outcome, &answer, stated);
            }
            if let Some(broken) = broken {
                reason(verdict, scene, broken, &answer);
            }
        }
        if verdict.undecided.is_empty() || answer.solution.end == End::Unfinished {
            return;
        }
    }
}

/// The end in a few words: how far it came, its kinds of events.
fn ending(scene: &Scene, outcome: &Outcome, broken: Option<&Broken>) -> String {
    let mut kinds: Vec<&str> = Vec::new();
    for happening in &outcome.events {
        if !kinds.contains(&happening.kind.name()) {
            kinds.push(happening.kind.name());
        }
    }
    let end = match broken {
        Some(broken) => format!("failed: {}", broken.failure.name()),
        None if outcome.statistics.time >= scene.t_end => "ran to t_end".to_owned(),
        None => "ended".to_owned(),
    };
    let beyond = if is_beyond(scene, outcome) { ", by a step over the wall" } else { "" };
    if kinds.is_empty() { format!("{end}{beyond}") } else { format!("{end}: {}{beyond}", kinds.join(", ")) }
}

/// A run that could not continue: is the reason in the equations, or in the user's settings?
fn reason(verdict: &mut Verdict, scene: &Scene, broken: &Broken, answer: &Answer) {
    let Answer { solution, .. } = answer;
    // a run that is not confirmed has gone on beyond where it should have ended
    let is_unconfirmed = matches!(broken.failure, ode::Failure::NotConfirmed { .. });
    let time = if is_unconfirmed { scene.t_end } else { 1.001 * broken.outcome.statistics.time };
    let is_own = match broken.failure {
        ode::Failure::TooManySteps { .. } => true,
        ode::Failure::NotFinite { .. } => scene.is_fixed(),
        // spacings that lose the shift show a uniform flow, whatever the steps; a loose tolerance leads out of the domain of a
        // formula that the solution does not leave
        ode::Failure::NotConfirmed { .. } => {
            let is_lost_by_error = scene.model.may_be_undefined() && solution.end == End::Reached;
            scene.is_fixed() || loses_shift(scene) || is_lost_by_error
        }
        _ => false,
    };
    let ends_there = matches!(solution.end, End::Singular | End::BlownUp) && solution.time <= time;
    // positions tell no room below their rounding; before a blow-up that rounding throws pedestrians about
    let (room, when) = solution.least[0];
    let is_rounding = |room: f64| room < 1e-10 * scene.ring.length;
    let own = broken.narrowest.is_some_and(|place| is_rounding(place.effective_gap));
    let blows_up = matches!(solution.end, End::Singular | End::BlownUp);
    let sees_none = when <= time && is_rounding(room) || own && blows_up;
    let is_blind = scene.form == StateVariables::Positions && sees_none;
    if !is_own && !ends_there && !is_blind {
        let text = format!(
            "{broken}; the second integration goes on: {:?} at t = {:?} with speeds up to {:e}",
            solution.end, solution.time, solution.fastest
        );
        let is_known = solution.time > time;
        if is_known { verdict.findings.push(text) } else { verdict.undecided.push(text) }
    }
}

/// Whether the run ended in a blow-up.
pub fn is_blown_up(outcome: &Outcome) -> bool {
    outcome.events.iter().any(|happening| happening.kind == EventKind::BlowUp)
}

/// The times of the rows, and the end, unless a step was too long for a wall: what is right after it is no question.
pub fn times(scene: &Scene, outcome: &Outcome) -> Vec<f64> {
    let mut times: Vec<f64> = outcome.samples.times.iter().copied().filter(|t| *t > 0.0).collect();
    let end = outcome.statistics.time;
    // a last row may lie a rounding after the end
    if !is_beyond(scene, outcome) && !times.contains(&end) && end > 0.0 {
        times.push(end);
        times.sort_by(f64::total_cmp);
    }
    times
}

/// Whether a fixed step went through a singular force, which no solution does.
pub fn is_beyond(scene: &Scene, outcome: &Outcome) -> bool {
    let is_over = |happening: &Event| happening.kind == EventKind::Overlap;
    scene.model.is_singular() && scene.is_fixed() && outcome.events.iter().any(is_over)
}

/// The comparison of one number.
struct Compared {
    what: &'static str,
    time: f64,
    found: f64,
    right: f64,
    uncertainty: f64,
    allowed: f64,
    range: f64,
}

impl Compared {
    fn note(self, verdict: &mut Verdict) {
        let Compared { what, time, found, right, uncertainty, allowed, range } = self;
        let error = (found - right).abs();
        if allowed.is_infinite() {
            return;
        }
        if error <= allowed {
            if uncertainty > 0.5 * allowed {
                verdict
                    .undecided
                    .push(format!("{what} at {time:?}: allowed {allowed:e}, uncertain by {uncertainty:e}"));
            }
            verdict.ratios.push(Ratio { what, error, allowed, uncertainty, range });
        } else if error > 3.0 * uncertainty {
            verdict.findings.push(format!(
                "{what} at t = {time:?} is {found:?}, right is {right:?} (sure to {uncertainty:.1e}): off by {error:.2e}, allowed {allowed:.2e}"
            ));
            verdict.ratios.push(Ratio { what, error, allowed, uncertainty, range });
        } else {
            verdict.undecided.push(format!("{what} at {time:?}: off by {error:e}, uncertain by {uncertainty:e}"));
        }
    }
}

fn compare(verdict: &mut Verdict, scene: &Scene, outcome: &Outcome, answer: &Answer, bound: &Bound) {
    if !answer.is_settled(outcome.statistics.time) {
        let ends = (answer.solution.end, answer.second.end, answer.solution.time);
        verdict.undecided.push(format!("the second integration ends: {ends:?}"));
        return;
    }
    let pedestrians = scene.ring.pedestrians;
    let (std, trajectories) = (scene::tables::std(&outcome.samples), scene::tables::trajectories(&outcome.samples));
    let stds: Vec<&[f64]> = std.rows().collect();
    let trajectories: Vec<&[f64]> = trajectories.rows().collect();
    let range = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0_f64, |most, value| larger(most, value.abs()));
    let std_range = range(&mut stds.iter().map(|row| row[1]));
    let solution = &answer.solution;
    for (row, std) in stds.iter().enumerate().skip(1) {
        let time = std[0];
        let Some((right, twin)) = answer.at(time) else {
            if solution.time < time {
                verdict.findings.push(format!(
                    "a row at t = {time:?}, but the solution ends at {:?} ({:?})",
                    solution.time, solution.end
                ));
            }
            break;
        };
        Compared {
            what: "std",
            time,
            found: std[1],
            right: right.std,
            uncertainty: (right.std - twin.std).abs(),
            allowed: bound.std,
            range: std_range,
        }
        .note(verdict);
        if let Some(rows) = trajectories.get(row * pedestrians..(row + 1) * pedestrians) {
            let (x, v): (Vec<f64>, Vec<f64>) = rows.iter().map(|row| (row[2], row[3])).unzip();
            state(verdict, time, (&x, &v), right, twin, bound.table);
        }
    }
    // at a blow-up a rounding of the time is a large part of the speeds
    if let Some((right, twin)) = answer.at(outcome.statistics.time).filter(|_| !is_blown_up(outcome)) {
        state(verdict, right.time, (&outcome.positions, &outcome.speeds), right, twin, bound.end);
    }
    events(verdict, scene, outcome, answer, bound);
}

/// Half a unit in the last place of a time, relative.
const ULP: f64 = 1.2e-16;

/// Positions and speeds: the worst pedestrian.
fn state(
    verdict: &mut Verdict,
    time: f64,
    (x, v): (&[f64], &[f64]),
    right: &reference::solution::Sample,
    twin: &reference::solution::Sample,
    allowed: [f64; 2],
) {
    let largest = |a: &[f64], b: &[f64]| {
        a.iter()
            .zip(b)
            .map(|(a, b)| (a - b).abs())
            .fold(0.0, |most: f64, error| if error <= most { most } else { error })
    };
    let numbers = [
        ("position", x, &right.positions, &twin.positions, allowed[0]),
        ("speed", v, &right.speeds, &twin.speeds, allowed[1] + right.acceleration * ULP * time),
    ];
    for (what, found, right, twin, allowed) in numbers {
        let range = right.iter().fold(0.0_f64, |most, value| larger(most, value.abs()));
        let error = largest(found, right);
        Compared { what, time, found: error, right: 0.0, uncertainty: largest(right, twin), allowed, range }
            .note(verdict);
    }
}

/// What becomes negative in an event.
pub fn kind(event: EventKind) -> Option<Kind> {
    match event {
        EventKind::Overlap => Some(Kind::Overlap),
        EventKind::NegativeSpeed => Some(Kind::NegativeSpeed),
        EventKind::Exchange => Some(Kind::Exchange),
        EventKind::Undefined | EventKind::BlowUp => None,
    }
}

fn events(verdict: &mut Verdict, scene: &Scene, outcome: &Outcome, answer: &Answer, bound: &Bound) {
    if is_beyond(scene, outcome) {
        return;
    }
    for happening in &outcome.events {
        match kind(happening.kind) {
            Some(kind) => crossing(verdict, happening, kind, scene, answer, bound),
            None => blow_up(verdict, happening, answer, scene.ring.length, bound),
        }
    }
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
            let index = Kind::ALL.iter().position(|other| *other == kind).unwrap_or(0);
            let depth = answer.solution.least[index].0;
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

fn crossing(verdict: &mut Verdict, happening: &Event, kind: Kind, scene: &Scene, answer: &Answer, bound: &Bound) {
    let (name, found) = (kind.name(), happening.time);
    let crossings = answer.crossings(kind);
    let Some(&(_, time, uncertainty, rate)) = crossings.first() else {
        let index = Kind::ALL.iter().position(|other| *other == kind).unwrap_or(0);
        let (least, when) = answer.solution.least[index];
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
    let allowed = bound.moment(kind, rate) + 1e-9 * time + stated::FINEST * scene.t_end;
    Compared { what: "event", time, found, right: time, uncertainty, allowed, range: scene.t_end }.note(verdict);
    let is_first = crossings.iter().any(|(n, t, ..)| *n == happening.pedestrian && t - time <= 2.0 * allowed)
        || answer.solution.time - time <= 2.0 * allowed;
    if !is_first {
        let first: Vec<_> = crossings.iter().take(4).collect();
        verdict.findings.push(format!("{name} at t = {found:?} by {}; right: {first:?}", happening.pedestrian));
    }
}

/// Speeds double at every throw, so the end is as near as the ring is long over the speed reached.
fn blow_up(verdict: &mut Verdict, happening: &Event, answer: &Answer, length: f64, bound: &Bound) {
    let solution = &answer.solution;
    let found = happening.time;
    let allowed = length / larger(solution.fastest, 1.0) + 1e-6 * solution.time + bound.value(Kind::Overlap);
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
