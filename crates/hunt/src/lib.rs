//! A test that hunts: random scenes ([`draw`]) are run as their users would run them and judged ([`judge`]) by a second
//! integration ([`answer`], `crates/reference`) that shares nothing with the first but the formula: not the reader of
//! scenes, not the laws, not the methods, not the elementary functions. Of a law that a scene gives as formulas both have
//! the parsed graph (`crates/formula`), which has tests of its own; how it is carried out is written twice.

pub mod answer;
pub mod bound;
pub mod case;
pub mod draw;
pub mod judge;
pub mod question;
pub mod random;
pub mod report;
pub mod stated;
