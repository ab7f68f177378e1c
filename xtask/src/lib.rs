//! The runner: it builds the programs of the figures, starts them in the right order, and has another program judge
//! their outputs.
//!
//! It links no physics, no judging and no publishing. `verbs` holds the verbs of the command line; the modules beside
//! it are what they share. Data flows `sources -> record -> plan -> pool -> work -> measured`.

pub mod child;
pub mod cli;
pub mod compile;
pub mod costs;
pub mod estimate;
pub mod gate;
pub mod lock;
pub mod measured;
pub mod module;
pub mod pins;
pub mod plan;
pub mod pool;
pub mod progress;
pub mod record;
pub mod sources;
pub mod store;
pub mod verbs;
pub mod work;
