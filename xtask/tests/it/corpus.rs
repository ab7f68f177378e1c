//! Kept inputs of the fuzzers of the runner's readers.

#[path = "../../../fuzz/targets/claims.rs"]
mod claims;
#[path = "../../../fuzz/targets/events.rs"]
mod events;
#[path = "../../../fuzz/targets/manifest.rs"]
mod manifest;
#[path = "../../../fuzz/targets/precision.rs"]
mod precision;
#[path = "../../../fuzz/targets/replay.rs"]
mod replay;
#[path = "../../../fuzz/targets/sheet.rs"]
mod sheet;
#[path = "../../../fuzz/targets/sums.rs"]
mod sums;

const TO_ROOT: &str = "..";

#[test]
fn sums_are_read_or_refused() {
    replay::replay("sums", sums::read);
}

#[test]
fn events_are_read_or_refused() {
    replay::replay("events", events::read);
}

#[test]
fn the_manifest_is_read_or_refused() {
    replay::replay("manifest", manifest::read);
}

#[test]
fn tables_of_precision_are_read_or_refused() {
    replay::replay("precision", precision::read);
}

#[test]
fn the_ledgers_files_are_read_or_refused() {
    replay::replay("claims", claims::read);
}

#[test]
fn the_ledgers_tables_are_read_or_refused() {
    replay::replay("sheet", sheet::read);
}
