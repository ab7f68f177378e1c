//! The judge detects faults: it is given a run and a scene that differs slightly from the one that was run.

use hunt::draw;
use hunt::judge::{self, Verdict};

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

#[test]
fn the_same_seed_draws_the_same_scene() {
    for seed in (0..50).chain(draw::FORMULAS..draw::FORMULAS + 50) {
        assert_eq!(draw::scene(seed), draw::scene(seed));
    }
    assert_ne!(draw::scene(1), draw::scene(2));
}
