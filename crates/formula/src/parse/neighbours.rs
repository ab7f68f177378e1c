//! The part of the grammar that only laws have: quantities of neighbours, and sums over them.

use super::Parser;
use crate::limits::FARTHEST;
use crate::names;
use crate::place::{Location, Problem};
use crate::token::{Lexeme, Token};
use crate::tree::{Entry, Index, Quantity};

pub(super) const SUM_FORM: &str =
    "sum(j, FROM, TO, EXPRESSION) with whole numbers FROM <= TO, such as sum(j, 1, 30, 1/x[j])";

impl Parser<'_> {
    /// `s`, `v`, `s[j]`, `v[j]`, `x[j]`.
    pub(super) fn neighbour(&mut self, name: &str, place: Location) -> Result<(), Problem> {
        let quantity = match name {
            "s" => Quantity::Spacing,
            "v" => Quantity::Speed,
            _ => Quantity::Distance,
        };
        let bracket = self.next().place;
        let index = if self.take_symbol('[') {
            let index = self.index(name)?;
            self.close(']', &format!("{name}["), bracket)?;
            index
        } else if quantity == Quantity::Distance {
            return Err(Problem::new(place, "`x` alone", "x[j], the distance to pedestrian n + j, such as x[1]"));
        } else if self.next().token == Token::Symbol('(') && self.next().joined {
            return Err(Problem::new(
                place,
                format!("`{name}(`"),
                format!("{name}[1] for a neighbour, {name}*(...) for a product"),
            ));
        } else {
            Index::default()
        };
        self.push(Entry::Neighbour(quantity, index), place);
        Ok(())
    }

    /// Which pedestrian: a sum of whole numbers, `j`, and whole multiples of `j`.
    fn index(&mut self, name: &str) -> Result<Index, Problem> {
        let mut index = Index::default();
        let mut is_first = true;
        loop {
            let sign = match self.next().token {
                Token::Symbol('-') => -1,
                Token::Symbol('+') if !is_first => 1,
                _ if is_first => 0,
                _ => return Ok(index),
            };
            self.at += usize::from(sign != 0);
            let sign = if sign < 0 { -1 } else { 1 };
            is_first = false;
            let place = self.next().place;
            let (number, factor) = self.index_term(name)?;
            let sum = if factor { &mut index.factor } else { &mut index.offset };
            *sum += sign * number;
            if sum.abs() > FARTHEST {
                return Err(Problem::new(
                    place,
                    format!("a neighbour {sum} places away"),
                    format!("-{FARTHEST} to {FARTHEST}"),
                ));
            }
        }
    }

    /// A whole number, or one with `j` (then true).
    fn index_term(&mut self, name: &str) -> Result<(i32, bool), Problem> {
        let at_j = |parser: &Parser<'_>| parser.next().token == Token::Name(names::INDEX);
        if at_j(self) && self.in_sum {
            self.at += 1;
            return Ok((1, true));
        }
        if at_j(self) {
            return Err(self.unexpected(format!("a whole number such as {name}[1]; j only within a sum")));
        }
        let number =
            self.whole(&format!("a whole number such as {name}[1] or {name}[-1], or within a sum {name}[j]"))?;
        if self.next().token == Token::Symbol('*') {
            self.at += 1;
            if !(at_j(self) && self.in_sum) {
                return Err(self.unexpected("j within a sum"));
            }
            self.at += 1;
            return Ok((number, true));
        }
        Ok((number, false))
    }

    /// A whole number without a sign.
    fn whole(&mut self, valid: &str) -> Result<i32, Problem> {
        let Lexeme { token, text, place, .. } = self.next();
        match text.parse::<i32>() {
            Ok(number) if matches!(token, Token::Number(_)) && number <= FARTHEST => {
                self.at += 1;
                Ok(number)
            }
            _ if matches!(token, Token::Number(_)) && text.bytes().all(|byte| byte.is_ascii_digit()) => {
                Err(Problem::new(place, text, format!("up to {FARTHEST}")))
            }
            _ => Err(self.unexpected(valid)),
        }
    }

    /// `sum(j, 1, 30, EXPRESSION)`, behind its name.
    pub(super) fn sum(&mut self, place: Location) -> Result<(), Problem> {
        if self.in_sum {
            return Err(Problem::new(place, "a sum within a sum", "one sum, whose index is j"));
        }
        let comma = |parser: &mut Self| match parser.take_symbol(',') {
            true => Ok(()),
            false => Err(parser.unexpected(SUM_FORM)),
        };
        if !self.take_symbol('(') || self.next().token != Token::Name(names::INDEX) {
            return Err(self.unexpected(SUM_FORM));
        }
        self.at += 1;
        comma(self)?;
        let from = self.bound()?;
        comma(self)?;
        let at = self.next().place;
        let to = self.bound()?;
        if to < from {
            return Err(Problem::new(at, format!("a sum from {from} to {to}"), SUM_FORM));
        }
        comma(self)?;
        let header = self.tree.entries.len();
        self.push(Entry::Sum { from, to, length: 0 }, place);
        self.in_sum = true;
        self.expression(0)?;
        self.in_sum = false;
        self.close(')', "sum(", place)?;
        let length = self.tree.entries.len() - header - 1;
        self.tree.entries[header].0 = Entry::Sum { from, to, length };
        Ok(())
    }

    /// A bound of a sum.
    fn bound(&mut self) -> Result<i32, Problem> {
        let is_negative = self.take_symbol('-');
        let number = self.whole(SUM_FORM)?;
        Ok(if is_negative { -number } else { number })
    }
}
