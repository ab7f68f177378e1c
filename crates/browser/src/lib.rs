//! What a page computes in WebAssembly, without a file system and without a clock: all tables of the figures (the scene
//! files are built in, [`figures`]; the tables come out as bytes, [`compute`]), and a reader's own scene ([`given`]): its
//! stability ([`flow`]) its run ([`simulate`]), and the claims of the paper on this run ([`rejudge`]). A few C functions are what a browser or Node calls ([`exports`]), a few
//! others what they are told by ([`page`]).

pub mod compute;
pub mod exports;
pub mod figures;
pub mod flow;
pub mod given;
pub mod page;
pub mod rejudge;
pub mod simulate;

pub use compute::Tables;
pub use figures::FIGURES;
