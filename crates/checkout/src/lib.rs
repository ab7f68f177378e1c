//! The checkout as the runner and the programs about the result see it: where things lie ([`paths`]), the figures and how
//! a user names them ([`figure`]), what they write ([`outputs`]) and what is committed of it ([`sums`], [`manifest`],
//! [`events`]). No physics; nothing here judges or starts a figure.

pub mod costs;
pub mod disk;
pub mod events;
pub mod failure;
pub mod figure;
pub mod hashing;
pub mod machine;
pub mod manifest;
pub mod outputs;
pub mod paths;
pub mod print;
pub mod process;
pub mod request;
pub mod sums;
