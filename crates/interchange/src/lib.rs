//! Trajectories for other programs, in metres and seconds: from a run with a sample for each frame ([`run`]), its table `t, n, x, v` of a run ([`frames`]) and its
//! scene ([`header`]) to text as PedPy reads it ([`text`]) and to JuPedSim's sqlite files ([`sqlite`]).
//!
//! No physics: positions are multiplied by a length. Both files are written row by row, beside their place, and put there
//! when they are whole ([`files::write::Draft`]); the same table and scene give the same bytes.

pub mod frames;
pub mod header;
pub mod run;
pub mod sqlite;
pub mod text;
