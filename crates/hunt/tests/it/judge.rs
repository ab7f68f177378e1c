//! The judge detects faults: it is given a run and a scene that differs slightly from the one that was run.

use hunt::judge::numbers::Compared;
use hunt::judge::refusals::is_advice_true;
use hunt::judge::{self, Verdict};
use hunt::{draw, question, stated};
use jam::errors::run_propagated;
use jam::run::Outcome;
use scene::run::Scene;

const SCENE: &str = "title = \"two laws\"\n[law]\nkind = \"exponential\"\na = 3.0\nb = 1.5\nc = 4.0\na_v = 0.1\nepsilon = 0.01\nv0 = 1.2\n[ring]\npedestrians = 12\nlength = 36.0\n[start]\nshift = 0.3\n[run]\nmethod = \"dop853\"\ntolerance = 1e-12\nt_end = 20.0\nsample = 2.0\n";

fn judged_as(other: &str) -> Verdict {
    judge::scene_as(SCENE, other).pop().expect("a panel")
}

#[test]
fn a_right_run_is_right() {
    let verdict = judged_as(SCENE);
    assert!(verdict.findings.is_empty() && verdict.undecided.is_empty(), "{verdict:#?}");
    assert!(verdict.ratios.len() > 30 && verdict.ratios.iter().all(|ratio| ratio.value() <= 1.0), "{verdict:#?}");
}

#[test]
fn every_number_of_a_law_matters_to_the_judge() {
    let changes = [
        ("a = 3.0", "a = 3.000001"),
        ("b = 1.5", "b = 1.500001"),
        ("a_v = 0.1", "a_v = 0.10001"),
        ("v0 = 1.2", "v0 = 1.200001"),
        ("length = 36.0", "length = 36.00001"),
        ("shift = 0.3", "shift = 0.300001"),
        ("pedestrians = 12", "pedestrians = 13"),
    ];
    for (from, to) in changes {
        let other = SCENE.replace(from, to);
        assert_ne!(other, SCENE, "{from}");
        assert!(!judged_as(&other).findings.is_empty(), "{to} goes unseen");
    }
}

const FORMULA: &str = "title = \"a formula\"\n[law]\nkind = \"formula\"\nacceleration = \"kappa*(V - v) - lambda*max(0, v - v[1])^2 - c*abs(v)*v\"\nV = \"v0*(tanh(x[2]/2 - m) + tanh(m))\"\nkappa = 1.3\nlambda = 0.7\nc = 0.05\nm = 1.9\nv0 = 1.2\nbody = 0.5\n[ring]\npedestrians = 7\nlength = 14.0\n[start]\nshift = 0.3\n[run]\nmethod = \"dop853\"\ntolerance = 1e-12\nt_end = 10.0\nsample = 1.0\n";

#[test]
fn every_number_of_a_formula_matters_to_the_judge() {
    let judged_as = |other: &str| judge::scene_as(FORMULA, other).pop().expect("a panel");
    let verdict = judged_as(FORMULA);
    assert!(verdict.findings.is_empty() && verdict.undecided.is_empty(), "{verdict:#?}");
    assert!(verdict.ratios.len() > 30, "{verdict:#?}");
    let changes = [
        ("kappa = 1.3", "kappa = 1.300001"),
        ("lambda = 0.7", "lambda = 0.70001"),
        ("c = 0.05", "c = 0.050001"),
        ("m = 1.9", "m = 1.900001"),
        ("v0 = 1.2", "v0 = 1.200001"),
        ("x[2]", "x[3]"),
        ("max(0, v", "min(0, v"),
    ];
    for (from, to) in changes {
        let other = FORMULA.replace(from, to);
        assert_ne!(other, FORMULA, "{from}");
        assert!(!judged_as(&other).findings.is_empty(), "{to} goes unseen");
    }
}

/// A run that pedestrians end: some turn back, then two overlap.
const EVENTS: &str = "title = \"events\"\n[law]\nkind = \"exponential\"\na = 3.0\nb = 0.3\nv0 = 1.2\n[ring]\npedestrians = 12\nlength = 30.0\n[start]\nshift = 0.4\n[run]\nmethod = \"dop853\"\ntolerance = 1e-12\nt_end = 20.0\nsample = 2.0\n";

/// A ring whose speeds grow beyond all bounds.
const BLOW_UP: &str = "title = \"blow-up\"\n[law]\nkind = \"algebraic\"\nmu = 1.0\nq = 2.0\nv0 = 4.0\n[ring]\npedestrians = 10\nlength = 27.0\n[start]\nshift = 0.1\n[run]\nmethod = \"dop853\"\ntolerance = 1e-12\nt_end = 60.0\nsample = 10.0\n";

#[test]
fn the_times_of_events_matter_to_the_judge() {
    for (text, from, to, words) in
        [(EVENTS, "shift = 0.4", "shift = 0.40001", "event at t"), (BLOW_UP, "mu = 1.0", "mu = 1.001", "blow-up at t")]
    {
        let verdict = judge::scene_as(text, text).pop().expect("a panel");
        assert!(verdict.findings.is_empty() && verdict.undecided.is_empty(), "{verdict:#?}");
        let other = text.replace(from, to);
        assert_ne!(other, text);
        let verdict = judge::scene_as(text, &other).pop().expect("a panel");
        assert!(verdict.findings.iter().any(|finding| finding.starts_with(words)), "{verdict:#?}");
    }
}

fn scene(text: &str) -> Scene {
    let scene_file = files::scene_file::parse("scene.toml", text).expect("a scene");
    scene::run::read("scene.toml", &scene_file.panels[0].tables).expect("a scene")
}

#[test]
fn a_row_that_is_missing_and_an_end_without_reason_are_seen() {
    let scene = scene(SCENE);
    let (right, _) = jam::errors::stated(&scene).expect("it runs");
    let judged = |change: &dyn Fn(&mut Outcome)| {
        let (mut verdict, mut outcome) = (judge::named("main"), right.clone());
        change(&mut outcome);
        judge::is_whole(&mut verdict, &scene, &outcome, None);
        verdict.findings.join("; ")
    };
    assert_eq!(judged(&|_| ()), "");
    // the last one lies on the end itself
    assert!(judged(&|outcome| outcome.samples.times.truncate(9)).contains("9 rows"));
    assert!(judged(&|outcome| outcome.statistics.time = 18.5).contains("without an event"));
}

#[test]
fn a_number_that_is_not_finite_is_seen_among_others() {
    for found in [f64::NAN, f64::INFINITY] {
        let mut verdict = judge::named("main");
        let (what, time, right, uncertainty, range) = ("std", 1.0, 0.0, 0.0, 1.0);
        Compared { what, time, found, right, uncertainty, allowed: 1.0, range }.note(&mut verdict);
        assert_eq!(verdict.findings.len(), 1, "{verdict:#?}");
    }
}

/// The findings of a run of which something was changed afterwards.
fn falsified(text: &str, change: impl Fn(&mut Outcome)) -> String {
    let scene = scene(text);
    let (made, propagated) = run_propagated(&scene, &mut ());
    let mut outcome = made.expect("it runs");
    let (refused, stated) = stated::of(&scene, &outcome, &propagated);
    assert!(refused.is_none(), "{refused:?}");
    change(&mut outcome);
    let mut verdict = judge::named("main");
    let question = question::read(text, "main").expect("a question");
    judge::judged(&mut verdict, &scene, &outcome, None, (question, &stated));
    verdict.findings.join("; ")
}

#[test]
fn a_wrong_first_row_is_seen() {
    assert_eq!(falsified(SCENE, |_| ()), "");
    assert!(falsified(SCENE, |run| run.samples.std[0] = 1e-300).contains("std at the start"));
    for pedestrian in [0, 11] {
        let words = format!("pedestrian {pedestrian} starts");
        assert!(falsified(SCENE, |run| run.samples.positions[pedestrian] += 1e-10).contains(&words));
        assert!(falsified(SCENE, |run| run.samples.speeds[pedestrian] = 1e-300).contains(&words));
    }
}

#[test]
fn a_resumed_run_that_differs_is_seen() {
    let words = "resumed, the run is another one";
    // long enough for a checkpoint
    let long = SCENE.replace("method = \"dop853\"\ntolerance = 1e-12", "method = \"rk4\"\ndt = 0.002");
    assert_eq!(falsified(&long, |_| ()), "");
    assert!(falsified(&long, |run| run.statistics.steps += 1).contains(words));
    assert!(falsified(&long, |run| run.speeds[3] = run.speeds[3].next_up()).contains(words));
    assert!(falsified(&long, |run| run.samples.std[4] = run.samples.std[4].next_up()).contains(words));
}

#[test]
fn a_wrong_gap_at_an_event_is_seen() {
    assert_eq!(falsified(EVENTS, |_| ()), "");
    assert!(falsified(EVENTS, |run| run.events[0].gap += 1e-7).contains("gap at t"));
}

/// Positions lose small gaps: deviations do not, but more steps would not help.
#[test]
fn advice_that_leads_no_further_is_seen() {
    let scene = scene(&draw::scene(370_716));
    let mut broken = jam::run::run(&scene).expect_err("positions lead no further");
    assert!(broken.advice.is_some_and(|advice| advice.contains("deviations")), "{broken}");
    assert!(is_advice_true(&scene, &broken));
    for advice in [Some("raise most_steps"), None] {
        broken.advice = advice;
        assert!(!is_advice_true(&scene, &broken), "{advice:?}");
    }
}

#[test]
fn the_same_seed_draws_the_same_scene() {
    for seed in (0..50).chain(draw::FORMULAS..draw::FORMULAS + 50) {
        assert_eq!(draw::scene(seed), draw::scene(seed));
    }
    assert_ne!(draw::scene(1), draw::scene(2));
}
