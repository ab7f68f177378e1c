//! Requirements on a value: `> 0`, `= 5`, `0.5 within 0.01`.

use crate::uncertain::{Outcome, Relation, Uncertain};

/// What must be true of a value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Requirement {
    /// It compares so with a number.
    Compare(Relation, f64),
    /// It differs from a number (first) by at most a distance (second).
    Within(f64, f64),
}

impl Requirement {
    /// Reads a requirement.
    ///
    /// # Errors
    /// What would be valid.
    pub fn parse(text: &str) -> Result<Requirement, String> {
        let number = |text: &str| text.parse::<f64>().ok().filter(|number| number.is_finite());
        let tokens: Vec<&str> = text.split_whitespace().collect();
        let found = match tokens[..] {
            [relation, value] => Relation::parse(relation)
                .zip(number(value))
                .map(|(relation, value)| Requirement::Compare(relation, value)),
            [centre, "within", width] => number(centre)
                .zip(number(width).filter(|width| *width >= 0.0))
                .map(|(centre, width)| Requirement::Within(centre, width)),
            _ => None,
        };
        found.ok_or_else(|| {
            format!("{text:?}; valid: `op number` with op one of < <= > >= = !=, or `number within number`")
        })
    }

    /// Whether it is true.
    pub fn judge(self, value: Uncertain) -> Outcome {
        match self {
            Requirement::Compare(relation, other) => value.compare(relation, Uncertain::exact(other)),
            Requirement::Within(centre, width) => {
                let distance = (value.value - centre).abs();
                if value.value.is_nan() || value.error.is_nan() {
                    return Outcome::Undecided;
                }
                Outcome::of(distance + value.error <= width, distance - value.error > width)
            }
        }
    }
}
