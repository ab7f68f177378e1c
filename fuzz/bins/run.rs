//! libFuzzer's entry; what is tried is in targets/run.rs.
#![no_main]

#[path = "../targets/run.rs"]
mod target;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| target::read(bytes));
