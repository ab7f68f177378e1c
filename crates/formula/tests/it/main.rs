//! Tests of formulas: their meaning, what is refused, and how accurate they are.

mod bad;
mod common;
mod corpus;
mod dual;
mod fuzz;
mod gallery;
mod good;
mod laws;
mod random;
mod running;
mod trees;
