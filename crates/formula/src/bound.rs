//! Formulas whose parameters are numbers, ready for evaluation.

use crate::graph::Stencil;
use crate::operation::{Id, Operation, Variable};
use crate::place::{Error, Location};

/// A place where a slope jumps: where two nodes are equal, or one is 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Kink {
    /// The node with the kink: `abs`, `min` or `max`; a sharp ramp is `max(0, -x)`.
    pub node: Id,
    /// One side.
    pub left: Id,
    /// The other side; 0 where there is none.
    pub right: Option<Id>,
}

/// The formulas of a law, or one expression, as a list of operations: operands come first, equal operations are one,
/// and every operation is needed by a root.
#[derive(Clone, Debug)]
pub struct Bound {
    pub(crate) file: String,
    pub(crate) nodes: Vec<Operation>,
    pub(crate) places: Vec<Location>,
    pub(crate) roots: Vec<Id>,
}

impl Bound {
    /// The operations in the order in which they are carried out.
    pub fn nodes(&self) -> &[Operation] {
        &self.nodes
    }

    /// The results: of a law the acceleration, then the gap if there is one.
    pub fn roots(&self) -> &[Id] {
        &self.roots
    }

    /// The node of the acceleration.
    pub fn acceleration(&self) -> Id {
        self.roots[0]
    }

    /// The node of the gap, if the law has one.
    pub fn gap(&self) -> Option<Id> {
        self.roots.get(1).copied()
    }

    /// The position of a node in the file.
    pub fn place(&self, node: Id) -> Location {
        self.places[node]
    }

    /// Which nodes a root needs, itself included.
    pub fn needed(&self, root: Id) -> Vec<bool> {
        let mut needed = vec![false; self.nodes.len()];
        needed[root] = true;
        for node in (0..=root).rev().filter(|node| self.nodes[*node].operands().next().is_some()) {
            if needed[node] {
                self.nodes[node].operands().for_each(|operand| needed[operand] = true);
            }
        }
        needed
    }

    /// The neighbours that a root depends on.
    pub fn stencil(&self, root: Id) -> Stencil {
        let needed = self.needed(root);
        Stencil::of(self.nodes.iter().zip(needed).filter_map(|(node, needed)| match node {
            Operation::Variable(variable) if needed => Some(*variable),
            _ => None,
        }))
    }

    /// Where a root has kinks, in the order of nodes.
    pub fn kinks(&self, root: Id) -> Vec<Kink> {
        use crate::operation::{Binary, Unary};
        let needed = self.needed(root);
        let kink = |(node, operation): (Id, &Operation)| match *operation {
            _ if !needed[node] => None,
            Operation::Unary(Unary::Abs, a) => Some(Kink { node, left: a, right: None }),
            Operation::Binary(Binary::Min | Binary::Max, a, b) => Some(Kink { node, left: a, right: Some(b) }),
            _ => None,
        };
        self.nodes.iter().enumerate().filter_map(kink).collect()
    }

    /// The message that a node has no value for these operands.
    pub fn undefined(&self, node: Id, operands: &[f64]) -> Error {
        let operation = &self.nodes[node];
        let (found, valid) = crate::eval::complaint(operation, operands);
        Error { file: self.file.clone(), place: self.places[node], found, valid: valid.to_owned() }
    }

    /// The variables and the nodes that hold them, in the order of nodes.
    pub fn variables(&self) -> impl Iterator<Item = (Id, Variable)> + '_ {
        self.nodes.iter().enumerate().filter_map(|(id, node)| match node {
            Operation::Variable(variable) => Some((id, *variable)),
            _ => None,
        })
    }
}
