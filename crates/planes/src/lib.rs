//! Planes of outcomes: the program `sweep` ([`command`]), which computes one, a shard of it, or gathers the shards; pictures of
//! planes ([`picture`]); and what the supplements read from committed planes ([`outcomes`]).

pub mod command;
pub mod outcomes;
pub mod picture;
