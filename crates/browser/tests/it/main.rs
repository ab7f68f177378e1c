//! Tests of the browser crate.

use browser::rejudge;
use browser::simulate::{self, Hearer};
use browser::{FIGURES, Tables, exports, flow};
use files::scene_file;
use serde_json::json;
use std::collections::BTreeSet;
use std::path::Path;

#[test]
fn every_panel_has_a_table() -> Result<(), Box<dyn std::error::Error>> {
    for figure in FIGURES.iter().filter(|figure| figure.id != "fig01") {
        let scene_file = scene_file::parse(figure.id, figure.scene)?;
        let panels: BTreeSet<&str> = scene_file.panels.iter().map(|panel| panel.name.as_str()).collect();
        let used: BTreeSet<&str> = figure.tables.iter().map(|entry| entry.panel).collect();
        assert_eq!(panels, used, "{}", figure.id);
    }
    Ok(())
}

/// Figures whose tables take little time without optimisation; the others are computed under Node by
/// `checks/other-machines.sh`.
const CHEAP: [&str; 6] = ["fig02", "fig04", "fig05", "fig07", "fig08", "fig10"];

#[test]
fn sums_are_those_of_the_figures() -> Result<(), Box<dyn std::error::Error>> {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/SHA256SUMS");
    if !file.exists() {
        eprintln!("skipped: there is no data/SHA256SUMS");
        return Ok(());
    }
    let known = std::fs::read_to_string(file)?;
    let mut tables = Tables::new();
    for figure in FIGURES.iter().filter(|figure| CHEAP.contains(&figure.id)) {
        for line in tables.sums(figure)?.lines() {
            assert!(known.lines().any(|other| other == line), "not in data/SHA256SUMS: {line}");
        }
    }
    Ok(())
}

#[test]
fn exports_say_what_is_missing() {
    assert_eq!(exports::table_count(1), 3);
    assert_eq!(exports::table_count(15), 0);
    assert!(exports::sums(15) < 0);
    assert!(exports::table(0, 0) < 0);
    assert!(exports::table(1, 0) > 0);
}

/// A scene of the optimal velocity model, of which the stability is known: `V'(2) = 1`, unstable below `kappa = 2`.
fn scene(kappa: &str, record: &str) -> String {
    format!(
        "title = \"t\"\nsource = \"s\"\n[law]\nkind = \"formula\"\nacceleration = \"kappa*(V - v)\"\nV = \"tanh(s - 2) + tanh(2)\"\n\
         kappa = {kappa}\nbody = 0.0\nscale = 1.0\n[ring]\npedestrians = 10\nlength = 20.0\n[start]\nshift = 0.1\n\
         [run]\nt_end = 20.0\nsample = 0.5\nmethod = \"dop853\"\ntolerance = 1e-10\nrecord = \"{record}\"\n"
    )
}

#[test]
fn a_flow_is_told_with_its_rates() {
    let told = flow::of(&scene("1.5", "std"), 50).expect("a flow");
    // D = (Re b)^2 Re c + ... with b = kappa, c = kappa V' (1 - e^{ik}), over kappa V' (1 - cos k): 2 kappa V' -
    // kappa^2 at k = 0
    let margin = told["uniform_flow"]["margin"].as_f64().expect("a margin");
    assert!((margin - (2.0 * 1.5 - 1.5 * 1.5)).abs() < 1e-12, "{margin}");
    assert_eq!(told["k"].as_array().map(Vec::len), Some(50));
    assert_eq!(told["waves"]["k"].as_array().map(Vec::len), Some(5));
    assert!(told["error"].as_f64().is_some_and(|error| error < 1e-13), "{}", told["error"]);
    let stable = flow::of(&scene("2.5", "std"), 50).expect("a flow");
    assert_eq!(stable["uniform_flow"]["stable"], true);
    let rates = stable["rate"].as_array().expect("rates").iter();
    assert!(rates.into_iter().all(|rate| rate.as_f64().is_some_and(|rate| rate < 0.0)));
}

#[test]
fn a_wrong_scene_is_told_by_key_and_line() {
    let text = scene("1.5", "std").replace("tanh(s - 2)", "tann(s - 2)");
    let complaint = flow::of(&text, 10).expect_err("a bad formula");
    assert_eq!((&complaint["key"], &complaint["line"]), (&json!("law.V"), &json!(6)));
    assert!(complaint["problem"].as_str().is_some_and(|problem| problem.starts_with("column 6: ")), "{complaint}");
    let complaint = flow::of(&text.replace("[run]", "[map]"), 10).expect_err("no run");
    assert!(complaint["problem"].as_str().is_some_and(|problem| problem.contains("[run]")), "{complaint}");
    let complaint =
        flow::of(&scene("1.5", "std").replace("length = 20.0", "length = -1"), 10).expect_err("a bad length");
    assert_eq!(complaint["key"], "ring.length");
}

/// What was heard of a run.
#[derive(Default)]
struct Ear {
    samples: Vec<Vec<f64>>,
    events: Vec<String>,
    checks: usize,
}

impl Hearer for Ear {
    fn sample(&mut self, numbers: &[f64]) {
        self.samples.push(numbers.to_vec());
    }

    fn event(&mut self, event: &str) {
        self.events.push(event.to_owned());
    }

    fn checking(&mut self) {
        self.checks += 1;
    }
}

#[test]
fn a_run_is_heard_sample_by_sample() {
    let mut ear = Ear::default();
    let told = simulate::run(&scene("1.0", "trajectories"), &mut ear).expect("a run");
    assert_eq!((ear.samples.len(), ear.checks), (41, 1));
    assert!(ear.samples.iter().all(|sample| sample.len() == 22));
    assert_eq!((ear.samples[0][0], ear.samples[0][1], ear.samples[40][0]), (0.0, 0.0, 20.0));
    assert!(told["sums"]["trajectories.csv"].as_str().is_some_and(|sum| sum.len() == 64));
    assert!(told["error"]["std"].as_f64().is_some_and(|error| error > 0.0 && error < 1e-7), "{}", told["error"]);
    assert!(told.get("seconds").is_none());
    let mut short = Ear::default();
    let told = simulate::run(&scene("1.0", "std"), &mut short).expect("a run");
    assert!(short.samples.iter().all(|sample| sample.len() == 2), "deviations alone");
    assert!(told["sums"].get("trajectories.csv").is_none());
}

#[test]
fn a_scene_of_the_room_is_answered_in_json() {
    let text = scene("1.5", "std");
    // the room is written by the page; here by nobody: it is empty, and that is told
    exports::room(text.len());
    assert!(exports::stability(10) < 0);
    assert!(exports::run() < 0);
}

/// Claims of the ledger by id, judged on the run of a panel with one text in its scene put in the place of another.
fn judged(figure: &str, panel: &str, change: [&str; 2]) -> Vec<serde_json::Value> {
    struct Deaf;
    impl Hearer for Deaf {
        fn sample(&mut self, _: &[f64]) {}
        fn event(&mut self, _: &str) {}
        fn checking(&mut self) {}
    }
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let claims = std::fs::read_to_string(root.join("paper/claims.toml")).expect("the claims");
    let scene = FIGURES.iter().find(|one| one.id == figure).expect("a figure").scene;
    // one panel's tables in the place of all panels
    let (before, after) = scene.split_once("\n[panel.").unwrap_or((scene, ""));
    let own = after.split("\n[").find_map(|part| part.split_once(&format!("{panel}.law]\n"))).map_or("", |own| own.1);
    let before = before.split("\n[origin]").next().expect("a scene").replace("[law]", &format!("[law]\n{own}"));
    let text = before.replace(change[0], change[1]);
    let (_, ran) = simulate::run_kept(&text, &mut Deaf).unwrap_or_else(|told| panic!("{text}: {told}"));
    let told = rejudge::judge(&format!("{figure} {panel}\n{claims}"), &ran).expect("verdicts");
    told.as_array().expect("a list").clone()
}

#[test]
fn claims_on_the_papers_numbers_are_those_of_the_ledger() {
    let panels = [("fig04", "stable", 1), ("fig04", "unstable", 1), ("fig07", "stable", 1), ("fig07", "unstable", 1)];
    for (figure, panel, least) in panels {
        let told = judged(figure, panel, ["", ""]);
        assert!(told.len() >= least, "{figure} {panel}: {told:?}");
        for claim in told {
            assert_eq!(claim["before"], claim["now"], "{claim:#}");
        }
    }
}

#[test]
fn without_growth_the_claim_of_growth_does_not_hold() {
    let told = judged("fig04", "unstable", ["mu = 0.55", "mu = 0.40"]);
    let growth = told.iter().find(|claim| claim["id"] == "algebraic-perturbation-grows").expect("the claim");
    assert_eq!(growth["before"], "holds");
    assert_eq!(growth["now"], "does not hold", "{growth:#}");
}
