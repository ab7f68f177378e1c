//! Draws random scenes, with every parameter varied over decades, as the text of scene files.

mod formulas;
mod wider;

use crate::random::Random;
use math::{larger, smaller};
use ode::Method;
use std::fmt::Write as _;

/// A law as text, with what the rest of a scene has to know of it.
struct Law {
    text: String,
    v0: f64,
    /// The spacing at which the room of standing pedestrians ends.
    contact: f64,
    /// Whether the force depends on the spacing alone.
    has_series: bool,
    /// How steep the force is: against the spacing, at the start and where it balances the drive; against speeds, as a
    /// multiple of that and as a number.
    steepness: Steepness,
}

/// How steep a force is.
struct Steepness {
    /// Against the room.
    by_room: Box<dyn Fn(f64) -> f64>,
    /// Where the force balances the drive.
    balanced: f64,
    /// `a_v`.
    widening: f64,
    /// Against speeds besides.
    by_speed: f64,
}

impl Law {
    /// How fast, about, the fastest motion is.
    fn rate(&self, room: f64) -> f64 {
        let Steepness { by_room, balanced, widening, by_speed } = &self.steepness;
        let phi = larger(by_room(room), *balanced);
        1.0 + phi.sqrt() + widening * phi + by_speed
    }
}

/// Seeds from this on draw laws as formulas, those below the laws of the paper.
pub const FORMULAS: u64 = 1_000_000;

/// Seeds from this on draw the scenes of seeds lower by this, but all by Taylor's method with steps of adaptive length.
pub const TAYLOR: u64 = 2_000_000;

/// Seeds from this on draw scenes with what the others never have.
pub const WIDER: u64 = 10_000_000;

/// The scene of this seed.
pub fn scene(seed: u64) -> String {
    if seed >= WIDER {
        return wider::scene(seed);
    }
    if seed >= TAYLOR {
        return by_taylor(&scene(seed - TAYLOR), &mut Random::new(seed));
    }
    if seed >= FORMULAS {
        return formulas::scene(seed);
    }
    let mut random = Random::new(seed);
    let law = law(&mut random);
    let (ring, pedestrians, room) = ring(&mut random, &law);
    let shift = shift(&mut random, room);
    // refused where the force is infinite at contact
    let continues = match (law.contact > 0.0, law.text.contains("algebraic")) {
        (false, _) => 0.0,
        (true, true) => 0.01,
        (true, false) => 0.1,
    };
    let run = run(&mut random, Kind { has_series: law.has_series, continues }, pedestrians, law.rate(room));
    let panels = if random.chance(0.1) { panels(&mut random, law.v0) } else { String::new() };
    format!(
        "title = \"Random scene {seed}\"\n\n[law]\n{}\n[ring]\n{ring}\n[start]\nshift = {shift}\n\n[run]\n{run}{panels}",
        law.text
    )
}

/// A scene by Taylor's method: in deviations if its law has them so, else in spacings.
fn by_taylor(text: &str, random: &mut Random) -> String {
    let tolerance = decades(random, -14.0, -4.0);
    let own = ["method", "dt", "tolerance", "most_steps", "state"];
    let is_own = |line: &&str| own.iter().any(|key| line.split(' ').next() == Some(key));
    let rest: Vec<&str> = text.lines().filter(|line| !is_own(line)).collect();
    let with = |state: &str| {
        let run =
            format!("[run]\nmethod = \"taylor\"\ntolerance = {tolerance:?}\nmost_steps = 100000\nstate = \"{state}\"");
        rest.join("\n").replace("[run]", &run) + "\n"
    };
    let is_refused = |text: &str| {
        let scene_file = files::scene_file::parse("scene.toml", text);
        scene_file.is_ok_and(|scene_file| {
            scene_file.panels.iter().any(|panel| {
                let scene = scene::run::read("scene.toml", &panel.tables);
                scene.is_err_and(|error| error.to_string().contains("positions have no series"))
            })
        })
    };
    let deviations = with("deviations");
    if is_refused(&deviations) { with("gaps") } else { deviations }
}

/// A number as people write it: three digits.
fn short(number: f64) -> f64 {
    format!("{number:.2e}").parse().unwrap_or(number)
}

/// A number over decades, with three digits.
fn decades(random: &mut Random, from: f64, to: f64) -> f64 {
    short(random.decades(from, to))
}

/// 0 or a number over decades.
fn perhaps(random: &mut Random, from: f64, to: f64) -> f64 {
    if random.chance(0.5) { 0.0 } else { decades(random, from, to) }
}

fn law(random: &mut Random) -> Law {
    let v0 = decades(random, -1.0, 1.0);
    let epsilon = decades(random, -8.0, 0.0);
    let a_v = perhaps(random, -3.0, 0.0);
    let mut law = match random.pick(&["algebraic", "exponential", "logarithmic"]) {
        "algebraic" => algebraic(random, v0, epsilon, a_v),
        "exponential" => exponential(random, v0, epsilon, a_v),
        _ => logarithmic(v0, epsilon, a_v),
    };
    push(&mut law.text, "v0", v0);
    law
}

fn logarithmic(v0: f64, epsilon: f64, a_v: f64) -> Law {
    let mut text = format!("kind = \"logarithmic\"\nepsilon = {epsilon:?}\n");
    optional(&mut text, "a_v", a_v);
    let steepness = Steepness { by_room: Box::new(|_| 0.0), balanced: v0, widening: a_v, by_speed: 0.0 };
    Law { text, v0, contact: 0.0, has_series: a_v == 0.0, steepness }
}

fn algebraic(random: &mut Random, v0: f64, epsilon: f64, a_v: f64) -> Law {
    let mut mu = decades(random, -2.0, 0.7);
    let mut delta = perhaps(random, -3.0, 0.5);
    let mut q = if random.chance(0.5) { random.pick(&[1.0, 2.0, 3.0]) } else { short(random.between(0.3, 4.0)) };
    let mut text = "kind = \"algebraic\"\n".to_owned();
    let mut widening = a_v;
    if random.chance(0.15) {
        // tab:model: what a preset fixes must not be given
        let name = random.pick(&["CFM", "GCFM", "HFV", "SEY", "GUO"]);
        let _ = writeln!(text, "preset = \"{name}\"");
        (delta, q) = match name {
            "CFM" | "GCFM" => (1.0, 1.0),
            "GUO" => (0.0, 1.0),
            _ => (0.0, 2.0),
        };
        if name == "CFM" {
            mu = epsilon * std::f64::consts::LN_2;
        } else {
            push(&mut text, "mu", mu);
        }
        let is_open = matches!(name, "GCFM" | "SEY");
        widening = if is_open { larger(a_v, 0.01) } else { 0.0 };
        if is_open {
            push(&mut text, "a_v", widening);
        }
    } else {
        push(&mut text, "mu", mu);
        push(&mut text, "q", q);
        optional(&mut text, "delta", delta);
        optional(&mut text, "a_v", a_v);
    }
    if delta > 0.0 {
        push(&mut text, "epsilon", epsilon);
    }
    let steepness = Steepness {
        by_room: Box::new(move |room| q * mu * mu / math::pow(room, q + 1.0)),
        balanced: q * v0 / math::pow(mu * mu / v0, 1.0 / q),
        widening,
        by_speed: 2.0 * delta * v0 / mu,
    };
    Law { text, v0, contact: 2.0, has_series: delta == 0.0 && widening == 0.0, steepness }
}

fn exponential(random: &mut Random, v0: f64, epsilon: f64, a_v: f64) -> Law {
    let (a, b) = (decades(random, -2.0, 2.0), decades(random, -4.0, 1.0));
    let c = perhaps(random, -2.0, 3.0);
    let mut text = "kind = \"exponential\"\n".to_owned();
    push(&mut text, "a", a);
    push(&mut text, "b", b);
    optional(&mut text, "c", c);
    optional(&mut text, "a_v", a_v);
    if c > 0.0 {
        push(&mut text, "epsilon", epsilon);
    }
    let by_room = Box::new(move |room: f64| a / b * math::exp(-room / b) + c);
    let steepness = Steepness { by_room, balanced: v0 / b + c, widening: a_v, by_speed: 0.0 };
    Law { text, v0, contact: 2.0, has_series: c == 0.0 && a_v == 0.0, steepness }
}

/// The text, how many, the room at rest.
fn ring(random: &mut Random, law: &Law) -> (String, usize, f64) {
    let pedestrians = (random.decades(0.301, 2.478) + 0.01).floor() as usize;
    let room = if law.contact == 0.0 { random.decades(-0.5, 1.5) } else { random.decades(-2.0, 2.0) };
    let length: f64 = format!("{:.6e}", (law.contact + room) * pedestrians as f64).parse().unwrap_or(room);
    let headway = length / pedestrians as f64;
    (format!("pedestrians = {pedestrians}\nlength = {length:?}\n"), pedestrians, headway - law.contact)
}

/// From 1e-200 to most of the room, forward or backward; sometimes none.
fn shift(random: &mut Random, room: f64) -> String {
    let size = match random.between(0.0, 1.0) {
        chance if chance < 0.03 => 0.0,
        chance if chance < 0.3 => random.decades(-200.0, -8.0),
        chance if chance < 0.6 => random.decades(-8.0, -0.01) * room,
        _ => random.decades(-2.0, -0.01) * room,
    };
    let sign = random.pick(&[1.0, -1.0]);
    format!("{:e}", short(sign * size))
}

/// What a run has to know of its law.
struct Kind {
    /// Whether the force depends on the spacing alone.
    has_series: bool,
    /// The probability that it is to go on after an overlap.
    continues: f64,
}

fn run(random: &mut Random, law: Kind, pedestrians: usize, rate: f64) -> String {
    let method = random.pick(&Method::ALL);
    let method = if method.needs_series() && !law.has_series && random.chance(0.9) { Method::Dop853 } else { method };
    // what both integrations can afford
    let longest = smaller(1e4 / pedestrians as f64, 500.0) / rate;
    let t_end = short(smaller(random.decades(-1.5, 2.7), longest));
    let sample = t_end / random.pick(&[0.3, 1.0, 2.0, 3.7, 10.0, 20.0]);
    let mut text = format!("method = \"{}\"\n", method.name());
    push(&mut text, "t_end", t_end);
    push(&mut text, "sample", short(sample));
    if method.is_adaptive() && random.chance(0.85) {
        push(&mut text, "tolerance", decades(random, -14.0, -3.0));
        text.push_str("most_steps = 100000\n");
    } else {
        let step = random.decades(-4.0, 0.0) / rate;
        push(&mut text, "dt", short(larger(step, larger(t_end / 3e4, t_end * pedestrians as f64 / 3e6))));
    }
    if !method.needs_series() && random.chance(0.4) {
        let _ = writeln!(text, "state = \"{}\"", random.pick(&["gaps", "positions", "deviations"]));
    }
    if law.continues > 0.0 && random.chance(law.continues) {
        text.push_str("at_overlap = \"continue\"\n");
    }
    if random.chance(0.25) {
        text.push_str("record = \"std\"\n");
    }
    text
}

/// Two panels that differ from the scene.
fn panels(random: &mut Random, v0: f64) -> String {
    let method = random.pick(&["dop853", "tsit54", "verner87"]);
    let tolerance = decades(random, -12.0, -5.0);
    let v0 = short(v0 * random.between(0.7, 1.1));
    format!(
        "\n[panel.slower.law]\nv0 = {v0:?}\n\n[panel.finer.start]\nshift = {:e}\n\n[panel.other.run]\nmethod = \"{method}\"\ntolerance = {tolerance:?}\n",
        decades(random, -20.0, -3.0)
    )
}

fn push(text: &mut String, key: &str, value: f64) {
    // writing to a string cannot fail
    let _ = writeln!(text, "{key} = {value:?}");
}

/// A term that is not named is not computed.
fn optional(text: &mut String, key: &str, value: f64) {
    if value != 0.0 {
        push(text, key, value);
    }
}
