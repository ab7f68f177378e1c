//! From a scene file to tables: validated scenes ([`law`], [`run`], [`map`], [`curve`]), their numbers in memory, and
//! their summaries ([`summary`]). A time-dependent scene is a [`jam::run::Run`]. This crate opens no files, so tables
//! can be computed wherever Rust runs.

pub mod axis;
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
