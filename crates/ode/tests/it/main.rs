//! Tests of the integrator: coefficients against the order conditions, solutions against known ones, the drivers
//! against what they promise.

mod batches;
mod comparison;
mod convergence;
mod dense;
mod driver;
mod events;
mod failures;
mod order_conditions;
mod pedestrians;
mod problems;
mod resume;
mod shadow;
mod taylor;
mod trees;
