//! Compares what was made with what is committed, on four levels: bytes, numbers, pixels, claims. The runner starts
//! this program ([`cli`]).
//!
//! [`mod@reference`] finds what is committed; [`tables`] with [`numbers`], [`states`], [`moved`] and [`pictures`] compare it
//! with what was made; [`verdict`] says what that means together, [`words`], [`json`] and [`page`] (by [`html`]) tell it. The ledger is
//! judged by the crate `claims`. [`bless`] shows the same judgement before it writes.

pub mod accuracy;
pub mod attest;
pub mod bless;
pub mod cli;
pub mod costs;
pub mod distance;
pub mod findings;
pub mod golden;
pub mod html;
pub mod json;
pub mod judgement;
pub mod moved;
pub mod numbers;
pub mod page;
pub mod pictures;
pub mod pixels;
pub mod precision;
pub mod published;
pub mod reference;
pub mod rows;
pub mod states;
pub mod tables;
pub mod tolerances;
pub mod verdict;
pub mod words;
