//! The runner's tests: its parts alone, then the whole of it on a small checkout with stand-ins for every program.

mod accuracy;
mod bench;
mod bundle;
mod cli;
mod data;
mod distance;
mod export;
#[cfg(unix)]
mod faults;
mod figures;
mod ids;
mod judging;
mod ledger;
mod page;
mod paper;
mod pool;
mod progress;
mod python;
mod record;
mod shop;
mod supply;
mod tables;
mod troubles;
