//! libFuzzer's entry; what is tried is in targets/sums.rs.
#![no_main]

#[path = "../targets/sums.rs"]
mod target;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| target::read(bytes));
