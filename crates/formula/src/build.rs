//! Builds a graph from syntax trees: names are replaced by their definitions, sums are expanded, common parts are
//! shared.

use crate::arena::Arena;
use crate::graph::Symbol;
use crate::limits::{FARTHEST, MOST_OPERATIONS};
use crate::operation::{Binary, Id, Operation, Unary, Variable};
use crate::place::{Location, Problem};
use crate::tree::{Entry, Index, Quantity};
use std::collections::BTreeMap;

/// A graph that grows.
#[derive(Default)]
pub(crate) struct Builder {
    pub(crate) arena: Arena<Symbol>,
    /// Whether the node depends on a variable.
    varies: Vec<bool>,
    /// Operations so far, shared ones counted as often as they are written.
    work: usize,
    /// `x[m]` for m = 1, 2, ..., and the sums behind `x[-m]`.
    distances: [Vec<Id>; 2],
}

impl Builder {
    pub(crate) fn add(&mut self, symbol: Symbol, place: Location) -> Result<Id, Problem> {
        self.work += 1;
        if self.work > MOST_OPERATIONS {
            let found = format!("a law of more than {MOST_OPERATIONS} operations, sums written out");
            return Err(Problem::new(place, found, "shorter sums; named expressions are counted once"));
        }
        let id = self.arena.add(symbol, place);
        if id == self.varies.len() {
            let varies = match symbol {
                Symbol::Parameter(_) => false,
                Symbol::Ramp(x, _) => self.varies[x],
                Symbol::Plain(Operation::Variable(_)) => true,
                Symbol::Plain(operation) => operation.operands().any(|operand| self.varies[operand]),
            };
            self.varies.push(varies);
        }
        Ok(id)
    }

    pub(crate) fn plain(&mut self, operation: Operation, place: Location) -> Result<Id, Problem> {
        self.add(Symbol::Plain(operation), place)
    }

    /// Adds an expression; `names` defines the names, `j` is the index of the enclosing sum.
    pub(crate) fn expression(
        &mut self,
        entries: &[(Entry, Location)],
        names: &BTreeMap<&str, Id>,
        j: i32,
    ) -> Result<Id, Problem> {
        // the parser leaves as many operands as every operation takes
        let mut stack: Vec<Id> = Vec::new();
        let mut at = 0;
        while let Some((entry, place)) = entries.get(at) {
            let place = *place;
            at += 1;
            let id = match entry {
                Entry::Number(value) => self.plain(Operation::Constant(*value), place)?,
                Entry::Name(name) => names[&**name],
                Entry::SumIndex => self.plain(Operation::Constant(f64::from(j)), place)?,
                Entry::Neighbour(quantity, index) => self.neighbour(*quantity, *index, j, place)?,
                Entry::Unary(unary) => {
                    let [a] = pop(&mut stack);
                    self.plain(Operation::Unary(*unary, a), place)?
                }
                Entry::Binary(binary) => {
                    let [a, b] = pop(&mut stack);
                    self.plain(Operation::Binary(*binary, a, b), place)?
                }
                Entry::Ramp => {
                    let [x, width] = pop(&mut stack);
                    if self.varies[width] {
                        let valid = "a width made of numbers and parameters, 0 or larger";
                        return Err(Problem::new(place, "a ramp whose width depends on s, v or x", valid));
                    }
                    self.add(Symbol::Ramp(x, width), place)?
                }
                Entry::Sum { from, to, length } => {
                    let body = &entries[at..at + length];
                    at += length;
                    let mut sum = self.expression(body, names, *from)?;
                    for j in from + 1..=*to {
                        let term = self.expression(body, names, j)?;
                        sum = self.plain(Operation::Binary(Binary::Add, sum, term), place)?;
                    }
                    sum
                }
            };
            stack.push(id);
        }
        let [value] = pop(&mut stack);
        Ok(value)
    }

    fn neighbour(&mut self, quantity: Quantity, index: Index, j: i32, place: Location) -> Result<Id, Problem> {
        let Index { factor, offset } = index;
        let n = factor * j + offset;
        if n.abs() > FARTHEST {
            let found = format!("a neighbour {n} places away at j = {j}");
            return Err(Problem::new(place, found, format!("-{FARTHEST} to {FARTHEST}")));
        }
        match quantity {
            Quantity::Spacing => self.plain(Operation::Variable(Variable::Spacing(n)), place),
            Quantity::Speed => self.plain(Operation::Variable(Variable::Speed(n)), place),
            Quantity::Distance if n == 0 => self.plain(Operation::Constant(0.0), place),
            Quantity::Distance => {
                let sum = self.distance(n, place)?;
                if n > 0 { Ok(sum) } else { self.plain(Operation::Unary(Unary::Neg, sum), place) }
            }
        }
    }

    /// The distance to pedestrian n + m, m != 0: spacings added from the nearest to the farthest.
    fn distance(&mut self, m: i32, place: Location) -> Result<Id, Problem> {
        let (side, count) = if m > 0 { (0, m) } else { (1, -m) };
        for step in self.distances[side].len() as i32..count {
            let spacing = Variable::Spacing(if m > 0 { step } else { -1 - step });
            let spacing = self.plain(Operation::Variable(spacing), place)?;
            let sum = match self.distances[side].last() {
                None => spacing,
                Some(nearer) => self.plain(Operation::Binary(Binary::Add, *nearer, spacing), place)?,
            };
            self.distances[side].push(sum);
        }
        Ok(self.distances[side][count as usize - 1])
    }
}

/// The last values of a stack.
fn pop<const N: usize>(stack: &mut Vec<Id>) -> [Id; N] {
    let rest = stack.len() - N;
    let values = std::array::from_fn(|i| stack[rest + i]);
    stack.truncate(rest);
    values
}
