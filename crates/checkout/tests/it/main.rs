//! Tests of the readers of committed files, and of events that must be refused.

mod corpus;
mod tables;
