//! Tests of tables, of writing, and of reading scene files.

mod corpus;
mod pairs;
mod reader;
mod recipe;
mod table;
mod write;
