//! Scenes like those of other seeds, but each with something that they never have: rings of two or three hundred,
//! samples denser than steps, runs shorter than a step, long ones, panels that differ in everything, everybody
//! displaced.

use super::{Law, law, push, shift, short};
use crate::random::Random;
use math::{larger, smaller};
use ode::Method;
use std::fmt::Write as _;

/// What a scene has that others never have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Class {
    /// Two pedestrians, who are each other's predecessors.
    Two,
    /// Three hundred.
    Many,
    /// Samples far denser than steps.
    Dense,
    /// An end before the first step would.
    Short,
    /// A long run of few pedestrians.
    Long,
    /// Panels that differ in law, ring, start and run.
    Panels,
    /// Everybody displaced, at random or as a wave.
    Displaced,
}

const CLASSES: [Class; 7] =
    [Class::Two, Class::Many, Class::Dense, Class::Short, Class::Long, Class::Panels, Class::Displaced];

/// The scene of this seed.
pub(super) fn scene(seed: u64) -> String {
    let random = &mut Random::new(seed);
    let class = CLASSES[(seed % CLASSES.len() as u64) as usize];
    let law = law(random);
    let room = if law.contact == 0.0 { random.decades(-0.5, 1.0) } else { random.decades(-1.5, 1.5) };
    let pedestrians = match class {
        Class::Two => 2,
        Class::Many => 300,
        Class::Long => (random.decades(0.31, 0.8) + 0.01).floor() as usize,
        _ => (random.decades(0.31, 1.7) + 0.01).floor() as usize,
    };
    let (ring, room) = ring(&law, pedestrians, room);
    let start = match class {
        Class::Displaced => displacements(random, pedestrians, room),
        _ => format!("shift = {}\n", shift(random, room)),
    };
    let head = format!("title = \"Random scene {seed}\"\n\n[law]\n{}\n[ring]\n{ring}\n[start]\n{start}", law.text);
    let run = run(random, class, &law, pedestrians, law.rate(room));
    let panels = if class == Class::Panels { panels(random, &law, room) } else { String::new() };
    format!("{head}\n[run]\n{run}{panels}")
}

/// The text, and the room at rest.
fn ring(law: &Law, pedestrians: usize, room: f64) -> (String, f64) {
    let length: f64 = format!("{:.6e}", (law.contact + room) * pedestrians as f64).parse().unwrap_or(room);
    let room = length / pedestrians as f64 - law.contact;
    (format!("pedestrians = {pedestrians}\nlength = {length:?}\n"), room)
}

/// A comment for the hunt alone: scene files shift pedestrian 0, the library displaces everybody.
fn displacements(random: &mut Random, pedestrians: usize, room: f64) -> String {
    let size = 0.45 * room * if random.chance(0.5) { random.decades(-12.0, -2.0) } else { random.decades(-2.0, 0.0) };
    let waves = random.pick(&[0.0, 1.0, 2.0]);
    let mut text = "shift = 0.0\n# displacements = [".to_owned();
    for n in 0..pedestrians {
        let place = 2.0 * std::f64::consts::PI * waves * n as f64 / pedestrians as f64;
        let part = if waves == 0.0 { random.between(-1.0, 1.0) } else { math::sin(place) };
        let _ = write!(text, "{}{:e}", if n == 0 { "" } else { ", " }, short(size * part));
    }
    text + "]\n"
}

fn run(random: &mut Random, class: Class, law: &Law, pedestrians: usize, rate: f64) -> String {
    let method = random.pick(&Method::ALL);
    let method = if method.needs_series() && !law.has_series { Method::Taylor } else { method };
    let most = match class {
        Class::Long => 3e4 / pedestrians as f64,
        Class::Many => 20.0,
        _ => smaller(5e3 / pedestrians as f64, 200.0),
    } / rate;
    let t_end = match class {
        Class::Short => random.decades(-12.0, -1.0) / rate,
        Class::Long => most * random.decades(-0.5, 0.0),
        _ => most * random.decades(-2.0, 0.0),
    };
    let t_end = short(t_end);
    let rows = if class == Class::Dense { random.decades(1.5, 3.0) } else { random.pick(&[0.3, 1.0, 3.7, 10.0]) };
    let mut text = format!("method = \"{}\"\n", method.name());
    push(&mut text, "t_end", t_end);
    push(&mut text, "sample", short(t_end / rows));
    if method.is_adaptive() && random.chance(0.8) {
        push(&mut text, "tolerance", super::decades(random, -14.0, -3.0));
        text.push_str("most_steps = 100000\n");
    } else {
        // of a short run, the step is longer than all of it
        let step =
            if class == Class::Short { t_end * random.decades(-0.5, 1.5) } else { random.decades(-3.0, -0.5) / rate };
        push(&mut text, "dt", short(larger(step, larger(t_end / 3e4, t_end * pedestrians as f64 / 3e6))));
    }
    if method != Method::Taylor && random.chance(0.4) {
        let _ = writeln!(text, "state = \"{}\"", random.pick(&["gaps", "positions", "deviations"]));
    }
    if class == Class::Many || random.chance(0.2) {
        text.push_str("record = \"std\"\n");
    }
    text
}

/// Panels that differ from the scene in two of its tables each.
fn panels(random: &mut Random, law: &Law, room: f64) -> String {
    let mut text = String::new();
    for name in ["one", "two", "three"] {
        let pedestrians = (random.decades(0.31, 1.5) + 0.01).floor() as usize;
        let (ring, room) = ring(law, pedestrians, room * random.decades(-0.3, 0.3));
        let _ = write!(
            text,
            "\n[panel.{name}.law]\nv0 = {:?}\n\n[panel.{name}.ring]\n{ring}\n[panel.{name}.start]\nshift = {}\n",
            short(law.v0 * random.between(0.7, 1.1)),
            shift(random, room)
        );
    }
    text
}
