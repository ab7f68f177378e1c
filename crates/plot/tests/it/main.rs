//! Pictures as a caller gets them.

mod faults;
mod pages;
mod samples;
