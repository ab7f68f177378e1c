//! CPU seconds and instructions of the parts of a run; against another commit, ratios. The runner starts this program
//! ([`mod@bench`]).

pub mod bench;
pub mod benchmarks;
pub mod pairs;
