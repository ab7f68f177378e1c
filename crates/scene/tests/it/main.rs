//! Tests of scenes: error messages, the figures' scenes, maps, curves, overrides, checkpoints, and runs against
//! published curves and a second method.

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
