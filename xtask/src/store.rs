//! Stored runs: one folder for each, named by the hash of its inputs, with a list of sums that is written last.

use checkout::disk;
use checkout::failure::Failure;
use checkout::hashing;
use checkout::paths::{Paths, Scheme};
use checkout::sums::Sums;
use std::path::{Path, PathBuf};

/// The list of sums inside a stored run.
const STORE_SUMS: &str = "SHA256SUMS";

/// The key of a run: the hash of what determines its numbers.
pub fn key(determinants: &str, numeric_sources: &str, scheme: Scheme) -> String {
    files::write::sha256(format!("{scheme:?}\n{numeric_sources}\n{determinants}").as_bytes())
}

/// The key of the run that checks another: a different method at a tighter tolerance.
pub fn check_key(key: &str) -> String {
    format!("{key}-check")
}

/// The folder of a stored run.
pub fn folder(paths: &Paths, key: &str) -> PathBuf {
    paths.store().join(key)
}

/// The folder a run writes to before it is stored.
pub fn fresh(paths: &Paths, key: &str) -> PathBuf {
    paths.store().join(files::write::draft_name(key))
}

/// Whether the stored run exists and every byte of it is unchanged. The list must name every file: one that lost its
/// end would otherwise let the files it no longer names pass.
///
/// # Errors
/// A file of it cannot be read.
pub fn is_sound(folder: &Path) -> Result<bool, Failure> {
    let Ok(Some(sums)) = Sums::read(&folder.join(STORE_SUMS), STORE_SUMS) else {
        return Ok(false);
    };
    let mut names = disk::names(folder)?;
    names.retain(|name| name != STORE_SUMS);
    let paths: Vec<PathBuf> = sums.by_name.keys().map(|name| folder.join(name)).collect();
    let hashes = hashing::hash_all(&paths)?;
    Ok(!paths.is_empty()
        && names.iter().eq(sums.by_name.keys())
        && hashes.iter().zip(sums.by_name.values()).all(|(found, listed)| found.as_ref() == Some(listed)))
}

/// Stores the run in the folder `fresh`: writes its sums, then moves the folder into the store.
///
/// # Errors
/// The run wrote nothing, or the folder cannot be read, written or moved.
pub fn adopt(fresh: &Path, folder: &Path) -> Result<(), Failure> {
    let names = disk::names(fresh)?;
    if names.is_empty() {
        return Err(Failure::Failed(format!("{}: the run wrote no files", fresh.display())));
    }
    let paths: Vec<PathBuf> = names.iter().map(|name| fresh.join(name)).collect();
    let hashes = hashing::hash_all(&paths)?;
    let by_name = names.into_iter().zip(hashes).filter_map(|(name, hash)| Some((name, hash?))).collect();
    disk::write(&fresh.join(STORE_SUMS), Sums { by_name }.to_text().as_bytes())?;
    disk::replace_folder(fresh, folder)
}
