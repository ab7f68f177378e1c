//! What every program of the project needs of files, and no physics: scene files read with line numbers ([`scene_file`]),
//! tables as CSV with numbers in shortest round-trip form ([`table`]), and
//! writing that leaves either the old file or the whole new one ([`write`]).

pub mod pairs;
pub mod reader;
pub mod scene_file;
pub mod table;
pub mod text;
pub mod write;
