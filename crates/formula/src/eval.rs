//! Evaluation by numbers of any kind.

use crate::operation::{Binary, Id, Operation, Unary, Variable};
use crate::place::Error;
use crate::{Bound, Number};

/// The value of a node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value<T> {
    /// It depends on no variable.
    Constant(f64),
    /// It depends on one.
    Number(T),
}

impl<T: Number> Value<T> {
    /// The nearest double.
    pub fn nearest(&self) -> f64 {
        match self {
            Value::Constant(value) => *value,
            Value::Number(number) => number.nearest(),
        }
    }

    /// The number; `constant` makes one of a double.
    pub fn number(self, constant: impl FnOnce(f64) -> T) -> T {
        match self {
            Value::Constant(value) => constant(value),
            Value::Number(number) => number,
        }
    }
}

impl Bound {
    /// The value of a root, by carrying out what it needs in the order of the list.
    ///
    /// Infinite values on the way are allowed, as long as the result is finite.
    ///
    /// # Errors
    /// The result is not finite: the operation that is to blame, its operands, and where it stands.
    pub fn eval<T: Number>(&self, root: Id, mut variable: impl FnMut(Variable) -> T) -> Result<Value<T>, Error> {
        let needed = self.needed(root);
        let mut values: Vec<Value<T>> = Vec::with_capacity(root + 1);
        for (id, node) in self.nodes[..=root].iter().enumerate() {
            let value = match node {
                _ if !needed[id] => Value::Constant(0.0),
                Operation::Constant(value) => Value::Constant(*value),
                Operation::Variable(name) => Value::Number(variable(*name)),
                Operation::Unary(unary, a) => apply(*unary, &values[*a]),
                Operation::Binary(binary, a, b) => combine(*binary, &values[*a], &values[*b]),
                Operation::Power(a, n) => power(&values[*a], *n),
            };
            values.push(value);
        }
        match values.pop() {
            Some(value) if value.nearest().is_finite() => Ok(value),
            last => {
                values.extend(last);
                let doubles: Vec<f64> = values.iter().map(Value::nearest).collect();
                Err(self.culprit(root, &doubles))
            }
        }
    }

    /// The message about the operation that made a root without a value what it is, from the values of all nodes.
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

/// An operation on one value.
pub(crate) fn apply<T: Number>(unary: Unary, a: &Value<T>) -> Value<T> {
    match a {
        Value::Constant(a) => Value::Constant(function(unary, a)),
        Value::Number(a) => Value::Number(function(unary, a)),
    }
}

fn function<T: Number>(unary: Unary, a: &T) -> T {
    match unary {
        Unary::Neg => a.neg(),
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

/// A whole power.
pub(crate) fn power<T: Number>(a: &Value<T>, n: i32) -> Value<T> {
    match a {
        Value::Constant(a) => Value::Constant(Number::power(a, n)),
        Value::Number(a) => Value::Number(a.power(n)),
    }
}

/// An operation on two values.
pub(crate) fn combine<T: Number>(binary: Binary, a: &Value<T>, b: &Value<T>) -> Value<T> {
    match (a, b) {
        (Value::Constant(a), Value::Constant(b)) => Value::Constant(of_numbers(binary, a, b)),
        (Value::Number(a), Value::Number(b)) => Value::Number(of_numbers(binary, a, b)),
        (Value::Number(a), Value::Constant(c)) => Value::Number(match binary {
            Binary::Add => a.add_constant(*c),
            Binary::Sub => a.sub_constant(*c),
            Binary::Mul => a.mul_constant(*c),
            Binary::Div => a.div_constant(*c),
            Binary::Pow => a.pow_constant(*c),
            Binary::Min => a.min(&a.constant(*c)),
            Binary::Max => a.max(&a.constant(*c)),
        }),
        (Value::Constant(c), Value::Number(b)) => Value::Number(match binary {
            Binary::Add => b.add_constant(*c),
            Binary::Sub => b.constant_sub(*c),
            Binary::Mul => b.mul_constant(*c),
            Binary::Div => b.constant_div(*c),
            Binary::Pow => b.constant_pow(*c),
            Binary::Min => b.constant(*c).min(b),
            Binary::Max => b.constant(*c).max(b),
        }),
    }
}

fn of_numbers<T: Number>(binary: Binary, a: &T, b: &T) -> T {
    match binary {
        Binary::Add => a.add(b),
        Binary::Sub => a.sub(b),
        Binary::Mul => a.mul(b),
        Binary::Div => a.div(b),
        Binary::Pow => a.pow(b),
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
