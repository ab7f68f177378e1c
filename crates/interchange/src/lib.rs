//! Exports trajectories in metres and seconds. A run is sampled once for each frame ([`run`]); its table ([`frames`])
//! and its scene ([`header`]) become text that PedPy reads ([`text`]) and a database that JuPedSim reads ([`sqlite`]).
//!
//! No physics: positions are multiplied by a length. Both files are written row by row, beside their place, and put
//! there when they are whole ([`files::write::Draft`]); the same table and scene give the same bytes.

pub mod frames;
pub mod header;
pub mod run;
pub mod sqlite;
pub mod text;
