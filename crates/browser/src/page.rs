//! Functions that the module imports from the page to report the progress of a run. Outside WebAssembly they do
//! nothing.
#![allow(unsafe_code, reason = "a foreign function is declared in an `unsafe` block; these are safe to call")]

use crate::simulate::Hearer;

#[cfg(target_arch = "wasm32")]
mod ears {
    #[link(wasm_import_module = "page")]
    unsafe extern "C" {
        pub safe fn sample(numbers: *const f64, count: usize);
        pub safe fn event(text: *const u8, length: usize);
        pub safe fn checking();
    }
}

#[cfg(not(target_arch = "wasm32"))]
mod ears {
    pub fn sample(_numbers: *const f64, _count: usize) {}
    pub fn event(_text: *const u8, _length: usize) {}
    pub fn checking() {}
}

/// The page.
#[derive(Debug)]
pub struct Page;

impl Hearer for Page {
    fn sample(&mut self, numbers: &[f64]) {
        ears::sample(numbers.as_ptr(), numbers.len());
    }

    fn event(&mut self, event: &str) {
        ears::event(event.as_ptr(), event.len());
    }

    fn checking(&mut self) {
        ears::checking();
    }
}
