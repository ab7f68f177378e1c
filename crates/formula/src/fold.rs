//! Parameters become numbers, and what has no variable is computed.

use crate::Bound;
use crate::arena::Arena;
use crate::eval::{self, Value};
use crate::graph::{Graph, Symbol};
use crate::limits::LARGEST_POWER;
use crate::operation::{Binary, Id, Operation, Unary};
use crate::place::{Place, Problem};

/// What became of a node.
#[derive(Clone, Copy, Debug)]
enum Folded {
    /// A number, from an operation.
    Number(f64),
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
            Folded::Number(value) | Folded::Plain(value) => Some(value),
            Folded::Gone => Some(0.0),
            Folded::Node(_) => None,
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
    let mut folder = Folder { arena: Arena::default(), place: Place::default() };
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
    finished(graph, folder.arena, &roots)
}

/// The nodes that the roots need.
fn finished(graph: &Graph, arena: Arena<Operation>, roots: &[Id]) -> Result<Bound, Problem> {
    let mut needed = vec![false; arena.nodes.len()];
    roots.iter().for_each(|root| needed[*root] = true);
    for (id, (node, _)) in arena.nodes.iter().enumerate().rev() {
        if needed[id] {
            node.operands().for_each(|operand| needed[operand] = true);
        }
    }
    let mut bound = Bound { file: graph.file.clone(), nodes: Vec::new(), places: Vec::new(), roots: Vec::new() };
    let mut moved: Vec<Id> = Vec::with_capacity(needed.len());
    for ((node, place), needed) in arena.nodes.iter().zip(needed) {
        moved.push(bound.nodes.len());
        if !needed {
            continue;
        }
        bound.places.push(*place);
        bound.nodes.push(match *node {
            Operation::Constant(value) if !value.is_finite() => {
                let found = format!("an expression without s, v and x whose value is {value}");
                return Err(Problem::new(*place, found, "parameters for which it is finite"));
            }
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
    place: Place,
}

impl Folder {
    fn node(&mut self, operation: Operation) -> Folded {
        Folded::Node(self.arena.add(operation, self.place))
    }

    /// The node that stands for an operand.
    fn operand(&mut self, folded: Folded) -> Id {
        match folded {
            Folded::Node(id) => id,
            Folded::Number(value) | Folded::Plain(value) => self.arena.add(Operation::Constant(value), self.place),
            Folded::Gone => self.arena.add(Operation::Constant(0.0), self.place),
        }
    }

    fn unary(&mut self, unary: Unary, a: Folded) -> Folded {
        match (unary, a, a.number()) {
            (Unary::Neg, Folded::Gone, _) => Folded::Gone,
            (_, _, Some(value)) => Folded::Number(eval::apply(unary, &Value::<f64>::Constant(value)).nearest()),
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
        if let (Some(a), Some(b)) = (a.number(), b.number()) {
            if let (Binary::Pow, Some(n)) = (binary, whole(b)) {
                return self.power(Folded::Number(a), n);
            }
            let value = eval::combine(binary, &Value::<f64>::Constant(a), &Value::Constant(b));
            return Folded::Number(value.nearest());
        }
        if let (Binary::Pow, Some(n)) = (binary, b.number().and_then(whole)) {
            return self.power(a, n);
        }
        let (a, b) = (self.operand(a), self.operand(b));
        self.node(Operation::Binary(binary, a, b))
    }

    fn power(&mut self, a: Folded, n: i32) -> Folded {
        match (a.number(), n) {
            (_, 0) => Folded::Number(1.0),
            (_, 1) => a,
            (Some(value), _) => Folded::Number(eval::power(&Value::<f64>::Constant(value), n).nearest()),
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
            return Ok(self.binary(Binary::Max, Folded::Number(0.0), fallen));
        }
        let slope = -1.0 / width;
        if !(width > 0.0 && width.is_finite() && slope.is_finite()) {
            return Err(Problem::new(self.place, format!("a ramp of width {width}"), "0 (sharp) or 1e-300 and larger"));
        }
        let argument = self.binary(Binary::Mul, x, Folded::Number(slope));
        let softplus = self.unary(Unary::Softplus, argument);
        Ok(self.binary(Binary::Mul, Folded::Number(width), softplus))
    }
}

/// The whole number that a small exponent is.
fn whole(exponent: f64) -> Option<i32> {
    let is_whole = exponent.trunc() == exponent && exponent.abs() <= f64::from(LARGEST_POWER);
    is_whole.then_some(exponent as i32)
}
