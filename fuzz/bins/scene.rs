//! libFuzzer's entry; what is tried is in targets/scene.rs.
#![no_main]

#[path = "../targets/scene.rs"]
mod target;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| target::read(bytes));
