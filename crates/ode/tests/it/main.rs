//! Tests of the integrator: coefficients against the order conditions, results against known solutions, and the
//! documented behaviour of the drivers.

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
