//! Lists of sums, samples, distances, tolerances, tables of accuracy.

mod corpus;
mod html;
mod judging;
mod precision;
mod tolerances;
