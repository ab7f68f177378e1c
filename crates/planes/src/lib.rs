//! Planes of outcomes: the program `sweep` ([`command`]), which computes a plane or a shard, or gathers shards;
//! pictures of planes ([`picture`]); and the tables that supplements read from committed planes ([`outcomes`]).

pub mod command;
pub mod outcomes;
pub mod picture;
