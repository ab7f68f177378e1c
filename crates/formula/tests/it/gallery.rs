//! The scenes of `scenes/gallery`. Every law parses, its partial derivatives at the uniform flow are those of its
//! published criterion, and the thresholds found from the dispersion relation over all waves are the published ones.

use files::reader::{Section, Value as Entry};
use files::scene_file::{self, SceneFile};
use formula::{Bound, Definition, Given, Graph, Location, Variable, law};
use math::dual::Dual;
use math::{complex_sqrt, cos, exp, sin};
use std::collections::BTreeMap;
use std::f64::consts::{E, LN_2, PI};
use std::path::{Path, PathBuf};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/gallery")
}

fn scene(name: &str) -> SceneFile {
    scene_file::read(&folder().join(name)).unwrap_or_else(|error| panic!("{error}"))
}

/// The law of a panel; `change` may replace expressions, `axes` are parameters that the law leaves to a map.
fn graph(scene: &SceneFile, panel: &str, change: impl Fn(&str) -> String, axes: &[(&str, f64)]) -> Graph {
    let tables = &scene.panel(panel).unwrap_or_else(|error| panic!("{error}")).tables;
    let section = tables.section("law").expect("a law");
    let place = |line: usize| Location { line: line as u32, column: 1 };
    let texts: Vec<(&str, usize, Result<f64, String>)> = section
        .entries
        .iter()
        .filter(|(name, _)| *name != "kind")
        .map(|(name, entry)| match &entry.value {
            Entry::Number(number) => (name.as_str(), entry.line, Ok(*number)),
            Entry::Text(text) => (name.as_str(), entry.line, Err(change(text))),
            other => panic!("{name} = {other:?}"),
        })
        .chain(axes.iter().map(|(name, value)| (*name, 0, Ok(*value))))
        .collect();
    let definitions: Vec<Definition<'_>> = texts
        .iter()
        .map(|(name, line, value)| Definition {
            name,
            key: place(*line),
            value: place(*line),
            given: value.as_ref().map_or_else(|text| Given::Text(text), |number| Given::Number(*number)),
        })
        .collect();
    law(&scene.file, place(section.line), &definitions).unwrap_or_else(|error| panic!("{error}"))
}

/// A law at a uniform flow, linearised.
struct Flow {
    speed: f64,
    by_spacing: BTreeMap<i32, f64>,
    by_speed: BTreeMap<i32, f64>,
}

impl Flow {
    /// Of a law whose steady speed lies between two speeds.
    fn new(bound: &Bound, headway: f64, (mut low, mut high): (f64, f64)) -> Flow {
        let root = bound.acceleration();
        let acceleration = |speed: f64| {
            let value = bound.eval(root, |variable| match variable {
                Variable::Spacing(_) => headway,
                _ => speed,
            });
            value.unwrap_or_else(|error| panic!("{error}"))
        };
        assert!(acceleration(low) > 0.0 && acceleration(high) < 0.0, "{} {}", acceleration(low), acceleration(high));
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            *(if acceleration(middle) > 0.0 { &mut low } else { &mut high }) = middle;
        }
        let speed = low;
        let slope = |direction: Variable| {
            let dual = |variable| {
                let value = if matches!(variable, Variable::Spacing(_)) { headway } else { speed };
                Dual { value, slope: if variable == direction { 1.0 } else { 0.0 } }
            };
            bound.carry_out(root, Dual::constant, dual).slope
        };
        let stencil = bound.stencil(root);
        let by_spacing = stencil.spacings.iter().map(|j| (*j, slope(Variable::Spacing(*j)))).collect();
        let by_speed = stencil.speeds.iter().map(|j| (*j, slope(Variable::Speed(*j)))).collect();
        Flow { speed, by_spacing, by_speed }
    }

    fn s(&self, j: i32) -> f64 {
        self.by_spacing[&j]
    }

    fn v(&self, j: i32) -> f64 {
        self.by_speed[&j]
    }

    /// The coefficients of z^2 + b z + c = 0 for waves of the wave number k: real and imaginary parts.
    fn coefficients(&self, k: f64) -> [f64; 4] {
        let sum = |terms: &BTreeMap<i32, f64>, part: &dyn Fn(f64) -> f64| -> f64 {
            terms.iter().map(|(j, slope)| slope * part(k * f64::from(*j))).sum()
        };
        let b = [-sum(&self.by_speed, &cos), -sum(&self.by_speed, &sin)];
        let c = [sum(&self.by_spacing, &|x| cos(x) - cos(x + k)), sum(&self.by_spacing, &|x| sin(x) - sin(x + k))];
        [b[0], b[1], c[0], c[1]]
    }

    /// The growth rate of waves of the wave number k: the larger real part of the two roots.
    fn growth(&self, k: f64) -> f64 {
        let [b_re, b_im, c_re, c_im] = self.coefficients(k);
        let (re, im) = (b_re * b_re - b_im * b_im - 4.0 * c_re, 2.0 * b_re * b_im - 4.0 * c_im);
        0.5 * (complex_sqrt(re, im).0.abs() - b_re)
    }

    /// Whether some wave grows, of a fine grid of wave numbers, and the one that grows fastest over k^2.
    fn fastest(&self) -> (f64, f64) {
        // denser at long waves, which mostly decide
        let waves = (1..=400).map(|i| PI * f64::from(i * i) / 160_000.0);
        waves
            .map(|k| (self.growth(k) / (k * k), k))
            .fold((f64::NEG_INFINITY, 0.0), |best, wave| if wave.0 > best.0 { wave } else { best })
    }

    fn is_unstable(&self) -> bool {
        self.fastest().0 > 0.0
    }
}

/// Where a property that holds at `yes` and not at `no` ends.
fn threshold(mut yes: f64, mut no: f64, holds: impl Fn(f64) -> bool) -> f64 {
    assert!(holds(yes) && !holds(no));
    for _ in 0..40 {
        let middle = 0.5 * (yes + no);
        *(if holds(middle) { &mut yes } else { &mut no }) = middle;
    }
    yes
}

#[track_caller]
fn assert_near(value: f64, expected: f64, tolerance: f64) {
    assert!((value - expected).abs() <= tolerance * math::larger(expected.abs(), 1.0), "{value} instead of {expected}");
}

/// The values of the file but for one.
fn with(graph: &Graph, name: &str, value: f64) -> Bound {
    let mut values = graph.values();
    values[graph.parameter(name).expect("a parameter")] = value;
    graph.bind(&values).unwrap_or_else(|error| panic!("{error}"))
}

fn as_written(text: &str) -> String {
    text.to_owned()
}

fn value(graph: &Graph, name: &str) -> f64 {
    graph.values()[graph.parameter(name).unwrap_or_else(|| panic!("no parameter {name}"))]
}

/// 1/cosh^2.
fn sech2(x: f64) -> f64 {
    let t = math::lane::tanh(x);
    1.0 - t * t
}

#[test]
fn every_scene_parses_has_a_value_and_says_where_its_numbers_come_from() {
    let mut count = 0;
    for entry in std::fs::read_dir(folder()).expect("the gallery") {
        let path = entry.expect("a file").path();
        // the contact sheet lies there too
        if path.extension().is_none_or(|extension| extension != "toml") {
            continue;
        }
        let scene = scene_file::read(&path).unwrap_or_else(|error| panic!("{error}"));
        for panel in &scene.panels {
            let numbers = |name: &str| {
                let section = panel.tables.section(name).cloned().unwrap_or_else(Section::default);
                section.entries.into_iter().filter(|(_, entry)| matches!(entry.value, Entry::Number(_)))
            };
            let axes: Vec<(&str, f64)> =
                if path.ends_with("intelligent-driver-map.toml") { vec![("T", 1.0)] } else { vec![] };
            let graph = graph(&scene, &panel.name, as_written, &axes);
            let bound = graph.bind(&graph.values()).unwrap_or_else(|error| panic!("{error}"));
            for root in bound.roots() {
                let state = |variable| if matches!(variable, Variable::Spacing(_)) { 40.0 } else { 0.5 };
                let value = bound.eval(*root, state).unwrap_or_else(|error| panic!("{error}"));
                assert!(value.is_finite());
            }
            for table in ["law", "ring", "start"] {
                for (name, _) in numbers(table) {
                    let key = format!("{table}.{name}");
                    // what stands in formulas is explained with them
                    assert!(scene.origin.iter().any(|(known, _)| *known == key), "{}: {key}", scene.file);
                }
            }
        }
        count += 1;
    }
    assert_eq!(count, 13);
}

#[test]
fn optimal_velocity() {
    let graph = graph(&scene("optimal-velocity.toml"), "two-phases", as_written, &[]);
    let flow = |kappa| Flow::new(&with(&graph, "kappa", kappa), 2.0, (0.0, 3.0));
    let two_phases = flow(1.0);
    assert_near(two_phases.speed, 0.964_027_580_075_817, 1e-15);
    assert_near(two_phases.s(0), 1.0, 1e-15);
    assert_near(two_phases.v(0), -1.0, 1e-15);
    assert_eq!(two_phases.by_speed.len(), 1);
    assert_near(threshold(1.0, 3.0, |kappa| flow(kappa).is_unstable()), 2.0, 1e-5);
    // the longest wave on a ring of 100
    let on_ring = threshold(1.0, 3.0, |kappa| flow(kappa).growth(2.0 * PI / 100.0) > 0.0);
    assert_near(on_ring, 2.0 * cos(PI / 100.0) * cos(PI / 100.0), 1e-10);
}

#[test]
fn full_velocity_difference() {
    let graph = graph(&scene("full-velocity-difference.toml"), "main", as_written, &[]);
    let flow = |lambda| Flow::new(&with(&graph, "lambda", lambda), 17.0, (0.0, 20.0));
    let slope = 7.91 * 0.13 * sech2(0.13 * 12.0 - 1.57);
    let (kappa, here) = (0.41, flow(0.2));
    assert_near(here.s(0), kappa * slope, 1e-14);
    assert_near(here.v(0), -kappa - 0.2, 1e-14);
    assert_near(here.v(1), 0.2, 1e-14);
    assert!(here.is_unstable());
    assert_near(threshold(0.2, 2.0, |lambda| flow(lambda).is_unstable()), slope - kappa / 2.0, 1e-5);
}

#[test]
fn follow_the_leader() {
    let graph = graph(&scene("follow-the-leader.toml"), "main", as_written, &[]);
    let d = 230.0 / 22.0 - 4.5;
    let flow = |b| Flow::new(&with(&graph, "b", b), 230.0 / 22.0, (0.0, 12.0));
    let slope = 10.0 * 0.5 * sech2(d / 2.0 - 2.0) / (1.0 + math::lane::tanh(2.0));
    let here = flow(20.0);
    assert_near(here.s(0), 0.5 * slope, 1e-14);
    assert_near(here.v(0), -0.5 - 20.0 / (d * d), 1e-14);
    assert_near(here.v(1), 20.0 / (d * d), 1e-14);
    assert_eq!(here.is_unstable(), slope > 0.25 + 20.0 / (d * d));
    assert_near(threshold(1.0, 200.0, |b| flow(b).is_unstable()), (slope - 0.25) * d * d, 1e-5);
}

#[test]
fn intelligent_driver() {
    for (panel, lowest) in [("brisk", 34.76), ("calm", 20.42)] {
        let graph = graph(&scene("intelligent-driver.toml"), panel, as_written, &[]);
        let bound = graph.bind(&graph.values()).expect("finite");
        let [a, b, t, v0, s0] = ["a", "b", "T", "v0", "s0"].map(|name| value(&graph, name));
        let flow = |density: f64| Flow::new(&bound, 1000.0 / density, (0.0, v0));
        for density in [15.0, 25.0, 40.0, 100.0] {
            let flow = flow(density);
            let (g, v) = (1000.0 / density - 5.0, flow.speed);
            let r = (s0 + v * t) / g;
            let by_gap = 2.0 * a * r * r / g;
            let by_difference = v * r * (a / b).sqrt() / g;
            let by_own = -(4.0 * a * v * v * v / (v0 * v0 * v0 * v0) + 2.0 * a * t * r / g);
            assert_near(flow.s(0), by_gap, 1e-13);
            assert_near(flow.v(0), by_own - by_difference, 1e-13);
            assert_near(flow.v(1), by_difference, 1e-13);
            assert_eq!(flow.is_unstable(), by_gap > by_own * by_own / 2.0 - by_own * by_difference);
        }
        let unstable = |density| flow(density).is_unstable();
        assert!((threshold(40.0, 10.0, unstable) - lowest).abs() < 0.005, "{}", threshold(40.0, 10.0, unstable));
        if panel == "brisk" {
            // beyond, the gap is below s0 and nobody moves forward: the steady speed is no longer in [0, v0]
            assert!(unstable(142.8) && 1000.0 / 142.86 - 5.0 - s0 < 1e-3);
        }
    }
    let calm = graph(&scene("intelligent-driver.toml"), "calm", as_written, &[]);
    let bound = calm.bind(&calm.values()).expect("finite");
    assert_near(Flow::new(&bound, 25.0, (0.0, 30.0)).speed, 11.17, 1e-3);
    // the other one, through which the acceleration rises
    let behind =
        bound.eval(bound.acceleration(), |variable| if variable == Variable::Spacing(0) { 25.0 } else { -13.58 });
    assert!(behind.expect("a value").abs() < 2e-3);
    let map = graph(&scene("intelligent-driver-map.toml"), "main", as_written, &[("T", 1.0)]);
    let brisk = graph(&scene("intelligent-driver.toml"), "brisk", as_written, &[]);
    let nodes = |graph: &Graph| graph.bind(&graph.values()).expect("finite").nodes().to_vec();
    assert_eq!(nodes(&map), nodes(&brisk), "the same law");
}

#[test]
fn mean_spacing() {
    let graph = graph(&scene("mean-spacing.toml"), "main", as_written, &[]);
    let flow = |tau| Flow::new(&with(&graph, "tau", tau), 2.0, (0.0, 3.0));
    let here = flow(1.7);
    (0..3).for_each(|j| assert_near(here.s(j), 1.0 / (3.0 * 1.7), 1e-14));
    assert_near(here.v(0), -1.0 / 1.7, 1e-14);
    assert_eq!((here.by_spacing.len(), here.by_speed.len()), (3, 1));
    assert_near(threshold(1.7, 1.0, |tau| flow(tau).is_unstable()), 1.5, 1e-4);
    // neutral waves, and those beside them
    assert!(here.growth(2.0 * PI / 3.0).abs() < 1e-14 && here.growth(2.0 * PI / 3.0 + 0.05) > 0.0);
}

#[test]
fn summed_force() {
    let scene = scene("summed-force.toml");
    // K, critical tau over that of the longest waves, wave number where it is lower
    for (count, ratio, wave) in
        [(5, 1.0, None), (10, 1.0, None), (12, 0.978, None), (15, 0.935, Some(0.54)), (30, 0.793, None)]
    {
        let change = |text: &str| text.replace("sum(j, 1, 15,", &format!("sum(j, 1, {count},"));
        let graph = graph(&scene, "main", change, &[]);
        let flow = |tau| Flow::new(&with(&graph, "tau", tau), 3.0, (-10.0, 10.0));
        let slopes: Vec<f64> = (1..=count).map(|j| 1.0 / f64::from((3 * j - 2) * (3 * j - 2))).collect();
        let here = flow(0.86);
        for j in 0..count {
            // spacing j is part of all distances from the (j+1)-th on
            assert_near(here.s(j), slopes[j as usize..].iter().sum(), 1e-13);
        }
        assert_near(here.v(0), -1.0 / 0.86, 1e-14);
        let moment = |power: fn(f64) -> f64| -> f64 {
            slopes.iter().zip(1..).map(|(slope, j)| power(f64::from(j)) * slope).sum()
        };
        let long = (moment(|j| j * j) / 2.0).sqrt() / moment(|j| j);
        let critical = threshold(2.0, 0.1, |tau| flow(tau).is_unstable());
        assert!((critical / long - ratio).abs() < 0.0006, "{count}: {}", critical / long);
        if let Some(wave) = wave {
            let (_, k) = flow(critical * 1.0001).fastest();
            assert!((k - wave).abs() < 0.006, "k* = {k}");
            assert_near(long, 0.8845, 1e-4);
            assert_near(critical, 0.827, 1e-3);
            // what the comment of the scene says: its own ring's longest wave does not grow, the tenth does, and rings
            // of up to 7 are stable
            let small = |n: i32| (1..n).all(|l| here.growth(2.0 * PI * f64::from(l) / f64::from(n)) <= 0.0);
            assert_eq!((2..60).filter(|n| small(*n)).collect::<Vec<_>>(), [2, 3, 4, 5, 6, 7]);
            assert!(here.growth(2.0 * PI * 10.0 / 116.0) > 0.0 && here.growth(2.0 * PI / 116.0) < 0.0);
        }
    }
}

#[test]
fn predecessor_and_follower() {
    let graph = graph(&scene("predecessor-and-follower.toml"), "main", as_written, &[]);
    let flow = |p| Flow::new(&with(&graph, "p", p), 3.0, (-5.0, 5.0));
    let here = flow(1.0);
    assert_near(here.s(0), 1.0, 1e-15);
    assert_near(here.s(-1), -0.1, 1e-15);
    assert_near(here.v(0), -1.0, 1e-15);
    // 2 (p - q)^2 = p + q: p = q + (1 + sqrt(1 + 16 q))/4
    assert_near(threshold(1.0, 0.1, |p| flow(p).is_unstable()), 0.1 + (1.0 + 2.6_f64.sqrt()) / 4.0, 1e-5);
    for p in [0.1, 3.0, 50.0] {
        let mut values = graph.values();
        for name in ["p", "q"] {
            values[graph.parameter(name).expect("a parameter")] = p;
        }
        let both = Flow::new(&graph.bind(&values).expect("finite"), 3.0, (-5.0, 5.0));
        assert!(!both.is_unstable(), "equal forces from both sides");
    }
}

/// A flow against phi, beta and kappa of the paper's linearised law, and its criterion.
#[track_caller]
fn assert_linear(flow: &Flow, phi: f64, beta: f64, kappa: f64) {
    let v = |j| flow.by_speed.get(&j).copied().unwrap_or(0.0);
    assert_near(flow.s(0), phi, 1e-12);
    assert_near(v(0), -1.0 - beta - kappa, 1e-12);
    assert_near(v(1), kappa - beta, 1e-12);
    assert_eq!(flow.is_unstable(), 2.0 * phi > (1.0 + 2.0 * kappa) * (1.0 + 2.0 * beta));
}

#[test]
fn algebraic_laws() {
    for (file, panel, headway) in [
        ("algebraic.toml", "plain", 200.0 / 67.0),
        ("algebraic.toml", "all-terms", 200.0 / 67.0),
        ("seyfried.toml", "n15", 96.11111111111111 / 15.0),
        ("seyfried.toml", "n30", 96.11111111111111 / 30.0),
    ] {
        let graph = graph(&scene(file), panel, as_written, &[]);
        let bound = graph.bind(&graph.values()).expect("finite");
        let parameter = |name| graph.parameter(name).map_or(0.0, |at| graph.values()[at]);
        let [mu, delta, q, a_v, epsilon] = ["mu", "delta", "q", "a_v", "epsilon"].map(parameter);
        // up to the speed at which d is 0, where the force is infinite
        let most = if a_v > 0.0 { (headway - 2.0) / (2.0 * a_v) * 0.999_999 } else { 3.0 };
        let low = if file == "algebraic.toml" { 0.0 } else { -20.0 };
        let flow = Flow::new(&bound, headway, (low, if most < 4.2 { most } else { 4.2 }));
        let d = headway - 2.0 - 2.0 * a_v * flow.speed;
        let gamma = mu + delta * epsilon * LN_2;
        let phi = q * gamma * gamma / math::pow(d, q + 1.0);
        assert_linear(&flow, phi, a_v * phi, delta * gamma / math::pow(d, q));
    }
}

#[test]
fn exponential_laws() {
    for (file, panel, headway) in [
        ("exponential.toml", "plain", 200.0 / 57.0),
        ("exponential.toml", "all-terms", 200.0 / 57.0),
        ("social-force.toml", "main", 2.6),
    ] {
        let graph = graph(&scene(file), panel, as_written, &[]);
        let bound = graph.bind(&graph.values()).expect("finite");
        let parameter = |name| graph.parameter(name).map_or(0.0, |at| graph.values()[at]);
        let [a, b, c, a_v, epsilon] = ["a", "b", "c", "a_v", "epsilon"].map(parameter);
        let flow = Flow::new(&bound, headway, (-3.0, 3.0));
        let d = headway - 2.0 - 2.0 * a_v * flow.speed;
        let contact = if epsilon > 0.0 { c / (1.0 + exp(d / epsilon)) } else { 0.0 };
        let phi = a / b * exp(-d / b) + contact;
        assert_linear(&flow, phi, a_v * phi, 0.0);
        if file == "social-force.toml" {
            assert_near(flow.speed, -0.195_817_178_372, 1e-12);
            let kinks = bound.kinks(bound.acceleration());
            assert_eq!(kinks.len(), 1);
            let at = |node, s| bound.eval(node, |_| s).expect("a value");
            let side = |s: f64| kinks[0].right.map_or(0.0, |right| at(right, s)) - at(kinks[0].left, s);
            assert_eq!((side(2.0), side(2.5)), (0.0, -0.5), "the kink lies at d = 0");
        }
    }
}

#[test]
fn logarithmic_laws() {
    for panel in ["plain", "widening"] {
        let graph = graph(&scene("logarithmic.toml"), panel, as_written, &[]);
        let bound = graph.bind(&graph.values()).expect("finite");
        let [v0, a_v, epsilon] = ["v0", "a_v", "epsilon"].map(|name| value(&graph, name));
        let headway = 200.0 / 133.0;
        let flow = Flow::new(&bound, headway, (0.0, 1.0));
        let a = 2.0 + 2.0 * a_v * flow.speed;
        let argument = (headway / a - 1.0) / epsilon;
        let ramp = epsilon * math::lane::softplus(-argument);
        let phi = (E - 1.0) * v0 / ((1.0 + exp(argument)) * a * (1.0 + (E - 1.0) * ramp));
        assert_linear(&flow, phi, phi * a_v / a * headway, 0.0);
    }
}
