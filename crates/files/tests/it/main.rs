//! Tests of tables, of prints of steps, of writing, and of reading scene files.

mod corpus;
mod reader;
mod recipe;
mod steps;
mod table;
mod write;
