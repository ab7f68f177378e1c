//! A second evaluation of laws that a scene gives as formulas.
//!
//! What is shared with the first: the reader of formulas and the graph that it gives, with numbers for the parameters
//! and folded (`crates/formula`). Of how an operation is carried out nothing is: each is written anew here, for the
//! numbers of [`crate::number`].

use crate::number::Number;
use formula::{Binary, Bound, Id, Operation, Unary, Variable};
use std::sync::Arc;

/// The formulas of a law, with numbers for their parameters.
#[derive(Clone, Debug)]
pub struct Graph {
    bound: Arc<Bound>,
    contact: f64,
    scale: f64,
    is_singular: bool,
}

impl PartialEq for Graph {
    fn eq(&self, other: &Graph) -> bool {
        Arc::ptr_eq(&self.bound, &other.bound)
    }
}

impl Graph {
    /// The law of these formulas; two touch at the spacing `contact`, and speeds are of the size of `scale`.
    pub fn new(bound: Bound, contact: f64, scale: f64) -> Graph {
        let mut graph = Graph { bound: Arc::new(bound), contact, scale, is_singular: false };
        let at_contact = graph.acceleration(|_| graph.contact, |_| 0.0, &mut crate::formula::smooth_ramp::<f64>);
        graph.is_singular = !at_contact.is_finite();
        graph
    }

    /// `dv/dt` of a pedestrian, from the spacing and speed of the pedestrian a given number of places ahead.
    pub fn acceleration<T: Number>(
        &self,
        spacing: impl Fn(i32) -> T,
        speed: impl Fn(i32) -> T,
        ramp: &mut impl FnMut(T, f64) -> T,
    ) -> T {
        self.carry_out(self.bound.acceleration(), &spacing, &speed, ramp)
    }

    /// What an overlap uses up: the effective gap of the scene, else the net gap.
    pub fn room<T: Number>(&self, spacing: impl Fn(i32) -> T, speed: impl Fn(i32) -> T) -> T {
        match self.bound.gap() {
            Some(gap) => self.carry_out(gap, &spacing, &speed, &mut crate::formula::smooth_ramp::<T>),
            None => spacing(0) - T::from(self.contact),
        }
    }

    /// How far it looks behind and ahead.
    pub fn reach(&self) -> [i32; 2] {
        self.bound.variables().fold([0, 0], |[behind, ahead], (_, variable)| match variable {
            Variable::Spacing(j) | Variable::Speed(j) => [behind.max(-j), ahead.max(j)],
            Variable::Free(_) => [behind, ahead],
        })
    }

    /// The spacing at which two touch.
    pub fn contact(&self) -> f64 {
        self.contact
    }

    /// The size of speeds.
    pub fn scale(&self) -> f64 {
        self.scale
    }

    /// Whether the force is infinite where standing pedestrians touch.
    pub fn is_singular(&self) -> bool {
        self.is_singular
    }

    fn carry_out<T: Number>(
        &self,
        root: Id,
        spacing: &impl Fn(i32) -> T,
        speed: &impl Fn(i32) -> T,
        ramp: &mut impl FnMut(T, f64) -> T,
    ) -> T {
        let mut values: Vec<T> = Vec::with_capacity(root + 1);
        for operation in &self.bound.nodes()[..=root] {
            values.push(match *operation {
                Operation::Constant(value) => T::from(value),
                Operation::Variable(Variable::Spacing(j)) => spacing(j),
                Operation::Variable(Variable::Speed(j)) => speed(j),
                Operation::Variable(Variable::Free(_)) => T::from(f64::NAN),
                // a ramp of width 1, whose kink is to be seen
                Operation::Unary(Unary::Softplus, a) => ramp(-values[a], 1.0),
                Operation::Unary(unary, a) => one(unary, values[a]),
                Operation::Binary(binary, a, b) => two(binary, values[a], values[b]),
                Operation::Power(a, n) => values[a].whole_power(n),
            });
        }
        values[root]
    }
}

fn one<T: Number>(unary: Unary, x: T) -> T {
    match unary {
        Unary::Neg => -x,
        Unary::Exp => x.exp(),
        Unary::ExpM1 => x.exp_m1(),
        Unary::Ln => x.ln(),
        Unary::Ln1p => x.ln_1p(),
        Unary::Sqrt => x.root(),
        Unary::Tanh => x.tanh(),
        Unary::Softplus => x.softplus(),
        Unary::Abs => x.size(),
    }
}

fn two<T: Number>(binary: Binary, x: T, y: T) -> T {
    match binary {
        Binary::Add => x + y,
        Binary::Sub => x - y,
        Binary::Mul => x * y,
        Binary::Div => x / y,
        Binary::Pow => (y * x.ln()).exp(),
        Binary::Min => x.smaller(y),
        Binary::Max => x.larger(y),
    }
}
