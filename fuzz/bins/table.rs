//! libFuzzer's entry; what is tried is in targets/table.rs.
#![no_main]

#[path = "../targets/table.rs"]
mod target;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| target::read(bytes));
