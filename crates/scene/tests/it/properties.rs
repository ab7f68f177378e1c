//! Random scenes of all kinds, laws, methods and forms, from plausible numbers to absurd ones: what is accepted runs to
//! its end, stops with an event, or says why it cannot go on; what is refused is refused with file, line and key. No
//! panic, no number in a table that is none, no run without an end.

use crate::corpus::run::{Ending, run};
use crate::corpus::scene_file as any_scene;
use files::scene_file::{self, Kind};
use ode::Method;
use proptest::prelude::*;
use proptest::test_runner::{Config, FileFailurePersistence, RngAlgorithm, TestRng, TestRunner};
use std::collections::BTreeMap;
use std::sync::mpsc;
use std::time::Duration;

/// Scenes that are tried; the environment's `PROPTEST_CASES` asks for more.
const CASES: u32 = 3000;
/// Without a new scene for so long, the last one is taken for a run without an end: such a run takes milliseconds.
const PATIENCE: Duration = Duration::from_secs(300);

/// A number that a law might have, or now and then one that no law should.
fn number(low: f64, high: f64) -> impl Strategy<Value = String> {
    let (low, high) = (math::ln(low), math::ln(high));
    let absurd = ["0.0", "-1.0", "5e-324", "1e-300", "1e-17", "1e17", "1e300", "1.7e308", "nan", "inf", "true"];
    prop_oneof![
        60 => (low..high).prop_map(|x| format!("{:?}", math::exp(x))),
        1 => proptest::sample::select(absurd.to_vec()).prop_map(str::to_owned),
    ]
}

/// The same with the other sign, where it has one.
fn negative(low: f64, high: f64) -> impl Strategy<Value = String> {
    number(low, high).prop_map(|x| match x.strip_prefix('-') {
        Some(positive) => positive.to_owned(),
        None if x == "true" => x,
        None => format!("-{x}"),
    })
}

/// `key = number`, or nothing.
fn optional(key: &'static str, low: f64, high: f64) -> impl Strategy<Value = String> {
    prop_oneof![2 => Just(String::new()), 1 => number(low, high).prop_map(move |x| format!("{key} = {x}\n"))]
}

fn algebraic() -> impl Strategy<Value = String> {
    let power =
        prop_oneof![proptest::sample::select(vec!["1.0", "2.0", "3.0"]).prop_map(str::to_owned), number(0.1, 9.0)];
    let rest = (optional("delta", 1e-3, 10.0), optional("a_v", 1e-3, 3.0), optional("epsilon", 1e-4, 3.0));
    (number(1e-3, 10.0), power, number(0.05, 20.0), rest).prop_map(|(mu, q, v0, (delta, a_v, epsilon))| {
        format!("kind = \"algebraic\"\nmu = {mu}\nq = {q}\nv0 = {v0}\n{delta}{a_v}{epsilon}")
    })
}

fn preset() -> impl Strategy<Value = String> {
    let name = proptest::sample::select(vec!["CFM", "GCFM", "HFV", "SEY", "GUO", "none"]);
    (name, optional("mu", 1e-3, 10.0), optional("a_v", 1e-3, 3.0), number(0.05, 20.0))
        .prop_map(|(name, mu, a_v, v0)| format!("kind = \"algebraic\"\npreset = \"{name}\"\n{mu}{a_v}v0 = {v0}\n"))
}

fn exponential() -> impl Strategy<Value = String> {
    let rest = (optional("c", 1e-2, 1e3), optional("a_v", 1e-3, 3.0), optional("epsilon", 1e-4, 3.0));
    (number(1e-2, 1e4), number(1e-3, 10.0), number(0.05, 20.0), rest).prop_map(|(a, b, v0, (c, a_v, epsilon))| {
        format!("kind = \"exponential\"\na = {a}\nb = {b}\nv0 = {v0}\n{c}{a_v}{epsilon}")
    })
}

fn logarithmic() -> impl Strategy<Value = String> {
    (number(0.05, 20.0), number(1e-4, 3.0), optional("a_v", 1e-3, 3.0))
        .prop_map(|(v0, epsilon, a_v)| format!("kind = \"logarithmic\"\nv0 = {v0}\nepsilon = {epsilon}\n{a_v}"))
}

fn law() -> impl Strategy<Value = String> {
    let law = prop_oneof![3 => algebraic(), 1 => preset(), 3 => exponential(), 3 => logarithmic()];
    law.prop_map(|law| format!("[law]\n{law}"))
}

fn ring() -> impl Strategy<Value = String> {
    let headway = prop_oneof![8 => 2.1_f64..6.0, 1 => 0.001_f64..1000.0];
    let shift = prop_oneof![3 => number(1e-12, 0.5), 3 => number(0.1, 2.0), 1 => negative(1e-12, 1e3)];
    (1_usize..=9, headway, shift).prop_map(|(n, headway, shift)| {
        format!("[ring]\npedestrians = {n}\nlength = {:?}\n[start]\nshift = {shift}\n", n as f64 * headway)
    })
}

/// Method and control: mostly those that go together.
fn method() -> impl Strategy<Value = String> {
    let method = proptest::sample::select(Method::ALL.to_vec());
    (method, 2_i32..=16, number(0.01, 3.0), 0_u32..24).prop_map(|(method, digits, dt, choice)| {
        let (tolerance, dt) = (format!("tolerance = 1e-{digits}\n"), format!("dt = {dt}\n"));
        let control = match choice {
            0 => String::new(),
            1 => [tolerance, dt].concat(),
            2 => tolerance,
            3..14 if method.is_adaptive() => tolerance,
            _ => dt,
        };
        format!("method = \"{}\"\n{control}", method.name())
    })
}

fn times() -> impl Strategy<Value = String> {
    let record =
        proptest::sample::select(vec!["", "", "record = \"std\"\n", "record = \"trajectories\"\n", "record = 1\n"]);
    let state =
        proptest::sample::select(vec!["", "state = \"deviations\"\n", "state = \"gaps\"\n", "state = \"positions\"\n"]);
    (number(1.0, 80.0), number(0.5, 80.0), method(), state, record).prop_map(|(end, sample, method, state, record)| {
        format!("[run]\nt_end = {end}\nsample = {sample}\n{method}{state}{record}")
    })
}

/// A law's parameters that can be an axis, with those of the flow.
fn axes(law: &str) -> Vec<&'static str> {
    let own: &[&str] = match law {
        law if law.contains("algebraic") => &["mu", "delta", "q", "a_v", "v0"],
        law if law.contains("exponential") => &["a", "b", "c", "a_v", "v0"],
        _ => &["a_v", "v0"],
    };
    [own, &["headway", "d_gap", "k"]].concat()
}

/// Mostly what goes together: axes that the law has and does not name, one way to say which flow, a wave number for
/// growth rates. Out of order by `slip`: the law names an axis, or the flow is said twice or not at all.
fn map() -> impl Strategy<Value = String> {
    let law = prop_oneof![algebraic(), exponential(), logarithmic()];
    let places = (0_usize..8, 0_usize..8, 0_usize..20);
    let ranges = (number(1e-3, 2.0), number(3.0, 30.0), number(1e-3, 2.0), number(3.0, 30.0), 1_usize..=6);
    let flow = (number(2.0, 30.0), number(0.1, 3.0), any::<bool>());
    (law, places, ranges, flow).prop_map(|(law, (i, j, slip), (low, high, from, to, cells), (gap, k, grows))| {
        let names = axes(&law);
        let (x, y) = (names[i % names.len()], names[j % names.len()]);
        let is_axis = |key: &str| key == x || key == y;
        let named = |line: &&str| slip == 0 || !is_axis(line.split(' ').next().unwrap_or(""));
        let law: String = law.lines().filter(named).map(|line| format!("{line}\n")).collect();
        let mut flow = String::new();
        if !is_axis("headway") && !is_axis("d_gap") && slip != 1 || slip == 2 {
            let key = if law.contains("logarithmic") || slip % 2 == 0 { "headway" } else { "d_gap" };
            flow.push_str(&format!("{key} = {gap}\n"));
        }
        let grows = grows || is_axis("k");
        if grows && !is_axis("k") && slip != 3 {
            flow.push_str(&format!("k = {k}\n"));
        }
        let value = if grows && slip != 4 { "growth_rate" } else { "criterion" };
        let x = format!("x = {{ parameter = \"{x}\", from = {low}, to = {high}, cells = {cells} }}\n");
        let y = format!("y = {{ parameter = \"{y}\", from = {from}, to = {to}, cells = 3 }}\n");
        format!("[law]\n{law}[uniform]\n{flow}[map]\nvalue = \"{value}\"\n{x}{y}")
    })
}

fn curve() -> impl Strategy<Value = String> {
    let value = proptest::sample::select(vec!["ramp", "force"]);
    let from = prop_oneof![number(1e-3, 10.0), negative(1e-3, 10.0)];
    (law(), value, from, number(1e-2, 30.0), 1_usize..=40, optional("epsilon", 1e-4, 3.0)).prop_map(
        |(law, value, from, to, points, epsilon)| {
            let law = if value == "ramp" { String::new() } else { law };
            format!("{law}[curve]\nvalue = \"{value}\"\nfrom = {from}\nto = {to}\npoints = {points}\n{epsilon}")
        },
    )
}

fn scene() -> impl Strategy<Value = String> {
    let run = (law(), ring(), times()).prop_map(|(law, ring, times)| [law, ring, times].concat());
    prop_oneof![6 => run, 2 => map(), 1 => curve()]
}

/// What became of a scene, in words; a panic when something that must not be.
fn fate(text: &str) -> String {
    any_scene::read(text.as_bytes());
    let parsed = scene_file::parse("any.toml", text).expect("it is TOML with known tables");
    let panel = &parsed.panels[0];
    let read = match panel.kind {
        Kind::Run => scene::run::read(&parsed.file, &panel.tables).map(|scene| format!("run: {:?}", run(scene))),
        Kind::Map => scene::map::read(&parsed.file, &panel.tables).map(|map| match map.compute() {
            Ok(_) => "map: Whole".to_owned(),
            Err(problem) => {
                assert!(problem.starts_with("at "), "{problem}");
                "map: Broken".to_owned()
            }
        }),
        Kind::Sweep => sweep::read(&parsed.file, &panel.tables).map(|_| "sweep: Whole".to_owned()),
        Kind::Curve => scene::curve::table(&parsed.file, &panel.tables).map(|_| "curve: Whole".to_owned()),
        Kind::Drawing => panic!("no drawing was asked for"),
    };
    read.unwrap_or_else(|error| {
        let words = error.to_string();
        let key = words.split(": ").nth(1).expect("file and line, then the key");
        let section = key.split('.').next().unwrap_or("");
        assert!(words.starts_with(&format!("any.toml:{}: ", error.line)) && error.line > 0, "{words}");
        assert!(["scene", "law", "ring", "start", "run", "uniform", "map", "curve"].contains(&section), "{words}");
        format!("{:?}: refused", panel.kind).to_lowercase()
    })
}

#[test]
fn any_accepted_scene_ends_and_any_other_is_refused_in_words() {
    let (sender, receiver) = mpsc::channel::<String>();
    // strategies within strategies take more of the stack than a thread has by default, without optimisation
    let worker = std::thread::Builder::new().stack_size(1 << 28).spawn(move || {
        let config = Config {
            cases: std::env::var("PROPTEST_CASES").ok().and_then(|cases| cases.parse().ok()).unwrap_or(CASES),
            // a scene that failed once is tried first from then on
            failure_persistence: Some(Box::new(FileFailurePersistence::Direct("tests/properties.regressions"))),
            ..Config::default()
        };
        // the same scenes on every machine
        let rng = TestRng::from_seed(RngAlgorithm::ChaCha, &[15; 32]);
        let fates = std::cell::RefCell::new(BTreeMap::<String, u32>::new());
        let result = TestRunner::new_with_rng(config, rng).run(&scene(), |text| {
            sender.send(text.clone()).expect("somebody listens");
            *fates.borrow_mut().entry(fate(&text)).or_default() += 1;
            Ok(())
        });
        (result.map_err(|error| error.to_string()), fates.into_inner())
    });
    let worker = worker.expect("a thread");
    let mut last = String::new();
    loop {
        match receiver.recv_timeout(PATIENCE) {
            Ok(text) => last = text,
            Err(mpsc::RecvTimeoutError::Disconnected) => break,
            Err(mpsc::RecvTimeoutError::Timeout) => panic!("no end after {PATIENCE:?}:\n{last}"),
        }
    }
    let (result, fates) = worker.join().expect("failures are returned");
    println!("{fates:?}");
    assert_eq!(result, Ok(()), "the last scene was\n{last}");
    // all that can become of a scene does
    let wanted = [Ending::Whole, Ending::Event, Ending::Broken].map(|ending| format!("run: {ending:?}"));
    let others = ["run: refused", "map: Whole", "map: refused", "curve: Whole", "curve: refused"].map(str::to_owned);
    for fate in wanted.iter().chain(&others) {
        assert!(fates.get(fate).is_some_and(|&count| count >= 20), "{fate}: {fates:?}");
    }
}
