//! Limits on formulas, which keep any text from exhausting stack, memory or time.

/// Bytes of one expression.
pub const LONGEST_TEXT: usize = 16_384;
/// Brackets, signs and exponents inside each other.
pub const DEEPEST: usize = 100;
/// How far a neighbour may be, and a bound of a sum.
pub const FARTHEST: i32 = 1000;
/// Operations of a law, with sums written out and named expressions counted once.
pub const MOST_OPERATIONS: usize = 100_000;
