//! libFuzzer's entry; what is tried is in targets/claims.rs.
#![no_main]

#[path = "../targets/claims.rs"]
mod target;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| target::read(bytes));
