//! Formulas: the language in which a scene file states a law, and expressions elsewhere.
//!
//! A text becomes a tree, the trees of a law one [`Graph`] whose parameters are symbols, and that, with numbers for
//! parameters, a [`Bound`] list of operations. The list is carried out as it stands: by [`Bound::eval`] in doubles, by
//! [`Bound::carry_out`] with any [`Number`](math::number::Number), or by an interpreter that goes over
//! [`Bound::nodes`].
//!
//! ```
//! use formula::{Definition, Given, Location, Variable, law};
//!
//! let at = |line, column| Location { line, column };
//! let line = |name, given, line| Definition { name, key: at(line, 1), value: at(line, 17), given };
//! let graph = law("scene.toml", Location { line: 1, column: 1 }, &[
//!     line("acceleration", Given::Text("kappa*(V - v)"), 2),
//!     line("V", Given::Text("tanh(s - 2) + tanh(2)"), 3),
//!     line("kappa", Given::Number(1.5), 4),
//!     line("body", Given::Number(0.0), 5),
//! ])?;
//! let bound = graph.bind(&graph.values())?;
//! let value = bound.eval(bound.acceleration(), |variable| match variable {
//!     Variable::Spacing(_) => 2.0,
//!     _ => 0.5,
//! })?;
//! assert!((value - 1.5 * (0.9640275800758169 - 0.5)).abs() < 1e-15);
//! # Ok::<(), formula::Error>(())
//! ```
//!
//! # Meaning
//! - `s`, `v`: spacing to the predecessor and own speed; `s[j]`, `v[j]`: those of pedestrian n + j; `x[j]` =
//!   x_{n+j} - x_n: the spacings between, added from the nearest to the farthest, negative for j < 0.
//! - `sum(j, a, b, EXPRESSION)`: the terms added in the order of j, from the left. Named expressions do not see j.
//! - `^` binds tightest, to the right; then unary minus (`-2^2` is -4); then `* /`, then `+ -`, to the left.
//! - Functions `exp ln ln_1p exp_m1 sqrt tanh softplus abs min max ramp`, constants `e pi`.
//! - `min` and `max` take two or more arguments, two at a time from the left; the first wins a tie.
//!
//! [`Graph::bind`] says what is folded, [`limits`] what is allowed at most.
//!
//! # Units, ranges, errors
//!
//! Formulas know no units: they compute with numbers in the units of their writer, who sees to it that `body` is a
//! length, `v0` or `scale` a speed, and arguments of functions are dimensionless. Numbers of a text are finite doubles.
//!
//! An [`Error`] carries file, line, column, what was found and what would be valid. [`Bound::eval`] returns one where
//! the result is not finite; [`Bound::carry_out`] goes on with NaN or infinities, as its numbers do. A node, root or
//! place in a list that belongs to another formula panics or gives numbers without meaning.

mod arena;
mod bound;
mod build;
mod eval;
mod expression;
mod fold;
mod graph;
mod law;
pub mod limits;
mod names;
mod operation;
mod parse;
mod place;
mod token;
mod tree;
mod written;

pub use bound::{Bound, Kink};
pub use expression::Expression;
pub use graph::{Graph, Parameter, Stencil};
pub use law::{Definition, Given, law};
pub use operation::{Binary, Id, Operation, Unary, Variable};
pub use place::{Error, Location};
pub use written::{Term, Writer};
