//! What the page computes in WebAssembly, without a file system or a clock. It computes all tables of the figures (the
//! scene files are built in, [`figures`]; [`compute`] returns tables as bytes). For a reader's own scene ([`given`]) it
//! computes the stability ([`flow`]), the run ([`simulate`]), and the claims of the paper judged on this run
//! ([`rejudge`]). A browser or Node calls the C functions of [`exports`]; the module calls those of [`page`] to report
//! progress.

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
