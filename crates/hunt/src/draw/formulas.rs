//! Draws scenes whose laws are formulas: gallery laws with other parameters, and optimal-velocity laws composed at
//! random, some of them with kinks.

use super::{Kind, decades, panels, push, run, short};
use crate::random::Random;
use math::larger;
use reference::formula::smooth_ramp;
use reference::graph::Graph;
use std::fmt::Write as _;
use toml::Value;
use toml::value::Table;

/// The laws of the gallery.
const GALLERY: [&str; 12] = [
    include_str!("../../../../scenes/gallery/algebraic.toml"),
    include_str!("../../../../scenes/gallery/exponential.toml"),
    include_str!("../../../../scenes/gallery/follow-the-leader.toml"),
    include_str!("../../../../scenes/gallery/full-velocity-difference.toml"),
    include_str!("../../../../scenes/gallery/intelligent-driver.toml"),
    include_str!("../../../../scenes/gallery/logarithmic.toml"),
    include_str!("../../../../scenes/gallery/mean-spacing.toml"),
    include_str!("../../../../scenes/gallery/optimal-velocity.toml"),
    include_str!("../../../../scenes/gallery/predecessor-and-follower.toml"),
    include_str!("../../../../scenes/gallery/seyfried.toml"),
    include_str!("../../../../scenes/gallery/social-force.toml"),
    include_str!("../../../../scenes/gallery/summed-force.toml"),
];

/// A law as text, and the spacing around which it does something.
struct Law {
    text: String,
    headway: f64,
}

/// Pedestrians in a law with kinks, each of which the second integration has to find.
const FEW: f64 = 1.1;

/// The scene of this seed.
pub fn scene(seed: u64) -> String {
    let mut random = Random::new(seed);
    let law = if random.chance(0.4) { of_gallery(&mut random) } else { composed(&mut random) };
    let head = format!("title = \"Random scene {seed}\"\n\n[law]\nkind = \"formula\"\n{}", law.text);
    // what the law is like, from the second reading of it
    let Ok(graph) = crate::question::law(&head) else { return head };
    let reach = graph.reach().into_iter().max().unwrap_or(0) as usize;
    let has_kinks = ["min(", "max(", "abs(", "epsilon = 0.0"].iter().any(|kink| law.text.contains(kink));
    let most = if has_kinks { FEW } else { 1.9 };
    let pedestrians = (random.decades(0.301, most) + 0.01).floor() as usize;
    let pedestrians = if pedestrians > reach + 1 { pedestrians } else { reach + 2 };
    let headway = graph.contact() + (law.headway - graph.contact()) * random.decades(-0.4, 0.4);
    let length: f64 = format!("{:.6e}", headway * pedestrians as f64).parse().unwrap_or(headway);
    let room = headway - graph.contact();
    let shift = super::shift(&mut random, room);
    let rate = rate(&graph, headway, room);
    let run = run(&mut random, Kind { has_series: false, continues: 0.03 }, pedestrians, rate);
    let v0 = graph.scale();
    let panels =
        if law.text.contains("\nv0 =") && random.chance(0.1) { panels(&mut random, v0) } else { String::new() };
    format!(
        "{head}\n[ring]\npedestrians = {pedestrians}\nlength = {length:?}\n\n[start]\nshift = {shift}\n\n[run]\n{run}{panels}"
    )
}

/// How fast, about, the fastest motion is: by differences, standing and walking, at the headway and closer.
fn rate(graph: &Graph, headway: f64, room: f64) -> f64 {
    let reach = graph.reach();
    let ramp = &mut |x, epsilon| smooth_ramp(x, epsilon);
    let mut fastest = 1.0;
    for spacing in [headway, headway - 0.5 * room] {
        for speed in [0.0, 0.5 * graph.scale()] {
            let mut at = |place: Option<i32>, by_spacing: bool, change: f64| {
                let more =
                    |j: i32, is_spacing: bool| if place == Some(j) && by_spacing == is_spacing { change } else { 0.0 };
                graph.acceleration(|j| spacing + more(j, true), |j| speed + more(j, false), ramp)
            };
            let here = at(None, true, 0.0);
            let (mut by_spacings, mut by_speeds) = (0.0, 0.0);
            for j in -reach[0]..=reach[1] {
                let [to_spacing, to_speed] = [1e-6 * room, 1e-6 * graph.scale()];
                by_spacings += (at(Some(j), true, to_spacing) - here).abs() / to_spacing;
                by_speeds += (at(Some(j), false, to_speed) - here).abs() / to_speed;
            }
            let rate = 1.0 + by_spacings.sqrt() + by_speeds;
            fastest = if rate.is_finite() { larger(fastest, rate) } else { fastest };
        }
    }
    fastest
}

/// A law of the gallery, its parameters up to 1.6 times as large or as small; exponents and the size of a body stay.
fn of_gallery(random: &mut Random) -> Law {
    let text = random.pick(&GALLERY);
    let scene: Table = text.parse().unwrap_or_default();
    let of = |table: &Table, key: &str| table.get(key).and_then(Value::as_table).cloned().unwrap_or_default();
    let mut law = of(&scene, "law");
    law.remove("kind");
    let panels = of(&scene, "panel");
    let (mut ring, mut others) = (of(&scene, "ring"), panels.values().filter_map(Value::as_table));
    if let Some(panel) = others.next() {
        law.extend(of(panel, "law"));
        ring.extend(of(panel, "ring"));
    }
    let mut text = String::new();
    for (name, value) in law {
        match value {
            Value::String(formula) => {
                // writing to a string cannot fail
                let _ = writeln!(text, "{name} = \"{formula}\"");
            }
            Value::Float(value) if ["body", "q", "epsilon"].contains(&name.as_str()) => push(&mut text, &name, value),
            Value::Float(value) => push(&mut text, &name, short(value * random.decades(-0.2, 0.2))),
            _ => (),
        }
    }
    let number = |key: &str| match ring.get(key) {
        Some(Value::Float(value)) => *value,
        Some(Value::Integer(value)) => *value as f64,
        _ => 1.0,
    };
    Law { text, headway: number("length") / number("pedestrians") }
}

/// What the optimal velocity depends on, with the parameters that this needs.
const GAPS: [&str; 7] = [
    "s - body",
    "s - body",
    "s - body - a_v*(v + v[1])",
    "(s + s[1])/2 - body",
    "x[3]/3 - body",
    "s - body + h*(v[1] - v)",
    "0.8*s + 0.2*s[-1] - body",
];

/// Optimal velocities.
const VELOCITIES: [&str; 9] = [
    "v0*(tanh(d/w - m) + tanh(m))/(1 + tanh(m))",
    "v0*(1 - exp(-d/w))",
    "v0*d^2/(w^2 + d^2)",
    "v0*d/sqrt(w^2 + d^2)",
    "v0*(1 - ramp(d/w - 1, epsilon))",
    "v0*(1 - softplus(m - d/w)/softplus(m))",
    "v0*exp(-w/(w + abs(d)))",
    "min(v0, max(0, d*v0/w))",
    "v0*ln_1p(d/w)/(1 + ln_1p(d/w))",
];

/// What may be added to the relaxation to it.
const TERMS: [&str; 9] = [
    "",
    " + lambda*(v[1] - v)",
    " + lambda*(v[1] - v)*exp(-d/w)",
    " - c*ramp(d, epsilon)",
    " - lambda*max(0, v - v[1])",
    " - lambda*max(0, v - v[1])^2/(1 + d^2)",
    " - c*v*abs(v)/v0",
    " - c/(s - body)^q",
    " + c*exp(-s[-1]/w)",
];

/// An optimal velocity with one or two terms more.
fn composed(random: &mut Random) -> Law {
    let (d, velocity) = (random.pick(&GAPS), random.pick(&VELOCITIES));
    let first = random.pick(&TERMS);
    let second = if random.chance(0.3) { random.pick(&TERMS) } else { "" };
    let second = if second == first { "" } else { second };
    let acceleration = format!("kappa*(V - v){first}{second}");
    let mut text = format!("acceleration = \"{acceleration}\"\nV = \"{velocity}\"\nd = \"{d}\"\n");
    let width = decades(random, -0.5, 1.0);
    let epsilon = if random.chance(0.3) { 0.0 } else { decades(random, -4.0, 0.0) };
    let parameters = [
        ("v0", decades(random, -0.5, 1.0)),
        ("kappa", decades(random, -0.7, 0.7)),
        ("w", width),
        ("m", decades(random, -0.3, 0.5)),
        ("a_v", decades(random, -2.0, -0.5)),
        ("h", decades(random, -2.0, 0.0)),
        ("lambda", decades(random, -1.0, 1.0)),
        ("c", decades(random, -2.0, 0.5)),
        ("q", random.pick(&[1.0, 2.0, 1.5])),
        ("epsilon", epsilon),
    ];
    for (name, value) in parameters {
        if uses(&text, name) {
            push(&mut text, name, value);
        }
    }
    let body = random.pick(&[0.0, 1.0, 2.0]);
    push(&mut text, "body", body);
    Law { text, headway: body + width }
}

/// Whether a name occurs in formulas.
fn uses(text: &str, name: &str) -> bool {
    text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_').any(|word| word == name)
}
