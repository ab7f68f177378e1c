//! The expressions in `of` and `where`: formulas and comparisons whose names are columns.

use crate::sheet::{LedgerTable, Stated};
use crate::uncertain::{Outcome, Relation, Uncertain};
use files::table::CellValue;
use formula::Location;

/// `v`, `2`, `v - v_beside`: a formula whose names are columns.
#[derive(Clone, Debug)]
pub struct Expression(formula::Expression);

/// The right of a comparison: a formula, or a word; in quotes where a column has that name.
#[derive(Clone, Debug)]
struct Right {
    text: String,
    expression: Option<Expression>,
}

/// `phi < 0`, `event = overlap`, `overlap_t != empty`, `v < 0.4 * v0`.
#[derive(Clone, Debug)]
pub struct Condition {
    left: Expression,
    relation: Relation,
    right: Right,
}

/// The source of the errors of a column.
#[derive(Clone, Copy, Debug)]
enum Source {
    /// It is stated for the whole column.
    Stated(Stated),
    /// Nothing is stated: numbers are taken as they are written.
    Nowhere,
    /// In this column.
    Column(usize),
}

/// An expression whose names are columns of a certain sheet.
#[derive(Clone, Debug)]
pub struct Bound {
    expression: Expression,
    columns: Vec<(usize, Source)>,
}

/// A condition whose names are columns of a certain sheet.
#[derive(Clone, Debug)]
#[expect(clippy::large_enum_variant, reason = "one lives while a table is judged")]
pub enum BoundCondition {
    /// Both sides are numbers.
    Numbers(Bound, Relation, Bound),
    /// A column against a word: equal, or not.
    Word(usize, bool, CellValue),
}

/// The word that denotes an empty cell.
pub const EMPTY: &str = "empty";

/// How the names of a measure are bound to columns.
pub struct Binding<'a> {
    /// The table.
    pub sheet: &'a LedgerTable,
    /// Columns whose error is in another column, with that column.
    pub errors: Option<(&'a [String], usize)>,
}

impl Expression {
    /// Reads an expression.
    ///
    /// # Errors
    /// What is wrong, at which column of the text, and what would be valid.
    pub fn parse(text: &str) -> Result<Expression, String> {
        let parsed = formula::Expression::parse("", Location { line: 1, column: 1 }, text);
        parsed.map(Expression).map_err(|error| {
            format!("{text:?}: column {}: {}; valid: {}", error.place.column, error.found, error.valid)
        })
    }

    /// The names in it.
    pub fn names(&self) -> Vec<String> {
        self.0.names().iter().map(|(name, _)| name.clone()).collect()
    }

    /// Finds the columns.
    ///
    /// # Errors
    /// A name that is no column, with those that are.
    pub fn bind(&self, binding: &Binding<'_>) -> Result<Bound, String> {
        let columns = self.0.names().iter().map(|(name, _)| binding.column(name)).collect::<Result<_, _>>()?;
        Ok(Bound { expression: self.clone(), columns })
    }
}

impl Right {
    fn parse(text: &str) -> Result<Right, String> {
        let is_word = text.bytes().all(|byte| byte.is_ascii_alphanumeric() || b"_-'".contains(&byte));
        let expression = match Expression::parse(text) {
            Err(_) if is_word && !text.is_empty() => None,
            parsed => Some(parsed?),
        };
        Ok(Right { text: text.to_owned(), expression })
    }

    /// The formula, if all its names are columns; one of several operands is taken for one anyway, so that its names
    /// are complained of.
    fn formula(&self, sheet: &LedgerTable) -> Option<&Expression> {
        let is_column = |name: &String| sheet.place(name).is_some();
        let expression = self.expression.as_ref()?;
        (self.text.contains(' ') || expression.names().iter().all(is_column)).then_some(expression)
    }
}

impl Binding<'_> {
    fn column(&self, name: &str) -> Result<(usize, Source), String> {
        let place = self.sheet.place(name).ok_or_else(|| self.sheet.no_column(name))?;
        let source = match self.errors {
            Some((columns, errors)) if columns.iter().any(|column| column == name) => Source::Column(errors),
            _ => self.sheet.error(place).map_or(Source::Nowhere, Source::Stated),
        };
        Ok((place, source))
    }
}

impl Bound {
    /// The value in a row; nothing where a cell is empty.
    ///
    /// # Errors
    /// A cell is a word.
    pub fn value(&self, sheet: &LedgerTable, row: usize) -> Result<Option<Uncertain>, String> {
        let cells = self.columns.iter().map(|&column| cell(column, sheet, row));
        let Some(cells) = cells.collect::<Result<Option<Vec<Uncertain>>, String>>()? else { return Ok(None) };
        Ok(Some(self.expression.0.carry_out(Uncertain::exact, |name| cells[name])))
    }
}

/// The number in a cell, with its error; nothing where it is empty.
fn cell((place, source): (usize, Source), sheet: &LedgerTable, row: usize) -> Result<Option<Uncertain>, String> {
    let Some(value) = number(sheet, place, row)? else { return Ok(None) };
    let error = match source {
        Source::Stated(stated) => stated.at(value),
        Source::Nowhere => 0.0,
        Source::Column(errors) => number(sheet, errors, row)?
            .map(f64::abs)
            .ok_or_else(|| format!("row {row} (from 0): {} is empty beside a value", sheet.names()[errors]))?,
    };
    Ok(Some(Uncertain { value, error }))
}

fn number(sheet: &LedgerTable, place: usize, row: usize) -> Result<Option<f64>, String> {
    match sheet.cell(place, row) {
        CellValue::Empty => Ok(None),
        CellValue::Number(number) => Ok(Some(*number)),
        CellValue::Word(word) => {
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
        let valid = "valid: `column op other`, op one of < <= > >= = !=, other an expression or a word";
        let (at, relation) = found.ok_or_else(|| format!("{text:?}: no comparison; {valid}"))?;
        let wrong = |problem: String| format!("{problem}; {valid}");
        let left = Expression::parse(&tokens[..at].join(" ")).map_err(wrong)?;
        let right = Right::parse(&tokens[at + 1..].join(" ")).map_err(wrong)?;
        Ok(Condition { left, relation, right })
    }

    /// Finds the columns. A name on the right that is not a column is a word, which must occur in the column on the
    /// left; otherwise a typing error would silently select nothing.
    ///
    /// # Errors
    /// A name that is no column, a word that stands nowhere, or words that are to be ordered.
    pub fn bind(&self, binding: &Binding<'_>) -> Result<BoundCondition, String> {
        if let Some(right) = self.right.formula(binding.sheet) {
            return Ok(BoundCondition::Numbers(self.left.bind(binding)?, self.relation, right.bind(binding)?));
        }
        let word = self.right.text.trim_matches('\'');
        let [name] = &self.left.names()[..] else { return Err(binding.sheet.no_column(word)) };
        let place = binding.sheet.place(name).ok_or_else(|| binding.sheet.no_column(name))?;
        let is_equal = match self.relation {
            Relation::Equal => true,
            Relation::Unequal => false,
            _ => {
                return Err(format!(
                    "{word} is not a column, and words have no order; {}",
                    binding.sheet.no_column(word)
                ));
            }
        };
        let wanted = if word == EMPTY { CellValue::Empty } else { CellValue::Word(word.into()) };
        if wanted != CellValue::Empty && !binding.sheet.column(place).any(|cell| *cell == wanted) {
            let words = words(binding.sheet.column(place));
            return Err(format!("{word} is not a column and does not occur in column {name}{words}"));
        }
        Ok(BoundCondition::Word(place, is_equal, wanted))
    }
}

/// The words of a column, for a message.
fn words<'a>(cells: impl Iterator<Item = &'a CellValue>) -> String {
    let mut words: Vec<&str> = Vec::new();
    for cell in cells {
        match cell {
            CellValue::Word(word) if !words.contains(&word.as_str()) => words.push(word),
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
    pub fn holds(&self, sheet: &LedgerTable, row: usize) -> Result<Outcome, String> {
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
