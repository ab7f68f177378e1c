//! The tables that the ledger reads: where each lies (or that the caller supplied it), and the errors stated for its
//! columns.

use crate::sheet::{LedgerTable, Stated};
use checkout::failure::Failure;
use checkout::manifest::{self, Entry};
use checkout::paths::Paths;
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::rc::Rc;

/// The method of tables whose manifest states the error relative to numbers above 1, not to the range of the column.
const CLOSED_FORM: &str = "closed form";

/// The table of the events of all runs.
pub const EVENTS: &str = "events";

/// Tables by name, each read once.
pub struct Tables<'a> {
    /// The paths of tables that have not been read yet; `None` if all were supplied.
    files: Option<Files<'a>>,
    read: RefCell<BTreeMap<String, Rc<LedgerTable>>>,
}

struct Files<'a> {
    paths: &'a Paths,
    made: &'a Paths,
    entries: BTreeMap<String, Entry>,
}

/// The figure or supplement that makes a table of this name; none for a table that is committed.
pub fn figure_of(table: &str) -> Option<&str> {
    let (folder, _) = table.split_once('/')?;
    let digits = folder.strip_prefix("fig").or_else(|| folder.strip_prefix('s'))?;
    let is_number = digits.len() == 2 && digits.bytes().all(|byte| byte.is_ascii_digit());
    is_number.then_some(folder)
}

impl<'a> Tables<'a> {
    /// Tables of figures from below `made`, committed tables from the checkout `paths`, whose manifest states their
    /// errors.
    ///
    /// # Errors
    /// Usage: the manifest is malformed.
    pub fn new(paths: &'a Paths, made: &'a Paths) -> Result<Tables<'a>, Failure> {
        let files = Files { paths, made, entries: manifest::read(paths)? };
        Ok(Tables { files: Some(files), read: RefCell::default() })
    }

    /// These tables by name, and no others.
    pub fn of_memory(sheets: impl IntoIterator<Item = (String, LedgerTable)>) -> Tables<'static> {
        let read = sheets.into_iter().map(|(name, sheet)| (name, Rc::new(sheet))).collect();
        Tables { files: None, read: RefCell::new(read) }
    }

    /// Whether it is there.
    pub fn has(&self, table: &str) -> bool {
        let is_file = || self.files.as_ref().is_some_and(|files| files.path(table).is_file());
        self.read.borrow().contains_key(table) || is_file()
    }

    /// A table.
    ///
    /// # Errors
    /// What is wrong, and how to get it.
    pub fn get(&self, table: &str) -> Result<Rc<LedgerTable>, String> {
        if let Some(sheet) = self.read.borrow().get(table) {
            return Ok(Rc::clone(sheet));
        }
        let sheet = match &self.files {
            Some(files) => Rc::new(files.read(table)?),
            None => return Err(format!("no table {table}")),
        };
        self.read.borrow_mut().insert(table.to_owned(), Rc::clone(&sheet));
        Ok(sheet)
    }
}

impl Files<'_> {
    /// The path of a table.
    fn path(&self, table: &str) -> PathBuf {
        let base = if figure_of(table).is_some() { self.made } else { self.paths };
        base.output(&Paths::table(table))
    }

    fn read(&self, table: &str) -> Result<LedgerTable, String> {
        let path = self.path(table);
        if !path.is_file() {
            return Err(match figure_of(table) {
                Some(figure) => format!("no table {table}; cargo xtask figures {figure} makes those of {figure}"),
                None => format!("no table {table}: {} is not there", Paths::table(table)),
            });
        }
        let cells = files::table::MixedTable::read(&path).map_err(|error| error.to_string())?;
        let entry = self.entries.get(&Paths::table(table));
        let error = |column: &str| {
            let entry = entry?;
            // a column whose check says nothing has an error that nothing bounds
            let part = entry.error.get(column)?.unwrap_or(f64::INFINITY);
            let of_size = entry.counts.get("method").is_some_and(|method| method == CLOSED_FORM);
            Some(if of_size { Stated::OfSize(part) } else { Stated::OfRange(part) })
        };
        Ok(LedgerTable::new(cells, &error))
    }
}
