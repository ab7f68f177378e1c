//! Replays the stored inputs of the fuzzer of tables.

#[path = "../../../../fuzz/targets/replay.rs"]
mod replay;
#[path = "../../../../fuzz/targets/table.rs"]
mod table;

const TO_ROOT: &str = "../..";

#[test]
fn tables_read_back_as_they_are_written() {
    replay::replay("table", table::read);
}
