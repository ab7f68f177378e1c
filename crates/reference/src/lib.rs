//! Reference solutions of the paper's scenes in double-double arithmetic (106 bits), against which the other crates are
//! judged.
//!
//! Nothing is shared with `jam` and `ode` but the arithmetic of `math`, and of a law that a scene gives as formulas the
//! parsed graph ([`graph`]): the laws are written a second time, straight
//! from the paper and with just the terms that the scenes have; the state is clearances and speeds, not deviations; the
//! method is extrapolation of a much higher order, in double-double numbers.

pub mod cascade;
pub mod collocation;
pub mod events;
pub mod extrapolation;
pub mod flow;
pub mod formula;
pub mod graph;
pub mod growth;
pub mod laws;
pub mod number;
pub mod ring;
pub mod run;
pub mod scenes;
pub mod solution;
pub mod solver;
pub mod table;
