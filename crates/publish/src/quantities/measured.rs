//! Numbers read from tables, as `paper/quantities.toml` defines them (its header explains the format).

use super::{Quantities, Source};
use checkout::disk;
use checkout::failure::Failure;
use checkout::paths::Paths;
use claims::entry::Measure;
use claims::measure::{each, evaluate};
use claims::source::ClaimLocation;
use claims::tables::Tables;
use claims::uncertain::Uncertain;
use claims::words;

/// The file, by name.
const FILE: &str = "paper/quantities.toml";

/// Adds all of them.
///
/// # Errors
/// Stale: a table of a figure is missing. Usage: an entry is malformed, or a table lacks a column or a row.
pub fn collect(source: &Source<'_>, all: &mut Quantities) -> Result<(), Failure> {
    let text = disk::read_text(&source.paths.root.join(FILE))?.unwrap_or_default();
    let entries: toml::Table = toml::from_str(&text).map_err(|error| Failure::Usage(format!("{FILE}: {error}")))?;
    let tables = Tables::new(source.paths, source.paths)?;
    for (name, entry) in entries {
        let place = ClaimLocation(format!("{FILE}, {name}"));
        match entry {
            toml::Value::Float(number) => all.exact(&name, number, FILE),
            toml::Value::Integer(number) => all.exact(&name, number as f64, FILE),
            toml::Value::Array(list) => list.into_iter().try_for_each(|one| add(all, &name, one, &tables, &place))?,
            one => add(all, &name, one, &tables, &place)?,
        }
    }
    Ok(())
}

fn add(
    all: &mut Quantities,
    name: &str,
    mut entry: toml::Value,
    tables: &Tables<'_>,
    place: &ClaimLocation,
) -> Result<(), Failure> {
    let digits = entry.as_table_mut().and_then(|table| table.remove("digits")).and_then(|digits| digits.as_integer());
    let measure: Measure = entry.try_into().map_err(|error: toml::de::Error| place.fail("", error.message()))?;
    measure.check(place)?;
    if let Some(table) = measure.tables(place)?.iter().find(|table| !tables.has(table)) {
        return Err(Failure::Stale(format!("{}: no such table; cargo xtask figures --all", Paths::table(table))));
    }
    let from = words::describe(&measure, place)?;
    let mut put = |name: &str, Uncertain { value, error }: Uncertain| match digits {
        Some(digits) => all.rounded(name, value, digits as usize, &from),
        None if measure.error_of.is_some() => all.uncertain(name, value, error, &from),
        None => all.exact(name, value, &from),
    };
    if !name.contains('{') {
        put(name, evaluate(&measure, tables, place)?);
        return Ok(());
    }
    let (sheet, rows) = each(&measure, tables, place)?;
    for (row, value) in rows {
        let cells = sheet.names().iter().enumerate().map(|(at, column)| (column, sheet.cell(at, row).to_string()));
        let name = cells.fold(name.to_owned(), |name, (column, cell)| name.replace(&format!("{{{column}}}"), &cell));
        put(&name, value);
    }
    Ok(())
}
