//! A Pratt parser: tokens to a tree.
//!
//! | binds | operator | to the |
//! |---|---|---|
//! | tightest | `^` | right; its exponent may have a sign |
//! | | unary `-` | |
//! | | `* /` | left |
//! | loosest | `+ -` | left |

mod neighbours;

use crate::limits::DEEPEST;
use crate::names;
use crate::operation::{Binary, Unary};
use crate::place::{Location, Problem};
use crate::token::{Lexeme, Token, tokens};
use crate::tree::{Entry, Tree};

/// Which words an expression may contain.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Vocabulary {
    /// Functions, constants, names, and what only a law has: `s v x sum`.
    Law,
    /// Functions, constants, names.
    Free,
}

const SUM_OF_TERMS: u8 = 10;
const PRODUCT: u8 = 20;
const SIGN: u8 = 30;
const POWER: u8 = 40;
const OPERAND: &str = "a number, a name, a function, ( or -";
const OPERATOR: &str = "an operator + - * / ^ or the end";

/// Parses the text of one expression whose first character is at `start`.
pub(crate) fn parse(text: &str, start: Location, vocabulary: Vocabulary) -> Result<Tree, Problem> {
    let lexemes = tokens(text, start)?;
    let mut parser = Parser { lexemes, at: 0, depth: 0, in_sum: false, vocabulary, tree: Tree::default() };
    parser.expression(0)?;
    match parser.next().token {
        Token::End => Ok(parser.tree),
        _ => Err(parser.left_over()),
    }
}

struct Parser<'a> {
    lexemes: Vec<Lexeme<'a>>,
    at: usize,
    depth: usize,
    in_sum: bool,
    vocabulary: Vocabulary,
    tree: Tree,
}

impl<'a> Parser<'a> {
    /// The next token; the end again and again.
    fn next(&self) -> Lexeme<'a> {
        self.lexemes[self.at.min(self.lexemes.len() - 1)]
    }

    fn take_symbol(&mut self, symbol: char) -> bool {
        let is_next = self.next().token == Token::Symbol(symbol);
        self.at += usize::from(is_next);
        is_next
    }

    fn push(&mut self, entry: Entry, place: Location) {
        self.tree.entries.push((entry, place));
    }

    fn unexpected(&self, valid: impl Into<String>) -> Problem {
        let Lexeme { token, text, place, .. } = self.next();
        let found = if token == Token::End { "the end of the expression".to_owned() } else { format!("`{text}`") };
        Problem::new(place, found, valid)
    }

    /// An expression whose operators bind at least as tightly as `weakest`.
    fn expression(&mut self, weakest: u8) -> Result<(), Problem> {
        if self.depth == DEEPEST {
            let found = format!("brackets, signs or exponents more than {DEEPEST} deep");
            return Err(Problem::new(self.next().place, found, "less nesting; named expressions help"));
        }
        self.depth += 1;
        self.operand()?;
        loop {
            let Lexeme { token, place, .. } = self.next();
            let (binary, strength) = match token {
                Token::Symbol('+') => (Binary::Add, SUM_OF_TERMS),
                Token::Symbol('-') => (Binary::Sub, SUM_OF_TERMS),
                Token::Symbol('*') => (Binary::Mul, PRODUCT),
                Token::Symbol('/') => (Binary::Div, PRODUCT),
                Token::Symbol('^') => (Binary::Pow, POWER),
                Token::Symbol('(' | '[') | Token::Number(_) | Token::Name(_) => return Err(self.implicit_product()),
                Token::Symbol(_) | Token::End => break,
            };
            if strength < weakest {
                break;
            }
            self.at += 1;
            // equal operators continue to the left, but powers to the right
            self.expression(if binary == Binary::Pow { strength } else { strength + 1 })?;
            self.push(Entry::Binary(binary), place);
        }
        self.depth -= 1;
        Ok(())
    }

    fn operand(&mut self) -> Result<(), Problem> {
        let Lexeme { token, place, text, .. } = self.next();
        match token {
            Token::Number(value) => {
                self.at += 1;
                self.push(Entry::Number(value), place);
            }
            Token::Symbol('-') => {
                self.at += 1;
                self.expression(SIGN)?;
                self.push(Entry::Unary(Unary::Neg), place);
            }
            Token::Symbol('(') => {
                self.at += 1;
                self.expression(0)?;
                self.close(')', "(", place)?;
            }
            Token::Name(name) => {
                self.at += 1;
                self.word(name, place)?;
            }
            Token::Symbol(')' | ']') => {
                return Err(Problem::new(place, format!("`{text}` where an operand is missing"), OPERAND));
            }
            _ => return Err(self.unexpected(OPERAND)),
        }
        Ok(())
    }

    /// The meaning of a name that has just been read.
    fn word(&mut self, name: &str, place: Location) -> Result<(), Problem> {
        let is_law = self.vocabulary == Vocabulary::Law;
        let is_operand =
            matches!(self.next().token, Token::End | Token::Symbol(')' | ',' | '+' | '-' | '*' | '/' | '^'));
        if !is_law && is_operand && names::functions().any(|known| known == name) {
            // the ledger's columns have such names
            self.push(Entry::Name(name.into()), place);
            Ok(())
        } else if let Some((_, unary)) = names::UNARY.iter().find(|(known, _)| *known == name) {
            self.arguments(name, place, 1, false, Entry::Unary(*unary))
        } else if let Some((_, binary)) = names::CHOICES.iter().find(|(known, _)| *known == name) {
            self.arguments(name, place, 2, true, Entry::Binary(*binary))
        } else if name == names::RAMP {
            self.arguments(name, place, 2, false, Entry::Ramp)
        } else if let Some((_, value)) = names::CONSTANTS.iter().find(|(known, _)| *known == name) {
            self.push(Entry::Number(*value), place);
            Ok(())
        } else if is_law && name == names::SUM {
            self.sum(place)
        } else if is_law && name == names::INDEX {
            if !self.in_sum {
                return Err(Problem::new(place, "`j` outside of a sum", format!("j within {}", neighbours::SUM_FORM)));
            }
            self.push(Entry::SumIndex, place);
            Ok(())
        } else if is_law && names::VARIABLES.contains(&name) {
            self.neighbour(name, place)
        } else {
            if let Lexeme { token: Token::Symbol('('), joined: true, .. } = self.next() {
                return Err(no_function(name, place));
            }
            self.push(Entry::Name(name.into()), place);
            Ok(())
        }
    }

    /// The arguments of a function: exactly `least`, or as many more as one likes, each of which is combined with those
    /// before.
    fn arguments(
        &mut self,
        name: &str,
        place: Location,
        least: usize,
        takes_more: bool,
        entry: Entry,
    ) -> Result<(), Problem> {
        let form = match (least, takes_more) {
            (_, true) => format!("{name}(A, B) with 2 arguments or more"),
            (1, _) => format!("{name}(EXPRESSION) with 1 argument"),
            _ => format!("{name}(EXPRESSION, WIDTH) with 2 arguments"),
        };
        if !self.take_symbol('(') {
            return Err(Problem::new(place, format!("`{name}` without arguments"), form));
        }
        let mut found = 0;
        loop {
            self.expression(0)?;
            found += 1;
            if found >= least {
                self.push(entry.clone(), place);
            }
            if self.next().token != Token::Symbol(',') {
                break;
            }
            if found == least && !takes_more {
                let valid = self.decimal_comma(self.at).unwrap_or(form);
                return Err(Problem::new(
                    self.next().place,
                    format!("a comma behind the arguments of `{name}`"),
                    valid,
                ));
            }
            self.at += 1;
        }
        self.close(')', &format!("{name}("), place)?;
        if found < least {
            return Err(Problem::new(place, format!("`{name}` with {found} argument"), form));
        }
        Ok(())
    }

    /// The closing bracket of what was opened at `place`.
    fn close(&mut self, bracket: char, opened: &str, place: Location) -> Result<(), Problem> {
        if self.take_symbol(bracket) {
            return Ok(());
        }
        if self.next().token == Token::Symbol(',') {
            return Err(self.left_over());
        }
        let missing = self.unexpected("");
        Err(Problem::new(
            missing.place,
            format!("{} where `{opened}` of {place} is not closed", missing.found),
            format!("{bracket} or an operator + - * / ^"),
        ))
    }

    /// Two operands side by side.
    fn implicit_product(&self) -> Problem {
        let (before, found) = (self.lexemes[self.at - 1], self.next());
        if found.token == Token::Symbol('[') {
            return Problem::new(
                found.place,
                format!("`[` behind `{}`", before.text),
                "s[j], v[j] or x[j] for neighbours, ( ) elsewhere",
            );
        }
        Problem::new(
            found.place,
            format!("`{}` behind `{}`, without an operator", found.text, before.text),
            format!(
                "a product is written {}*{}{}; {OPERATOR}",
                before.text,
                found.text,
                if found.text == "(" { "...)" } else { "" }
            ),
        )
    }

    /// What cannot follow a whole expression.
    fn left_over(&self) -> Problem {
        let Lexeme { token, text, place, .. } = self.next();
        match token {
            Token::Symbol(')' | ']') => Problem::new(place, format!("`{text}`, which closes nothing"), OPERATOR),
            Token::Symbol(',') => match self.decimal_comma(self.at) {
                Some(valid) => Problem::new(place, "a decimal comma", valid),
                None => Problem::new(place, "a comma outside of the arguments of a function", OPERATOR),
            },
            _ => self.unexpected(OPERATOR),
        }
    }

    /// What to write if the comma at `comma` joins two numbers.
    fn decimal_comma(&self, comma: usize) -> Option<String> {
        let (before, after) = (self.lexemes.get(comma.checked_sub(1)?)?, self.lexemes.get(comma + 1)?);
        let numbers = [before, after].iter().all(|lexeme| matches!(lexeme.token, Token::Number(_)));
        let joined = numbers && after.joined && self.lexemes[comma].joined;
        joined.then(|| format!("a decimal point: {}.{}", before.text, after.text))
    }
}

/// A name with a bracket behind it that is not a function.
fn no_function(name: &str, place: Location) -> Problem {
    let functions: Vec<&str> = names::functions().collect();
    let elsewhere = names::ELSEWHERE.iter().find(|(other, _)| *other == name).map(|(_, here)| *here);
    let near = elsewhere.or_else(|| names::nearest(name, functions.iter().copied()));
    let hint = near.map_or(String::new(), |near| format!("{near}(...)? "));
    let valid = format!("{hint}functions {}; {name}*(...) for a product", functions.join(" "));
    Problem::new(place, format!("`{name}(`, which is not a function"), valid)
}
