//! All tables of the figures, computed without a file system: the scene files are built in ([`figures`]), the tables
//! come out as bytes ([`compute`]), and a few C functions hand them to a browser or to Node ([`exports`]).

pub mod compute;
pub mod exports;
pub mod figures;

pub use compute::Tables;
pub use figures::FIGURES;
