//! Runs a scene as its user would, and judges the result by the second integration: the numbers of the tables and of
//! the end ([`numbers`]), the events ([`events`]), and why a run was refused ([`refusals`]); and that a run which is
//! broken off and resumed is the same ([`resumed`]).

mod events;
pub mod numbers;
pub mod refusals;
mod resumed;

pub use events::kind;

use crate::answer::{Answer, Numbers};
use crate::bound::{self, Bound};
use crate::question;
use crate::stated::{self, Stated};
use files::scene_file;
use jam::errors::run_propagated;
use jam::events::{Event, EventKind};
use jam::run::{Broken, Outcome};
use reference::solution::{End, Question};
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
    /// The right-hand sides of the run.
    pub evaluations: u64,
    /// What it cost to know the errors that it states: right-hand sides over those of the run.
    pub cost: Option<f64>,
    /// Whether it was long enough to be broken off and resumed.
    pub is_resumed: bool,
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

/// The verdict on a panel of this name, of which nothing is known yet.
pub fn named(panel: &str) -> Verdict {
    Verdict {
        panel: panel.to_owned(),
        method: String::new(),
        ending: String::new(),
        ratios: Vec::new(),
        stated: Vec::new(),
        evaluations: 0,
        cost: None,
        is_resumed: false,
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
        Ok(scene) => Scene { displacements: question.displacements.clone(), ..scene },
        Err(error) => {
            refusals::of_scene(&mut verdict, &error.to_string(), &question);
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
            verdict.evaluations = outcome.statistics.evaluations;
            let (refused, stated) = stated::of(&scene, &outcome, &propagated);
            let broken = refused.or(broken);
            judged(&mut verdict, &scene, &outcome, broken.as_ref(), (question, &stated));
        }
    }
    verdict
}

/// A run that was made, with tables up to where it is confirmed: are they right, and is it the same if resumed?
pub fn judged(
    verdict: &mut Verdict,
    scene: &Scene,
    outcome: &Outcome,
    broken: Option<&Broken>,
    (question, stated): (Question, &Stated),
) {
    let until = broken.map_or(outcome, |broken| &*broken.outcome);
    ended(verdict, scene, until, broken, (question, stated));
    let resumed = resumed::compare(scene, outcome);
    verdict.is_resumed = resumed.is_some();
    verdict.findings.extend(resumed.and_then(Result::err));
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
    // whether an event that ends the run happens shows a little later
    if outcome.ends_at_event() {
        let late = stated.events.iter().copied().filter(|error| error.is_finite()).fold(0.0, math::larger);
        question.times.push(outcome.statistics.time * (1.0 + NEAR) + bound::FACTOR * late);
        question.times.sort_by(f64::total_cmp);
    }
    verdict.cost = Some(stated.cost);
    // what faster numbers cannot decide, better ones are asked
    for numbers in [Numbers::Doubles, Numbers::DoubleDouble] {
        let answer = Answer::new(&question, numbers);
        if numbers == Numbers::Doubles || answer.is_settled(outcome.statistics.time) {
            verdict.ratios.clear();
            verdict.stated.clear();
            verdict.findings.clear();
            verdict.undecided.clear();
            let bound = Bound::new(stated);
            is_whole(verdict, scene, outcome, broken);
            if answer.is_settled(outcome.statistics.time) {
                numbers::compare(verdict, scene, outcome, &answer, &bound);
                events::compare(verdict, scene, outcome, &answer, (&bound, stated));
            } else {
                let ends = (answer.solution.end, answer.second.end, answer.solution.time);
                verdict.undecided.push(format!("the second integration ends: {ends:?}"));
            }
            if broken.is_none() {
                verdict.stated = stated::ratios(scene, outcome, &answer, stated);
            }
            if let Some(broken) = broken {
                refusals::of_run(verdict, scene, broken, &answer);
            }
        }
        if verdict.undecided.is_empty() || answer.solution.end == End::Unfinished {
            return;
        }
    }
}

/// A run goes to its end, or there is an event or a reason; and it has a row for every multiple of the sampling
/// interval up to there.
pub fn is_whole(verdict: &mut Verdict, scene: &Scene, outcome: &Outcome, broken: Option<&Broken>) {
    let (time, stop) = (outcome.statistics.time, outcome.stop());
    if time < scene.t_end && stop.is_none() && broken.is_none() {
        verdict.findings.push(format!("ends at t = {time:?} without an event or a reason"));
    }
    // a row may lie on either side of an end that is a rounding away from it
    let end = stop.map_or(time, |stop| stop.time) / scene.sample;
    let rows = [1.0 - NEAR, 1.0 + NEAR].map(|part| (part * end).floor() + 1.0);
    let found = outcome.samples.len() as f64;
    if found < rows[0] || found > rows[1] {
        verdict.findings.push(format!("{found} rows up to t = {time:?}; should be {rows:?}"));
    }
}

/// The part of a time that is none.
const NEAR: f64 = 1e-9;

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
