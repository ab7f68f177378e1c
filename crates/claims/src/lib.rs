//! The ledger: statements of the source, its errata and the constants of the reproduction, each judged by tests over
//! tables.
//!
//! Three files are written by hand, `paper/claims.toml`, `paper/errata.toml` and `paper/parameters.toml`; no measured
//! number stands in them. From them and the tables follows `data/ledger.json`, which the document and the page read.
//!
//! A test is a measure and, mostly, what must be true of it:
//!
//! ```toml
//! name = "least"                # for placeholders; optional
//! take = "least"                # least largest mean sum span first last | only: of the one row that is left |
//!                               # count, share: of rows
//! of = "v"                      # a formula (crate `formula`) whose names are columns: "v - v_beside"
//! table = "fig11/trajectories"  # below data/, without .csv
//! where = ["t >= 1", "v < 0"]   # all must hold; op one of < <= > >= = !=
//! among = ["t >= 1"]            # the rows looked at, before others are put beside them; share is a share of these
//! beside = "fig11/other"        # puts rows of another table beside these; its columns end in _beside
//! next = "t"                    # or puts the next row by this column beside each one; its columns end in _next
//! on = ["t", "n"]               # the columns that two rows side by side share; else those without a stated error
//! error_of = "uncertainty"      # the column that holds the errors of what `of` names
//! times = 2                     # or over, less: a number, or { take.., of.., table.. }
//! is = "> 0"                    # what must be true: `op number`, or `1 within 0.02`; without it the test only reports
//! ```
//!
//! On the right of a comparison stands a formula too, a word that stands in the column on the left (in single quotes
//! where a column has that name), or `empty`. A comparison of numbers with an empty cell does not hold.
//!
//! Every number has an error: that of `error_of`; else the one the manifest states for the column, a part of the
//! column's range (of tables in closed form, a part of numbers above 1); else none, the number is taken as it is
//! written. A comparison is true or false only if it is so for all values within the errors, and undecided otherwise;
//! rows of which it is open whether they are chosen count as error.
//!
//! A claim has `[[claim.test]]` of the statement as it is written and perhaps `[[claim.under]]`, of the statement under
//! its `condition`. The verdict follows from them ([`report::verdict`]); the one in the file is what is expected.

pub mod again;
pub mod check;
pub mod entry;
pub mod expression;
pub mod measure;
pub mod report;
pub mod requirement;
pub mod sheet;
pub mod source;
pub mod tables;
pub mod uncertain;
pub mod words;

mod judge;
mod show;

pub use judge::{Verdicts, figures, is_complete, judge, write};
pub use show::{explain, list};
