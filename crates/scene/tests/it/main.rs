//! Tests of scenes: every complaint, the figures' own scenes, maps, curves, overrides, and runs against published curves
//! and against a second method; checkpoints.

mod cases;
mod checkpoint;
mod contours;
mod corpus;
mod errors;
mod estimates;
mod figures;
mod formulas;
mod gallery;
mod hard;
mod maps;
mod outcome;
mod overrides;
mod project;
mod properties;
mod published;
mod reference;
mod runs;
