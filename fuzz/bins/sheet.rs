//! libFuzzer's entry; what is tried is in targets/sheet.rs.
#![no_main]

#[path = "../targets/sheet.rs"]
mod target;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| target::read(bytes));
