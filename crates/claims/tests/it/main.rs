//! Measures, verdicts, and every kind of bad input.

mod committed;
mod corpus;
mod desk;
mod entries;
mod measures;
mod uncertain;
