//! Distances between two tables.

use files::pairs::{KEYS, Pair, pairs};
use files::table::{CellValue, MixedTable};
use serde::Serialize;

/// A distance and where it was found.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Worst {
    /// The distance.
    pub value: f64,
    /// The row of the full table, the first after the header is 0.
    pub row: usize,
    /// The column.
    pub column: String,
    /// The cells that name the row, `t = 5, n = 3`; empty for a table without them.
    pub at: String,
}

/// How the differences of one column go along t.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Course {
    /// The column: that of the largest absolute difference.
    pub column: String,
    /// The first t at which it differs.
    pub since: f64,
    /// Largest absolute difference in each quarter of the rows.
    pub quarters: [f64; 4],
    /// What the quarters say: see [`Course::word`].
    pub course: &'static str,
}

/// How far two tables are apart, over the rows that both have.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Distance {
    /// Cells that are not equal.
    pub cells: usize,
    /// Largest |a - b|.
    pub absolute: Worst,
    /// Largest |a - b| / max(|a|, |b|).
    pub relative: Worst,
    /// Largest number of doubles that lie between.
    pub ulp: Worst,
    /// Cells further apart than the tolerance of their column.
    pub beyond: usize,
    /// The cell that is furthest beyond the tolerance, with |a - b|; none when all are within.
    pub furthest: Option<Worst>,
    /// Rows that only one of the two has.
    pub unmatched: usize,
    /// How the differences go along t; none for a table without t, or without differences.
    pub course: Option<Course>,
}

/// How far two values of a column may be apart; all three are added.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tolerance {
    /// In units of the column.
    pub absolute: f64,
    /// Times the larger of the two values.
    pub relative: f64,
    /// Times the largest absolute value of the committed column.
    pub of_scale: f64,
}

/// By how much quarters must differ to be called growing or shrinking.
const CLEARLY: f64 = 4.0;

/// Compares a committed table (or every `step`-th row of one) with a fresh one. `tolerance` gives that of a column.
///
/// # Errors
/// The tables have other columns; both are named.
pub fn compare(
    committed: &MixedTable,
    fresh: &MixedTable,
    step: usize,
    tolerance: &dyn Fn(&str) -> Tolerance,
) -> Result<Distance, String> {
    if committed.columns != fresh.columns {
        return Err(format!("expected the columns {}, found {}", committed.columns.join(","), fresh.columns.join(",")));
    }
    let (pairs, unmatched) = pairs(committed, fresh);
    let mut distance = Distance { unmatched, ..Distance::default() };
    let mut excess = 0.0;
    let allowed: Vec<(f64, f64)> = committed.columns.iter().map(|name| constant(committed, name, tolerance)).collect();
    for &(row, expected, found) in &pairs {
        for (column, (a, b)) in expected.iter().zip(found).enumerate() {
            if same(a, b) {
                continue;
            }
            let worst = |value: f64| Worst {
                value,
                row: row * step,
                column: committed.columns[column].clone(),
                at: place(committed, expected),
            };
            let raise = |old: &mut Worst, value: f64| {
                if value > old.value {
                    *old = worst(value);
                }
            };
            let apart = apart(a, b);
            let (a, b) = (a.number(), b.number());
            distance.cells += 1;
            raise(&mut distance.absolute, apart);
            raise(&mut distance.relative, a.zip(b).map_or(f64::INFINITY, |(a, b)| relative(a, b)));
            raise(&mut distance.ulp, a.zip(b).map_or(f64::INFINITY, |(a, b)| ulps(a, b) as f64));
            let (constant, times) = allowed[column];
            let limit = constant + times * a.zip(b).map_or(0.0, |(a, b)| larger(a, b));
            let within = apart <= limit;
            if !within {
                let over = if limit.is_finite() { apart - limit } else { apart };
                distance.beyond += 1;
                if over > excess {
                    excess = over;
                    distance.furthest = Some(worst(apart));
                }
            }
        }
    }
    distance.course = course(committed, &pairs, &distance.absolute.column);
    Ok(distance)
}

/// The part of a column's tolerance that is the same for all rows, and the part relative to a value.
fn constant(committed: &MixedTable, column: &str, tolerance: &dyn Fn(&str) -> Tolerance) -> (f64, f64) {
    let Tolerance { absolute, relative, of_scale } = tolerance(column);
    let values = committed.column(column).unwrap_or_default();
    let scale = values.iter().filter_map(CellValue::number).map(f64::abs).max_by(f64::total_cmp).unwrap_or(0.0);
    (absolute + of_scale * scale, relative)
}

/// The cells that name a row.
fn place(table: &MixedTable, row: &[CellValue]) -> String {
    let named = table.columns.iter().zip(row).filter(|(name, _)| KEYS.contains(&name.as_str()));
    named.map(|(name, value)| format!("{name} = {value}")).collect::<Vec<_>>().join(", ")
}

fn course(committed: &MixedTable, pairs: &[Pair<'_, CellValue>], column: &str) -> Option<Course> {
    let index = |name: &str| committed.columns.iter().position(|other| other == name);
    let (t, value) = (index("t")?, index(column)?);
    let apart = |(_, a, b): &Pair<'_, CellValue>| apart(&a[value], &b[value]);
    let differs = |(_, a, b): &&Pair<'_, CellValue>| !same(&a[value], &b[value]);
    let since = pairs.iter().find(differs)?.1[t].number()?;
    let quarter = pairs.len().div_ceil(4).max(1);
    let mut quarters = [0.0; 4];
    for (largest, rows) in quarters.iter_mut().zip(pairs.chunks(quarter)) {
        *largest = rows.iter().map(apart).max_by(f64::total_cmp).unwrap_or(0.0);
    }
    let differing = pairs.iter().filter(differs).count();
    let course = if differing == 1 { "in one row" } else { Course::word(&quarters) };
    Some(Course { column: column.to_owned(), since, quarters, course })
}

impl Course {
    /// `growing` when the last quarter has clearly larger differences than the first, `shrinking` the other way
    /// round, else `constant`.
    pub fn word(quarters: &[f64; 4]) -> &'static str {
        let [first, .., last] = *quarters;
        match () {
            () if last > CLEARLY * first => "growing",
            () if first > CLEARLY * last => "shrinking",
            () => "constant",
        }
    }
}

/// |a - b| / max(|a|, |b|); 0 when both are zero.
pub fn relative(a: f64, b: f64) -> f64 {
    let scale = larger(a, b);
    if scale > 0.0 { (a - b).abs() / scale } else { 0.0 }
}

/// Whether two cells are the same, to the bit.
fn same(a: &CellValue, b: &CellValue) -> bool {
    match (a, b) {
        (CellValue::Number(a), CellValue::Number(b)) => a.to_bits() == b.to_bits(),
        _ => a == b,
    }
}

/// |a - b|; infinite for cells that differ and are not both numbers.
fn apart(a: &CellValue, b: &CellValue) -> f64 {
    match (a, b) {
        (CellValue::Number(a), CellValue::Number(b)) => (a - b).abs(),
        _ if a == b => 0.0,
        _ => f64::INFINITY,
    }
}

fn larger(a: f64, b: f64) -> f64 {
    if a.abs() > b.abs() { a.abs() } else { b.abs() }
}

/// The number of steps from one double to the next that lead from `a` to `b`; -0 and 0 are one step apart.
pub fn ulps(a: f64, b: f64) -> u64 {
    // bits of a double sort like its value once negative ones are turned round
    let place = |x: f64| {
        let bits = x.to_bits();
        if bits >> 63 == 1 { !bits } else { bits | (1 << 63) }
    };
    place(a).abs_diff(place(b))
}
