//! The hunt: random scenes, those that once went wrong, and that the judge sees what is wrong.

mod judge;
mod scenes;
mod seeds;
mod shifts;
