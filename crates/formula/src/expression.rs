//! One expression whose names are variables.

use crate::Bound;
use crate::build::Builder;
use crate::graph::Graph;
use crate::operation::{Operation, Variable};
use crate::parse::{Vocabulary, parse};
use crate::place::{Error, Location, Problem};
use math::number::Number;
use std::collections::BTreeMap;

/// An expression outside of a law: functions, constants and operators as there, but `s v x j sum`, and functions
/// without brackets, are names like all others, and every name is a variable.
#[derive(Clone, Debug)]
pub struct Expression {
    names: Vec<(String, Location)>,
    bound: Bound,
}

impl Expression {
    /// Parses a text whose first character is at `place` in `file`.
    ///
    /// # Errors
    /// What is wrong, with its place, what was found and what would be valid.
    pub fn parse(file: &str, place: Location, text: &str) -> Result<Expression, Error> {
        let graph = graph(file, place, text).map_err(|problem| problem.within(file));
        graph.and_then(|(names, graph)| Ok(Expression { names, bound: graph.bind(&[])? }))
    }

    /// The names in the order of their first occurrence in the text, with positions.
    pub fn names(&self) -> &[(String, Location)] {
        &self.names
    }

    /// The value in doubles, with `variable` giving that of each name, by its place in [`names`](Expression::names).
    ///
    /// # Errors
    /// The part that has no finite value, such as the logarithm of a negative number.
    pub fn eval(&self, variable: impl FnMut(usize) -> f64) -> Result<f64, Error> {
        self.bound.eval(self.bound.roots()[0], of_names(variable))
    }

    /// The value in numbers of any kind, of which `constant` makes those that depend on nothing.
    pub fn carry_out<T: Number>(&self, constant: impl Fn(f64) -> T, variable: impl FnMut(usize) -> T) -> T {
        self.bound.carry_out(self.bound.roots()[0], constant, of_names(variable))
    }
}

/// The values of variables from those of names.
fn of_names<T>(mut variable: impl FnMut(usize) -> T) -> impl FnMut(Variable) -> T {
    move |free| match free {
        Variable::Free(place) => variable(place),
        Variable::Spacing(_) | Variable::Speed(_) => unreachable!("only a law has neighbours"),
    }
}

fn graph(file: &str, place: Location, text: &str) -> Result<(Vec<(String, Location)>, Graph), Problem> {
    let tree = parse(text, place, Vocabulary::Free)?;
    let mut builder = Builder::default();
    let (mut names, mut known) = (Vec::new(), BTreeMap::new());
    for (name, place) in tree.names() {
        if !known.contains_key(name) {
            let variable = Operation::Variable(Variable::Free(names.len()));
            known.insert(name, builder.plain(variable, place)?);
            names.push((name.to_owned(), place));
        }
    }
    let root = builder.expression(&tree.entries, &known, 0)?;
    let graph = Graph { file: file.to_owned(), arena: builder.arena, parameters: Vec::new(), roots: vec![root] };
    Ok((names, graph))
}
