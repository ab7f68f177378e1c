//! The level of numbers: tables against the committed ones, or against committed samples of them.

use crate::golden;
use crate::numbers::{self, Distance, Tolerance};
use crate::reference::{self, Reference};
use checkout::disk;
use checkout::failure::Failure;
use checkout::figure::Figure;
use checkout::paths::Paths;
use files::table::MixedTable;
use std::collections::{BTreeMap, BTreeSet};

/// What a table was compared with.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Against {
    /// The whole committed table: one with the committed sum lies in the checkout.
    #[default]
    Table,
    /// The committed sample of it.
    Sample,
}

/// A table compared.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Compared {
    /// With what.
    pub against: Against,
    /// How far it is from that.
    pub distance: Distance,
}

impl Compared {
    /// Whether every number is the same, to the bit.
    pub fn is_same(&self) -> bool {
        self.distance.cells == 0 && self.distance.unmatched == 0
    }
}

impl Against {
    /// The word for JSON.
    pub fn word(self) -> &'static str {
        match self {
            Against::Table => "table",
            Against::Sample => "sample",
        }
    }
}

/// Compares the tables that a figure has below `made` with the committed ones, by file name. A table that is as
/// committed is compared with its sample as well, to see that the two belong together.
///
/// # Errors
/// A file cannot be read.
pub fn judge(
    paths: &Paths,
    made: &Paths,
    figure: &Figure,
    reference: &Reference,
) -> Result<BTreeMap<String, Result<Compared, String>>, Failure> {
    let tables = reference::tables(made, figure)?;
    let samples = paths.root.join(Paths::golden(&figure.id));
    let committed: Vec<String> = disk::names(&samples)?.into_iter().filter(|name| name.ends_with(".csv")).collect();
    let mut judged = BTreeMap::new();
    for file in tables.keys().chain(&committed).collect::<BTreeSet<_>>() {
        let tolerance = |column: &str| reference.tolerances.column(&figure.id, file, column);
        let sample = disk::read_text(&samples.join(file))?;
        let compared = match (sample, tables.get(file)) {
            (None, _) => Err("no committed sample".to_owned()),
            (_, None) => Err("the table was not made".to_owned()),
            (Some(sample), Some(name)) => {
                let fresh = disk::read_bytes(&made.output(name))?.unwrap_or_default();
                let whole = reference.bytes(paths, figure, name)?.filter(|whole| *whole != fresh);
                compare(&sample, whole.as_deref(), &fresh, &tolerance)
            }
        };
        judged.insert(file.clone(), compared);
    }
    Ok(judged)
}

/// Compares a fresh table with the whole committed one, if that is available and differs, otherwise with the sample.
fn compare(
    sample: &str,
    whole: Option<&[u8]>,
    fresh: &[u8],
    tolerance: &dyn Fn(&str) -> Tolerance,
) -> Result<Compared, String> {
    if let Some(whole) = whole {
        let [committed, made] = parse([(whole, "committed"), (fresh, "made")])?;
        let distance = numbers::compare(&committed, &made, 1, tolerance)?;
        return Ok(Compared { against: Against::Table, distance });
    }
    let text = std::str::from_utf8(fresh).map_err(|error| format!("made: {error}"))?;
    let sampled = golden::sample(text);
    let distance = match sampled == sample {
        true => Distance::default(),
        false => {
            let [sample, sampled] = parse([(sample.as_bytes(), "sample"), (sampled.as_bytes(), "made")])?;
            numbers::compare(&sample, &sampled, golden::step_of(text), tolerance)?
        }
    };
    Ok(Compared { against: Against::Sample, distance })
}

/// Reads two tables with their names.
fn parse(tables: [(&[u8], &str); 2]) -> Result<[MixedTable; 2], String> {
    let [one, other] =
        tables.map(|(bytes, which)| MixedTable::parse(bytes).map_err(|error| format!("{which}: {error}")));
    Ok([one?, other?])
}
