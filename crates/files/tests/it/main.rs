//! Tests of tables, of writing, and of reading scene files.

mod corpus;
mod pairs;
mod reader;
mod scene_file;
mod table;
mod write;
