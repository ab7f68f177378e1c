//! Measures, verdicts, and every kind of bad input.

mod corpus;
mod ledger;
