//! libFuzzer's entry; what is tried is in targets/precision.rs.
#![no_main]

#[path = "../targets/precision.rs"]
mod target;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| target::read(bytes));
