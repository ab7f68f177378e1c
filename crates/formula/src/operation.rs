//! The operations of the language.

/// The place of a node in its graph; operands come before what uses them.
pub type Id = usize;

/// What a formula depends on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Variable {
    /// `s[j]`: the spacing of pedestrian n + j to the predecessor, `x_{n+j+1} - x_{n+j}`.
    Spacing(i32),
    /// `v[j]`: the speed of pedestrian n + j.
    Speed(i32),
    /// A free name, by its place in [`Expression::names`](crate::Expression::names).
    Free(usize),
}

/// Operations on one number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Unary {
    /// `-x`
    Neg,
    /// `e^x`
    Exp,
    /// `e^x - 1`
    ExpM1,
    /// The natural logarithm, of x > 0.
    Ln,
    /// `ln(1 + x)`, x > -1.
    Ln1p,
    /// The square root, of x >= 0.
    Sqrt,
    /// The hyperbolic tangent.
    Tanh,
    /// `ln(1 + e^x)`
    Softplus,
    /// The absolute value: `-x` for x < 0, else `x`. A kink at 0.
    Abs,
}

impl Unary {
    /// The name in formulas; `-` for the sign.
    pub fn name(self) -> &'static str {
        match self {
            Unary::Neg => "-",
            _ => crate::names::UNARY.iter().find(|(_, unary)| *unary == self).map_or("", |(name, _)| name),
        }
    }
}

/// Operations on two numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Binary {
    /// `a + b`
    Add,
    /// `a - b`
    Sub,
    /// `a * b`
    Mul,
    /// `a / b`
    Div,
    /// `a^b` for a > 0: `exp(b * ln(a))`. Small whole exponents are [`Operation::Power`].
    Pow,
    /// The smaller one, the first in a tie; NaN if either is. A kink where both are equal.
    Min,
    /// The larger one, the first in a tie; NaN if either is. A kink where both are equal.
    Max,
}

impl Binary {
    /// The sign or the name in formulas.
    pub fn name(self) -> &'static str {
        match self {
            Binary::Add => "+",
            Binary::Sub => "-",
            Binary::Mul => "*",
            Binary::Div => "/",
            Binary::Pow => "^",
            Binary::Min => "min",
            Binary::Max => "max",
        }
    }
}

/// A node of a [`Bound`](crate::Bound) graph.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Operation {
    /// A finite number.
    Constant(f64),
    /// What the formula depends on.
    Variable(Variable),
    /// An operation on one number, which is not a constant.
    Unary(Unary, Id),
    /// An operation on two numbers, of which at most one is a constant.
    Binary(Binary, Id, Id),
    /// A whole power n with 2 <= |n| <= 16 or n = -1: `((x x) x) ...` from the left, and 1 divided by that where n < 0.
    Power(Id, i32),
}

impl Operation {
    /// The operands, first to last.
    pub fn operands(&self) -> impl Iterator<Item = Id> + use<> {
        let (first, second) = match *self {
            Operation::Constant(_) | Operation::Variable(_) => (None, None),
            Operation::Unary(_, a) | Operation::Power(a, _) => (Some(a), None),
            Operation::Binary(_, a, b) => (Some(a), Some(b)),
        };
        first.into_iter().chain(second)
    }

    /// The name of the operation in formulas.
    pub fn name(&self) -> &'static str {
        match *self {
            Operation::Constant(_) => "constant",
            Operation::Variable(_) => "variable",
            Operation::Unary(unary, _) => unary.name(),
            Operation::Binary(binary, ..) => binary.name(),
            Operation::Power(..) => "^",
        }
    }
}
