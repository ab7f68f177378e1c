//! Replays the stored fuzzer inputs of this crate's readers.

#[path = "../../../../fuzz/targets/claims.rs"]
mod ledger_files;
#[path = "../../../../fuzz/targets/replay.rs"]
mod replay;
#[path = "../../../../fuzz/targets/sheet.rs"]
mod sheet;

const TO_ROOT: &str = "../..";

#[test]
fn the_ledgers_files_are_read_or_refused() {
    replay::replay("claims", ledger_files::read);
}

#[test]
fn the_ledgers_tables_are_read_or_refused() {
    replay::replay("sheet", sheet::read);
}
