//! Numerals in the text of the document: each must come from the data, or stand in a short list with a reason.
//!
//! A scanner of Typst's three modes. In text and in strings no numeral may stand; where it is part of a name that begins
//! with a letter (DOP853) it is none. In mathematics digits that belong to the structure may stand: one digit, but not as
//! a whole side of a relation, except 0 and 1. In code lengths and shares (12pt, 50%) and single digits may stand. Strings
//! that name something (`#n("fig04.room")`, `image("...")`, `#said("10")`) are no text.

use crate::disk;
use crate::failure::Failure;
use crate::paths::{ALLOWED_NUMERALS, NUMBERS_JSON, Paths};
use serde_json::Value;
use std::collections::BTreeSet;

/// Functions whose strings name something, or repeat what the source states.
const NAMING: [&str; 14] = [
    "n",
    "plain",
    "value",
    "has",
    "keys",
    "said",
    "image",
    "json",
    "bibliography",
    "label",
    "ref",
    "regex",
    "rgb",
    "datetime",
];
/// Named arguments of the kind of `numbering: "1.1"`.
const PATTERNS: [&str; 1] = ["numbering"];
/// Named arguments that are text, also of a function whose other strings name something.
const SPOKEN: [&str; 2] = ["alt", "caption"];
/// Words of code after which a string is the name of a file.
const IMPORTING: [&str; 2] = ["import", "include"];
/// Statements, which go on to the end of the line.
const STATEMENTS: [&str; 10] = ["let", "set", "show", "if", "for", "while", "import", "include", "return", "context"];
/// Units behind which a number is a measure of the page.
const UNITS: [&str; 8] = ["pt", "mm", "cm", "em", "in", "fr", "deg", "%"];

/// Numerals in words, from eleven on: a number of the data is one in this dress too. Smaller ones count what the text
/// itself shows ("two panels").
const WORDS: [&str; 30] = [
    "eleven",
    "twelve",
    "thirteen",
    "fourteen",
    "fifteen",
    "sixteen",
    "seventeen",
    "eighteen",
    "nineteen",
    "twenty",
    "thirty",
    "forty",
    "fifty",
    "sixty",
    "seventy",
    "eighty",
    "ninety",
    "hundred",
    "hundreds",
    "thousand",
    "thousands",
    "million",
    "millions",
    "billion",
    "dozen",
    "percent",
    "tenth",
    "tenths",
    "hundredth",
    "thousandth",
];

/// A numeral that may not stand where it does.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Stray {
    /// Line of the file, from 1.
    pub line: usize,
    /// The numeral.
    pub numeral: String,
    /// Where in the file it begins, in bytes.
    at: usize,
}

/// Checks every Typst file of the document.
///
/// # Errors
/// Differs: a numeral stands in the text, or the list of allowed ones has an entry that is not used; all of them.
pub fn check(paths: &Paths) -> Result<(), Failure> {
    let allowed = allowed(&disk::read_text(&paths.root.join(ALLOWED_NUMERALS))?.unwrap_or_default())?;
    let measured = measured(&disk::read_text(&paths.root.join(NUMBERS_JSON))?.unwrap_or_default());
    let mut used = BTreeSet::new();
    let mut wrong = Vec::new();
    for file in disk::walk(&paths.document(), &|_| true)? {
        if file.extension().is_none_or(|ending| ending != "typ") {
            continue;
        }
        let text = disk::read_text(&file)?.unwrap_or_default();
        let name = file.strip_prefix(&paths.root).unwrap_or(&file).display().to_string();
        let disguised = said(&text).into_iter().filter(|(_, numeral)| measured.contains(*numeral));
        wrong.extend(disguised.map(|(line, numeral)| format!("{name}:{line}: {numeral} was measured, not said")));
        for stray in strays(&text) {
            match allowed.iter().find(|entry| covers(&text, entry, stray.at)) {
                Some(entry) => {
                    used.insert(entry.clone());
                }
                None => wrong.push(format!("{name}:{}: {} stands in the text", stray.line, stray.numeral)),
            }
        }
    }
    let unused = allowed.iter().filter(|entry| !used.contains(*entry));
    wrong.extend(unused.map(|entry| format!("{ALLOWED_NUMERALS}: {entry:?} is not used")));
    match wrong.is_empty() {
        true => Ok(()),
        false => Err(Failure::Differs(format!(
            "{}\na number of the data is #n(\"name\") (names: paper/numbers.json), one that the source states #said(\"...\")",
            wrong.join("\n")
        ))),
    }
}

/// Numerals in what the source is said to state, with their lines.
pub fn said(text: &str) -> Vec<(usize, &str)> {
    let mut found = Vec::new();
    for (at, open) in text.match_indices("said(\"") {
        let inner = text[at + open.len()..].split('"').next().unwrap_or("");
        let line = text[..at].matches('\n').count() + 1;
        let numerals = inner.split(|c: char| !(c.is_ascii_digit() || c == '.')).map(|word| word.trim_matches('.'));
        found.extend(numerals.filter(|word| !word.is_empty()).map(|word| (line, word)));
    }
    found
}

/// How the numbers are written that come from tables, not from a scene; of at least three digits, since two may agree
/// with a stated one by chance.
fn measured(numbers: &str) -> BTreeSet<String> {
    let numbers: Value = serde_json::from_str(numbers).unwrap_or_default();
    let entries = numbers["numbers"].as_object().into_iter().flatten().map(|(_, entry)| entry);
    let from_tables = entries.filter(|entry| entry["from"].as_str().is_some_and(|from| !from.starts_with("figures/")));
    let texts =
        from_tables.filter_map(|entry| entry["mantissa"].as_str()).map(|text| text.split('(').next().unwrap_or(""));
    texts.filter(|text| text.bytes().filter(u8::is_ascii_digit).count() > 2).map(str::to_owned).collect()
}

/// The texts of the list: `text | why`, a line each; lines that begin with # say something about the list.
///
/// # Errors
/// Usage: a line without a reason.
pub fn allowed(list: &str) -> Result<Vec<String>, Failure> {
    let mut texts = Vec::new();
    for (index, line) in list.lines().enumerate().filter(|(_, line)| !line.is_empty() && !line.starts_with('#')) {
        let reason = line.split_once(" | ").filter(|(_, why)| !why.trim().is_empty());
        let fail = || Failure::Usage(format!("{ALLOWED_NUMERALS}:{}: not `text | why`: {line:?}", index + 1));
        texts.push(reason.ok_or_else(fail)?.0.to_owned());
    }
    Ok(texts)
}

/// Whether an occurrence of `entry` covers the place `at`.
fn covers(text: &str, entry: &str, at: usize) -> bool {
    text.match_indices(entry).any(|(start, found)| (start..start + found.len()).contains(&at))
}

/// The numerals of a Typst file that belong to the data.
pub fn strays(text: &str) -> Vec<Stray> {
    let mut scanner = Scanner { text, at: 0, strays: Vec::new() };
    scanner.markup(None);
    scanner.strays
}

struct Scanner<'a> {
    text: &'a str,
    at: usize,
    strays: Vec<Stray>,
}

impl<'a> Scanner<'a> {
    fn rest(&self) -> &'a str {
        &self.text[self.at..]
    }

    fn peek(&self) -> Option<char> {
        self.rest().chars().next()
    }

    fn before(&self) -> Option<char> {
        self.text[..self.at].chars().next_back()
    }

    fn skip(&mut self) {
        self.at += self.peek().map_or(0, char::len_utf8);
    }

    /// Takes characters while they fit.
    fn take(&mut self, fits: impl Fn(char) -> bool) -> &'a str {
        let rest = self.rest();
        let end = rest.find(|c: char| !fits(c)).unwrap_or(rest.len());
        self.at += end;
        &rest[..end]
    }

    fn stray(&mut self, at: usize, numeral: &str) {
        let line = self.text[..at].matches('\n').count() + 1;
        self.strays.push(Stray { line, numeral: numeral.to_owned(), at });
    }

    /// Skips a comment; whether there was one.
    fn comment(&mut self) -> bool {
        if self.rest().starts_with("//") && self.before() != Some(':') {
            self.take(|c| c != '\n');
            return true;
        }
        if self.rest().starts_with("/*") {
            self.at += self.rest().find("*/").map_or(self.rest().len(), |end| end + 2);
            return true;
        }
        false
    }

    /// Text, up to the closing character.
    fn markup(&mut self, close: Option<char>) {
        while let Some(next) = self.peek() {
            match next {
                _ if self.comment() => {}
                _ if Some(next) == close => return self.skip(),
                '\\' => {
                    self.skip();
                    self.skip();
                }
                '`' => self.raw(),
                '$' => {
                    self.skip();
                    self.mathematics();
                }
                '#' => {
                    self.skip();
                    self.expression();
                }
                '[' => {
                    self.skip();
                    self.markup(Some(']'));
                }
                '@' => {
                    self.skip();
                    self.take(is_label);
                }
                '<' if self.is_label() => {
                    self.take(|c| c != '>');
                    self.skip();
                }
                _ if next.is_alphabetic() => self.word(),
                _ if next.is_numeric() => self.numeral(),
                _ => self.skip(),
            }
        }
    }

    /// A word of text, which may be a numeral.
    fn word(&mut self) {
        let at = self.at;
        let word = self.take(is_word);
        if WORDS.contains(&word.to_lowercase().as_str()) {
            self.stray(at, word);
        }
    }

    fn is_label(&self) -> bool {
        let inner = self.rest()[1..].split('>').next().unwrap_or("");
        inner.starts_with(char::is_alphabetic) && inner.chars().all(is_label)
    }

    /// A numeral in text.
    fn numeral(&mut self) {
        let at = self.at;
        let numeral = self.take(|c| c.is_alphanumeric() || c == '.' || c == ',').trim_end_matches(['.', ',']);
        self.stray(at, numeral);
    }

    /// Names of files and programs; a number in the same dress is one all the same.
    fn raw(&mut self) {
        let at = self.at;
        let ticks = self.take(|c| c == '`');
        if ticks.len() == 2 {
            return;
        }
        let end = self.rest().find(ticks).unwrap_or(self.rest().len());
        let inner = &self.rest()[..end];
        self.at += (end + ticks.len()).min(self.rest().len());
        if inner.chars().any(|c| c.is_ascii_digit()) && !inner.chars().any(|c| c.is_alphabetic() && c != 'e') {
            self.stray(at, inner);
        }
    }

    /// What follows a `#` in text.
    fn expression(&mut self) {
        match self.peek() {
            Some('{') => {
                self.skip();
                self.code(Some('}'), false);
            }
            Some('(') => {
                self.skip();
                self.code(Some(')'), false);
                self.postfix("");
            }
            Some('[') => {
                self.skip();
                self.markup(Some(']'));
            }
            Some('"') => self.string(false),
            Some(c) if c.is_alphabetic() || c == '_' => {
                let word = self.take(is_identifier);
                match STATEMENTS.contains(&word) {
                    true => self.statement(IMPORTING.contains(&word)),
                    false => self.postfix(word),
                }
            }
            _ => {}
        }
    }

    /// Arguments, content and fields behind a name.
    fn postfix(&mut self, name: &str) {
        let mut name = name;
        loop {
            match self.peek() {
                Some('(') => {
                    self.skip();
                    self.code(Some(')'), NAMING.contains(&name));
                }
                Some('[') => {
                    self.skip();
                    self.markup(Some(']'));
                }
                Some('.') if self.rest()[1..].starts_with(|c: char| c.is_alphabetic()) => {
                    self.skip();
                    name = self.take(is_identifier);
                }
                _ => return,
            }
        }
    }

    /// Code to the end of the line; brackets may go on over lines.
    fn statement(&mut self, is_naming: bool) {
        while let Some(next) = self.peek() {
            if next == '\n' || next == ';' {
                return;
            }
            // the branch of a condition ends what was begun in text
            if next == ']' {
                return;
            }
            self.token(is_naming);
        }
    }

    /// Code up to the closing bracket.
    fn code(&mut self, close: Option<char>, is_naming: bool) {
        while let Some(next) = self.peek() {
            if Some(next) == close {
                return self.skip();
            }
            self.token(is_naming);
        }
    }

    /// One token of code.
    fn token(&mut self, is_naming: bool) {
        match self.peek() {
            _ if self.comment() => {}
            Some('"') => self.string(is_naming),
            Some('$') if is_naming => {
                self.skip();
                self.take(|c| c != '$');
                self.skip();
            }
            Some('$') => {
                self.skip();
                self.mathematics();
            }
            Some('`') => self.raw(),
            Some('[') => {
                self.skip();
                self.markup(Some(']'));
            }
            Some('(') => {
                self.skip();
                self.code(Some(')'), is_naming);
            }
            Some('{') => {
                self.skip();
                self.code(Some('}'), is_naming);
            }
            Some('<') if self.is_label() => {
                self.take(|c| c != '>');
                self.skip();
            }
            Some(c) if c.is_alphabetic() || c == '_' => {
                let word = self.take(is_identifier);
                match self.peek() {
                    _ if IMPORTING.contains(&word) => self.statement(true),
                    Some(':') if PATTERNS.contains(&word) => self.argument(true),
                    Some(':') if SPOKEN.contains(&word) => self.argument(false),
                    _ => self.postfix(word),
                }
            }
            Some(c) if c.is_ascii_digit() && is_naming => {
                self.take(|c| c.is_ascii_digit() || c == '.');
            }
            Some(c) if c.is_ascii_digit() => self.code_number(),
            _ => self.skip(),
        }
    }

    /// The value of a named argument.
    fn argument(&mut self, is_naming: bool) {
        while self.peek().is_some_and(|next| !matches!(next, ',' | ')' | '\n')) {
            self.token(is_naming);
        }
    }

    fn code_number(&mut self) {
        let at = self.at;
        let number = self.take(|c| c.is_ascii_digit() || c == '.');
        let unit = self.take(|c| c.is_alphabetic() || c == '%');
        if number.len() > 1 && !UNITS.contains(&unit) {
            self.stray(at, number);
        }
    }

    /// A string of code: text, unless it names something.
    fn string(&mut self, is_naming: bool) {
        self.skip();
        while let Some(next) = self.peek() {
            match next {
                '"' => return self.skip(),
                '\\' if self.rest().starts_with("\\u{") => {
                    self.take(|c| c != '}');
                }
                '\\' => {
                    self.skip();
                    self.skip();
                }
                _ if next.is_alphabetic() && is_naming => {
                    self.take(is_word);
                }
                _ if next.is_alphabetic() => self.word(),
                _ if next.is_numeric() && !is_naming => self.numeral(),
                _ => self.skip(),
            }
        }
    }

    /// Mathematics up to the closing sign.
    fn mathematics(&mut self) {
        let mut after_relation = false;
        while let Some(next) = self.peek() {
            match next {
                _ if self.comment() => {}
                '$' => return self.skip(),
                '\\' => {
                    self.skip();
                    self.skip();
                }
                '"' => {
                    self.string(false);
                    after_relation = false;
                }
                '#' => {
                    self.skip();
                    self.expression();
                    after_relation = false;
                }
                '=' | '<' | '>' | '≈' | '≤' | '≥' => {
                    self.skip();
                    after_relation = true;
                }
                _ if next.is_whitespace() || next == '&' => self.skip(),
                _ if next.is_ascii_digit() => {
                    self.math_number(after_relation);
                    after_relation = false;
                }
                _ if next.is_alphabetic() => {
                    let word = self.take(char::is_alphabetic);
                    after_relation = matches!(word, "approx" | "lt" | "gt" | "eq" | "prop");
                }
                // a sign in front leaves a number a whole side
                '-' | '+' | '−' => self.skip(),
                _ => {
                    self.skip();
                    after_relation = false;
                }
            }
        }
    }

    fn math_number(&mut self, after_relation: bool) {
        let at = self.at;
        let number = self.take(|c| c.is_ascii_digit() || c == '.');
        let next = self.rest().trim_start_matches([' ', '&', '\n']);
        let ends = next.is_empty() || next.starts_with(['$', ',', ';', '=', '<', '>', '\\', ')', ']']);
        let ends = ends || next.starts_with("quad") || next.starts_with("\"");
        let is_structure = number.len() == 1 && !(after_relation && ends && !matches!(number, "0" | "1"));
        if !is_structure {
            self.stray(at, number);
        }
    }
}

fn is_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

fn is_identifier(c: char) -> bool {
    c.is_alphanumeric() || c == '-' || c == '_'
}

fn is_label(c: char) -> bool {
    c.is_alphanumeric() || matches!(c, '-' | '_' | ':' | '.')
}
