//! Documents made from the figures: the article ([`article`], set by Typst with the numbers of [`quantities`]), the
//! page ([`page`]) and the archive ([`bundle`]). The runner starts this program ([`cli`]) once it has found the figures
//! to be the committed ones.

pub mod article;
pub mod bundle;
pub mod cli;
pub mod page;
pub mod quantities;
pub mod typeset;
