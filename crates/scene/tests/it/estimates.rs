//! Estimated errors against true errors, in random scenes.

use jam::errors::Propagated;
use jam::errors::{errors, errors_of};
use jam::run::{Outcome, run, run_from};
use ode::{Control, Method};
use scene::run::{Scene, read};

/// Numbers drawn at random, always the same (Knuth's generator of 64 bits).
struct Draw(u64);

impl Draw {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        low + (high - low) * ((self.0 >> 11) as f64 / (1_u64 << 53) as f64)
    }

    fn decades(&mut self, low: f64, high: f64) -> f64 {
        math::pow(10.0, self.between(math::log10(low), math::log10(high)))
    }
}

/// A scene over decades of its parameters, if it can be run.
fn draw(random: &mut Draw) -> Option<Scene> {
    let (epsilon, v0) = (random.decades(1e-8, 1.0), random.between(0.5, 3.0));
    let (a_v, is_wide) = (random.between(0.0, 0.3), random.between(0.0, 1.0) < 0.4);
    let (law, contact) = match random.between(0.0, 3.0) as u32 {
        0 => {
            let (mu, q) = (random.decades(0.05, 1.0), random.between(1.0, 4.0));
            let delta = if is_wide { random.between(0.0, 0.5) } else { 0.0 };
            (format!("kind = \"algebraic\"\nmu = {mu:?}\nq = {q:?}\ndelta = {delta:?}"), 2.0)
        }
        1 => {
            let (a, b) = (random.decades(0.1, 10.0), random.decades(0.05, 3.0));
            let c = if is_wide { random.decades(0.1, 10.0) } else { 0.0 };
            (format!("kind = \"exponential\"\na = {a:?}\nb = {b:?}\nc = {c:?}"), 2.0)
        }
        _ => ("kind = \"logarithmic\"".to_owned(), 0.0),
    };
    let a_v = if is_wide { a_v } else { 0.0 };
    let count = random.decades(2.0, 40.0) as usize;
    let room = random.between(0.6, 3.0);
    let shift = room * random.decades(1e-6, 0.9);
    let method = Method::ALL[random.between(0.0, 14.0) as usize];
    let method = match method {
        Method::Taylor if is_wide => Method::Dop853,
        method if method.is_adaptive() => method,
        _ => Method::Verner87,
    };
    let (tolerance, t_end) = (random.decades(1e-10, 1e-6), random.between(2.0, 40.0));
    let text = format!(
        "[law]\n{law}\na_v = {a_v:?}\nepsilon = {epsilon:?}\nv0 = {v0:?}\n[ring]\npedestrians = {count}\n\
         length = {:?}\n[start]\nshift = {shift:?}\n[run]\nt_end = {t_end:?}\nsample = 1.0\n\
         method = \"{}\"\ntolerance = {tolerance:?}\nmost_steps = 200000\n",
        count as f64 * (contact + room),
        method.name()
    );
    let parsed = files::scene_file::parse("my.toml", &text).ok()?;
    read("my.toml", &parsed.panels[0].tables).ok()
}

/// The largest difference of the standard deviation from that of a run with far smaller errors by another method.
fn true_error(scene: &Scene, outcome: &Outcome) -> Option<f64> {
    let method = if scene.method == Method::Verner98 { Method::Dop853 } else { Method::Verner98 };
    let control = Control::Adaptive { tolerance: 1e-14 };
    let exact = run(&Scene { method, control, most_steps: 2_000_000, ..scene.clone() }).ok()?;
    let rows = outcome.samples.std.iter().zip(&exact.samples.std);
    Some(rows.fold(0.0, |most: f64, (one, other)| math::larger(most, (one - other).abs())))
}

#[test]
fn estimates_are_honest_and_not_too_shy() {
    let mut random = Draw(5);
    let (mut ratios, mut unknown) = (Vec::new(), 0);
    for seed in 0..SCENES {
        let Some(scene) = draw(&mut random) else { continue };
        let Ok(outcome) = run(&scene) else { continue };
        let Some(stated) = errors(&scene, &outcome).std else {
            unknown += 1;
            continue;
        };
        let Some(true_error) = true_error(&scene, &outcome) else { continue };
        let size = outcome.samples.std.iter().copied().fold(0.0, math::larger);
        // what is as small as the reference's own error says nothing
        if true_error > 1e-13 * size {
            if true_error > 3.0 * stated {
                println!("scene {seed}: {true_error:e} stated {stated:e} {scene:?}");
            }
            ratios.push(true_error / stated);
        }
    }
    ratios.sort_by(f64::total_cmp);
    let (count, at) = (ratios.len(), |part: f64| ratios[((ratios.len() - 1) as f64 * part) as usize]);
    println!(
        "{count} scenes, {unknown} unknown; true over stated: {:e} {:e} {:e} {:e}",
        at(0.1),
        at(0.5),
        at(0.99),
        at(1.0)
    );
    assert!(count > 40 && unknown < count / 10, "{count}, {unknown} unknown");
    assert!(at(1.0) < 10.0 && at(0.99) < 3.0 && at(0.1) > 0.01, "{:e} {:e} {:e}", at(1.0), at(0.99), at(0.1));
}

/// So many scenes are drawn.
const SCENES: usize = 300;

/// True errors over those that the steps of a run by Taylor's method tell: of std, of positions and of speeds at the
/// end.
fn told(scene: &Scene) -> Option<[(f64, f64); 3]> {
    let mut propagated = Propagated::new(scene);
    let outcome = run_from(scene, None, &mut propagated).ok()?;
    let told = propagated.errors(scene, &outcome)?;
    let control = Control::Adaptive { tolerance: 1e-14 };
    let t_end = outcome.statistics.time;
    let exact =
        run(&Scene { method: Method::Verner98, control, t_end, most_steps: 2_000_000, ..scene.clone() }).ok()?;
    let apart = |a: &[f64], b: &[f64]| a.iter().zip(b).fold(0.0, |most: f64, (a, b)| math::larger(most, (a - b).abs()));
    let std = |outcome: &Outcome| outcome.samples.std.clone();
    let whole = exact.statistics.time == t_end;
    let is_blow_up = told.positions.is_none();
    (whole && !is_blow_up).then(|| {
        [
            (apart(&std(&outcome), &std(&exact)), told.std.expect("a number")),
            (apart(&outcome.positions, &exact.positions), told.positions.expect("a number")),
            (apart(&outcome.speeds, &exact.speeds), told.speeds.expect("a number")),
        ]
    })
}

#[test]
fn errors_that_steps_tell_are_honest_and_not_too_shy() {
    let mut random = Draw(11);
    let mut ratios = Vec::new();
    for seed in 0..SCENES {
        let Some(scene) = draw(&mut random) else { continue };
        let scene = Scene { method: Method::Taylor, ..scene };
        if !Method::Taylor.suits(&*scene.form.build(&scene.model, scene.ring)) {
            continue;
        }
        for (what, (error, stated)) in
            ["std", "positions", "speeds"].into_iter().zip(told(&scene).into_iter().flatten())
        {
            // the other run has errors of its own
            if error > 1e-12 {
                let ratio = error / stated;
                if !(0.01..3.0).contains(&ratio) {
                    println!("scene {seed}: {what} off by {error:e}, stated {stated:e} {scene:?}");
                }
                ratios.push(ratio);
            }
        }
    }
    ratios.sort_by(f64::total_cmp);
    let (count, at) = (ratios.len(), |part: f64| ratios[((ratios.len() - 1) as f64 * part) as usize]);
    println!("{count} numbers; true over stated: {:e} {:e} {:e} {:e}", at(0.1), at(0.5), at(0.99), at(1.0));
    assert!(count > 150, "{count}");
    assert!(at(1.0) < 10.0 && at(0.99) < 3.0 && at(0.1) > 0.01, "{:e} {:e} {:e}", at(1.0), at(0.99), at(0.1));
}

#[test]
fn laws_with_kinks_and_other_methods_tell_nothing() {
    let text = |law: &str, method: &str| {
        let text = format!(
            "[law]\n{law}\n[ring]\npedestrians = 5\nlength = 20.0\n[start]\nshift = 0.1\n[run]\nt_end = 5.0\nsample = 1.0\n\
             method = \"{method}\"\ntolerance = 1e-8\n"
        );
        let parsed = files::scene_file::parse("my.toml", &text).expect("a scene");
        read("my.toml", &parsed.panels[0].tables).expect("a run")
    };
    let smooth = "kind = \"exponential\"\na = 3.0\nb = 1.5\nv0 = 1.2";
    let kinked = "kind = \"formula\"\nacceleration = \"v0 - v - max(0, 3 - s)^2\"\nv0 = 1.2\nbody = 0.0";
    for (law, method, tells) in [(smooth, "taylor", true), (smooth, "dop853", false), (kinked, "taylor", false)] {
        let scene = text(law, method);
        let mut propagated = Propagated::new(&scene);
        let outcome = run_from(&scene, None, &mut propagated).expect("it runs");
        assert_eq!(propagated.errors(&scene, &outcome).is_some(), tells, "{law} {method}");
        // then a second run tells them
        let errors = errors_of(&scene, &outcome, Some(&propagated), &mut ());
        assert!(errors.std.is_some_and(|error| error > 0.0) && (errors.cost > 0.0) != tells, "{law} {method}");
    }
}

/// The scene of figure 4 with this `mu` to this time, by Taylor's method.
fn figure_4(mu: f64, t_end: f64) -> Scene {
    let text = format!(
        "[law]\nkind = \"algebraic\"\nmu = {mu:?}\nq = 2.0\nv0 = 3.0\n[ring]\npedestrians = 67\nlength = 200.0\n\
         [start]\nshift = 1e-4\n[run]\nt_end = {t_end:?}\nsample = 1.0\nmethod = \"taylor\"\ntolerance = 1e-12\n\
         record = \"std\"\n"
    );
    let scene_file = files::scene_file::parse("my.toml", &text).expect("a scene");
    read("my.toml", &scene_file.panels[0].tables).expect("a run")
}

/// Both numbers are there and no more than so many times apart.
fn are_near(one: Option<f64>, other: Option<f64>, times: f64) -> bool {
    one.zip(other).is_some_and(|(one, other)| one < times * other && other < times * one)
}

/// Once the flow is all but uniform, steps are longer than the time in which an error moves.
#[test]
fn a_slow_run_tells_errors_that_move_faster_than_its_steps() {
    let scene = figure_4(0.45, 1200.0);
    let mut propagated = Propagated::new(&scene);
    let outcome = run_from(&scene, None, &mut propagated).expect("it runs");
    assert!(outcome.statistics.steps < 300, "{} steps", outcome.statistics.steps);
    let told = propagated.errors(&scene, &outcome).expect("steps tell their errors");
    let second = errors(&scene, &outcome);
    assert!(are_near(told.std, second.std, 30.0), "{told:?} {second:?}");
    assert!(are_near(told.positions, second.positions, 30.0), "{told:?} {second:?}");
}

/// The error leaves all bounds in the throws before a blow-up; its time is known all the same.
#[test]
fn the_time_of_a_blow_up_is_told_without_a_second_run() {
    let scene = figure_4(0.55, 2000.0);
    let mut propagated = Propagated::new(&scene);
    let outcome = run_from(&scene, None, &mut propagated).expect("it runs");
    let told = propagated.errors(&scene, &outcome).expect("steps tell their errors");
    let second = errors(&scene, &outcome);
    assert_eq!(told.events.len(), 2, "{:?}", outcome.events);
    for (one, other) in told.events.iter().zip(&second.events) {
        assert!(are_near(*one, *other, 30.0), "{told:?} {second:?}");
    }
    assert!(told.positions.is_none() && told.speeds.is_none(), "{told:?}");
}
