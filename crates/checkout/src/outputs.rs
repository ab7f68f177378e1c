//! The outputs of a figure: tables in its folder of data, a PNG and an SVG beside its source.

use crate::disk;
use crate::failure::Failure;
use crate::figure::Figure;
use crate::hashing;
use crate::paths::Paths;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// Hashes of outputs by name relative to the root.
pub type Hashes = BTreeMap<String, String>;

/// The names of the two pictures.
pub fn pictures(paths: &Paths, figure: &Figure) -> [String; 2] {
    let folder = paths.pictures(&figure.slug, &figure.id);
    ["png", "svg"].map(|ending| format!("{folder}/{}.{ending}", figure.id))
}

/// The names of the tables that are there, sorted.
///
/// # Errors
/// The folder cannot be read.
pub fn tables(paths: &Paths, figure: &Figure) -> Result<Vec<String>, Failure> {
    let folder = paths.tables(&figure.id);
    let names = disk::names(&paths.output(&folder))?;
    Ok(names.into_iter().filter(|name| name.ends_with(".csv")).map(|name| format!("{folder}/{name}")).collect())
}

/// The hashes of what each figure has now, in the order of `figures`; what is missing has no entry.
///
/// # Errors
/// A folder or a file cannot be read.
pub fn hash(paths: &Paths, figures: &[&Figure]) -> Result<Vec<Hashes>, Failure> {
    let mut names: Vec<Vec<String>> = Vec::new();
    for figure in figures {
        let mut mine = tables(paths, figure)?;
        mine.extend(pictures(paths, figure));
        names.push(mine);
    }
    let all: Vec<PathBuf> = names.iter().flatten().map(|name| paths.output(name)).collect();
    let mut hashes = hashing::hash_all(&all)?.into_iter();
    let mut own = |names: Vec<String>| {
        let hashed = names.into_iter().zip(&mut hashes);
        hashed.filter_map(|(name, hash)| Some((name, hash?))).collect()
    };
    Ok(names.into_iter().map(&mut own).collect())
}

/// The beginnings that the names of a figure's outputs share, to find them in a list of sums.
pub fn beginnings(paths: &Paths, figure: &Figure) -> Vec<String> {
    vec![format!("{}/", paths.tables(&figure.id)), format!("{}/", paths.pictures(&figure.slug, &figure.id))]
}
