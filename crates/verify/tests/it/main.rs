//! Lists of sums, samples, distances, tolerances, tables of accuracy.

mod corpus;
mod judging;
mod precision;
mod tolerances;
