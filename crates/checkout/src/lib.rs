//! The checkout as the runner and the judging and publishing programs see it: where files lie ([`paths`]), the figures
//! and the names by which a user selects them ([`figure`]), what they write ([`outputs`]) and what of it is committed
//! ([`sums`], [`manifest`], [`events`]). This crate contains no physics, judges nothing and starts no figure.

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
