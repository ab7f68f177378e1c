//! libFuzzer's entry; what is tried is in targets/formula.rs.
#![no_main]

#[path = "../targets/formula.rs"]
mod target;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| target::read(bytes));
