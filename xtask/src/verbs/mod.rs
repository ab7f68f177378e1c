//! One file for each verb of the command line.

pub mod accuracy;
pub mod bench;
pub mod bless;
pub mod bundle;
pub mod ci;
pub mod clean;
pub mod describe;
pub mod doctor;
pub mod explain;
pub mod export;
pub mod figures;
pub mod forward;
pub mod list;
pub mod paper;
pub mod report;
pub mod status;
pub mod summary;
pub mod test;
pub mod verify;
