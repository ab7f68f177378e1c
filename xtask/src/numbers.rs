//! How far two tables are from each other.

use files::table::Table;
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
}

/// How far two tables of the same shape are apart.
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
}

/// Compares a committed sample with a fresh one; both hold every `step`-th row of a table.
///
/// # Errors
/// The tables have other columns or another number of rows; both are named.
pub fn compare(golden: &Table, fresh: &Table, step: usize) -> Result<Distance, String> {
    if golden.columns != fresh.columns {
        return Err(format!("columns {} in place of {}", fresh.columns.join(","), golden.columns.join(",")));
    }
    if golden.len() != fresh.len() {
        return Err(format!("{} sampled rows in place of {}", fresh.len(), golden.len()));
    }
    let mut distance = Distance::default();
    for (index, (expected, found)) in golden.rows().zip(fresh.rows()).enumerate() {
        for (column, (&a, &b)) in expected.iter().zip(found).enumerate() {
            if a.to_bits() != b.to_bits() {
                let raise = |worst: &mut Worst, value: f64| {
                    if value > worst.value {
                        *worst = Worst { value, row: index * step, column: golden.columns[column].clone() };
                    }
                };
                distance.cells += 1;
                raise(&mut distance.absolute, (a - b).abs());
                raise(&mut distance.relative, relative(a, b));
                raise(&mut distance.ulp, ulps(a, b) as f64);
            }
        }
    }
    Ok(distance)
}

/// |a - b| / max(|a|, |b|); 0 when both are zero.
pub fn relative(a: f64, b: f64) -> f64 {
    let scale = if a.abs() > b.abs() { a.abs() } else { b.abs() };
    if scale > 0.0 { (a - b).abs() / scale } else { 0.0 }
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
