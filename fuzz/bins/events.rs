//! libFuzzer's entry; what is tried is in targets/events.rs.
#![no_main]

#[path = "../targets/events.rs"]
mod target;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| target::read(bytes));
