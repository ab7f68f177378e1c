//! From a scene file to tables: validated scenes ([`law`], [`run`], [`map`], [`curve`], [`sweep`]) and their numbers, in memory;
//! long runs as bytes to go on from ([`checkpoint`]); how far their numbers are off ([`check`]); what is told of them in
//! the end ([`summary`]). No file is opened here, so that the tables can be computed wherever Rust runs.

pub mod check;
pub mod checkpoint;
pub mod curve;
pub mod law;
pub mod map;
pub mod overrides;
pub mod propagated;
pub mod run;
pub mod simulation;
pub mod summary;
pub mod sweep;
pub mod uniform;

pub use files::reader::SceneError;
pub use overrides::Overrides;
