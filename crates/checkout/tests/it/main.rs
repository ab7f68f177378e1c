//! Readers of what is committed, and events that are refused.

mod corpus;
mod tables;
