//! Errors as estimated against errors as they are, in random scenes.

use ode::{Control, Method};
use scene::check::errors;
use scene::run::{Scene, read};
use scene::simulation::{Outcome, run};

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
    let recipe = files::recipe::parse("my.toml", &text).ok()?;
    read("my.toml", &recipe.panels[0].tables).ok()
}

/// The largest difference of the standard deviation from that of a run with far smaller errors by another method.
fn true_error(scene: &Scene, outcome: &Outcome) -> Option<f64> {
    let method = if scene.method == Method::Verner98 { Method::Dop853 } else { Method::Verner98 };
    let control = Control::Adaptive { tolerance: 1e-14 };
    let exact = run(&Scene { method, control, most_steps: 2_000_000, ..scene.clone() }).ok()?;
    let rows = outcome.std.rows().zip(exact.std.rows());
    Some(rows.fold(0.0, |most: f64, (one, other)| math::larger(most, (one[1] - other[1]).abs())))
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
        let size = outcome.std.rows().fold(0.0, |most: f64, row| math::larger(most, row[1]));
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
