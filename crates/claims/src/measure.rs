//! Measures over tables: rows are chosen, then become one number with its error.

use crate::check::Operand;
use crate::entry::{Measure, Take};
use crate::expression::{Binding, Bound, BoundCondition, Condition, Expression};
use crate::sheet::LedgerTable;
use crate::source::ClaimLocation;
use crate::tables::Tables;
use crate::uncertain::{Outcome, Uncertain};
use checkout::failure::Failure;
use std::rc::Rc;

/// The value of a measure.
///
/// # Errors
/// Usage: a table or column that is not there, no row where one is needed, several where only one may be left, or a
/// word where a number is needed; with the place and what would be valid.
pub fn evaluate(measure: &Measure, tables: &Tables<'_>, place: &ClaimLocation) -> Result<Uncertain, Failure> {
    let own = of_table(measure, tables, place)?;
    let Some((key, operand)) = measure.operand(place)? else { return Ok(own) };
    let other = match operand {
        Operand::Number(number) => Uncertain::exact(number),
        Operand::Measure(measure) => evaluate(&measure, tables, &ClaimLocation(format!("{}, {key}", place.0)))?,
    };
    Ok(match key {
        "times" => own * other,
        "over" => own / other,
        _ => own - other,
    })
}

/// Rows of a table, from 0, each with its value.
pub type Rows = Vec<(usize, Uncertain)>;

/// The rows that are left of the table, each with its value.
///
/// # Errors
/// As [`evaluate`]; or the measure takes another one than `only`, has a second operand, or a row of which it is open
/// whether it is left.
pub fn each(measure: &Measure, tables: &Tables<'_>, place: &ClaimLocation) -> Result<(Rc<LedgerTable>, Rows), Failure> {
    if measure.take != Take::Only || measure.operand(place)?.is_some() {
        return Err(place.fail("take", "must be `only`, without a second operand, where each row gives a number"));
    }
    let (sheet, chosen, of) = looked_at(measure, tables, place)?;
    let values = of.map(|of| values(&sheet, of, &chosen)).transpose();
    let values = values.map_err(|problem| place.fail("of", of_the_table(measure, &problem)))?;
    match values {
        Some(values) if values.open.is_empty() => Ok((sheet, chosen.sure.into_iter().zip(values.sure).collect())),
        _ => Err(place.fail("where", of_the_table(measure, "errors leave open which rows are left"))),
    }
}

fn of_table(measure: &Measure, tables: &Tables<'_>, place: &ClaimLocation) -> Result<Uncertain, Failure> {
    let (sheet, chosen, of) = looked_at(measure, tables, place)?;
    if measure.take.counts() {
        return counted(measure.take, &chosen, sheet.rows()).map_err(|problem| place.fail("among", problem));
    }
    let of = of.ok_or_else(|| place.fail("of", "is missing"))?;
    let values = values(&sheet, of, &chosen).map_err(|problem| place.fail("of", of_the_table(measure, &problem)))?;
    taken(measure.take, &values).map_err(|problem| place.fail("where", of_the_table(measure, &problem)))
}

/// The table, the rows of it that are chosen, and what is taken of them; nothing where rows are counted.
fn looked_at(
    measure: &Measure,
    tables: &Tables<'_>,
    place: &ClaimLocation,
) -> Result<(Rc<LedgerTable>, Chosen, Option<Bound>), Failure> {
    let sheet = sheet(measure, tables, place)?;
    let of = measure.of.as_deref().map(Expression::parse).transpose().map_err(|problem| place.fail("of", problem))?;
    let names = of.as_ref().map(Expression::names).unwrap_or_default();
    let errors = match &measure.error_of {
        Some(name) => Some(sheet.place(name).ok_or_else(|| place.fail("error_of", sheet.no_column(name)))?),
        None => None,
    };
    let binding = Binding { sheet: &sheet, errors: errors.map(|errors| (names.as_slice(), errors)) };
    let bound = measure.conditions.iter().map(|text| Condition::parse(text)?.bind(&binding));
    let fail = |problem: String| place.fail("where", of_the_table(measure, &problem));
    let wanted = bound.collect::<Result<Vec<_>, String>>().map_err(fail)?;
    let chosen = choose(&sheet, &wanted).map_err(fail)?;
    let of = of.filter(|_| !measure.take.counts()).map(|of| of.bind(&binding)).transpose();
    let of = of.map_err(|problem| place.fail("of", of_the_table(measure, &problem)))?;
    Ok((Rc::clone(&sheet), chosen, of))
}

fn of_the_table(measure: &Measure, problem: &str) -> String {
    format!("{} ({})", problem, measure.table)
}

/// The rows of the table that are looked at, with the other table or the next rows beside them.
fn sheet(measure: &Measure, tables: &Tables<'_>, place: &ClaimLocation) -> Result<Rc<LedgerTable>, Failure> {
    let mut sheet = tables.get(&measure.table).map_err(|problem| place.fail("table", problem))?;
    if !measure.among.is_empty() {
        let fail = |problem: String| place.fail("among", of_the_table(measure, &problem));
        sheet = Rc::new(among(&sheet, &measure.among).map_err(fail)?);
    }
    if let Some(name) = &measure.beside {
        let other = tables.get(name).map_err(|problem| place.fail("beside", problem))?;
        let on = measure.on.clone().unwrap_or_else(|| keys(&sheet, &other));
        let hint = |problem: String| place.fail("beside", format!("{problem}; name the columns to share: on = [..]"));
        return sheet.beside(&other, &on).map(Rc::new).map_err(hint);
    }
    if let Some(by) = &measure.next {
        let mut on = measure.on.clone().unwrap_or_else(|| keys(&sheet, &sheet));
        on.retain(|name| name != by);
        let hint = |problem: String| place.fail("next", format!("{problem}; name the columns to share: on = [..]"));
        return sheet.next(by, &on).map(Rc::new).map_err(hint);
    }
    Ok(sheet)
}

/// The rows that meet conditions of which none may be open.
fn among(sheet: &LedgerTable, conditions: &[String]) -> Result<LedgerTable, String> {
    let binding = Binding { sheet, errors: None };
    let bound = conditions.iter().map(|text| Condition::parse(text)?.bind(&binding));
    let chosen = choose(sheet, &bound.collect::<Result<Vec<_>, String>>()?)?;
    match chosen.open.first() {
        Some(row) => Err(format!("row {row} (from 0): its error leaves open whether it belongs")),
        None => Ok(sheet.rows_only(&chosen.sure)),
    }
}

/// The columns of both tables that name rows: those without a stated error.
fn keys(sheet: &LedgerTable, other: &LedgerTable) -> Vec<String> {
    sheet.exact().filter(|name| other.exact().any(|one| one == *name)).cloned().collect()
}

/// Rows that were chosen, and those of which it is open.
#[derive(Debug, Default)]
struct Chosen {
    sure: Vec<usize>,
    open: Vec<usize>,
}

fn choose(sheet: &LedgerTable, wanted: &[BoundCondition]) -> Result<Chosen, String> {
    let mut chosen = Chosen::default();
    for row in 0..sheet.rows() {
        match hold(wanted, sheet, row)? {
            Outcome::True => chosen.sure.push(row),
            Outcome::Undecided => chosen.open.push(row),
            Outcome::False => {}
        }
    }
    Ok(chosen)
}

/// Whether all conditions hold in a row.
fn hold(conditions: &[BoundCondition], sheet: &LedgerTable, row: usize) -> Result<Outcome, String> {
    let mut all = Outcome::True;
    for condition in conditions {
        match condition.holds(sheet, row)? {
            Outcome::False => return Ok(Outcome::False),
            Outcome::Undecided => all = Outcome::Undecided,
            Outcome::True => {}
        }
    }
    Ok(all)
}

/// The number of rows, or their share of all. Rows of which it is open count as the error.
fn counted(take: Take, chosen: &Chosen, all: usize) -> Result<Uncertain, String> {
    let found = Uncertain { value: chosen.sure.len() as f64, error: chosen.open.len() as f64 };
    match (take, all) {
        (Take::Share, 0) => Err("no row is left to be a share of".to_owned()),
        (Take::Share, all) => Ok(found / Uncertain::exact(all as f64)),
        _ => Ok(found),
    }
}

struct Values {
    sure: Vec<Uncertain>,
    open: Vec<Uncertain>,
}

fn values(sheet: &LedgerTable, of: Bound, chosen: &Chosen) -> Result<Values, String> {
    let all = |rows: &[usize]| -> Result<Vec<Uncertain>, String> {
        let value = |&row: &usize| {
            let value = of.value(sheet, row)?;
            value.ok_or_else(|| {
                format!("row {row} (from 0) is empty; leave such rows out: where = [\"column != empty\"]")
            })
        };
        rows.iter().map(value).collect()
    };
    Ok(Values { sure: all(&chosen.sure)?, open: all(&chosen.open)? })
}

/// One number of many. Rows of which it is open whether they belong widen the error of the extremes; of the others
/// they leave none that is bounded.
fn taken(take: Take, values: &Values) -> Result<Uncertain, String> {
    let Values { sure, open } = values;
    let Some(first) = sure.first().copied() else {
        return Err(match open.len() {
            0 => "no row is left".to_owned(),
            open => format!("no row is left for sure, {open} perhaps"),
        });
    };
    let bounded = |value: Uncertain| match open.is_empty() {
        true => value,
        false => Uncertain { error: f64::INFINITY, ..value },
    };
    match take {
        Take::Least => Ok(extreme(values, f64::total_cmp)),
        Take::Largest => Ok(extreme(values, |a, b| b.total_cmp(a))),
        Take::Span => {
            let (least, largest) = (extreme(values, f64::total_cmp), extreme(values, |a, b| b.total_cmp(a)));
            Ok(largest - least)
        }
        Take::Mean => Ok(bounded(sum(sure) / Uncertain::exact(sure.len() as f64))),
        Take::Sum => Ok(bounded(sum(sure))),
        Take::Only if sure.len() > 1 => Err(format!("{} rows are left where `only` needs one", sure.len())),
        Take::Last => Ok(bounded(sure.last().copied().unwrap_or(first))),
        _ => Ok(bounded(first)),
    }
}

fn sum(values: &[Uncertain]) -> Uncertain {
    values.iter().fold(Uncertain::exact(0.0), |sum, &value| sum + value)
}

/// The first of the values in an order, with an interval that contains the first of the true values.
fn extreme(values: &Values, order: impl Fn(&f64, &f64) -> std::cmp::Ordering) -> Uncertain {
    let best = |values: &mut dyn Iterator<Item = f64>| values.min_by(&order);
    let sure = &values.sure;
    let value = best(&mut sure.iter().map(|one| one.value)).unwrap_or(f64::NAN);
    // the ends of the intervals, of the sure ones alone and with the open ones
    let ends = [Uncertain::low, Uncertain::high].map(|end| {
        let alone = best(&mut sure.iter().map(|one| end(*one))).unwrap_or(f64::NAN);
        let all = best(&mut sure.iter().chain(&values.open).map(|one| end(*one))).unwrap_or(f64::NAN);
        [alone, all]
    });
    let ends = ends.concat();
    let low = ends.iter().copied().min_by(f64::total_cmp).unwrap_or(f64::NAN);
    let high = ends.iter().copied().max_by(f64::total_cmp).unwrap_or(f64::NAN);
    Uncertain::between(low, high, value)
}
