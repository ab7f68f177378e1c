//! Tables that the ledger reads: critical values against formulas derived by hand, jams at other samples, counted maps,
//! distances of curves.

use crate::root;
use files::scene_file::{self, Kind};
use jam::laws::Logarithmic;
use ode::{Control, Method};
use std::f64::consts::{E, PI};
use studies::draw::Draw;
use studies::overlay::{Published, Sampled, sizes};
use studies::parameters::jammed::{Jammed, Run, Start, run};
use studies::thresholds::critical::{Waves, algebraic, critical, exponential, logarithmic};
use studies::thresholds::monotone;

fn assert_near(found: f64, expected: f64, within: f64, what: &str) {
    assert!((found - expected).abs() <= within, "{what}: {found:?}, expected {expected:?}");
}

/// The critical value by the margin; the one by growth rates must agree.
fn edge(family: &dyn Fn(f64) -> jam::stability::Linear, waves: Waves) -> f64 {
    let (by_margin, by_rate) = critical(family, waves, (1e-6, 1e3)).expect("an edge");
    assert_near(by_rate, by_margin, 1e-10, "the edge by growth rates");
    by_margin
}

#[test]
fn critical_values_are_those_of_the_formulas() {
    let gap: f64 = 200.0 / 67.0 - 2.0;
    // q mu^2 / d'^(q+1) = 1/2
    let mu = |mu: f64| algebraic(mu, (0.0, 2.0, 0.0)).linearise(gap);
    assert_near(edge(&mu, Waves::All), (gap * gap * gap / 4.0).sqrt(), 1e-12, "mu");
    // a_v takes phi from 1/2 to 1 / (2 (1 - a_v))
    let wider = |mu: f64| algebraic(mu, (0.0, 2.0, 0.2)).linearise(1.0);
    assert_near(edge(&wider, Waves::All), (1.0_f64 / (4.0 * 0.8)).sqrt(), 1e-12, "mu with a_v");
    // 4 g^2 = 1 + 2 g at d' = 1, q = 2, delta = 1: g = (1 + sqrt 5) / 4
    let faster = |mu: f64| algebraic(mu, (1.0, 2.0, 0.0)).linearise(1.0);
    let expected = (1.0 + 5.0_f64.sqrt()) / 4.0 - 0.1 * std::f64::consts::LN_2;
    assert_near(edge(&faster, Waves::All), expected, 1e-11, "mu with delta");
    let a = |a: f64| exponential(a, 1.5, 0.0).linearise(1.5);
    assert_near(edge(&a, Waves::All), 0.75 * E, 1e-11, "a");
    // c v_0' / (2 d_0) = 1/2 with d_0 = 1 + c / 4
    let v0 = |v0: f64| Logarithmic { v0, a_v: 0.0, epsilon: 0.01 }.linearise(1.5, 0.0);
    assert_near(edge(&v0, Waves::All), 1.0 / (E - 1.0) + 0.25, 1e-10, "v_0'");
}

#[test]
fn on_a_ring_the_critical_phi_is_larger_by_the_cosine_of_its_longest_wave() {
    for count in [5_usize, 16, 57, 133] {
        let factor = 1.0 / math::cos(PI / count as f64);
        let mu = |mu: f64| algebraic(mu, (0.0, 2.0, 0.0)).linearise(1.0);
        assert_near(edge(&mu, Waves::Ring(count)), 0.5 * factor, 1e-12, "mu");
        let a = |a: f64| exponential(a, 1.5, 0.0).linearise(1.5);
        assert_near(edge(&a, Waves::Ring(count)), 0.75 * E * factor * factor, 1e-11, "a");
    }
}

#[test]
fn a_law_that_no_strength_makes_unstable_has_no_critical_value() {
    let family = |mu: f64| algebraic(mu, (1.0, 1.0, 0.1)).linearise(1.0);
    assert_eq!(critical(&family, Waves::All, (1e-6, 1e3)), None);
}

#[test]
fn widening_lowers_the_flow_that_it_is_linearised_about() {
    let (narrow, wide) = (logarithmic(3.0, 0.0, 1.5).expect("a flow"), logarithmic(3.0, 0.8, 1.5).expect("a flow"));
    assert!(narrow.long_wave_margin() > 0.0 && wide.long_wave_margin() < 0.0);
}

/// A short run on a small ring, and what is seen of it at these samples.
fn small(sample: f64, method: Method) -> Jammed {
    let short = Run { pedestrians: 33, length: 49.5, end: 1200.0, start: Start::One(0.1), sample, ..Run::default() };
    run(&short, (method, Control::Adaptive { tolerance: 1e-8 })).expect("a run")
}

#[test]
fn jams_are_the_same_at_other_samples_and_by_another_method() {
    let (one, finer, other) = (small(1.0, Method::Taylor), small(0.25, Method::Taylor), small(1.0, Method::Dop853));
    assert_eq!((one.stop, one.jams), (None, finer.jams));
    assert!(one.jams.is_some_and(|jams| jams >= 1.0));
    // linear between samples: the standard deviation bends by less than 1e-5 within a time unit
    for (seen, within) in [(&finer, 2e-2), (&other, 1e-5)] {
        for (index, number) in Jammed::NUMBERS.iter().enumerate() {
            let pair = number(&one).zip(number(seen));
            assert_eq!(number(&one).is_some(), number(seen).is_some(), "number {index}");
            pair.into_iter().for_each(|(a, b)| assert_near(a, b, within, &format!("number {index}")));
        }
    }
    // everybody is as fast on the average as the flow by the headway says
    assert_near(one.flow.expect("a flow") * 1.5, one.mean_speed.expect("a speed"), 1e-15, "flow");
}

#[test]
fn drawn_numbers_fill_their_range_evenly_and_are_always_the_same() {
    let drawn = |mut draw: Draw| (0..10_000).map(|_| draw.between(-1.0, 3.0)).collect::<Vec<f64>>();
    let numbers = drawn(Draw::default());
    assert_eq!(numbers, drawn(Draw::default()));
    assert!(numbers.iter().all(|x| (-1.0..3.0).contains(x)));
    // standard deviation of the mean: 4 / sqrt(12 * 10000) = 0.0115
    assert_near(numbers.iter().sum::<f64>() / 10_000.0, 1.0, 0.05, "mean");
}

#[test]
fn the_maps_that_are_counted_are_those_of_the_figures() {
    let counted = scene_file::read(&root().join("figures/s14-thresholds/scene.toml")).expect("a scene");
    let mut compared = 0;
    for folder in std::fs::read_dir(root().join("figures")).expect("the figures") {
        let slug = folder.expect("an entry").file_name().into_string().expect("a name");
        if !slug.starts_with("fig") {
            continue;
        }
        let figure = scene_file::read(&root().join("figures").join(&slug).join("scene.toml")).expect("a scene");
        for panel in figure.panels.iter().filter(|panel| panel.kind == Kind::Map) {
            let name = format!("{}_{}", &slug[..5], panel.name);
            let own = counted.panel(&name).expect("a panel of that name");
            let read = |file: &str, panel: &scene_file::Panel| scene::map::read(file, &panel.tables).expect("a map");
            assert_eq!(format!("{:?}", read("a", panel)), format!("{:?}", read("a", own)), "{name}");
            compared += 1;
        }
    }
    assert_eq!(compared, 20);
}

#[test]
fn along_the_strength_stability_is_lost_once_for_each_distance() {
    let counted = scene_file::read(&root().join("figures/s14-thresholds/scene.toml")).expect("a scene");
    let panel = counted.panel("fig03_left").expect("the panel");
    let map = scene::map::read("a", &panel.tables).expect("a map");
    let rows = monotone::table(&[("fig03_left", map)]).expect("a table");
    let along =
        rows.select(&[("axis", "mu")], &["pairs", "rising", "falling", "lost", "regained"]).expect("the columns");
    let row: Vec<f64> = along.rows().next().expect("a row").to_vec();
    // 199 pairs in each of 200 lines; the critical strength sqrt(d'^3 / 4) is below 0.005 in some of the lowest of them
    let unstable_from_the_start =
        (0..200).filter(|j| (0.01 * (f64::from(*j) + 0.5)) < math::pow(4.0 * 0.005 * 0.005, 1.0 / 3.0)).count();
    assert_eq!(row, [39_800.0, 39_800.0, 0.0, 200.0 - unstable_from_the_start as f64, 0.0]);
}

#[test]
fn maps_with_blank_cells_are_refused() {
    // in the lowest cells the margin is above all numbers
    let map = "law = { kind = \"algebraic\", mu = 0.5, q = 1.0, v0 = 3.0 }\nmap.value = \"margin\"\n\
               map.x = { parameter = \"a_v\", from = 0.0, to = 0.1, cells = 2 }\n\
               map.y = { parameter = \"d_gap\", from = 0.0, to = 1e-153, cells = 100 }\n";
    let parsed = scene_file::parse("a", map).expect("a scene");
    let counted = scene::map::read("a", &parsed.panels[0].tables).expect("a map");
    let refused = monotone::table(&[("fig03_left", counted)]).expect_err("cells are blank");
    assert!(refused.message.starts_with("fig03_left: 5.0 % blank: 10 cells without a value"), "{}", refused.message);
    let folder = tempfile::tempdir().expect("a scratch folder");
    let scene = folder.path().join("scene.toml");
    std::fs::write(&scene, format!("[panel.delta_k]\n{map}")).expect("a scene is written");
    let mut figure = std::process::Command::new(env!("CARGO_BIN_EXE_s14-thresholds"));
    figure.arg("--scene").arg(&scene).arg("--tables").arg(folder.path()).arg("--pictures").arg(folder.path());
    let output = figure.output().expect("the figure starts");
    assert_eq!(output.status.code(), Some(4));
    assert!(String::from_utf8_lossy(&output.stderr).contains("delta_k: 5.0 % blank: "), "{output:?}");
    assert!(!folder.path().join("delta_k.csv").exists());
}

#[test]
fn distances_are_largest_root_mean_square_and_median() {
    assert_eq!(sizes(&[3.0, -4.0, 0.0]), [4.0, (25.0_f64 / 3.0).sqrt(), 3.0]);
    assert_eq!(sizes(&[1.0, -2.0]), [2.0, 2.5_f64.sqrt(), 1.5]);
    let run = Sampled { spread: vec![0.0, 0.5], speeds: vec![1.0, 2.0] };
    let published = Published { spread: vec![(1.0, 0.75)], speeds: vec![(0.0, 1.0), (0.999, 2.5)] };
    assert_eq!(run.spread_differences(&published.spread).expect("samples"), [0.25]);
    assert_eq!(run.speed_differences(&published.speeds).expect("samples"), [0.0, 0.5]);
}

#[test]
fn a_place_without_a_sample_is_named() {
    let run = Sampled { spread: vec![0.0, 0.5], speeds: vec![1.0, 2.0] };
    for place in [1.6, -1.0, 1e18, f64::NAN] {
        let failure = run.spread_differences(&[(1.0, 0.75), (place, 0.5)]).expect_err("no sample there");
        assert_eq!(failure.code, 2);
        let words = [format!("t = {place:?}"), "2 samples".to_owned()];
        assert!(words.iter().all(|word| failure.message.contains(word)), "{}", failure.message);
    }
    let failure = run.speed_differences(&[(7.0, 1.0)]).expect_err("no such pedestrian");
    assert!(failure.message.contains("n = 7.0"), "{}", failure.message);
}

/// Time of an event of a reference solution.
fn reference(scene: &str, event: &str) -> f64 {
    let file = root().join("data/reference/solutions/events.csv");
    let rows = studies::hard::rows::Rows::read(&file).expect("the events of the reference solutions");
    let row = rows.select(&[("scene", scene), ("event", event)], &["t"]).expect("the columns");
    row.rows().next().expect("the event")[0]
}

#[test]
fn errors_of_events_at_other_desired_speeds_hold_the_distance_from_the_reference() {
    let events = studies::optimal_velocity::events().expect("the runs");
    let mut compared = 0;
    for (law, scene, stop) in
        [("algebraic", "algebraic_unstable", "blow_up"), ("exponential", "exponential_unstable", "overlap")]
    {
        // an offset of the speeds moves no gap: the end of the run is that of the reference at every desired speed
        let words = [("law", law), ("varied", "speed")];
        let columns = ["v0", "stop_t", "stop_t_error", "negative_t", "negative_t_error"];
        for row in events.select(&words, &columns).expect("the columns").rows() {
            let off = (row[1] - reference(scene, stop)).abs();
            assert!(off <= row[2] && row[2] < 1e-5, "{law}, v0 = {}: off by {off:e}, stated {:e}", row[0], row[2]);
            compared += 1;
            if row[0] == 3.0 {
                let off = (row[3] - reference(scene, "negative_speed")).abs();
                assert!(off <= row[4] && row[4] < 1e-5, "{law}: negative speed off by {off:e}, stated {:e}", row[4]);
                compared += 1;
            }
        }
    }
    assert_eq!(compared, 14);
}
