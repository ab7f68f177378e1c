//! The reserved words of the language.

use crate::operation::{Binary, Unary};
use std::f64::consts::{E, PI};

/// Functions of one argument.
pub(crate) const UNARY: [(&str, Unary); 8] = [
    ("exp", Unary::Exp),
    ("ln", Unary::Ln),
    ("ln_1p", Unary::Ln1p),
    ("exp_m1", Unary::ExpM1),
    ("sqrt", Unary::Sqrt),
    ("tanh", Unary::Tanh),
    ("softplus", Unary::Softplus),
    ("abs", Unary::Abs),
];
/// Functions of two or more arguments, of which the first two are taken first.
pub(crate) const CHOICES: [(&str, Binary); 2] = [("min", Binary::Min), ("max", Binary::Max)];
/// What functions are called elsewhere, and here.
pub(crate) const ELSEWHERE: [(&str, &str); 4] =
    [("log", "ln"), ("log1p", "ln_1p"), ("expm1", "exp_m1"), ("fabs", "abs")];
/// The smooth ramp.
pub(crate) const RAMP: &str = "ramp";
/// The sum over neighbours, and its index.
pub(crate) const SUM: &str = "sum";
/// The index of a sum.
pub(crate) const INDEX: &str = "j";
/// Constants.
pub(crate) const CONSTANTS: [(&str, f64); 2] = [("e", E), ("pi", PI)];
/// Spacing, speed, and distance.
pub(crate) const VARIABLES: [&str; 3] = ["s", "v", "x"];
/// The right-hand side of the law.
pub(crate) const ACCELERATION: &str = "acceleration";
/// The effective gap; overlap where it reaches 0.
pub(crate) const GAP: &str = "gap";
/// The spacing at which two touch.
pub(crate) const BODY: &str = "body";
/// A typical speed, for laws without `v0`.
pub(crate) const SCALE: &str = "scale";
/// Which law it is.
pub(crate) const KIND: &str = "kind";

/// Functions.
pub(crate) fn functions<'a>() -> impl Iterator<Item = &'a str> {
    UNARY.iter().map(|(name, _)| *name).chain(CHOICES.iter().map(|(name, _)| *name)).chain([RAMP])
}

/// Functions and constants.
pub(crate) fn common<'a>() -> impl Iterator<Item = &'a str> {
    functions().chain(CONSTANTS.iter().map(|(name, _)| *name))
}

/// Words that a scene must not give another meaning: functions, constants, `s v x j sum kind`.
pub(crate) fn reserved() -> impl Iterator<Item = &'static str> {
    common().chain(VARIABLES).chain([INDEX, SUM, KIND])
}

/// Whether something is a name: an ASCII letter, then letters, digits and `_`.
pub(crate) fn is_name(text: &str) -> bool {
    text.starts_with(|c: char| c.is_ascii_alphabetic()) && text.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
}

/// The candidate that differs from `name` by the fewest letters, if it is close: by at most a third of the letters, but
/// 1 in any case. Among equals the first.
pub(crate) fn nearest<'a>(name: &str, candidates: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let reach = (name.chars().count() / 3).max(1);
    let scored = candidates.map(|candidate| (distance(name, candidate), candidate));
    scored.filter(|(distance, _)| *distance <= reach).min_by_key(|(distance, _)| *distance).map(|(_, name)| name)
}

/// Letters to insert, delete or replace (Levenshtein), capitals counting as small ones.
fn distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.to_lowercase().chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.to_lowercase().chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (k, y) in b.iter().enumerate() {
            let replaced = diagonal + usize::from(x != *y);
            diagonal = row[k + 1];
            row[k + 1] = replaced.min(diagonal + 1).min(row[k] + 1);
        }
    }
    row[b.len()]
}
