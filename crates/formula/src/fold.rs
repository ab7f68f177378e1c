//! Constant folding: parameters become numbers, and parts without variables are evaluated.

use crate::Bound;
use crate::arena::Arena;
use crate::eval;
use crate::graph::{Graph, Symbol};
use crate::operation::{Binary, Id, Operation, Unary};
use crate::place::{Location, Problem};
use math::number::{Number, whole};
use std::collections::BTreeMap;

/// The result of folding a node.
#[derive(Clone, Copy, Debug)]
enum Folded {
    /// A number, from an operation; where it is not finite, which of [`Folder::problems`] is to blame.
    Number(f64, Option<usize>),
    /// A number that is a literal or a parameter: as a factor 0 or 1 it counts.
    Plain(f64),
    /// A product with a factor 0.
    Gone,
    /// Something with a variable.
    Node(Id),
}

impl Folded {
    fn number(self) -> Option<f64> {
        match self {
            Folded::Number(value, _) | Folded::Plain(value) => Some(value),
            Folded::Gone => Some(0.0),
            Folded::Node(_) => None,
        }
    }

    fn blame(self) -> Option<usize> {
        match self {
            Folded::Number(_, blame) => blame,
            _ => None,
        }
    }

    fn is_zero(self) -> bool {
        matches!(self, Folded::Gone) || matches!(self, Folded::Plain(value) if value == 0.0)
    }

    fn is_one(self) -> bool {
        matches!(self, Folded::Plain(1.0))
    }
}

/// Binds the parameters of a graph.
pub(crate) fn bind(graph: &Graph, values: &[f64]) -> Result<Bound, Problem> {
    let mut folder =
        Folder { arena: Arena::default(), place: Location::default(), problems: Vec::new(), blames: BTreeMap::new() };
    let mut folded: Vec<Folded> = Vec::with_capacity(graph.arena.nodes.len());
    for (symbol, place) in &graph.arena.nodes {
        folder.place = *place;
        let result = match *symbol {
            Symbol::Parameter(index) => Folded::Plain(values[index]),
            Symbol::Ramp(x, width) => folder.ramp(folded[x], folded[width])?,
            Symbol::Plain(Operation::Constant(value)) => Folded::Plain(value),
            Symbol::Plain(operation @ Operation::Variable(_)) => folder.node(operation),
            Symbol::Plain(Operation::Unary(unary, a)) => folder.unary(unary, folded[a]),
            Symbol::Plain(Operation::Binary(binary, a, b)) => folder.binary(binary, folded[a], folded[b]),
            Symbol::Plain(Operation::Power(a, n)) => folder.power(folded[a], n),
        };
        folded.push(result);
    }
    let roots: Vec<Id> = graph
        .roots
        .iter()
        .map(|root| {
            folder.place = graph.arena.nodes[*root].1;
            folder.operand(folded[*root])
        })
        .collect();
    finished(graph, &folder, &roots)
}

/// The nodes that the roots need.
fn finished(graph: &Graph, folder: &Folder, roots: &[Id]) -> Result<Bound, Problem> {
    let nodes = &folder.arena.nodes;
    let mut needed = vec![false; nodes.len()];
    roots.iter().for_each(|root| needed[*root] = true);
    for (id, (node, _)) in nodes.iter().enumerate().rev() {
        if needed[id] {
            node.operands().for_each(|operand| needed[operand] = true);
        }
    }
    let mut bound = Bound { file: graph.file.clone(), nodes: Vec::new(), places: Vec::new(), roots: Vec::new() };
    let mut moved: Vec<Id> = Vec::with_capacity(needed.len());
    for (id, ((node, place), needed)) in nodes.iter().zip(needed).enumerate() {
        moved.push(bound.nodes.len());
        if !needed {
            continue;
        }
        if let Some(blame) = folder.blames.get(&id) {
            return Err(folder.problems[*blame].clone());
        }
        bound.places.push(*place);
        bound.nodes.push(match *node {
            Operation::Constant(_) | Operation::Variable(_) => *node,
            Operation::Unary(unary, a) => Operation::Unary(unary, moved[a]),
            Operation::Binary(binary, a, b) => Operation::Binary(binary, moved[a], moved[b]),
            Operation::Power(a, n) => Operation::Power(moved[a], n),
        });
    }
    bound.roots = roots.iter().map(|root| moved[*root]).collect();
    Ok(bound)
}

/// Operations that are added to a graph unless they can be carried out.
struct Folder {
    arena: Arena<Operation>,
    /// Of the node at hand.
    place: Location,
    /// Operations without variables that have no finite value: no error as long as nothing needs them.
    problems: Vec<Problem>,
    /// Constants that are not finite, and the problem.
    blames: BTreeMap<Id, usize>,
}

impl Folder {
    fn node(&mut self, operation: Operation) -> Folded {
        Folded::Node(self.arena.add(operation, self.place))
    }

    /// The node that replaces an operand.
    fn operand(&mut self, folded: Folded) -> Id {
        match folded {
            Folded::Node(id) => id,
            Folded::Gone => self.arena.add(Operation::Constant(0.0), self.place),
            Folded::Plain(value) => self.arena.add(Operation::Constant(value), self.place),
            Folded::Number(value, blame) => {
                let id = self.arena.add(Operation::Constant(value), self.place);
                if let Some(blame) = blame {
                    self.blames.entry(id).or_insert(blame);
                }
                id
            }
        }
    }

    /// The value of an operation on numbers.
    fn computed(&mut self, operation: Operation, operands: &[Folded], value: f64) -> Folded {
        if value.is_finite() {
            return Folded::Number(value, None);
        }
        let inherited = operands.iter().find_map(|operand| operand.blame());
        let blame = inherited.unwrap_or_else(|| {
            let operands: Vec<f64> = operands.iter().filter_map(|operand| operand.number()).collect();
            let (found, valid) = eval::complaint(&operation, &operands);
            self.problems.push(Problem::new(self.place, found, valid));
            self.problems.len() - 1
        });
        Folded::Number(value, Some(blame))
    }

    fn unary(&mut self, unary: Unary, a: Folded) -> Folded {
        match (unary, a, a.number()) {
            (Unary::Neg, Folded::Gone, _) => Folded::Gone,
            (_, _, Some(value)) => {
                let value = eval::apply(unary, value);
                self.computed(Operation::Unary(unary, 0), &[a], value)
            }
            _ => {
                let a = self.operand(a);
                self.node(Operation::Unary(unary, a))
            }
        }
    }

    fn binary(&mut self, binary: Binary, a: Folded, b: Folded) -> Folded {
        match (binary, a, b) {
            (Binary::Mul, a, b) if a.is_zero() || b.is_zero() => return Folded::Gone,
            (Binary::Mul, a, b) if a.is_one() => return b,
            (Binary::Mul | Binary::Div, a, b) if b.is_one() => return a,
            // 0/0 has no value
            (Binary::Div, a, b) if a.is_zero() && b.number() != Some(0.0) => return Folded::Gone,
            (Binary::Add, Folded::Gone, other) => return other,
            (Binary::Add | Binary::Sub, other, Folded::Gone) => return other,
            _ => {}
        }
        if let (Binary::Pow, Some(n)) = (binary, b.number().and_then(whole)) {
            return self.power(a, n);
        }
        if let (Some(left), Some(right)) = (a.number(), b.number()) {
            let value = eval::combine(binary, left, right);
            return self.computed(Operation::Binary(binary, 0, 0), &[a, b], value);
        }
        let (a, b) = (self.operand(a), self.operand(b));
        self.node(Operation::Binary(binary, a, b))
    }

    fn power(&mut self, a: Folded, n: i32) -> Folded {
        match (a.number(), n) {
            (_, 0) => Folded::Number(1.0, None),
            (_, 1) => a,
            (Some(value), _) => {
                let value = Number::powi(value, n);
                self.computed(Operation::Power(0, n), &[a], value)
            }
            (None, _) => {
                let a = self.operand(a);
                self.node(Operation::Power(a, n))
            }
        }
    }

    fn ramp(&mut self, x: Folded, width: Folded) -> Result<Folded, Problem> {
        let width = width.number().unwrap_or(f64::NAN);
        if width == 0.0 {
            let fallen = self.unary(Unary::Neg, x);
            return Ok(self.binary(Binary::Max, Folded::Number(0.0, None), fallen));
        }
        let slope = -1.0 / width;
        if !(width > 0.0 && width.is_finite() && slope.is_finite()) {
            return Err(Problem::new(self.place, format!("a ramp of width {width}"), "0 (sharp) or 1e-300 and larger"));
        }
        let argument = self.binary(Binary::Mul, x, Folded::Number(slope, None));
        let softplus = self.unary(Unary::Softplus, argument);
        Ok(self.binary(Binary::Mul, Folded::Number(width, None), softplus))
    }
}
