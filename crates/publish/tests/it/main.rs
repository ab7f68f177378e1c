//! The page and the article: what they hold, how numbers are written, whether bytes are always the same.

mod article;
mod page;
