//! Scenes whose law is a formula.

use files::scene_file;
use jam::events::EventKind;
use jam::run::{Outcome, run as simulate};
use scene::map;
use scene::run::{self, Scene};

fn read(text: &str) -> Result<Scene, String> {
    let parsed = scene_file::parse("my.toml", text).map_err(|error| error.to_string())?;
    run::read("my.toml", &parsed.panels[0].tables).map_err(|error| error.to_string())
}

fn outcome(text: &str) -> Outcome {
    simulate(&read(text).unwrap_or_else(|error| panic!("{error}"))).unwrap_or_else(|broken| panic!("{broken}"))
}

/// A scene of the optimal velocity model, with `kappa` and what stands in its place.
fn optimal_velocity(law: &str, more: &str) -> String {
    format!(
        "[law]\nkind = \"formula\"\n{law}\n[ring]\npedestrians = 30\nlength = 60.0\n[start]\nshift = 0.1\n\
         [run]\nt_end = 40.0\nsample = 1.0\nmethod = \"dop853\"\ntolerance = 1e-11\n{more}"
    )
}

const BANDO: &str = "acceleration = \"kappa*(V - v)\"\nV = \"tanh(s - 2) + tanh(2)\"\nkappa = 1.0\nbody = 0.0";

#[test]
fn the_laws_of_the_paper_as_formulas_give_their_tables_bit_for_bit() {
    let built_in = [
        "kind = \"algebraic\"\nmu = 0.45\nq = 2.0\nv0 = 3.0",
        "kind = \"exponential\"\na = 3.0\nb = 1.5\nv0 = 3.0",
        "kind = \"logarithmic\"\nv0 = 1.0\nepsilon = 0.01",
    ];
    let formulas = [
        "acceleration = \"v0 - v - mu^2*d^(-q)\"\nd = \"s - body\"\nmu = 0.45\nq = 2.0\nv0 = 3.0\nbody = 2.0",
        "acceleration = \"v0 - v - a*exp(-d/b)\"\nd = \"s - body\"\na = 3.0\nb = 1.5\nv0 = 3.0\nbody = 2.0",
        "acceleration = \"v0*(1 - ln_1p((e - 1)*ramp(s/2 - 1, epsilon))) - v\"\nv0 = 1.0\nepsilon = 0.01\nbody = 0.0",
    ];
    let rings =
        ["pedestrians = 67\nlength = 200.0", "pedestrians = 57\nlength = 200.0", "pedestrians = 133\nlength = 200.0"];
    for ((built_in, formula), ring) in built_in.iter().zip(formulas).zip(rings) {
        for method in [
            "method = \"taylor\"\ntolerance = 1e-12",
            "method = \"dop853\"\ntolerance = 1e-9",
            "method = \"heun\"\ndt = 1e-3\nstate = \"positions\"",
        ] {
            let rest = format!("[ring]\n{ring}\n[start]\nshift = 0.1\n[run]\nt_end = 60.0\nsample = 0.5\n{method}\n");
            let expected = outcome(&format!("[law]\n{built_in}\n{rest}"));
            let found = outcome(&format!("[law]\nkind = \"formula\"\n{formula}\n{rest}"));
            assert!(found.samples == expected.samples, "{formula}, {method}");
            assert_eq!(found.events, expected.events, "{formula}, {method}");
        }
    }
}

#[test]
fn a_formula_says_where_it_is_wrong() {
    for (law, line, words) in [
        ("acceleration = \"kappa*(W - v)\"\nkappa = 1.0\nbody = 0.0", "3:", ["column 24", "`W`"]),
        ("acceleration = \"2 s\"\nbody = 0.0", "3:", ["column 19", "`s`"]),
        ("acceleration = \"U - v\"\nU = \"W\"\nW = \"U\"\nbody = 0.0", "5:", ["U", "W"]),
        ("acceleration = \"1 - v\"\nkappa = 2.0\nbody = 0.0", "4:", ["kappa", "valid"]),
        ("acceleration = \"1 - v\"", "1:", ["body", "valid"]),
        ("acceleration = \"1 - v + s[40]\"\nbody = 0.0", "6:", ["40", "41"]),
        ("acceleration = \"ln(s - 5) - v\"\nbody = 0.0", "9:", ["no value at the start", "pedestrian 0"]),
    ] {
        let message = read(&optimal_velocity(law, "")).expect_err(law);
        assert!(message.starts_with(&format!("my.toml:{line}")), "{message}");
        assert!(words.iter().all(|word| message.contains(word)), "{message}");
    }
}

#[test]
fn several_steady_speeds_are_listed_and_one_can_be_chosen() {
    // falls through 0 at 1 and 3
    let law = "acceleration = \"-(v - 1)*(v - 2)*(v - 3)\"\nbody = 0.0";
    let message = read(&optimal_velocity(law, "")).expect_err("two steady speeds");
    assert!(message.contains("[uniform] speed") && message.contains("1.0") && message.contains("3.0"), "{message}");
    let scene = read(&optimal_velocity(law, "[uniform]\nspeed = 2.9\n")).unwrap_or_else(|error| panic!("{error}"));
    assert!((scene.steady_speed.expect("one") - 3.0).abs() < 1e-12);
}

#[test]
fn a_law_without_a_uniform_flow_runs_in_spacings() {
    let scene = read(&optimal_velocity("acceleration = \"0.1 + 0*v + 0.001*s\"\nbody = 0.0", "")).expect("a scene");
    assert_eq!(scene.steady_speed, None);
    let end = simulate(&scene).expect("it runs");
    // everybody gains the same speed: 0.102 t
    assert!((end.speeds[7] - 40.0 * 0.102).abs() < 1e-2, "{:?}", end.speeds);
}

#[test]
fn a_formula_that_loses_its_value_ends_by_name() {
    // ln(2.5 - t): the spacings shrink nowhere, speeds grow until the logarithm has no value
    let end = outcome(&optimal_velocity("acceleration = \"1 + 0.001*ln(3 - v)\"\nbody = 0.0", ""));
    let event = end.events.iter().find(|happening| happening.kind == EventKind::Undefined).expect("an end");
    assert!((event.time - 3.0).abs() < 0.1, "{event:?}");
}

#[test]
fn a_run_that_comes_to_rest_at_the_end_of_the_domain_ends_by_name() {
    // speeds fall ever faster towards s = 1.3, and none of the last steps changes a spacing any more
    let law = "acceleration = \"v0 - v + 3*ln(s - 1.3)\"\nv0 = -0.5\nbody = 0.5";
    let text = optimal_velocity(law, "").replace("shift = 0.1", "shift = 0.6");
    let [series, pair] = ["", "method = \"dop853\"\ntolerance = 1e-11"].map(|method| {
        let end = outcome(&text.replace("method = \"dop853\"\ntolerance = 1e-11", method));
        *end.events.iter().find(|event| event.kind == EventKind::Undefined).expect("an end")
    });
    assert_eq!(series.pedestrian, pair.pedestrian);
    assert!((series.time - pair.time).abs() < 1e-9, "{series:?} {pair:?}");
}

#[test]
fn a_gap_of_its_own_tells_the_overlap() {
    // from rest everybody but the first gains V(2) (1 - exp(-t)); the gap 2 - 1.1 * 2 v closes at v = 1/1.1
    let law = format!("{BANDO}\ngap = \"s - 1.1*(v + v[1])\"").replace("tanh(s - 2) + tanh(2)", "tanh(2)");
    let end = outcome(&optimal_velocity(&law.replace("kappa*(V - v)", "kappa*(V - v) + 0*s"), ""));
    let overlap = end.events.iter().find(|happening| happening.kind == EventKind::Overlap).expect("an overlap");
    let full = 0.964_027_580_075_816_9;
    // the last pedestrian, whose spacing is shorter by the shift, is the first one
    let speed = (2.0 - 0.1) / 2.2;
    let expected = -math::ln(1.0 - speed / full);
    assert!((overlap.time - expected).abs() < 1e-9, "{overlap:?}, {expected}");
    assert_eq!((overlap.pedestrian, overlap.gap > 1.8), (0, true), "{overlap:?}");
}

#[test]
fn margins_of_formulas_are_those_of_the_criteria() {
    let text = "[law]\nkind = \"formula\"\nacceleration = \"kappa*(V - v)\"\nV = \"tanh(s - 2) + tanh(2)\"\nbody = 0.0\n\
                [uniform]\nheadway = 2.0\n[map]\nx = { parameter = \"kappa\", from = 1.0, to = 3.0, cells = 10 }\n\
                y = { parameter = \"headway\", from = 1.5, to = 2.5, cells = 3 }\n";
    let text = text.replace("[uniform]\nheadway = 2.0\n", "");
    let parsed = scene_file::parse("my.toml", &text).expect("a map");
    let map = map::read("my.toml", &parsed.panels[0].tables).unwrap_or_else(|error| panic!("{error}"));
    let computed = map.compute().unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(computed.table.len(), 30);
    for row in computed.table.rows() {
        let (kappa, headway, margin) = (row[0], row[1], row[2]);
        // unstable where V' > kappa / 2
        let t = math::exp_m1(2.0 * (headway - 2.0));
        let slope = 1.0 - (t / (t + 2.0)) * (t / (t + 2.0));
        assert_eq!(margin > 0.0, slope > 0.5 * kappa, "{row:?}");
    }
}

#[test]
fn margins_of_maps_are_those_of_runs_where_short_waves_decay_slowest() {
    let law = "[law]\nkind = \"algebraic\"\nq = 2.0\nv0 = 2.0\nepsilon = 0.1\ndelta = 0.5\n";
    let axes = "[uniform]\nheadway = 3.0\n[map]\nx = { parameter = \"mu\", from = 0.05, to = 1.45, cells = 7 }\n\
                y = { parameter = \"a_v\", from = 0.0, to = 0.6, cells = 4 }\n";
    let parsed = scene_file::parse("my.toml", &format!("{law}{axes}")).expect("a map");
    let map = map::read("my.toml", &parsed.panels[0].tables).unwrap_or_else(|error| panic!("{error}"));
    let computed = map.compute().unwrap_or_else(|error| panic!("{error}"));
    assert!(computed.error < 1e-13, "{:e}", computed.error);
    let mut short = 0;
    for row in computed.table.rows() {
        let (mu, a_v, margin) = (row[0], row[1], row[2]);
        let run = "[ring]\npedestrians = 20\nlength = 60.0\n[start]\nshift = 0.1\n[run]\nt_end = 1.0\nsample = 1.0\n";
        let scene = read(&format!("{law}mu = {mu:?}\na_v = {a_v:?}\n{run}")).unwrap_or_else(|error| panic!("{error}"));
        let linear = scene.model.linearise(3.0, scene.steady_speed.expect("a flow"));
        let expected = scene::uniform::stability(&scene).expect("derivatives").margin;
        assert!((margin - expected).abs() <= 1e-12 * expected.abs(), "{row:?}: {expected}");
        short += u32::from(linear.long_wave_margin() < 2.0 * margin);
    }
    assert!(short > 3, "{short} cells where long waves decay twice as fast as the slowest");
}
