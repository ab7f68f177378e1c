//! The syntax tree, stored as a list in evaluation order, so that no code recurses over it, however long the text.

use crate::operation::{Binary, Unary};
use crate::place::Location;

/// Which quantity of a pedestrian.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Quantity {
    Spacing,
    Speed,
    Distance,
}

/// `factor j + offset`: which pedestrian.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Index {
    pub(crate) factor: i32,
    pub(crate) offset: i32,
}

/// One entry. Operations take their operands from the values of the entries before, the last ones first, as on a stack.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Entry {
    Number(f64),
    /// A named expression, a parameter or a free name.
    Name(Box<str>),
    /// The index of the sum around.
    SumIndex,
    Neighbour(Quantity, Index),
    Unary(Unary),
    Binary(Binary),
    Ramp,
    /// The given number of following entries, evaluated for every index from the first to the last and added in that
    /// order.
    Sum {
        from: i32,
        to: i32,
        length: usize,
    },
}

/// An expression.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tree {
    pub(crate) entries: Vec<(Entry, Location)>,
}

impl Tree {
    /// The names in it with their positions, in the order of the text.
    pub(crate) fn names(&self) -> impl Iterator<Item = (&str, Location)> {
        self.entries.iter().filter_map(|(entry, place)| match entry {
            Entry::Name(name) => Some((&**name, *place)),
            _ => None,
        })
    }
}
