//! Differential testing of random scenes. Each scene ([`draw`]) is run as a user would run it and judged ([`judge`]) by
//! a second integration ([`answer`], `crates/reference`). The two share the formula of the law, but neither the scene
//! reader, the laws, the methods nor the elementary functions. When the law is given as formulas, they also share the
//! parsed graph (`crates/formula`), which has its own tests; its evaluation is implemented twice.

pub mod answer;
pub mod bound;
pub mod case;
pub mod draw;
pub mod judge;
pub mod question;
pub mod random;
pub mod report;
pub mod stated;
