//! Records a formula that is a Rust function as a list of operations.

use crate::Bound;
use crate::arena::Arena;
use crate::operation::{Binary, Id, Operation, Unary, Variable};
use crate::place::Location;
use math::number::Number;
use std::cell::RefCell;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Records the operations on the [`Term`]s that it creates.
///
/// ```
/// use formula::{Variable, Writer};
/// use math::number::Number;
///
/// let writer = Writer::default();
/// let (s, v) = (writer.variable(Variable::Spacing(0)), writer.variable(Variable::Speed(0)));
/// let bound = writer.finish((s - 2.0).tanh() - v);
/// let value = bound.eval(bound.acceleration(), |variable| if variable == Variable::Speed(0) { 0.5 } else { 2.0 })?;
/// assert_eq!(value, -0.5);
/// # Ok::<(), formula::Error>(())
/// ```
#[derive(Debug, Default)]
pub struct Writer(RefCell<Arena<Operation>>);

/// A number that records how it is computed.
#[derive(Clone, Copy, Debug)]
pub struct Term<'w> {
    writer: &'w Writer,
    id: Id,
}

impl Writer {
    /// A variable of the formula.
    pub fn variable(&self, variable: Variable) -> Term<'_> {
        self.add(Operation::Variable(variable))
    }

    /// The operations that lead to a term, whose value is the acceleration.
    pub fn finish(&self, acceleration: Term<'_>) -> Bound {
        let nodes: Vec<Operation> = self.0.borrow().nodes.iter().map(|(operation, _)| *operation).collect();
        let places = vec![Location::default(); nodes.len()];
        Bound { file: String::new(), nodes, places, roots: vec![acceleration.id] }
    }

    fn add(&self, operation: Operation) -> Term<'_> {
        Term { writer: self, id: self.0.borrow_mut().add(operation, Location::default()) }
    }
}

impl<'w> Term<'w> {
    fn constant(self, value: f64) -> Term<'w> {
        self.writer.add(Operation::Constant(value))
    }

    fn unary(self, unary: Unary) -> Term<'w> {
        self.writer.add(Operation::Unary(unary, self.id))
    }

    fn binary(self, binary: Binary, other: Term<'w>) -> Term<'w> {
        self.writer.add(Operation::Binary(binary, self.id, other.id))
    }
}

impl Neg for Term<'_> {
    type Output = Self;
    fn neg(self) -> Self {
        self.unary(Unary::Neg)
    }
}

/// An operation on two terms, and on a term and a constant.
macro_rules! operator {
    ($($name:ident $method:ident;)*) => {
        $(impl $name for Term<'_> {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                self.binary(Binary::$name, other)
            }
        }

        impl $name<f64> for Term<'_> {
            type Output = Self;
            fn $method(self, other: f64) -> Self {
                self.binary(Binary::$name, self.constant(other))
            }
        })*
    };
}

operator! {
    Add add;
    Sub sub;
    Mul mul;
    Div div;
}

/// Functions of one number.
macro_rules! functions {
    ($($method:ident $name:ident;)*) => {
        $(fn $method(self) -> Self {
            self.unary(Unary::$name)
        })*
    };
}

impl Number for Term<'_> {
    functions! {
        exp Exp;
        exp_m1 ExpM1;
        ln Ln;
        ln_1p Ln1p;
        sqrt Sqrt;
        tanh Tanh;
        softplus Softplus;
        abs Abs;
    }

    fn recip(self) -> Self {
        self.powi(-1)
    }

    fn powi(self, n: i32) -> Self {
        match n {
            0 => self.constant(1.0),
            1 => self,
            _ => self.writer.add(Operation::Power(self.id, n)),
        }
    }

    fn powf(self, q: f64) -> Self {
        self.binary(Binary::Pow, self.constant(q))
    }

    fn min(self, other: Self) -> Self {
        self.binary(Binary::Min, other)
    }

    fn max(self, other: Self) -> Self {
        self.binary(Binary::Max, other)
    }
}
