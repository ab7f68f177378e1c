//! Runs: two methods against each other, events, and what a run records.

use crate::project::{figure, jams, scene, with_check};
use files::table::Table;
use jam::events::EventKind;
use jam::run::{Narrowest, Outcome, RunObserver, Statistics, run, run_from};
use jam::states::StateVariables;
use ode::Step;
use scene::Overrides;
use scene::tables;

/// The largest difference of a column over the rows that both have, relative to its range.
fn difference(runs: &[Outcome; 2], table: fn(&Outcome) -> Table, column: &str) -> f64 {
    let [one, other] = runs.each_ref().map(|run| table(run).column(column).expect("the column"));
    assert_eq!(one.len(), other.len());
    let high = one.iter().copied().fold(f64::NEG_INFINITY, math::larger);
    let low = one.iter().copied().fold(f64::INFINITY, math::smaller);
    let largest = one.iter().zip(&other).map(|(a, b)| (a - b).abs()).fold(0.0, math::larger);
    largest / (high - low)
}

fn events(run: &Outcome) -> Vec<EventKind> {
    run.events.iter().map(|happening| happening.kind).collect()
}

#[test]
fn figures_4_and_7_agree_with_their_check() {
    for (id, panel) in [("fig04", "stable"), ("fig07", "stable"), ("fig07", "unstable")] {
        let runs = with_check(&figure(id), panel);
        let error = difference(&runs, |run| tables::std(&run.samples), "std");
        println!("{id} {panel}: {error:e} of the range, {} steps", runs[0].statistics.steps);
        assert!(error < 1e-8, "{id} {panel}: {error:e}");
        assert_eq!(events(&runs[0]), events(&runs[1]));
        for (a, b) in runs[0].events.iter().zip(&runs[1].events) {
            println!("{} at {} and {}", a.kind.name(), a.time, b.time);
            // the time errs as the state does, divided by the rate at which the room shrinks, which is of order 1
            assert!((a.time - b.time).abs() < 1e-7 && a.pedestrian == b.pedestrian, "{a:?} {b:?}");
        }
    }
}

#[test]
fn the_unstable_algebraic_run_blows_up_at_one_time() {
    let runs = with_check(&figure("fig04"), "unstable");
    for run in &runs {
        assert_eq!(events(run), [EventKind::NegativeSpeed, EventKind::BlowUp]);
        assert!(run.events[0].time < run.events[1].time);
        assert_eq!(run.stop().map(|stop| stop.kind), Some(EventKind::BlowUp));
        // every gap is still open
        let gaps = run.positions.windows(2).map(|pair| pair[1] - pair[0]);
        assert!(gaps.fold(f64::INFINITY, math::smaller) > 0.0);
        // samples up to the stop
        let last = run.samples.times.last().copied().expect("a last sample");
        assert!(last <= run.events[1].time && last > run.events[1].time - 1.0);
    }
    let [one, other] = runs.each_ref().map(|run| run.events[1]);
    println!("blow-up at {:?} and {:?}: {:e} apart", one.time, other.time, one.time - other.time);
    assert!((one.time - other.time).abs() < 1e-8 && one.pedestrian == other.pedestrian);
    let error = difference(&runs, |run| tables::std(&run.samples), "std");
    println!("std before the blow-up: {error:e} of the range");
    assert!(error < 1e-8, "{error:e}");
}

/// The states at the ends of the steps that it sees.
#[derive(Default)]
struct Ends(Vec<Vec<f64>>);

impl RunObserver for Ends {
    fn after(&mut self, step: &Step<'_>) {
        self.0.push(step.after().to_vec());
    }
}

#[test]
fn a_run_that_changes_its_state_at_the_walls_counts_both_parts() {
    let overrides = Overrides { method: Some("dop853".to_owned()), ..Overrides::default() };
    let scene = scene(&figure("fig04"), "unstable", &overrides);
    let mut seen = Ends::default();
    let run = run_from(&scene, None, &mut seen).expect("it runs");
    let Statistics { steps, rejected, evaluations, .. } = run.statistics;
    assert_eq!(steps, seen.0.len() as u64);
    // deviations until somebody has less than a thousandth of the room in the uniform flow, then gaps
    let form = StateVariables::Deviations.build(&scene.model, scene.ring);
    let (first, second): (Vec<_>, Vec<_>) = seen.0.iter().partition(|state| state.len() == form.dimension());
    let (mut gaps, mut speeds) = (vec![0.0; 67], vec![0.0; 67]);
    let mut least = |state: &[f64]| {
        form.read(state, &mut gaps, &mut speeds);
        gaps.iter().fold(f64::INFINITY, |least: f64, gap| math::smaller(least, gap - 2.0)) / (200.0 / 67.0 - 2.0)
    };
    let (last, before) = (least(first[first.len() - 1]), least(first[first.len() - 2]));
    assert!(!second.is_empty() && before >= 1e-3 && last < 1e-3, "{before}, {last}, {}", second.len());
    // each step that is taken evaluates eleven stages and the rates at its end, each that is not at most as many; a
    // step that is looked into evaluates three more, once for each sample, or some tens of times where an event is
    // searched
    let stages = 12 * steps + 11 * rejected;
    assert_eq!((steps, rejected), (12_199, 3_621), "both parts have some of each; seen once and written down");
    assert!((12 * steps..stages + 3 * 20 * steps).contains(&evaluations), "{evaluations}, stages {stages}");
}

#[test]
fn of_a_calm_run_by_heun_only_the_steps_to_samples_are_seen() {
    let overrides = Overrides { dt: Some(1e-3), t_end: Some(20.0), sample: Some(0.5), ..Overrides::paper() };
    let mut seen = Ends::default();
    let run = run_from(&scene(&figure("fig04"), "stable", &overrides), None, &mut seen).expect("it runs");
    assert_eq!((run.statistics.steps, seen.0.len()), (20_000, 40));
}

#[test]
fn a_run_that_breaks_off_names_who_had_the_least_room() {
    let text = "[law]\nkind = \"algebraic\"\nmu = 0.5\nq = 2.0\na_v = 0.2\nv0 = 3.0\n\
                [ring]\npedestrians = 9\nlength = 45.0\n[start]\nshift = 0.8\n[run]\nt_end = 60.0\nsample = 1.0\n\
                method = \"dop853\"\ntolerance = 1e-10\nmost_steps = ";
    // who has the least room changes as the wave goes round
    let mut named = std::collections::BTreeSet::new();
    for most in [3, 15, 30, 45, 60] {
        let parsed = files::scene_file::parse("my.toml", &format!("{text}{most}\n")).expect("a scene");
        let scene = scene::run::read("my.toml", &parsed.panels[0].tables).expect("a run");
        let mut seen = Ends::default();
        let Err(broken) = run_from(&scene, None, &mut seen) else { panic!("{most} steps are enough") };
        let Narrowest { pedestrian, spacing: gap, effective_gap: room, speed } =
            broken.narrowest.expect("a state was reached");
        let (mut gaps, mut speeds) = ([0.0; 9], [0.0; 9]);
        let form = StateVariables::Deviations.build(&scene.model, scene.ring);
        form.read(seen.0.last().expect("a step was made"), &mut gaps, &mut speeds);
        let rooms: Vec<f64> = (0..9).map(|n| gaps[n] - 0.2 * (speeds[n] + speeds[(n + 1) % 9]) - 2.0).collect();
        assert_eq!((gap, speed), (gaps[pedestrian], speeds[pedestrian]));
        assert!((room - rooms[pedestrian]).abs() < 1e-14, "{room} not {}", rooms[pedestrian]);
        assert!(rooms.iter().all(|other| room <= other + 1e-14), "{room} of {rooms:?}");
        named.insert(pedestrian);
    }
    assert!(named.len() > 2, "{named:?}");
}

#[test]
fn the_unstable_exponential_run_overlaps_turns_back_and_exchanges() {
    let run = run(&scene(&figure("fig07"), "unstable", &Overrides::default())).expect("it runs");
    assert_eq!(events(&run), [EventKind::Overlap, EventKind::NegativeSpeed, EventKind::Exchange]);
    let stop = run.stop().expect("it stops");
    let last = run.samples.times.last().copied().expect("a last sample");
    assert!(last <= stop.time && last > stop.time - 1.0, "the table ends at the first stop");
    assert_eq!(run.statistics.time, run.events[2].time, "the run goes on for the later events, and ends at the last");
}

#[test]
fn figure_11_agrees_with_its_check() {
    let runs = jams();
    assert!(runs.iter().all(|run| run.events.is_empty() && run.statistics.time == 3000.0));
    for (table, column) in [("x", "x"), ("v", "v")] {
        let error = difference(runs, |run| tables::trajectories(&run.samples), column);
        println!("fig11 {table}: {error:e} of the range, {} steps", runs[0].statistics.steps);
        assert!(error < 1e-8, "{table}: {error:e}");
    }
    let error = difference(runs, |run| tables::std(&run.samples), "std");
    println!("fig13: {error:e} of the range");
    assert!(error < 1e-8, "{error:e}");
}

#[test]
fn figure_13_with_the_small_shift_agrees_with_its_check() {
    let runs = with_check(&figure("fig13"), "std_small_shift");
    assert!(runs.iter().all(|run| run.events.is_empty() && run.statistics.time == 3000.0));
    let error = difference(&runs, |run| tables::std(&run.samples), "std");
    println!("fig13 std_small_shift: {error:e} of the range, {} steps", runs[0].statistics.steps);
    assert!(error < 1e-8, "{error:e}");
}

#[test]
fn figure_11_ends_in_jams_that_travel_backwards() {
    let [run, check] = jams();
    let jams = run.drift.jams();
    let (speed, time) = run.drift.speed().expect("jams at the last samples");
    println!("{} jams, travelling at {speed} for {time}", jams.len());
    assert!(jams.len() > 1 && jams.len() == check.drift.jams().len());
    let slow: usize = jams.iter().map(|jam| jam.pedestrians).sum();
    assert!(slow > 10 && slow < 133);
    // a wrong sign, or jams taken for their neighbours (some 30 away), would be far off
    assert!((-0.15..-0.12).contains(&speed) && time > 500.0, "{speed} over {time}");
    // nobody stands: a stopped pedestrian walks at some 0.3 of the desired speed
    let slowest = run.speeds.iter().copied().fold(f64::INFINITY, math::smaller);
    assert!(slowest > 0.2 && slowest < 0.4, "{slowest}");
}

/// A short run of a few pedestrians.
fn short(changes: &[(&str, &str)]) -> Outcome {
    let text = "[law]\nkind = \"exponential\"\na = 3.0\nb = 1.5\nv0 = 3.0\n[ring]\npedestrians = 5\nlength = 15.0\n\
                [start]\nshift = 0.1\n[run]\nt_end = 10.0\nsample = 0.75\nmethod = \"dop853\"\ntolerance = 1e-12\n";
    let text = changes.iter().fold(text.to_owned(), |text, (from, to)| text.replacen(from, to, 1));
    let parsed = files::scene_file::parse("my.toml", &text).expect("a scene");
    run(&scene::run::read("my.toml", &parsed.panels[0].tables).expect("a run")).expect("it runs")
}

#[test]
fn tables_have_a_row_for_every_sample() {
    let run = short(&[]);
    let times: Vec<f64> = (0..=13).map(|k| f64::from(k) * 0.75).collect();
    assert_eq!(run.samples.times.clone(), times);
    assert_eq!(tables::trajectories(&run.samples).columns, ["t", "n", "x", "v"]);
    assert_eq!(tables::trajectories(&run.samples).len(), 14 * 5);
    let table = tables::trajectories(&run.samples);
    let rows: Vec<&[f64]> = table.rows().take(5).collect();
    assert_eq!(rows[0], [0.0, 0.0, 0.1, 0.0]);
    assert_eq!(rows[4], [0.0, 4.0, 12.0, 0.0]);
    assert_eq!(run.statistics.time, 10.0);
    // the standard deviation is that of the speeds in the trajectories
    let speeds: Vec<f64> =
        tables::trajectories(&run.samples).rows().filter(|row| row[0] == 7.5).map(|row| row[3]).collect();
    let std = run.samples.iter().find(|sample| sample.time == 7.5).expect("the sample").std;
    assert!((jam::observe::speed_std(&speeds) - std).abs() < 1e-14);
}

#[test]
fn trajectories_are_kept_only_where_they_are_wanted() {
    let run = short(&[("tolerance", "record = \"std\"\ntolerance")]);
    assert!(tables::trajectories(&run.samples).is_empty());
    assert_eq!(run.samples.std, short(&[]).samples.std);
}

#[test]
fn a_run_without_shift_stays_uniform_to_the_last_bit() {
    let run = short(&[("shift = 0.1", "shift = 0.0")]);
    assert!(run.samples.std.clone().iter().all(|&std| std == 0.0));
    assert!(run.events.is_empty() && run.drift.jams().is_empty() && run.drift.speed().is_none());
}

#[test]
fn a_tiny_shift_is_the_linear_run() {
    // a perturbation of 1e-300 keeps its digits: the same curve as with 1e-9, up to terms of 1e-9
    let std = |shift: &str| short(&[("shift = 0.1", shift)]).samples.std;
    for (shift, factor) in [("shift = 1e-100", 1e91), ("shift = 1e-300", 1e291)] {
        for (tiny, small) in std(shift).iter().zip(std("shift = 1e-9")).skip(1) {
            assert!((tiny * factor / small - 1.0).abs() < 1e-7, "{tiny:e} {small:e}");
        }
    }
}

#[test]
fn all_methods_and_states_give_the_same_run() {
    let exact = short(&[]);
    for state in ["deviations", "gaps", "positions"] {
        // errors over 10 time units with these steps, from the orders 1, 1, 2, 4, 8, 16
        for (method, dt, allowed) in [
            ("euler", "1e-4", 1e-3),
            ("ballistic", "1e-4", 1e-3),
            ("heun", "1e-3", 1e-5),
            ("rk4", "1e-2", 1e-7),
            ("dop853", "0.1", 1e-9),
            ("extrapolation", "0.5", 1e-9),
        ] {
            let run = short(&[
                ("tolerance = 1e-12", &format!("dt = {dt}\nstate = \"{state}\"")),
                ("\"dop853\"", &format!("\"{method}\"")),
            ]);
            let ends = exact.positions.iter().zip(&run.positions).chain(exact.speeds.iter().zip(&run.speeds));
            let largest = ends.map(|(a, b)| (a - b).abs()).fold(0.0, math::larger);
            assert!(largest < allowed, "{method} {state}: {largest:e}");
        }
    }
}

#[test]
fn two_pedestrians_are_a_ring() {
    let run = short(&[("pedestrians = 5\nlength = 15.0", "pedestrians = 2\nlength = 6.0")]);
    assert_eq!(run.positions.len(), 2);
    assert!(run.events.is_empty());
}

#[test]
fn a_stop_ends_the_tables_within_the_step() {
    // so fast that inertia carries a pedestrian past the one ahead
    let run = short(&[
        ("kind = \"exponential\"\na = 3.0\nb = 1.5\nv0 = 3.0", "kind = \"logarithmic\"\nv0 = 30.0\nepsilon = 0.01"),
        ("length = 15.0", "length = 7.5"),
        ("t_end = 10.0", "t_end = 100.0"),
        ("sample = 0.75", "sample = 0.0078125"),
    ]);
    let stop = *run.stop().expect("it overlaps");
    let last = run.samples.times.last().copied().expect("a last sample");
    println!("{:?}", run.events);
    assert!(last <= stop.time && last > stop.time - 0.0078125, "{last} {stop:?}");
    assert_eq!(tables::trajectories(&run.samples).len(), 5 * run.samples.len());
}
