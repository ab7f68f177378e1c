//! Evaluates the list of operations in order, for any kind of number.

use crate::Bound;
use crate::operation::{Binary, Id, Operation, Unary, Variable};
use crate::place::Error;
use math::number::Number;

impl Bound {
    /// The value of a root in doubles: the operations it needs are evaluated in the order of the list.
    ///
    /// Infinite values on the way are allowed, as long as the result is finite.
    ///
    /// # Errors
    /// The result is not finite: the responsible operation, its operands, and its position.
    pub fn eval(&self, root: Id, variable: impl FnMut(Variable) -> f64) -> Result<f64, Error> {
        let values = self.values(root, |constant| constant, variable);
        let value = values[root];
        if value.is_finite() { Ok(value) } else { Err(self.culprit(root, &values)) }
    }

    /// The value of a root in numbers of any kind, of which `constant` makes those that depend on nothing.
    pub fn carry_out<T: Number>(
        &self,
        root: Id,
        constant: impl Fn(f64) -> T,
        variable: impl FnMut(Variable) -> T,
    ) -> T {
        self.values(root, constant, variable)[root]
    }

    /// The values of all nodes up to a root; 0 for those that it does not need.
    fn values<T: Number>(
        &self,
        root: Id,
        constant: impl Fn(f64) -> T,
        mut variable: impl FnMut(Variable) -> T,
    ) -> Vec<T> {
        let needed = self.needed(root);
        let mut values: Vec<T> = Vec::with_capacity(root + 1);
        for (id, node) in self.nodes[..=root].iter().enumerate() {
            let value = match *node {
                _ if !needed[id] => constant(0.0),
                Operation::Constant(value) => constant(value),
                Operation::Variable(name) => variable(name),
                Operation::Unary(unary, a) => apply(unary, values[a]),
                Operation::Power(a, n) => values[a].powi(n),
                Operation::Binary(binary, a, b) => match (binary, self.nodes[a], self.nodes[b]) {
                    // where a constant can stand as it is, it costs less
                    (Binary::Add, Operation::Constant(c), _) => values[b] + c,
                    (Binary::Add, _, Operation::Constant(c)) => values[a] + c,
                    (Binary::Sub, _, Operation::Constant(c)) => values[a] - c,
                    (Binary::Mul, Operation::Constant(c), _) => values[b] * c,
                    (Binary::Mul, _, Operation::Constant(c)) => values[a] * c,
                    (Binary::Div, _, Operation::Constant(c)) => values[a] / c,
                    (Binary::Pow, _, Operation::Constant(c)) => values[a].powf(c),
                    _ => combine(binary, values[a], values[b]),
                },
            };
            values.push(value);
        }
        values
    }

    /// The message about the operation that left a root without a finite value, from the values of all nodes.
    pub fn culprit(&self, root: Id, values: &[f64]) -> Error {
        let mut node = root;
        loop {
            let operands: Vec<Id> = self.nodes[node].operands().collect();
            let is_bad = |test: fn(&f64) -> bool| operands.iter().copied().find(|operand| test(&values[*operand]));
            match is_bad(|value| value.is_nan()).or_else(|| is_bad(|value| value.is_infinite())) {
                Some(operand) => node = operand,
                None => {
                    let operands: Vec<f64> = operands.iter().map(|operand| values[*operand]).collect();
                    return self.undefined(node, &operands);
                }
            }
        }
    }
}

/// An operation on one number.
pub(crate) fn apply<T: Number>(unary: Unary, a: T) -> T {
    match unary {
        Unary::Neg => -a,
        Unary::Exp => a.exp(),
        Unary::ExpM1 => a.exp_m1(),
        Unary::Ln => a.ln(),
        Unary::Ln1p => a.ln_1p(),
        Unary::Sqrt => a.sqrt(),
        Unary::Tanh => a.tanh(),
        Unary::Softplus => a.softplus(),
        Unary::Abs => a.abs(),
    }
}

/// An operation on two numbers.
pub(crate) fn combine<T: Number>(binary: Binary, a: T, b: T) -> T {
    match binary {
        Binary::Add => a + b,
        Binary::Sub => a - b,
        Binary::Mul => a * b,
        Binary::Div => a / b,
        // as math::lane::pow has it
        Binary::Pow => (b * a.ln()).exp(),
        Binary::Min => a.min(b),
        Binary::Max => a.max(b),
    }
}

/// What was found and what would be valid where an operation has no finite value.
pub(crate) fn complaint(operation: &Operation, operands: &[f64]) -> (String, &'static str) {
    let valid = match *operation {
        Operation::Unary(Unary::Ln, _) => "an argument > 0",
        Operation::Unary(Unary::Ln1p, _) => "an argument > -1",
        Operation::Unary(Unary::Sqrt, _) => "an argument >= 0",
        Operation::Unary(Unary::Exp | Unary::ExpM1, _) => "an argument up to 709",
        Operation::Binary(Binary::Div, ..) | Operation::Power(_, i32::MIN..=-1) => {
            "a divisor other than 0, a quotient up to 1.8e308"
        }
        Operation::Binary(Binary::Pow, ..) => "a base > 0; whole exponents up to 16 in size take any base",
        _ => "finite values",
    };
    let found = match (operation, operands) {
        (Operation::Variable(_), _) | (Operation::Constant(_), _) => "a value that is not finite".to_owned(),
        (Operation::Power(_, n), [a]) => format!("({a:?})^({n}), which has no finite value"),
        (_, [a]) => format!("{}({a:?}), which has no finite value", operation.name()),
        (Operation::Binary(Binary::Min | Binary::Max, ..), [a, b]) => {
            format!("{}({a:?}, {b:?}), which has no finite value", operation.name())
        }
        (_, [a, b]) => format!("({a:?}) {} ({b:?}), which has no finite value", operation.name()),
        _ => format!("`{}`, which has no finite value", operation.name()),
    };
    (found, valid)
}
