//! Files as every program of the project needs them, without physics: scene files with line numbers ([`scene_file`]),
//! CSV tables whose numbers have shortest round-trip form ([`table`]), atomic writing ([`mod@write`]); and the paper's
//! symbols of what both name ([`symbols`]).

pub mod pairs;
pub mod reader;
pub mod scene_file;
pub mod symbols;
pub mod table;
pub mod text;
pub mod write;
