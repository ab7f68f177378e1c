//! Replays the stored fuzzer inputs of this crate's readers.

#[path = "../../../../fuzz/targets/manifest.rs"]
mod manifest;
#[path = "../../../../fuzz/targets/replay.rs"]
mod replay;
#[path = "../../../../fuzz/targets/sums.rs"]
mod sums;

const TO_ROOT: &str = "../..";

#[test]
fn the_manifest_is_read_or_refused() {
    replay::replay("manifest", manifest::read);
}

#[test]
fn sums_are_read_or_refused() {
    replay::replay("sums", sums::read);
}
