//! The tokeniser.

use crate::limits::LONGEST_TEXT;
use crate::place::{Location, Problem};

/// The smallest unit of a formula.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Token<'a> {
    Number(f64),
    Name(&'a str),
    /// One of `+ - * / ^ ( ) [ ] ,`.
    Symbol(char),
    End,
}

/// A token, its text and its place.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lexeme<'a> {
    pub(crate) token: Token<'a>,
    pub(crate) text: &'a str,
    pub(crate) place: Location,
    /// Whether this token directly follows the one before.
    pub(crate) joined: bool,
}

const SYMBOLS: &str = "+-*/^()[],";

/// Characters that look right and are not, and what to write.
const LOOKALIKES: [(&str, &str, &str); 13] = [
    ("\u{2212}\u{2013}\u{2014}\u{2010}\u{2011}\u{2012}\u{ad}", "a typographic minus or dash", "the ASCII minus -"),
    ("\u{d7}\u{b7}\u{22c5}\u{2219}\u{2217}\u{2022}", "a typographic multiplication sign", "*"),
    ("\u{f7}\u{2215}\u{2044}:", "a division sign other than /", "/"),
    ("\u{b2}", "a superscript", "^2"),
    ("\u{b3}", "a superscript", "^3"),
    ("\u{b9}\u{2070}\u{2074}\u{2075}\u{2076}\u{2077}\u{2078}\u{2079}\u{207b}", "a superscript", "^ and the exponent"),
    ("\u{221a}", "a root sign", "sqrt(...)"),
    ("\u{3c0}", "a Greek letter", "pi"),
    ("\u{a0}\u{2002}\u{2003}\u{2009}\u{202f}\u{feff}", "a special blank", "an ordinary space"),
    ("{}", "a brace", "parentheses ( )"),
    ("|", "a bar", "abs(...)"),
    ("=<>", "a comparison", "an expression without comparisons; min(a, b) and max(a, b) choose"),
    (";", "a semicolon", "a comma between arguments"),
];

/// Splits a text whose first character is at `start` into tokens; the last one is [`Token::End`].
pub(crate) fn tokens(text: &str, start: Location) -> Result<Vec<Lexeme<'_>>, Problem> {
    if text.len() > LONGEST_TEXT {
        let found = format!("an expression of {} bytes", text.len());
        return Err(Problem::new(start, found, format!("up to {LONGEST_TEXT} bytes; split it into named expressions")));
    }
    let (mut lexemes, mut rest, mut place) = (Vec::new(), text, start);
    loop {
        let blank = rest.len() - rest.trim_start_matches([' ', '\t', '\n', '\r']).len();
        place = after(place, &rest[..blank]);
        rest = &rest[blank..];
        let Some(first) = rest.chars().next() else {
            lexemes.push(Lexeme { token: Token::End, text: "", place, joined: false });
            return Ok(lexemes);
        };
        let (token, length) = if first.is_ascii_digit() || first == '.' {
            number(rest, place)?
        } else if first.is_ascii_alphabetic() {
            let end = rest.find(|c: char| !c.is_ascii_alphanumeric() && c != '_').unwrap_or(rest.len());
            (Token::Name(&rest[..end]), end)
        } else if rest.starts_with("**") {
            return Err(Problem::new(place, "**", "^ for powers, * for products"));
        } else if SYMBOLS.contains(first) {
            (Token::Symbol(first), 1)
        } else {
            return Err(foreign(first, place));
        };
        let joined = blank == 0 && !lexemes.is_empty();
        lexemes.push(Lexeme { token, text: &rest[..length], place, joined });
        place = after(place, &rest[..length]);
        rest = &rest[length..];
    }
}

/// The place behind a text.
fn after(place: Location, text: &str) -> Location {
    text.chars().fold(place, |place, c| match c {
        '\n' => Location { line: place.line.saturating_add(1), column: 1 },
        _ => Location { column: place.column.saturating_add(1), ..place },
    })
}

/// The number at the beginning of a text: digits, a point and digits, an exponent.
fn number(text: &str, place: Location) -> Result<(Token<'_>, usize), Problem> {
    let bytes = text.as_bytes();
    let digits = |from: usize| from + bytes[from..].iter().take_while(|byte| byte.is_ascii_digit()).count();
    let mut end = digits(0);
    if bytes.get(end) == Some(&b'.') {
        end = digits(end + 1);
    }
    if bytes.get(end).is_some_and(|byte| byte.eq_ignore_ascii_case(&b'e')) {
        let sign = usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
        let exponent = digits(end + 1 + sign);
        // without digits it is the constant e, or a name
        if exponent > end + 1 + sign {
            end = exponent;
        }
    }
    let valid = "a number such as 2, 0.5 or 1e-3";
    let value: f64 = text[..end].parse().map_err(|_| Problem::new(place, format!("`{}`", &text[..end]), valid))?;
    if !value.is_finite() {
        return Err(Problem::new(
            place,
            format!("{}, too large for a double", &text[..end]),
            "up to 1.7976931348623157e308",
        ));
    }
    if matches!(bytes.get(end), Some(b'.')) {
        return Err(Problem::new(place, "a number with two points", valid));
    }
    Ok((Token::Number(value), end))
}

/// A character that no formula has.
fn foreign(c: char, place: Location) -> Problem {
    let shown = if c.is_control() { '?' } else { c };
    let shown = format!("`{shown}` (U+{:04X})", u32::from(c));
    match LOOKALIKES.iter().find(|(characters, ..)| characters.contains(c)) {
        Some((_, what, instead)) => Problem::new(place, format!("{what} {shown}"), *instead),
        None => Problem::new(
            place,
            format!("the character {shown}"),
            "numbers, names of ASCII letters, digits and _ (a letter first), + - * / ^ ( ) [ ] and commas",
        ),
    }
}
