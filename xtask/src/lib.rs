//! The runner: it builds the figures' binaries, starts them in the right order, and judges what they wrote.
//!
//! It links no physics. `verbs` holds one file for each verb of the command line; the modules beside it are what the
//! verbs share. Data flows `figure -> sources -> freshness -> plan -> pool -> outputs -> sums, manifest`.

pub mod attest;
pub mod benchmarks;
pub mod browser;
pub mod bundle;
pub mod child;
pub mod cli;
pub mod compile;
pub mod costs;
pub mod disk;
pub mod distance;
pub mod estimate;
pub mod events;
pub mod failure;
pub mod figure;
pub mod gate;
pub mod golden;
pub mod hashing;
pub mod judging;
pub mod ledger;
pub mod lock;
pub mod manifest;
pub mod numbers;
pub mod outputs;
pub mod page;
pub mod pairs;
pub mod paths;
pub mod pedpy;
pub mod pins;
pub mod plan;
pub mod pool;
pub mod precision;
pub mod print;
pub mod progress;
pub mod python;
pub mod quantities;
pub mod record;
pub mod rows;
pub mod sources;
pub mod store;
pub mod sums;
pub mod typeset;
pub mod usage;
pub mod verbs;
pub mod work;
