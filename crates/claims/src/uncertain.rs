//! Values with errors: arithmetic propagates the error, and a comparison may be undecided.

use math::number::Number;
use serde::{Deserialize, Serialize};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A value and how far the true one may be from it; an error that nothing bounds is infinite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Uncertain {
    /// The value.
    pub value: f64,
    /// Not negative.
    pub error: f64,
}

/// The result of a comparison over all values within the error.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Outcome {
    /// It holds for all of them.
    True,
    /// It holds for none of them.
    False,
    /// It holds for some of them.
    Undecided,
}

/// A comparison of two values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Relation {
    /// `<`
    Below,
    /// `<=`
    AtMost,
    /// `>`
    Above,
    /// `>=`
    AtLeast,
    /// `=`
    Equal,
    /// `!=`
    Unequal,
}

impl Uncertain {
    /// A value without an error.
    pub fn exact(value: f64) -> Uncertain {
        Uncertain { value, error: 0.0 }
    }

    /// The middle of an interval and half its width.
    pub fn between(low: f64, high: f64, value: f64) -> Uncertain {
        let (below, above) = (value - low, high - value);
        Uncertain { value, error: if below > above { below } else { above } }
    }

    /// The least value that the error allows.
    pub fn low(self) -> f64 {
        self.value - self.error
    }

    /// The largest value that the error allows.
    pub fn high(self) -> f64 {
        self.value + self.error
    }

    /// The value of a function that only rises or only falls.
    fn monotone(self, f: impl Fn(f64) -> f64) -> Uncertain {
        let (low, high, value) = (f(self.low()), f(self.high()), f(self.value));
        let (low, high) = if high < low { (high, low) } else { (low, high) };
        // an end outside of the domain bounds nothing
        let is_bounded = self.error == 0.0 || low.is_finite() && high.is_finite();
        if is_bounded { Uncertain::between(low, high, value) } else { Uncertain { value, error: f64::INFINITY } }
    }

    /// Compares with another value: open when the errors of both together reach over the border.
    pub fn compare(self, relation: Relation, other: Uncertain) -> Outcome {
        let difference = Uncertain { value: self.value - other.value, error: self.error + other.error };
        let (low, high) = (difference.low(), difference.high());
        if low.is_nan() || high.is_nan() {
            return Outcome::Undecided;
        }
        match relation {
            Relation::Below => Outcome::of(high < 0.0, low >= 0.0),
            Relation::AtMost => Outcome::of(high <= 0.0, low > 0.0),
            Relation::Above => Outcome::of(low > 0.0, high <= 0.0),
            Relation::AtLeast => Outcome::of(low >= 0.0, high < 0.0),
            Relation::Equal => Outcome::of(low == 0.0 && high == 0.0, low > 0.0 || high < 0.0),
            Relation::Unequal => Outcome::of(low > 0.0 || high < 0.0, low == 0.0 && high == 0.0),
        }
    }
}

/// Arithmetic of two values, with the largest error that theirs allow; its own rounding is not counted.
macro_rules! arithmetic {
    ($operation:ident, $name:ident, |$a:ident, $b:ident| $result:expr) => {
        impl $operation for Uncertain {
            type Output = Uncertain;

            fn $name(self, other: Uncertain) -> Uncertain {
                let ($a, $b) = (self, other);
                let (value, error) = $result;
                Uncertain { value, error }
            }
        }

        impl $operation<f64> for Uncertain {
            type Output = Uncertain;

            fn $name(self, other: f64) -> Uncertain {
                $operation::$name(self, Uncertain::exact(other))
            }
        }
    };
}

arithmetic!(Add, add, |a, b| (a.value + b.value, a.error + b.error));
arithmetic!(Sub, sub, |a, b| (a.value - b.value, a.error + b.error));
arithmetic!(Mul, mul, |a, b| {
    (a.value * b.value, a.value.abs() * b.error + b.value.abs() * a.error + a.error * b.error)
});
arithmetic!(Div, div, |a, b| {
    let (value, room) = (a.value / b.value, b.value.abs() - b.error);
    // a divisor that may be 0 bounds nothing
    (value, if room <= 0.0 { f64::INFINITY } else { (a.error + value.abs() * b.error) / room })
});

impl Neg for Uncertain {
    type Output = Uncertain;

    fn neg(self) -> Uncertain {
        Uncertain { value: -self.value, error: self.error }
    }
}

impl Number for Uncertain {
    fn recip(self) -> Uncertain {
        Uncertain::exact(1.0) / self
    }

    fn powi(self, n: i32) -> Uncertain {
        let power =
            (1..n.unsigned_abs()).fold(if n == 0 { Uncertain::exact(1.0) } else { self }, |power, _| power * self);
        if n < 0 { power.recip() } else { power }
    }

    fn powf(self, q: f64) -> Uncertain {
        self.monotone(|x| Number::powf(x, q))
    }

    fn abs(self) -> Uncertain {
        Uncertain { value: self.value.abs(), error: self.error }
    }

    fn min(self, other: Uncertain) -> Uncertain {
        let least = |end: fn(Uncertain) -> f64| Number::min(end(self), end(other));
        Uncertain::between(least(Uncertain::low), least(Uncertain::high), Number::min(self.value, other.value))
    }

    fn max(self, other: Uncertain) -> Uncertain {
        -Number::min(-self, -other)
    }

    fn exp(self) -> Uncertain {
        self.monotone(Number::exp)
    }

    fn exp_m1(self) -> Uncertain {
        self.monotone(Number::exp_m1)
    }

    fn ln(self) -> Uncertain {
        self.monotone(Number::ln)
    }

    fn ln_1p(self) -> Uncertain {
        self.monotone(Number::ln_1p)
    }

    fn sqrt(self) -> Uncertain {
        self.monotone(Number::sqrt)
    }

    fn tanh(self) -> Uncertain {
        self.monotone(Number::tanh)
    }

    fn softplus(self) -> Uncertain {
        self.monotone(Number::softplus)
    }
}

impl Outcome {
    /// True when it holds for all values, false when for none, open otherwise.
    pub fn of(for_all: bool, for_none: bool) -> Outcome {
        match (for_all, for_none) {
            (true, _) => Outcome::True,
            (_, true) => Outcome::False,
            _ => Outcome::Undecided,
        }
    }

    /// The word of the file.
    pub fn word(self) -> &'static str {
        match self {
            Outcome::True => "true",
            Outcome::False => "false",
            Outcome::Undecided => "undecided",
        }
    }
}

impl Relation {
    /// The relations as they are written.
    pub const ALL: [(&'static str, Relation); 6] = [
        ("<", Relation::Below),
        ("<=", Relation::AtMost),
        (">", Relation::Above),
        (">=", Relation::AtLeast),
        ("=", Relation::Equal),
        ("!=", Relation::Unequal),
    ];

    /// Reads a relation.
    pub fn parse(text: &str) -> Option<Relation> {
        Relation::ALL.iter().find(|(written, _)| *written == text).map(|(_, relation)| *relation)
    }
}
