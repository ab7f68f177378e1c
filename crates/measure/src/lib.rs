//! Seconds of CPU and instructions of the parts that runs consist of; against another commit, ratios. A program that the
//! runner starts ([`mod@bench`]).

pub mod bench;
pub mod benchmarks;
pub mod pairs;
