//! Replays the stored fuzzer inputs of this crate's readers.

#[path = "../../../../fuzz/targets/checkpoint.rs"]
mod checkpoint;
#[path = "../../../../fuzz/targets/replay.rs"]
mod replay;
#[path = "../../../../fuzz/targets/run.rs"]
pub mod run;
#[path = "../../../../fuzz/targets/scene.rs"]
pub mod scene_file;

const TO_ROOT: &str = "../..";

#[test]
fn scene_files_are_accepted_or_refused() {
    replay::replay("scene", scene_file::read);
}

#[test]
fn small_scenes_run_or_say_why_not() {
    replay::replay("run", run::read);
}

#[test]
fn checkpoints_are_taken_or_not() {
    replay::replay("checkpoint", checkpoint::read);
}
