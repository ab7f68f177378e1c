//! Tests of the page and the article: contents, number formats, reproducible bytes.

mod article;
mod page;
