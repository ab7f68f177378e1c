//! A value with its error, arithmetic that carries the error along, and comparisons that may stay open.

use serde::{Deserialize, Serialize};

/// A value and how far the true one may be from it; an error that nothing bounds is infinite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Uncertain {
    /// The value.
    pub value: f64,
    /// Not negative.
    pub error: f64,
}

/// What a comparison says of all values that an error allows.
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

/// A sign of arithmetic between two values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sign {
    /// `+`
    Plus,
    /// `-`
    Less,
    /// `*`
    Times,
    /// `/`
    Over,
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

    /// The result for the two values, with the largest error that theirs allow; rounding of this arithmetic is not
    /// counted.
    pub fn combine(self, sign: Sign, other: Uncertain) -> Uncertain {
        let (a, b) = (self.value, other.value);
        let (da, db) = (self.error, other.error);
        match sign {
            Sign::Plus => Uncertain { value: a + b, error: da + db },
            Sign::Less => Uncertain { value: a - b, error: da + db },
            Sign::Times => Uncertain { value: a * b, error: a.abs() * db + b.abs() * da + da * db },
            // a divisor that may be 0 bounds nothing
            Sign::Over if b.abs() <= db => Uncertain { value: a / b, error: f64::INFINITY },
            Sign::Over => Uncertain { value: a / b, error: (da + (a / b).abs() * db) / (b.abs() - db) },
        }
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

impl Sign {
    /// Reads a sign.
    pub fn parse(text: &str) -> Option<Sign> {
        Some(match text {
            "+" => Sign::Plus,
            "-" => Sign::Less,
            "*" => Sign::Times,
            "/" => Sign::Over,
            _ => return None,
        })
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
