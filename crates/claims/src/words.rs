//! Text for readers: a measure as a sentence, a number with the digits that its error supports, placeholders.

use crate::check::Operand;
use crate::entry::{Measure, Take};
use crate::source::ClaimLocation;
use crate::uncertain::Uncertain;
use checkout::failure::Failure;
use checkout::paths::Paths;
use std::collections::BTreeMap;

/// Digits of a number in a text, unless the placeholder asks for others or its error carries fewer.
const DIGITS: usize = 3;
/// Whole numbers below this are written in full.
const LARGEST_WHOLE: f64 = 1e9;

/// A measure in words: `least v in data/fig11/trajectories.csv where t >= 1`.
///
/// # Errors
/// As [`Measure::operand`].
pub fn describe(measure: &Measure, place: &ClaimLocation) -> Result<String, Failure> {
    let file = |table: &str| Paths::table(table);
    let of = measure.of.as_deref().filter(|_| !measure.take.counts()).unwrap_or("");
    let what = match measure.take {
        Take::Count => "number of rows".to_owned(),
        Take::Share => "share of rows".to_owned(),
        Take::Only => of.to_owned(),
        Take::First | Take::Last | Take::Least | Take::Largest => format!("{} {of}", measure.take.word()),
        Take::Mean | Take::Sum | Take::Span => format!("{} of {of}", measure.take.word()),
    };
    let mut words = format!("{what} in {}", file(&measure.table));
    if !measure.among.is_empty() {
        words.push_str(&format!(" among those with {}", measure.among.join(" and ")));
    }
    if let Some(beside) = &measure.beside {
        words.push_str(&format!(" beside {}", file(beside)));
    }
    if let Some(next) = &measure.next {
        words.push_str(&format!(", each row beside the next by {next}"));
    }
    if !measure.conditions.is_empty() {
        words.push_str(&format!(" where {}", measure.conditions.join(" and ")));
    }
    match measure.operand(place)? {
        None => Ok(words),
        Some((key, Operand::Number(number))) => Ok(format!("{words}, {key} {number}")),
        Some((key, Operand::Measure(other))) => Ok(format!("{words}, {key} {}", describe(&other, place)?)),
    }
}

/// A number with the given number of digits: plain where that is short, otherwise with an exponent.
pub fn significant(value: f64, digits: usize) -> String {
    let digits = digits.max(1);
    let text = format!("{value:.*e}", digits - 1);
    let exponent = exponent_of(&text);
    if !(-4..6).contains(&exponent) {
        return text;
    }
    let decimals = digits as i32 - 1 - exponent;
    format!("{value:.*}", usize::try_from(decimals).unwrap_or(0))
}

fn exponent_of(text: &str) -> i32 {
    text.rsplit_once('e').and_then(|(_, exponent)| exponent.parse().ok()).unwrap_or(0)
}

/// A value with at most the given number of digits, and none beyond its error; whole numbers without an error in full.
pub fn number(found: Uncertain, digits: Option<usize>) -> String {
    let Uncertain { value, error } = found;
    if value.fract() == 0.0 && error == 0.0 && value.abs() < LARGEST_WHOLE {
        return format!("{value:.0}");
    }
    let digits = digits.unwrap_or(DIGITS);
    if error == 0.0 || !error.is_finite() {
        return significant(value, digits);
    }
    let carried = exponent_of(&format!("{value:e}")) - exponent_of(&format!("{error:e}"));
    significant(value, digits.min(usize::try_from(carried).unwrap_or(0)))
}

/// A text with numbers in place of `{name}`, `{name:5}` (digits) and `{name:percent}`.
///
/// # Errors
/// Usage: an unknown test name (the message lists the valid ones), an unbalanced brace, or another form.
pub fn fill(
    text: &str,
    named: &BTreeMap<&str, Uncertain>,
    place: &ClaimLocation,
    key: &str,
) -> Result<String, Failure> {
    let mut filled = String::new();
    let mut rest = text;
    while let Some((before, after)) = rest.split_once('{') {
        let (inside, left) =
            after.split_once('}').ok_or_else(|| place.fail(key, format!("a brace is not closed: {{{after}")))?;
        let (name, form) = inside.split_once(':').map_or((inside, None), |(name, form)| (name, Some(form)));
        let found = named.get(name).copied().ok_or_else(|| {
            let names: Vec<&str> = named.keys().copied().collect();
            place.fail(key, format!("{{{inside}}}: no test has the name {name}; there are: {}", names.join(", ")))
        })?;
        let words = match form {
            None => number(found, None),
            Some("percent") => percent(found),
            Some(digits) => {
                let digits = digits.parse().ok().filter(|digits| (1..=17).contains(digits));
                let valid = "valid: {name}, {name:5} (1 to 17 digits), {name:percent}";
                number(found, Some(digits.ok_or_else(|| place.fail(key, format!("{{{inside}}}: {valid}")))?))
            }
        };
        filled.push_str(before);
        filled.push_str(&words);
        rest = left;
    }
    filled.push_str(rest);
    Ok(filled)
}

fn percent(part: Uncertain) -> String {
    let whole = Uncertain { value: 100.0 * part.value, error: 100.0 * part.error };
    format!("{} %", number(whole, None))
}

/// A measured number typed into a text: one with a decimal point or an exponent that occurs neither in the entry's
/// quotation of the source nor in its tests. Such numbers must be placeholders.
pub fn typed_number<'a>(text: &'a str, known: &str) -> Option<&'a str> {
    let outside = text
        .split('{')
        .enumerate()
        .map(|(index, part)| if index == 0 { part } else { part.split_once('}').map_or(part, |(_, after)| after) });
    let is_numeric = |c: char| c.is_ascii_digit() || matches!(c, '.' | 'e' | '-' | '+');
    let tokens = outside.flat_map(|part| part.split(|c: char| !is_numeric(c)));
    let tokens = tokens.map(|token| token.trim_matches(|c: char| !c.is_ascii_digit()));
    let measured = |token: &&str| (token.contains('.') || token.contains('e')) && token.parse::<f64>().is_ok();
    tokens.filter(measured).find(|token| !known.contains(*token))
}
