//! A run that is broken off and resumed from its checkpoint is the same to the last bit.

use jam::run::{Checkpoint, Outcome, PartialRun, RunObserver, run_from};
use scene::run::Scene;

/// Breaks a run off where it could leave its first checkpoint.
#[derive(Default)]
struct Broken {
    bytes: Vec<u8>,
}

impl RunObserver for Broken {
    fn between(&mut self, underway: &PartialRun<'_>) {
        if self.bytes.is_empty() {
            self.bytes = underway.to_bytes();
        }
    }

    fn is_done(&self) -> bool {
        !self.bytes.is_empty()
    }
}

/// What is wrong with the run made in two parts, if anything; `None` for a run too short to leave a checkpoint.
pub(super) fn compare(scene: &Scene, outcome: &Outcome) -> Option<Result<(), String>> {
    let mut broken = Broken::default();
    // the end of the first part says nothing
    let _ = run_from(scene, None, &mut broken);
    if broken.bytes.is_empty() {
        return None;
    }
    let Some(checkpoint) = Checkpoint::parse(&broken.bytes, scene) else {
        return Some(Err("the checkpoint cannot be read".to_owned()));
    };
    let resumed = run_from(scene, Some(checkpoint), &mut ()).unwrap_or_else(|broken| *broken.outcome);
    let is_same = resumed.samples == outcome.samples
        && resumed.events == outcome.events
        && resumed.statistics == outcome.statistics
        && resumed.positions == outcome.positions
        && resumed.speeds == outcome.speeds;
    let (found, right) = (&resumed.statistics, &outcome.statistics);
    Some(if is_same { Ok(()) } else { Err(format!("resumed, the run is another one: {found:?}, not {right:?}")) })
}
