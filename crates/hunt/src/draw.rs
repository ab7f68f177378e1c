//! Random scenes over decades of every parameter, as the text of scene files.

use crate::random::Random;
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
    /// How fast, about, the fastest motion is where the force balances the drive.
    rate: f64,
}

/// The scene of this seed.
pub fn scene(seed: u64) -> String {
    let mut random = Random::new(seed);
    let law = law(&mut random);
    let (ring, pedestrians, headway, room) = ring(&mut random, &law);
    let shift = shift(&mut random, room);
    let run = run(&mut random, &law, pedestrians, headway);
    let panels = if random.chance(0.1) { panels(&mut random, &law) } else { String::new() };
    format!(
        "title = \"Random scene {seed}\"\n\n[law]\n{}\n[ring]\n{ring}\n[start]\nshift = {shift}\n\n[run]\n{run}{panels}",
        law.text
    )
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
        _ => Law {
            text: format!("kind = \"logarithmic\"\nepsilon = {epsilon:?}\n"),
            v0,
            contact: 0.0,
            has_series: a_v == 0.0,
            rate: 1.0 + v0.sqrt() + a_v * v0,
        },
    };
    push(&mut law.text, "v0", v0);
    optional(&mut law.text, "a_v", a_v);
    law
}

fn algebraic(random: &mut Random, v0: f64, epsilon: f64, a_v: f64) -> Law {
    let mu = decades(random, -2.0, 0.7);
    let delta = perhaps(random, -3.0, 0.5);
    let q = if random.chance(0.5) { random.pick(&[1.0, 2.0, 3.0]) } else { short(random.between(0.3, 4.0)) };
    let mut text = "kind = \"algebraic\"\n".to_owned();
    push(&mut text, "mu", mu);
    push(&mut text, "q", q);
    optional(&mut text, "delta", delta);
    if delta > 0.0 {
        push(&mut text, "epsilon", epsilon);
    }
    // where mu^2 / d^q balances v0
    let phi = q * v0 / math::pow(mu * mu / v0, 1.0 / q);
    let rate = 1.0 + phi.sqrt() + a_v * phi + 2.0 * delta * v0 / mu;
    Law { text, v0, contact: 2.0, has_series: delta == 0.0 && a_v == 0.0, rate }
}

fn exponential(random: &mut Random, v0: f64, epsilon: f64, a_v: f64) -> Law {
    let (a, b) = (decades(random, -2.0, 2.0), decades(random, -4.0, 1.0));
    let c = perhaps(random, -2.0, 3.0);
    let mut text = "kind = \"exponential\"\n".to_owned();
    push(&mut text, "a", a);
    push(&mut text, "b", b);
    optional(&mut text, "c", c);
    if c > 0.0 {
        push(&mut text, "epsilon", epsilon);
    }
    let phi = v0 / b + c;
    Law { text, v0, contact: 2.0, has_series: c == 0.0 && a_v == 0.0, rate: 1.0 + phi.sqrt() + a_v * phi }
}

/// The text, how many, the headway, the room at rest.
fn ring(random: &mut Random, law: &Law) -> (String, usize, f64, f64) {
    let pedestrians = (random.decades(0.301, 2.478) + 0.01).floor() as usize;
    let room = if law.contact == 0.0 { random.decades(-0.5, 1.5) } else { random.decades(-2.0, 2.0) };
    let length: f64 = format!("{:.6e}", (law.contact + room) * pedestrians as f64).parse().unwrap_or(room);
    let headway = length / pedestrians as f64;
    (format!("pedestrians = {pedestrians}\nlength = {length:?}\n"), pedestrians, headway, headway - law.contact)
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

fn run(random: &mut Random, law: &Law, pedestrians: usize, headway: f64) -> String {
    let method = random.pick(&Method::ALL);
    let method = if method.needs_series() && !law.has_series && random.chance(0.9) { Method::Dop853 } else { method };
    // what both integrations can afford
    let longest = (1e4 / (pedestrians as f64 * law.rate)).min(500.0 / law.rate);
    let t_end = short(random.decades(-1.5, 2.7).min(longest));
    let sample = t_end / random.pick(&[0.3, 1.0, 2.0, 3.7, 10.0, 20.0]);
    let mut text = format!("method = \"{}\"\n", method.name());
    push(&mut text, "t_end", t_end);
    push(&mut text, "sample", short(sample));
    if method.is_adaptive() && random.chance(0.85) {
        push(&mut text, "tolerance", decades(random, -14.0, -3.0));
        text.push_str("most_steps = 300000\n");
    } else {
        // from a few steps to many, of lengths that people take
        let fewest = random.decades(-4.0, 0.0).max(t_end * pedestrians as f64 / 3e6);
        push(&mut text, "dt", short((fewest / law.rate.max(headway.recip())).max(t_end / 3e4)));
    }
    if !method.needs_series() && random.chance(0.4) {
        let _ = writeln!(text, "state = \"{}\"", random.pick(&["gaps", "positions", "deviations"]));
    }
    if random.chance(0.25) {
        text.push_str("record = \"std\"\n");
    }
    text
}

/// Two panels that differ from the scene.
fn panels(random: &mut Random, law: &Law) -> String {
    let method = random.pick(&["dop853", "tsit54", "verner87"]);
    let tolerance = decades(random, -12.0, -5.0);
    let v0 = short(law.v0 * random.between(0.7, 1.1));
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
