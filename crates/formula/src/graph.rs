//! A law's formulas as a graph whose parameters are still symbols.

use crate::Bound;
use crate::arena::{Arena, Key, Node};
use crate::fold;
use crate::operation::{Id, Operation, Variable};
use crate::place::{Error, Location, Problem};

/// A node before parameters have values.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Symbol {
    /// A parameter, by its place in the list.
    Parameter(usize),
    /// `ramp(x, eps)`, whose form depends on the value of `eps`.
    Ramp(Id, Id),
    /// An operation; powers are still [`Binary::Pow`](crate::Binary::Pow).
    Plain(Operation),
}

impl Node for Symbol {
    fn key(&self) -> Key {
        match *self {
            Symbol::Parameter(index) => Key::Parameter(index),
            Symbol::Ramp(x, width) => Key::Ramp(x, width),
            Symbol::Plain(operation) => operation.key(),
        }
    }
}

/// A number of a law with a name.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Its name.
    pub name: String,
    /// The position of its value.
    pub place: Location,
    /// The value in the file.
    pub value: f64,
}

/// Which neighbours a formula looks at: pedestrian n + j for every j listed, ascending.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Stencil {
    /// The j of `s[j]`.
    pub spacings: Vec<i32>,
    /// The j of `v[j]`.
    pub speeds: Vec<i32>,
}

impl Stencil {
    pub(crate) fn of(variables: impl Iterator<Item = Variable>) -> Stencil {
        let mut stencil = Stencil::default();
        for variable in variables {
            match variable {
                Variable::Spacing(j) => stencil.spacings.push(j),
                Variable::Speed(j) => stencil.speeds.push(j),
                Variable::Free(_) => {}
            }
        }
        for list in [&mut stencil.spacings, &mut stencil.speeds] {
            list.sort_unstable();
            list.dedup();
        }
        stencil
    }
}

/// The formulas of a law, with common parts shared and parameters as symbols.
///
/// [`law`](crate::law) makes one; [`bind`](Graph::bind) gives the parameters values.
#[derive(Clone, Debug)]
pub struct Graph {
    pub(crate) file: String,
    pub(crate) arena: Arena<Symbol>,
    pub(crate) parameters: Vec<Parameter>,
    /// The acceleration and, if there is one, the gap.
    pub(crate) roots: Vec<Id>,
}

impl Graph {
    /// The parameters in the order of the file, `body` and `scale` among them.
    pub fn parameters(&self) -> &[Parameter] {
        &self.parameters
    }

    /// The place of a parameter in the list.
    pub fn parameter(&self, name: &str) -> Option<usize> {
        self.parameters.iter().position(|parameter| parameter.name == name)
    }

    /// The values of the file, in the order of [`parameters`](Graph::parameters).
    pub fn values(&self) -> Vec<f64> {
        self.parameters.iter().map(|parameter| parameter.value).collect()
    }

    /// How many operations, variables and constants it holds.
    pub fn size(&self) -> usize {
        self.arena.nodes.len()
    }

    /// All neighbours that acceleration and gap name, also in terms that some values of parameters remove.
    pub fn stencil(&self) -> Stencil {
        Stencil::of(self.arena.nodes.iter().filter_map(|(node, _)| match node {
            Symbol::Plain(Operation::Variable(variable)) => Some(*variable),
            _ => None,
        }))
    }

    /// Gives the parameters values, in the order of [`parameters`](Graph::parameters), and folds:
    ///
    /// - What has no variable is computed once.
    /// - A product with a factor 0 that is a literal or a parameter is 0, and gone from the sum that it is a term of;
    ///   so is a quotient whose numerator is such. A factor or divisor 1 of that kind is gone.
    /// - An exponent without variables whose value is whole and at most 16 in size becomes repeated multiplication.
    /// - `ramp(x, eps)` becomes `eps * softplus(x * (-1 / eps))`, and for `eps = 0` `max(0, -x)`.
    ///
    /// Nothing else is changed and nothing re-associated.
    ///
    /// # Errors
    /// A part without variables that has no finite value, a value that is not finite, or a negative width of a ramp,
    /// with its place in the file.
    ///
    /// # Panics
    /// `values` has another length than the list of parameters.
    pub fn bind(&self, values: &[f64]) -> Result<Bound, Error> {
        assert_eq!(values.len(), self.parameters.len(), "one value for each parameter");
        let mut pairs = self.parameters.iter().zip(values);
        if let Some((parameter, value)) = pairs.find(|(_, value)| !value.is_finite()) {
            let problem = Problem::new(parameter.place, format!("{} = {value}", parameter.name), "a finite number");
            return Err(problem.within(&self.file));
        }
        fold::bind(self, values).map_err(|problem| problem.within(&self.file))
    }
}
