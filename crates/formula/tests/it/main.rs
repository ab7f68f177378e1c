//! Tests of formulas: what they mean, what they refuse, how exact they are.

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
