//! Tests of the elementary functions: their accuracy, and that their bits are the same everywhere.

mod complex;
mod difference;
mod double_double;
mod full;
mod lane;
mod pinned;
mod sample;
mod scalar;
mod special;
mod widths;
