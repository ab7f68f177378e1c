//! The runner's tests: its parts alone, then the whole of it on a small checkout with stand-ins for every program.

mod accuracy;
mod bless;
mod bundle;
mod checks;
mod cli;
mod data;
mod distance;
mod export;
#[cfg(unix)]
mod faults;
mod figures;
mod ids;
mod ledger;
mod levels;
mod page;
mod paper;
mod pool;
mod progress;
mod real;
mod record;
mod shop;
mod stale;
mod supply;
mod tables;
mod troubles;
mod verify;
mod walls;
