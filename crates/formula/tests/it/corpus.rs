//! Replays the stored inputs of the fuzzer.

#[path = "../../../../fuzz/targets/formula.rs"]
mod formulas;
#[path = "../../../../fuzz/targets/replay.rs"]
mod replay;

/// From this crate to the folder of the project.
const TO_ROOT: &str = "../..";

#[test]
fn kept_formulas() {
    replay::replay("formula", formulas::read);
}
