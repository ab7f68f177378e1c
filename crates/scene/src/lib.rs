//! From a scene file to tables: validated scenes ([`law`], [`run`], [`map`], [`curve`]) and their numbers, in memory;
//! what is told of them in the end ([`summary`]). A scene in time is a [`jam::run::Run`]. No file is opened here, so that the tables can be computed wherever Rust runs.

pub mod curve;
pub mod law;
pub mod map;
pub mod overrides;
pub mod run;
pub mod summary;
pub mod tables;
pub mod uniform;

pub use files::reader::SceneError;
pub use overrides::Overrides;
