//! Runs: a small scene that is accepted runs to its end, stops with an event, or reports why it cannot continue.

use files::scene_file::{self, Kind};
use jam::run::Samples;
use ode::Control;
use scene::run::Scene;

/// Larger ones are left out: pedestrians, rows of a table, steps.
const SMALL: (usize, f64, u64) = (12, 200.0, 400);

/// Tries one file.
pub fn read(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    let Ok(scene_file) = scene_file::parse("any.toml", text) else { return };
    for panel in scene_file.panels.iter().filter(|panel| panel.kind == Kind::Run) {
        if let Ok(scene) = scene::run::read(&scene_file.file, &panel.tables) {
            run(scene);
        }
    }
}

/// How a small run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Ending {
    /// Not run: too large to be tried by the thousand.
    Large,
    /// It reached its end.
    Whole,
    /// An event ended it.
    Event,
    /// It could not go on and said why.
    Broken,
}

/// Runs a scene if it is small, with no more steps than are small.
pub fn run(scene: Scene) -> Ending {
    let (pedestrians, rows, steps) = SMALL;
    let too_fine = matches!(scene.control, Control::Fixed { step } if scene.t_end / step > steps as f64);
    if scene.ring.pedestrians > pedestrians || scene.t_end / scene.sample > rows || too_fine {
        return Ending::Large;
    }
    let scene = Scene { most_steps: scene.most_steps.min(steps), ..scene };
    let outcome = match jam::run::run(&scene) {
        Ok(outcome) => outcome,
        Err(broken) => {
            assert!(broken.to_string().contains("t = "), "{broken}");
            return Ending::Broken;
        }
    };
    let Samples { std, positions, speeds, .. } = &outcome.samples;
    let mut numbers = std.iter().chain(positions).chain(speeds);
    assert!(numbers.all(|number| number.is_finite()), "a table with a number that is none: {scene:?}");
    assert!(outcome.events.iter().all(|event| (0.0..=scene.t_end).contains(&event.time)), "{:?}", outcome.events);
    if outcome.statistics.time == scene.t_end {
        return Ending::Whole;
    }
    assert!(!outcome.events.is_empty(), "it ends early and nothing happened: {scene:?}");
    Ending::Event
}
