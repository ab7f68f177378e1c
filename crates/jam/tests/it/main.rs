//! Tests of the physics: the laws against their printed form, the ring's symmetries, growth against linear theory, the
//! paper's criteria against the exact ones, events and jams on constructed runs.

mod bits;
mod confirmed;
mod constants;
mod convergence;
mod criteria;
mod deviation;
mod edges;
mod events;
mod fingerprints;
mod forms;
mod formula;
mod growth;
mod heun;
mod jams;
mod kinks;
mod linear;
mod own;
mod precise;
mod presets;
mod public;
mod ring;
mod rings;
mod run;
mod sample;
mod series;
mod tangent;
mod uniform;
mod walls;
mod written;
