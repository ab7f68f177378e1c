//! What is made from the figures for readers: the article ([`article`], set by Typst from numbers that [`quantities`]
//! names), the page ([`page`]) and the archive ([`bundle`]). A program that the runner starts ([`cli`]), once it has seen
//! that the figures are the committed ones.

pub mod article;
pub mod bundle;
pub mod cli;
pub mod page;
pub mod quantities;
pub mod typeset;
