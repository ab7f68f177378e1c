//! What stands in `of` and `where`: a column, a number, or two of them with a sign between; and comparisons of such.

use crate::sheet::{Sheet, Stated};
use crate::uncertain::{Outcome, Relation, Sign, Uncertain};
use files::table::Cell;

/// A number or the name of a column (or, on the right of a comparison, a word; in quotes where a column has that name).
#[derive(Clone, Debug, PartialEq)]
enum Term {
    Number(f64),
    Name(String),
    Quoted(String),
}

/// `v`, `2`, `v - v_beside`.
#[derive(Clone, Debug, PartialEq)]
pub struct Expression {
    first: Term,
    rest: Option<(Sign, Term)>,
}

/// `phi < 0`, `event = overlap`, `overlap_t != empty`, `v < 0.4 * v0`.
#[derive(Clone, Debug, PartialEq)]
pub struct Condition {
    left: Expression,
    relation: Relation,
    right: Expression,
}

/// Where the error of a column's numbers stands.
#[derive(Clone, Copy, Debug)]
enum Source {
    /// It is stated for the whole column.
    Stated(Stated),
    /// Nothing is stated: numbers are taken as they are written.
    Nowhere,
    /// In this column.
    Column(usize),
}

#[derive(Clone, Copy, Debug)]
enum Value {
    Number(f64),
    Column(usize, Source),
}

/// An expression whose names are columns of a certain sheet.
#[derive(Clone, Copy, Debug)]
pub struct Bound {
    first: Value,
    rest: Option<(Sign, Value)>,
}

/// A condition whose names are columns of a certain sheet.
#[derive(Clone, Debug)]
pub enum BoundCondition {
    /// Both sides are numbers.
    Numbers(Bound, Relation, Bound),
    /// A column against a word: equal, or not.
    Word(usize, bool, Cell),
}

/// The word that stands for an empty cell.
pub const EMPTY: &str = "empty";

/// How the names of a measure are bound to columns.
pub struct Binding<'a> {
    /// The table.
    pub sheet: &'a Sheet,
    /// Columns whose error stands in another one, and that one.
    pub errors: Option<(&'a [String], usize)>,
}

impl Term {
    fn parse(text: &str) -> Result<Term, String> {
        let quoted = text.strip_prefix('\'').and_then(|text| text.strip_suffix('\''));
        match text.parse::<f64>() {
            _ if quoted.is_some() => Ok(Term::Quoted(quoted.unwrap_or("").to_owned())),
            Ok(number) if number.is_finite() => Ok(Term::Number(number)),
            Ok(_) => Err(format!("{text} is not finite")),
            Err(_) if text.bytes().all(|byte| byte.is_ascii_alphanumeric() || b"_-".contains(&byte)) => {
                Ok(Term::Name(text.to_owned()))
            }
            Err(_) => Err(format!("{text} is neither a number nor the name of a column")),
        }
    }
}

impl Expression {
    /// Reads an expression; blanks stand around the sign.
    ///
    /// # Errors
    /// What is wrong and what would be valid.
    pub fn parse(text: &str) -> Result<Expression, String> {
        Expression::from_tokens(&text.split_whitespace().collect::<Vec<_>>()).map_err(|problem| {
            format!("{text:?}: {problem}; valid: a column, a number, or two of them with + - * / between blanks")
        })
    }

    fn from_tokens(tokens: &[&str]) -> Result<Expression, String> {
        match tokens {
            [one] => Ok(Expression { first: Term::parse(one)?, rest: None }),
            [one, sign, other] => {
                let sign = Sign::parse(sign).ok_or_else(|| format!("{sign} is no sign"))?;
                Ok(Expression { first: Term::parse(one)?, rest: Some((sign, Term::parse(other)?)) })
            }
            _ => Err(format!("{} words", tokens.len())),
        }
    }

    /// The names in it.
    pub fn names(&self) -> Vec<String> {
        let terms = [Some(&self.first), self.rest.as_ref().map(|(_, term)| term)];
        let name = |term: &Term| match term {
            Term::Name(name) => Some(name.clone()),
            Term::Number(_) | Term::Quoted(_) => None,
        };
        terms.into_iter().flatten().filter_map(name).collect()
    }

    fn lone_name(&self) -> Option<&str> {
        match (&self.first, &self.rest) {
            (Term::Name(name), None) => Some(name),
            _ => None,
        }
    }

    /// The word that this is, in a table with these columns.
    fn word(&self, sheet: &Sheet) -> Option<&str> {
        match (&self.first, &self.rest) {
            (Term::Quoted(word), None) => Some(word),
            _ => self.lone_name().filter(|name| sheet.place(name).is_none()),
        }
    }

    /// Finds the columns.
    ///
    /// # Errors
    /// A name that is no column, with those that are.
    pub fn bind(&self, binding: &Binding<'_>) -> Result<Bound, String> {
        let value = |term: &Term| match term {
            Term::Number(number) => Ok(Value::Number(*number)),
            Term::Name(name) => binding.column(name),
            Term::Quoted(word) => Err(format!("'{word}' is a word, where a number or a column is needed")),
        };
        let rest = self.rest.as_ref().map(|(sign, term)| Ok::<_, String>((*sign, value(term)?))).transpose()?;
        Ok(Bound { first: value(&self.first)?, rest })
    }
}

impl Binding<'_> {
    fn column(&self, name: &str) -> Result<Value, String> {
        let place = self.sheet.place(name).ok_or_else(|| self.sheet.no_column(name))?;
        let source = match self.errors {
            Some((columns, errors)) if columns.iter().any(|column| column == name) => Source::Column(errors),
            _ => self.sheet.error(place).map_or(Source::Nowhere, Source::Stated),
        };
        Ok(Value::Column(place, source))
    }
}

impl Bound {
    /// The value in a row; nothing where a cell is empty.
    ///
    /// # Errors
    /// A cell is a word.
    pub fn value(&self, sheet: &Sheet, row: usize) -> Result<Option<Uncertain>, String> {
        let Some(first) = self.first.value(sheet, row)? else { return Ok(None) };
        match self.rest {
            None => Ok(Some(first)),
            Some((sign, other)) => Ok(other.value(sheet, row)?.map(|other| first.combine(sign, other))),
        }
    }
}

impl Value {
    fn value(self, sheet: &Sheet, row: usize) -> Result<Option<Uncertain>, String> {
        let (place, source) = match self {
            Value::Number(number) => return Ok(Some(Uncertain::exact(number))),
            Value::Column(place, source) => (place, source),
        };
        let Some(value) = number(sheet, place, row)? else { return Ok(None) };
        let error = match source {
            Source::Stated(stated) => stated.at(value),
            Source::Nowhere => 0.0,
            Source::Column(errors) => {
                let error = number(sheet, errors, row)?;
                error
                    .map(f64::abs)
                    .ok_or_else(|| format!("row {row} (from 0): {} is empty beside a value", sheet.names()[errors]))?
            }
        };
        Ok(Some(Uncertain { value, error }))
    }
}

fn number(sheet: &Sheet, place: usize, row: usize) -> Result<Option<f64>, String> {
    match sheet.cell(place, row) {
        Cell::Empty => Ok(None),
        Cell::Number(number) => Ok(Some(*number)),
        Cell::Word(word) => {
            Err(format!("row {row} (from 0): {} is the word {word:?}, where a number is needed", sheet.names()[place]))
        }
    }
}

impl Condition {
    /// Reads a condition; blanks stand around the relation.
    ///
    /// # Errors
    /// What is wrong and what would be valid.
    pub fn parse(text: &str) -> Result<Condition, String> {
        let tokens: Vec<&str> = text.split_whitespace().collect();
        let found = tokens.iter().enumerate().find_map(|(at, token)| Some((at, Relation::parse(token)?)));
        let valid = "valid: `column op other`, op one of < <= > >= = !=, other a number, a column or a word";
        let (at, relation) = found.ok_or_else(|| format!("{text:?}: no comparison; {valid}"))?;
        let side = |tokens: &[&str]| {
            Expression::from_tokens(tokens).map_err(|problem| format!("{text:?}: {problem}; {valid}"))
        };
        Ok(Condition { left: side(&tokens[..at])?, relation, right: side(&tokens[at + 1..])? })
    }

    /// Finds the columns. A name on the right that is no column is a word, which must stand somewhere in the column on the
    /// left: a slip of the pen selects nothing otherwise, and nobody notices.
    ///
    /// # Errors
    /// A name that is no column, a word that stands nowhere, or words that are to be ordered.
    pub fn bind(&self, binding: &Binding<'_>) -> Result<BoundCondition, String> {
        let Some(word) = self.right.word(binding.sheet) else {
            let (left, right) = (self.left.bind(binding)?, self.right.bind(binding)?);
            return Ok(BoundCondition::Numbers(left, self.relation, right));
        };
        let name = self.left.lone_name().ok_or_else(|| binding.sheet.no_column(word))?;
        let place = binding.sheet.place(name).ok_or_else(|| binding.sheet.no_column(name))?;
        let is_equal = match self.relation {
            Relation::Equal => true,
            Relation::Unequal => false,
            _ => {
                return Err(format!(
                    "{word} is no column, and words are not ordered; {}",
                    binding.sheet.no_column(word)
                ));
            }
        };
        let wanted = if word == EMPTY { Cell::Empty } else { Cell::Word(word.into()) };
        if wanted != Cell::Empty && !binding.sheet.column(place).any(|cell| *cell == wanted) {
            let words = words(binding.sheet.column(place));
            return Err(format!("{word} is no column and stands nowhere in column {name}{words}"));
        }
        Ok(BoundCondition::Word(place, is_equal, wanted))
    }
}

/// The words of a column, for a message.
fn words<'a>(cells: impl Iterator<Item = &'a Cell>) -> String {
    let mut words: Vec<&str> = Vec::new();
    for cell in cells {
        match cell {
            Cell::Word(word) if !words.contains(&word.as_str()) => words.push(word),
            _ => {}
        }
    }
    if words.is_empty() { ", which has no words".to_owned() } else { format!(", which has {}", words.join(", ")) }
}

impl BoundCondition {
    /// Whether it holds in a row. A comparison with an empty cell does not.
    ///
    /// # Errors
    /// A word where a number is needed.
    pub fn holds(&self, sheet: &Sheet, row: usize) -> Result<Outcome, String> {
        match self {
            BoundCondition::Word(place, is_equal, wanted) => {
                let is_same = *sheet.cell(*place, row) == *wanted;
                Ok(Outcome::of(is_same == *is_equal, is_same != *is_equal))
            }
            BoundCondition::Numbers(left, relation, right) => {
                let sides = left.value(sheet, row)?.zip(right.value(sheet, row)?);
                Ok(sides.map_or(Outcome::False, |(left, right)| left.compare(*relation, right)))
            }
        }
    }
}
