//! Scenes from public reports that once went wrong (`tests/cases`), with values from independent programs.

use crate::project::scene;
use jam::events::{Event, EventKind};
use jam::run::{Outcome, run};
use ode::{Control, Method};
use scene::map::{Computed, Map, Value};
use scene::run::{AtOverlap, Scene};
use scene::tables;
use scene::{Overrides, SceneError};
use std::path::{Path, PathBuf};

fn file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("tests/cases/{name}.toml"))
}

fn case(name: &str, overrides: &Overrides) -> Scene {
    let parsed = files::scene_file::read(&file(name)).unwrap_or_else(|error| panic!("{error}"));
    scene(&parsed, "main", overrides)
}

fn plain(name: &str) -> Outcome {
    run(&case(name, &Overrides::default())).unwrap_or_else(|broken| panic!("{name}: {broken}"))
}

fn map(name: &str) -> (Map, Computed) {
    let parsed = files::scene_file::read(&file(name)).expect("a scene");
    let map = scene::map::read(&parsed.file, &parsed.panels[0].tables).expect("a map");
    let computed = map.compute().expect("every cell has a value or is blank");
    (map, computed)
}

/// The std at this sample of a run.
fn std_at(run: &Outcome, t: f64) -> f64 {
    run.samples.iter().find(|sample| (sample.time - t).abs() < 1e-9).expect("a sample").std
}

/// Width of the ramp, and the std at t = 5 and 20 by an integrator that ends a step on every crossing.
const KINKS: [(&str, f64, f64); 4] = [
    ("kink-eps-0.01", 0.038_427_041_728_29, 0.029_970_765_102_22),
    ("kink-eps-0.002", 0.038_515_975_229_84, 0.030_049_692_799_45),
    ("kink-eps-1e-4", 0.038_519_603_417_90, 0.030_052_894_932_99),
    ("kink-eps-1e-6", 0.038_519_612_522_92, 0.030_052_902_967_43),
];

#[test]
fn no_method_steps_over_a_kink() {
    for (name, early, late) in KINKS {
        for method in Method::ALL.into_iter().filter(|method| method.is_adaptive()) {
            let overrides = Overrides { method: Some(method.name().to_owned()), ..Overrides::default() };
            let run = run(&case(name, &overrides)).expect("it runs");
            let errors = [std_at(&run, 5.0) - early, std_at(&run, 20.0) - late];
            // the tolerance is 1e-10 of gaps and speeds that differ by 0.6 at the start
            assert!(errors.iter().all(|error| error.abs() < 2e-10), "{name} {}: {errors:?}", method.name());
        }
    }
}

/// At t = 60, by an integrator with steps of 0.002.
const CLIPPED_STD: f64 = 0.006_042_124_728_1;
const CLIPPED_POSITION: f64 = 53.312_628_682_56;

/// At the start everybody accelerates alike and steadily: Taylor's series is a polynomial, whose step would be without
/// end.
#[test]
fn kinks_of_a_formula_are_met_to_the_stated_error() {
    assert_eq!(case("kinks-of-a-formula", &Overrides::default()).method, Method::Dop853, "without a method");
    for name in ["taylor", "dop853", "dopri54"] {
        let overrides = Overrides { method: Some(name.to_owned()), ..Overrides::default() };
        let (outcome, errors) = jam::errors::stated(&case("kinks-of-a-formula", &overrides)).expect("it runs");
        let off = [std_at(&outcome, 60.0) - CLIPPED_STD, outcome.positions[0] - CLIPPED_POSITION].map(f64::abs);
        for (off, stated) in off.into_iter().zip([errors.std, errors.positions]) {
            let stated = stated.expect("an error is stated");
            assert!(off < 3.0 * stated && stated < 1e-7, "{name}: off by {off:e}, stated {stated:e}");
        }
    }
}

#[test]
fn a_kink_narrower_than_rounding_costs_a_few_steps() {
    let mut scene = case("kink-eps-1e-6", &Overrides::default());
    let wide = run(&scene).expect("it runs").statistics;
    let jam::laws::Model::Logarithmic(law) = &mut scene.model else { panic!("{:?}", scene.model) };
    law.epsilon = 1e-13;
    let narrow = run(&scene).expect("it runs");
    assert!((std_at(&narrow, 20.0) - KINKS[3].2).abs() < 2e-10);
    assert!(narrow.statistics.steps < 5 * wide.steps, "{} and {}", narrow.statistics.steps, wide.steps);
}

#[test]
fn maps_of_free_flow_are_exact_or_blank() {
    let (criterion, computed) = map("criterion-log-free");
    assert_eq!((criterion.value, computed.blank.len() + computed.table.len()), (Value::Criterion, 1400));
    assert!(computed.blank_share() > 0.8, "{}", computed.blank_share());
    // what is left has the exact sign
    let (growth, rates) = map("criterion-log-free-growth");
    let rates = rates.values();
    for (cell, value) in computed.values().into_iter().enumerate().filter(|(_, value)| !value.is_nan()) {
        assert!((value > 0.0) == (rates[cell] > 0.0) || value.abs() < 2e-3, "cell {cell}: {value} and {}", rates[cell]);
    }
    // the margin has it in every cell; by growth rates 9.2 % are unstable
    let mut margin = criterion;
    margin.value = Value::Margin;
    let margin = margin.compute().expect("every cell has a margin");
    assert!(margin.blank.is_empty() && margin.error > 0.0 && margin.error < 1e-14, "{:e}", margin.error);
    let unstable = |values: &[f64]| values.iter().filter(|&&value| value > 0.0).count();
    assert_eq!((unstable(&margin.values()), growth.value), (unstable(&rates), Value::GrowthRate));
    assert!((unstable(&rates) as f64 / 1400.0 - 0.092).abs() < 5e-4);
    // a wide ramp is nowhere that of the paper
    let (_, wide) = map("criterion-log-eps");
    assert!((wide.blank_share(), wide.table.is_empty()) == (1.0, true), "{}", wide.blank_share());
    let (_, narrow) = map("narrow-map");
    assert!(narrow.blank.is_empty() && narrow.error < 1e-14);
}

#[test]
fn margin_is_the_default_and_blank_cells_are_empty_in_the_table() {
    let text = std::fs::read_to_string(file("criterion-log-free")).expect("a file");
    let parsed = files::scene_file::parse("my.toml", &text.replace("value = \"criterion\"\n", "")).expect("a scene");
    let map = scene::map::read("my.toml", &parsed.panels[0].tables).expect("a map");
    assert_eq!((map.value, map.columns()[2]), (Value::Margin, "margin"));
    let (map, computed) = self::map("criterion-log-free");
    let csv = String::from_utf8(computed.to_csv(&map)).expect("text");
    let lines: Vec<&str> = csv.lines().skip(1).collect();
    assert_eq!(lines.len(), 1400);
    assert!(lines.iter().all(|line| line.split(',').count() == 3));
    assert_eq!(lines.iter().filter(|line| line.ends_with(',')).count(), computed.blank.len());
}

#[test]
fn jams_have_one_speed_number_and_extent_for_any_sample() {
    let sampled = |sample: f64| {
        let overrides = Overrides { sample: Some(sample), ..Overrides::default() };
        let outcome = run(&case("jam-speed-ring133", &overrides)).expect("it runs");
        (outcome.drift.speed().expect("jams"), outcome.drift.jams().to_vec())
    };
    let (usual, jams) = sampled(1.0);
    // -0.1356 by this definition, -0.134 on the average of another
    assert!((usual.0 + 0.1356).abs() < 5e-4 && jams.len() == 6, "{usual:?} {jams:?}");
    for sample in [10.0, 100.0, 150.0, 200.0] {
        assert_eq!(sampled(sample), (usual, jams.clone()), "sample {sample}");
    }
}

/// Event, time and pedestrians of the events at one time.
fn at_once(events: &[Event], event: EventKind) -> (f64, Vec<usize>) {
    let own = || events.iter().filter(|happening| happening.kind == event);
    (own().next().expect("it happens").time, own().map(|happening| happening.pedestrian).collect())
}

#[test]
fn an_event_at_the_start_has_time_0_and_everybody() {
    let run = plain("event-at-0");
    assert_eq!(at_once(&run.events, EventKind::NegativeSpeed), (0.0, (0..20).collect()));
    assert_eq!(run.stop().map(|stop| stop.kind), Some(EventKind::Overlap));
}

#[test]
fn two_that_are_far_apart_walk_alone() {
    for name in ["far-apart", "far-apart-gaps"] {
        let run = plain(name);
        assert_eq!(run.statistics.time, 20.0);
        for row in tables::trajectories(&run.samples).rows() {
            let exact = -2.0 * math::exp_m1(-row[0]);
            assert!((row[3] - exact).abs() < 1e-11, "{name}: {row:?} and {exact}");
        }
    }
}

#[test]
fn an_unstable_run_ends_by_name_where_no_double_follows() {
    // thrown back at 52.272876414 and 52.333870, the third time to within less than any double tells
    for (method, tolerance) in [("taylor", 1e-12), ("dop853", 1e-12), ("extrapolation", 1e-10)] {
        let overrides =
            Overrides { method: Some(method.to_owned()), tolerance: Some(tolerance), ..Overrides::default() };
        let run = run(&case("blow-up-guo", &overrides)).unwrap_or_else(|broken| panic!("{broken}"));
        let stop = run.stop().expect("it stops");
        assert_eq!((stop.kind, stop.pedestrian), (EventKind::BlowUp, 1), "{method}");
        assert!((stop.time - 52.373_982_875).abs() < 2e-8, "{method}: {}", stop.time);
        assert_eq!(run.samples.len(), 53, "samples up to there");
        assert_eq!(run.statistics.time, stop.time, "it ends there");
    }
}

#[test]
fn what_follows_the_end_at_a_wall_is_part_of_its_error() {
    let overrides = [("taylor", 1e-12), ("dop853", 1e-10)].map(|(method, tolerance)| Overrides {
        method: Some(method.to_owned()),
        tolerance: Some(tolerance),
        ..Overrides::default()
    });
    for overrides in overrides {
        let (outcome, errors) = jam::errors::stated(&case("blow-up-guo", &overrides)).expect("it ends well");
        let stop = outcome.stop().expect("it stops");
        assert!(stop.is_at_wall(), "{stop:?}");
        // with 4200 bits, throws go on after this fifth one, towards 52.384
        let error = errors.events.last().copied().flatten().expect("a number");
        assert!(stop.time + error > 52.384 && error < 0.1, "{stop:?} {error:e}");
        // who is thrown turns within a rounding of the time
        assert!(errors.speeds.is_none() && errors.std.is_some_and(|error| error < 1e-6), "{errors:?}");
    }
}

fn refusal(text: &str) -> SceneError {
    let parsed = match files::scene_file::parse("my.toml", text) {
        Ok(parsed) => parsed,
        Err(error) => return error,
    };
    scene::run::read("my.toml", &parsed.panels[0].tables).expect_err("it is refused")
}

#[test]
fn an_end_too_near_for_adaptive_steps_is_named() {
    let text = std::fs::read_to_string(file("tiny-interval")).expect("a file");
    let error = refusal(&text);
    assert!(error.line == 13 && error.problem.contains("t_end = 1e-300"), "{error}");
    // steps of fixed length reach it
    let fixed = text.replace("tolerance = 1e-10", "dt = 1e-301");
    let parsed = files::scene_file::parse("my.toml", &fixed).expect("a scene");
    let scene = scene::run::read("my.toml", &parsed.panels[0].tables).expect("a run");
    assert_eq!(run(&scene).expect("it runs").statistics.steps, 10);
}

#[test]
fn names_of_panels_are_no_paths() {
    let text = std::fs::read_to_string(file("panel-names")).expect("a file");
    let error = refusal(&text);
    assert!(error.problem.contains("../outside") || error.problem.contains("N/L"), "{error}");
    for bad in ["../../x", "/x", "a b", "\u{3c1}", "", "x.y"] {
        let text = format!("[run]\nt_end = 1.0\n[panel.{bad:?}.run]\nt_end = 2.0\n");
        let error = refusal(&text);
        assert!(error.line == 3 && error.problem.contains(&format!("{bad:?}")), "{bad}: {error}");
    }
    let error = refusal(
        "[run]\nt_end = 1.0\n[panel.Ab.run]\nt_end = 2.0\n[panel.c.run]\nt_end = 3.0\n[panel.aB.run]\nt_end = 2.0\n",
    );
    assert_eq!(error.line, 7, "{error}");
    assert!(error.problem.starts_with("panel.aB: differs from panel.Ab (line 3) in case only"), "{error}");
    for device in ["con", "NUL", "Com1"] {
        let error = refusal(&format!("[run]\nt_end = 1.0\n[panel.{device}.run]\nt_end = 2.0\n"));
        assert!(
            error.line == 3 && error.problem.starts_with(&format!("panel.{device}: is the name of a device")),
            "{error}"
        );
    }
    for good in ["x", "N_2-b", "7", "com", "com12", "contact"] {
        files::scene_file::parse("my.toml", &format!("[panel.{good}.run]\nt_end = 2.0\n")).expect("a name");
    }
}

#[test]
fn a_force_in_contact_is_seen_where_the_run_goes_on() {
    let stopped = plain("contact-force-hfv");
    assert_eq!(stopped.stop().map(|stop| stop.kind), Some(EventKind::Overlap));
    let text = std::fs::read_to_string(file("contact-force-hfv")).expect("a file");
    let text = text.replace("[run]\n", "[run]\nat_overlap = \"continue\"\n");
    let parsed = files::scene_file::parse("my.toml", &text).expect("a scene");
    let scene = scene::run::read("my.toml", &parsed.panels[0].tables).expect("a run");
    assert_eq!(scene.at_overlap, AtOverlap::Continue);
    let on = run(&scene).expect("it runs");
    let overlap = |run: &Outcome| at_once(&run.events, EventKind::Overlap);
    assert_eq!(overlap(&on), overlap(&stopped));
    assert_ne!(on.stop().map(|stop| stop.kind), Some(EventKind::Overlap));
    assert!(on.samples.len() > stopped.samples.len(), "{} and {}", on.samples.len(), stopped.samples.len());
    // where the force is infinite nothing goes on
    let text = std::fs::read_to_string(file("blow-up-guo")).expect("a file");
    let error = refusal(&text.replace("[run]\n", "[run]\nat_overlap = \"continue\"\n"));
    assert!(error.line == 14 && error.problem.contains("at_overlap"), "{error}");
}

#[test]
fn a_perturbation_of_any_size_keeps_its_digits() {
    let with_shift = |shift: f64| {
        let mut scene = case("jam-speed-ring133", &Overrides { t_end: Some(20.0), ..Overrides::default() });
        scene.start.shift = shift;
        run(&scene).expect("it runs").samples.std
    };
    let usual = with_shift(1e-9);
    for shift in [1e-30, 1e-160, 1e-200, 1e-280] {
        for (std, usual) in with_shift(shift).iter().zip(&usual).skip(1) {
            let (std, usual) = (std / shift, usual / 1e-9);
            // linear to the square of the larger one
            assert!((std / usual - 1.0).abs() < 1e-7, "{shift:e}: {std} and {usual}");
        }
    }
}

#[test]
fn the_case_of_a_long_run_is_one_by_adaptive_steps() {
    let scene = case("long-adaptive", &Overrides::default());
    assert!(matches!(scene.control, Control::Adaptive { .. }) && scene.t_end == 1e9);
}
