//! Tests of the hunt: random scenes, scenes that once failed, and the judge's ability to detect faults.

mod judge;
mod scenes;
mod seeds;
mod shifts;
