//! How long the errors of runs take, relative to the runs: each panel of a scene is run with errors and without in
//! turn, and the ratio of the medians less 1 is printed: `target/release/examples/error_time SCENE [PAIRS]`. Without a
//! scene, short random runs, all of them in each turn: `error_time short [PAIRS]`.

use hunt::draw;
use jam::errors::stated;
use jam::run::{Run, run};
use ode::Control;
use std::time::Instant;

/// Pairs, unless told.
const PAIRS: usize = 31;
/// Scenes of short runs, and what is short.
const SCENES: u64 = 200;
const STEPS: f64 = 2000.0;
const PEDESTRIANS: usize = 60;

fn runs(text: &str) -> Vec<(String, Run)> {
    let Ok(scene_file) = files::scene_file::parse("scene.toml", text) else { return Vec::new() };
    let read = |panel: &files::scene_file::Panel| {
        scene::run::read("scene.toml", &panel.tables).ok().map(|run| (panel.name.clone(), run))
    };
    scene_file.panels.iter().filter_map(read).collect()
}

fn is_short(run: &Run) -> bool {
    let are_few = match run.control {
        Control::Fixed { step } => run.t_end < STEPS * step,
        Control::Adaptive { .. } => true,
    };
    are_few && run.ring.pedestrians < PEDESTRIANS
}

/// The seconds that this takes.
fn seconds(what: impl Fn()) -> f64 {
    let start = Instant::now();
    what();
    start.elapsed().as_secs_f64()
}

/// The medians of both in turn.
fn medians(pairs: usize, runs: &[Run]) -> [f64; 2] {
    let mut all: [Vec<f64>; 2] = Default::default();
    for _ in 0..pairs {
        all[0].push(seconds(|| runs.iter().for_each(|one| drop(run(one)))));
        all[1].push(seconds(|| runs.iter().for_each(|one| drop(stated(one)))));
    }
    all.map(|mut seconds| {
        seconds.sort_by(f64::total_cmp);
        seconds[seconds.len() / 2]
    })
}

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let scene = arguments.get(1).map_or("short", String::as_str);
    let pairs = arguments.get(2).and_then(|word| word.parse().ok()).unwrap_or(PAIRS);
    let groups: Vec<(String, Vec<Run>)> = if scene == "short" {
        let seeds = draw::TAYLOR + 400_000..draw::TAYLOR + 400_000 + SCENES;
        let all = seeds.flat_map(|seed| runs(&draw::scene(seed))).map(|(_, run)| run);
        let short = all.map(|run| Run { most_steps: STEPS as u64, ..run }).filter(is_short);
        vec![("short runs".to_string(), short.collect())]
    } else {
        let text = std::fs::read_to_string(scene).unwrap_or_default();
        runs(&text).into_iter().map(|(name, run)| (name, vec![run])).collect()
    };
    for (name, runs) in groups {
        let [without, with] = medians(pairs, &runs);
        let count = runs.len();
        println!("{scene} {name}: {count} runs, {pairs} pairs, {without:.3e} s, errors {:.3}", with / without - 1.0);
    }
}
