//! Tests of pictures through the public interface.

mod faults;
#[path = "../../examples/gallery.rs"]
#[expect(dead_code, reason = "the page's own main function")]
mod gallery;
mod pages;
