//! Tests of the reference solutions: the laws against those of `jam`, the order of the method, the committed digits.

mod laws;
mod method;
mod number;
mod published;
mod solution;
mod tables;
