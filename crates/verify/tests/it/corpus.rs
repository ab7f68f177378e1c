//! Replays the stored fuzzer inputs of the readers of events and of accuracy tables.

#[path = "../../../../fuzz/targets/events.rs"]
mod events;
#[path = "../../../../fuzz/targets/precision.rs"]
mod precision;
#[path = "../../../../fuzz/targets/replay.rs"]
mod replay;

const TO_ROOT: &str = "../..";

#[test]
fn events_are_read_or_refused() {
    replay::replay("events", events::read);
}

#[test]
fn tables_of_precision_are_read_or_refused() {
    replay::replay("precision", precision::read);
}
