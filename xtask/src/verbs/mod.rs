//! The verbs of the command line.

pub mod accuracy;
pub mod bless;
pub mod checks;
pub mod clean;
pub mod describe;
pub mod doctor;
pub mod explain;
pub mod figures;
pub mod forward;
pub mod judge;
pub mod list;
pub mod publish;
pub mod receipt;
pub mod status;
pub mod summary;
pub mod verify;
