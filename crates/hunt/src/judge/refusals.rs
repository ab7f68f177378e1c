//! Refusals: of scenes, and of runs that do not go on. A run may end without an event where the solution does, or with
//! advice that is true: whoever follows it gets further.

use super::{Fixed, Verdict};
use crate::answer::Answer;
use jam::errors::{loses_shift, stated};
use jam::run::{Broken, fitting};
use jam::states::StateVariables;
use ode::{Control, Failure};
use reference::solution::{End, Question};
use scene::run::Scene;

/// Refusals of scenes that the generator provokes.
pub(super) fn of_scene(verdict: &mut Verdict, problem: &str, question: &Question) {
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

/// A run that does not go on: is the reason in the equations, or in the user's settings?
pub(super) fn of_run(verdict: &mut Verdict, scene: &Scene, broken: &Broken, answer: &Answer) {
    let Answer { solution, .. } = answer;
    // a run that is not confirmed has gone on beyond where it should have ended
    let is_unconfirmed = matches!(broken.failure, Failure::NotConfirmed { .. });
    let time = if is_unconfirmed { scene.t_end } else { 1.001 * broken.outcome.statistics.time };
    let ends_there = matches!(solution.end, End::Singular | End::BlownUp) && solution.time <= time;
    if ends_there || is_lost_by_settings(scene, broken, answer) || is_advice_true(scene, broken) {
        return;
    }
    let text = format!(
        "{broken}; the second integration goes on: {:?} at t = {:?} with speeds up to {:e}",
        solution.end, solution.time, solution.fastest
    );
    let is_known = solution.end == End::Reached || solution.time > time;
    if is_known { verdict.findings.push(text) } else { verdict.undecided.push(text) }
}

/// Whether the user asked for what cannot go on: too long steps of fixed length, spacings for a shift that they lose, a
/// tolerance that leads out of the domain of a formula which the solution does not leave.
fn is_lost_by_settings(scene: &Scene, broken: &Broken, answer: &Answer) -> bool {
    match broken.failure {
        Failure::NotFinite { .. } => scene.is_fixed(),
        Failure::NotConfirmed { .. } => {
            let is_lost_by_error = scene.model.may_be_undefined() && answer.solution.end == End::Reached;
            scene.is_fixed() || loses_shift(scene) || is_lost_by_error
        }
        _ => false,
    }
}

/// Whether the run gets further if its advice is followed.
pub fn is_advice_true(scene: &Scene, broken: &Broken) -> bool {
    let Some(advice) = broken.advice else { return false };
    let reached = broken.outcome.statistics.time;
    advised(scene, advice).iter().any(|scene| {
        let time = match stated(scene) {
            Ok((outcome, _)) => outcome.statistics.time,
            Err(broken) => broken.outcome.statistics.time,
        };
        time > (1.0 + FURTHER) * reached
    })
}

/// The scenes of whoever follows an advice, one after the other.
fn advised(scene: &Scene, advice: &str) -> Vec<Scene> {
    let mut all = Vec::new();
    if advice.contains("deviations") {
        let form = fitting(Some(StateVariables::Deviations), &scene.model, scene.ring, scene.steady_speed);
        all.push(Scene { form, ..scene.clone() });
    }
    if let Control::Adaptive { tolerance } = scene.control {
        let at = |tolerance: f64| Scene { control: Control::Adaptive { tolerance }, ..scene.clone() };
        if advice.contains("smaller tolerance") {
            let smaller = [1e-2, 1e-4, 1e-6].map(|part| part * tolerance);
            all.extend(smaller.into_iter().filter(|tolerance| *tolerance > LEAST).map(at));
        }
        if advice.contains("raise") && advice.contains("the tolerance") {
            all.extend([1e2, 1e4].map(|times| at(math::smaller(times * tolerance, LARGEST))));
        }
        if advice.contains("most_steps") {
            all.push(Scene { most_steps: MORE * scene.most_steps, ..scene.clone() });
        }
    }
    all
}

/// A run that gets further by less than this part gets no further.
const FURTHER: f64 = 1e-6;
/// Tolerances that people choose.
const LEAST: f64 = 1e-14;
const LARGEST: f64 = 1e-2;
/// What `most_steps` is raised by.
const MORE: u64 = 4;
