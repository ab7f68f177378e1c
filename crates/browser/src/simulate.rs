//! Runs a scene for a viewer: samples and events are passed on as they occur, the summary at the end.

use crate::given::{FILE, complaint, panel};
use crate::rejudge::Ran;
use files::write::sha256;
use jam::errors;
use jam::events::Event;
use jam::run::{Judging, RunObserver, Sample, Sight};
use ode::Step;
use scene::run::Scene;
use scene::summary::{self, FinishedRun};
use scene::tables;
use scene::uniform::stability;
use serde_json::{Value, json};

/// Hears of a run as it goes.
pub trait Hearer {
    /// A sample: `t`, the standard deviation, then `x` and `v` of all pedestrians, if the scene records them.
    fn sample(&mut self, numbers: &[f64]);
    /// An event: `event`, `t` and `n` as JSON.
    fn event(&mut self, event: &str);
    /// The run has ended; the second one, which estimates its errors, begins.
    fn checking(&mut self);
}

/// Runs a scene as `cargo xtask simulate` does, to the same bits: the contents of `summary.json` (without the seconds,
/// since there is no clock here), and `sums` with the SHA-256 of each table.
///
/// # Errors
/// The scene is wrong; see [`complaint`].
pub fn run(text: &str, hearer: &mut dyn Hearer) -> Result<Value, Value> {
    run_kept(text, hearer).map(|(told, _)| told)
}

/// The same, with the run itself.
///
/// # Errors
/// As [`run`].
pub fn run_kept(text: &str, hearer: &mut dyn Hearer) -> Result<(Value, Ran), Value> {
    let panel = panel(text)?;
    let scene = scene::run::read(FILE, &panel.tables).map_err(|error| complaint(&error))?;
    let mut watch = Watch { numbers: Vec::new(), hearer };
    let mut ended = end(&scene, &mut watch);
    watch.hearer.checking();
    let errors = ended.checked(&scene, &mut (), &mut Judging::Along);
    let mut told = summary::of_run(&scene, &ended, stability(&scene).as_ref(), Some(&errors));
    let mut sums = json!({ "std.csv": sha256(&tables::std(&ended.outcome.samples).to_csv()) });
    if scene.keeps_trajectories {
        sums["trajectories.csv"] = json!(sha256(&tables::trajectories(&ended.outcome.samples).to_csv()));
    }
    if let Value::Object(told) = &mut told {
        told.remove("seconds");
        told.insert("sums".to_owned(), sums);
    }
    Ok((told, Ran { outcome: ended.outcome, errors }))
}

/// Runs to the end, with the errors estimated by the steps if the method provides them.
fn end(scene: &Scene, watch: &mut Watch<'_>) -> FinishedRun {
    let (made, propagated) = errors::run_propagated(scene, watch);
    let (outcome, broken) = match made {
        Ok(outcome) => (outcome, None),
        Err(broken) => (*broken.outcome.clone(), Some(broken)),
    };
    FinishedRun { outcome, broken, seconds: 0.0, resumed_steps: 0, propagated: Some(propagated) }
}

/// Tells what is seen.
struct Watch<'a> {
    numbers: Vec<f64>,
    hearer: &'a mut dyn Hearer,
}

impl RunObserver for Watch<'_> {
    fn seen(&mut self, _step: &mut Step<'_>, sight: &mut Sight<'_, '_>) {
        for Event { kind: event, time, pedestrian, .. } in sight.new {
            self.hearer.event(&json!({ "event": event.name(), "t": time, "n": pedestrian }).to_string());
        }
    }

    fn sampled(&mut self, sample: &Sample<'_>) {
        self.numbers.clear();
        self.numbers.extend([sample.time, sample.std]);
        self.numbers.extend(sample.positions.iter().chain(sample.speeds));
        self.hearer.sample(&self.numbers);
    }

    fn judging(&self) -> Judging {
        Judging::Along
    }
}
