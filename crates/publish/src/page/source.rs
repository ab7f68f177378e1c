//! The inputs of the page (figures, manifest, column descriptions, tables, the ledger), each read once.

use super::html;
use checkout::disk;
use checkout::failure::Failure;
use checkout::figure::{self, Figure};
use checkout::manifest::{self, Entry};
use checkout::paths::Paths;
use claims::report::Ledger;
use files::reader::{Section, Value as Toml};
use files::table::Table;
use serde_json::Value;
use std::collections::BTreeMap;

/// What each picture shows, in words, by name.
const ALTERNATIVES: &str = "paper/alternatives.toml";

/// Words and LaTeX symbol of columns, by table and column.
type Columns = BTreeMap<(String, String), (String, String)>;

/// Everything that the page reads.
#[derive(Debug)]
pub struct Source<'a> {
    /// Where it lies.
    pub paths: &'a Paths,
    /// Figures of the paper, then supplements.
    pub figures: Vec<Figure>,
    /// What is known of each output.
    pub manifest: BTreeMap<String, Entry>,
    /// The claims, errata and parameters.
    pub ledger: Ledger,
    /// What each picture shows, in words, by figure.
    alternatives: BTreeMap<String, String>,
    /// What the columns of each table mean, by `fig03/left` and column.
    columns: Columns,
}

impl Source<'_> {
    /// Reads all but the tables.
    ///
    /// # Errors
    /// A file is missing or malformed.
    pub fn read(paths: &Paths) -> Result<Source<'_>, Failure> {
        Ok(Source {
            paths,
            figures: figure::discover(paths)?,
            manifest: manifest::read(paths)?,
            ledger: Ledger::read(paths)?,
            alternatives: alternatives(paths)?,
            columns: columns(paths)?,
        })
    }

    /// The words that stand for a picture.
    ///
    /// # Errors
    /// There are none: a picture without them is lost on those who cannot see it.
    pub fn alternative(&self, id: &str) -> Result<&str, Failure> {
        let missing = || Failure::failed(format!("{ALTERNATIVES}: no words for {id}"));
        self.alternatives.get(id).map(String::as_str).ok_or_else(missing)
    }

    /// What a column means; empty where it is not described.
    pub fn words(&self, table: &str, column: &str) -> &str {
        self.columns.get(&(table.to_owned(), column.to_owned())).map_or("", |(words, _)| words)
    }

    /// The symbol of a column; the criteria differ in theirs from figure to figure.
    pub fn symbol(&self, table: &str, column: &str) -> String {
        let described = self.columns.get(&(table.to_owned(), column.to_owned())).filter(|_| column == "phi");
        described.map_or_else(|| html::symbol(column), |(_, symbol)| html::latex(symbol))
    }

    /// A table, `fig03/left`.
    ///
    /// # Errors
    /// It is missing or malformed.
    pub fn table(&self, name: &str) -> Result<Table, Failure> {
        let path = self.paths.output(&format!("data/{name}.csv"));
        Table::read(&path).map_err(Failure::at(&path))
    }

    /// The words of a text file of the checkout.
    ///
    /// # Errors
    /// It is missing.
    pub fn text(&self, name: &str) -> Result<String, Failure> {
        let path = self.paths.root.join(name);
        disk::read_text(&path)?.ok_or_else(|| Failure::failed(format!("{}: no such file", path.display())))
    }

    /// The bytes of a picture.
    ///
    /// # Errors
    /// It is missing.
    pub fn bytes(&self, name: &str) -> Result<Vec<u8>, Failure> {
        let path = self.paths.output(name);
        std::fs::read(&path).map_err(Failure::at(&path))
    }
}

fn alternatives(paths: &Paths) -> Result<BTreeMap<String, String>, Failure> {
    let path = paths.root.join(ALTERNATIVES);
    let text = disk::read_text(&path)?.ok_or_else(|| Failure::failed(format!("{}: no such file", path.display())))?;
    let section = Section::parse(&path.display().to_string(), &text).map_err(Failure::failed)?;
    let words = section.entries.into_iter().filter_map(|(id, entry)| match entry.value {
        Toml::Text(words) => Some((id, words)),
        _ => None,
    });
    Ok(words.collect())
}

fn columns(paths: &Paths) -> Result<Columns, Failure> {
    let path = paths.root.join("data/datapackage.json");
    let text = disk::read_text(&path)?.ok_or_else(|| Failure::failed(format!("{}: no such file", path.display())))?;
    let package: Value = serde_json::from_str(&text).map_err(Failure::at(&path))?;
    let mut columns = BTreeMap::new();
    for resource in package["resources"].as_array().into_iter().flatten() {
        let table = resource["path"].as_str().unwrap_or("").trim_end_matches(".csv");
        for field in resource["schema"]["fields"].as_array().into_iter().flatten() {
            let text = |key: &str| field[key].as_str().unwrap_or("").to_owned();
            columns.insert((table.to_owned(), text("name")), (text("title"), text("symbol")));
        }
    }
    Ok(columns)
}
