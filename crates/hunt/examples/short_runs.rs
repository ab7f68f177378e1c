//! Short random runs, with the errors of their numbers or without, for counting what these cost:
//! `valgrind --tool=callgrind target/release/examples/short_runs FROM COUNT [taylor] [errors]`.

use hunt::draw;
use jam::errors::stated;
use jam::run::{Run, run};
use ode::Control;

/// Longer runs are left out, or cut off.
const STEPS: f64 = 2000.0;
const PEDESTRIANS: usize = 60;

/// The runs of a scene that are short.
fn short(seed: u64) -> Vec<Run> {
    let Ok(scene_file) = files::scene_file::parse("scene.toml", &draw::scene(seed)) else { return Vec::new() };
    let runs = scene_file.panels.iter().filter_map(|panel| scene::run::read("scene.toml", &panel.tables).ok());
    let is_short = |run: &Run| {
        let are_few = match run.control {
            Control::Fixed { step } => run.t_end < STEPS * step,
            Control::Adaptive { .. } => true,
        };
        are_few && run.ring.pedestrians < PEDESTRIANS
    };
    runs.map(|run| Run { most_steps: STEPS as u64, ..run }).filter(is_short).collect()
}

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let number = |index: usize| arguments.get(index).and_then(|word| word.parse().ok()).unwrap_or(0);
    let asks = |word: &str| arguments.iter().any(|argument| argument == word);
    let first = number(1) + if asks("taylor") { draw::TAYLOR } else { 0 };
    let (mut runs, mut ended) = (0, 0);
    for run_of_scene in (first..first + number(2)).flat_map(short) {
        runs += 1;
        let is_whole = if asks("errors") { stated(&run_of_scene).is_ok() } else { run(&run_of_scene).is_ok() };
        ended += u64::from(is_whole);
    }
    println!("{runs} runs, {ended} of them to an end");
}
