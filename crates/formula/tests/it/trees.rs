//! Random formulas as trees, printed with as few brackets as possible and evaluated without the parser.

use crate::common::{Random, state};
use formula::Variable;
use math::lane;
use math::number::Number;

/// A formula.
#[derive(Clone, Debug)]
pub enum Tree {
    /// A text and what it stands for.
    Leaf(String, f64),
    Neg(Box<Tree>),
    /// One of `+ - * / ^`.
    Sign(char, Box<Tree>, Box<Tree>),
    /// A whole exponent, written as a number.
    Whole(Box<Tree>, i32),
    Call(&'static str, Vec<Tree>),
}

/// The parameters that a formula may use.
pub const PARAMETERS: [(&str, f64); 3] = [("p", 0.6), ("q2", -1.7), ("kappa", 3.25)];

const VARIABLES: [(&str, Variable); 6] = [
    ("s", Variable::Spacing(0)),
    ("v", Variable::Speed(0)),
    ("v[1]", Variable::Speed(1)),
    ("s[ -1]", Variable::Spacing(-1)),
    ("s[2 - 1]", Variable::Spacing(1)),
    ("x[1]", Variable::Spacing(0)),
];
const NUMBERS: [&str; 9] = ["2", "0.5", "3.", ".25", "1e-3", "7.5E+1", "2.718281828", "pi", "e"];
const ANY: [&str; 7] = ["tanh", "softplus", "abs", "exp_m1", "exp", "min", "max"];
const POSITIVE: [&str; 2] = ["ln", "sqrt"];

/// A formula of so many levels at most.
pub fn tree(random: &mut Random, levels: u32) -> Tree {
    if levels == 0 || random.below(8) == 0 {
        return leaf(random);
    }
    let part = |random: &mut Random| Box::new(tree(random, levels - 1));
    match random.below(20) {
        0..=11 => {
            let sign = random.pick(&['+', '+', '-', '-', '*', '*', '/']);
            Tree::Sign(sign, part(random), part(random))
        }
        12 => Tree::Neg(part(random)),
        13 => Tree::Whole(part(random), random.pick(&[-3, -2, -1, 2, 3, 5])),
        14 => Tree::Sign('^', Box::new(positive(*part(random))), Box::new(leaf(random))),
        15 => Tree::Call(random.pick(&POSITIVE), vec![positive(*part(random))]),
        16 => Tree::Call("ln_1p", vec![Tree::Call("abs", vec![*part(random)])]),
        _ => {
            let name = random.pick(&ANY);
            let count = if ["min", "max"].contains(&name) { 2 + random.below(2) } else { 1 };
            Tree::Call(name, (0..count).map(|_| *part(random)).collect())
        }
    }
}

/// |a| + 0.5.
fn positive(a: Tree) -> Tree {
    Tree::Sign('+', Box::new(Tree::Call("abs", vec![a])), Box::new(Tree::Leaf("0.5".to_owned(), 0.5)))
}

fn leaf(random: &mut Random) -> Tree {
    match random.below(10) {
        0..=5 => {
            let (name, variable) = random.pick(&VARIABLES);
            Tree::Leaf(name.to_owned(), state(variable))
        }
        6..=7 => {
            let (name, value) = random.pick(&PARAMETERS);
            Tree::Leaf(name.to_owned(), value)
        }
        _ => {
            let text = random.pick(&NUMBERS);
            let value = match text {
                "pi" => std::f64::consts::PI,
                "e" => std::f64::consts::E,
                digits => digits.parse().expect("a number"),
            };
            Tree::Leaf(text.to_owned(), value)
        }
    }
}

impl Tree {
    /// How tightly it binds: sums 1, products 2, signs 3, powers 4, all else 5.
    fn strength(&self) -> u32 {
        match self {
            Tree::Sign('+' | '-', ..) => 1,
            Tree::Sign('^', ..) | Tree::Whole(..) => 4,
            Tree::Sign(..) => 2,
            Tree::Neg(_) => 3,
            Tree::Leaf(..) | Tree::Call(..) => 5,
        }
    }

    /// The text, in brackets if it binds less tightly than `least`.
    fn within(&self, least: u32, random: &mut Random) -> String {
        let text = self.text(random);
        if self.strength() < least || random.below(12) == 0 { format!("({text})") } else { text }
    }

    /// The text, with blanks here and there.
    pub fn text(&self, random: &mut Random) -> String {
        let blank = random.pick(&["", " ", "", "\n", "\t "]);
        match self {
            Tree::Leaf(text, _) => text.clone(),
            Tree::Neg(a) => format!("-{blank}{}", a.within(3, random)),
            Tree::Whole(a, n) => format!("{}^{blank}{n}", a.within(5, random)),
            Tree::Sign('^', a, b) => format!("{}{blank}^{}", a.within(5, random), b.within(3, random)),
            Tree::Sign(sign, a, b) => {
                let own = self.strength();
                format!("{}{blank}{sign}{blank}{}", a.within(own, random), b.within(own + 1, random))
            }
            Tree::Call(name, parts) => {
                let parts: Vec<String> = parts.iter().map(|part| part.text(random)).collect();
                format!("{name}{blank}({})", parts.join(","))
            }
        }
    }

    /// The value, by recursion.
    pub fn value(&self) -> f64 {
        match self {
            Tree::Leaf(_, value) => *value,
            Tree::Neg(a) => -a.value(),
            Tree::Whole(a, n) => {
                let a = a.value();
                let product = (1..n.abs()).fold(a, |product, _| product * a);
                if *n < 0 { 1.0 / product } else { product }
            }
            Tree::Sign(sign, a, b) => {
                let (a, b) = (a.value(), b.value());
                match sign {
                    '+' => a + b,
                    '-' => a - b,
                    '*' => a * b,
                    '/' => a / b,
                    // no other leaf is whole and at most 16
                    _ if b == 2.0 => a * a,
                    _ if b == 3.0 => a * a * a,
                    _ => lane::pow(a, b),
                }
            }
            Tree::Call(name, parts) => {
                let a = parts[0].value();
                match *name {
                    "tanh" => lane::tanh(a),
                    "softplus" => lane::softplus(a),
                    "abs" => a.abs(),
                    "exp_m1" => lane::exp_m1(a),
                    "exp" => lane::exp(a),
                    "ln" => lane::ln(a),
                    "ln_1p" => lane::ln_1p(a),
                    "sqrt" => a.sqrt(),
                    "min" => parts[1..].iter().fold(a, |least, part| Number::min(least, part.value())),
                    _ => parts[1..].iter().fold(a, |most, part| Number::max(most, part.value())),
                }
            }
        }
    }
}
