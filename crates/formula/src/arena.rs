//! A list of nodes in which equal nodes are stored once.

use crate::operation::{Binary, Id, Operation, Unary, Variable};
use crate::place::Location;
use std::collections::BTreeMap;

/// What makes two nodes equal: the operation and its operands, constants by their bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Key {
    Parameter(usize),
    Ramp(Id, Id),
    Constant(u64),
    Variable(Variable),
    Unary(Unary, Id),
    Binary(Binary, Id, Id),
    Power(Id, i32),
}

/// A node that can be compared with others.
pub(crate) trait Node {
    fn key(&self) -> Key;
}

impl Node for Operation {
    fn key(&self) -> Key {
        match *self {
            Operation::Constant(value) => Key::Constant(value.to_bits()),
            Operation::Variable(variable) => Key::Variable(variable),
            Operation::Unary(unary, a) => Key::Unary(unary, a),
            Operation::Binary(binary, a, b) => Key::Binary(binary, a, b),
            Operation::Power(a, n) => Key::Power(a, n),
        }
    }
}

/// Nodes, each with the place of its first occurrence in the file.
#[derive(Clone, Debug)]
pub(crate) struct Arena<N> {
    pub(crate) nodes: Vec<(N, Location)>,
    found: BTreeMap<Key, Id>,
}

impl<N> Default for Arena<N> {
    fn default() -> Arena<N> {
        Arena { nodes: Vec::new(), found: BTreeMap::new() }
    }
}

impl<N: Node> Arena<N> {
    /// The index of a node, which is added if no equal node exists.
    pub(crate) fn add(&mut self, node: N, place: Location) -> Id {
        let nodes = &mut self.nodes;
        *self.found.entry(node.key()).or_insert_with(|| {
            nodes.push((node, place));
            nodes.len() - 1
        })
    }
}
