//! libFuzzer's entry; what is tried is in targets/checkpoint.rs.
#![no_main]

#[path = "../targets/checkpoint.rs"]
mod target;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| target::read(bytes));
