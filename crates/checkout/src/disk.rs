//! Operations on files and folders whose errors name the path.

use crate::failure::Failure;
use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// The text of a file; `None` when there is no such file.
///
/// # Errors
/// Any other error of the operating system, or bytes that are not UTF-8.
pub fn read_text(path: &Path) -> Result<Option<String>, Failure> {
    match fs::read_to_string(path) {
        Ok(text) => Ok(Some(text)),
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
        Err(error) => Err(Failure::at(path)(error)),
    }
}

/// The bytes of a file; `None` when there is no such file.
///
/// # Errors
/// Any other error of the operating system.
pub fn read_bytes(path: &Path) -> Result<Option<Vec<u8>>, Failure> {
    match fs::read(path) {
        Ok(bytes) => Ok(Some(bytes)),
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
        Err(error) => Err(Failure::at(path)(error)),
    }
}

/// Writes a file whole or not at all, with the folders above it.
///
/// # Errors
/// A folder or the file cannot be written.
pub fn write(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    if let Some(parent) = path.parent() {
        create_folder(parent)?;
    }
    files::write::atomic(path, bytes).map_err(Failure::failed)
}

/// The text of a file of the runner, which can be made again: empty if it does not exist or cannot be read.
pub fn read_own(path: &Path) -> String {
    let is_file = path.metadata().is_ok_and(|data| data.is_file());
    if is_file { fs::read_to_string(path).unwrap_or_default() } else { String::new() }
}

/// Writes a file of the runner's own whole or not at all; anything else of that name is removed.
///
/// # Errors
/// A folder or the file cannot be written, or what is in the way not be removed.
pub fn write_own(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    if let Some(parent) = path.parent() {
        own_folder(parent)?;
    }
    clear_for_file(path)?;
    write(path, bytes)
}

/// Makes a folder of the runner's own and those above it; a file or a dead link of this name is removed. Several
/// threads may ask for the same folder at once.
///
/// # Errors
/// The folder cannot be made.
pub fn own_folder(path: &Path) -> Result<(), Failure> {
    // one look decides, and only a file can go: another thread may have made the folder since then, and filled it
    if fs::symlink_metadata(path).is_ok_and(|data| !data.is_dir()) && !path.is_dir() {
        // where it stays, the folder cannot be made, which is told
        let _ = fs::remove_file(path);
    }
    create_folder(path)
}

/// Removes anything that is not a file from the path of a file that will be written.
///
/// # Errors
/// It cannot be removed.
pub fn clear_for_file(path: &Path) -> Result<(), Failure> {
    match fs::symlink_metadata(path) {
        Ok(data) if !data.is_file() => remove(path),
        _ => Ok(()),
    }
}

/// Writes a file unless it holds these bytes already, so that an unchanged file keeps its date.
///
/// # Errors
/// As [`write()`].
pub fn write_if_changed(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    match fs::read(path) {
        Ok(old) if old == bytes => Ok(()),
        _ => write(path, bytes),
    }
}

/// Makes a folder and those above it.
///
/// # Errors
/// The folder cannot be made.
pub fn create_folder(path: &Path) -> Result<(), Failure> {
    fs::create_dir_all(path).map_err(Failure::at(path))
}

/// Removes a file or a folder with everything in it; it is not an error if it does not exist.
///
/// # Errors
/// It cannot be removed.
pub fn remove(path: &Path) -> Result<(), Failure> {
    let removed = match fs::symlink_metadata(path) {
        Ok(data) if data.is_dir() => fs::remove_dir_all(path),
        Ok(_) => fs::remove_file(path),
        Err(error) => Err(error),
    };
    match removed {
        Err(error) if error.kind() != ErrorKind::NotFound => Err(Failure::at(path)(error)),
        _ => Ok(()),
    }
}

/// Moves a folder to `to` on the same file system, replacing anything there. The old one is renamed first and removed
/// last, so only between two renames is neither in place.
///
/// # Errors
/// The old one cannot be moved aside or removed, or the new one not be renamed: then the old one is back in its place.
pub fn replace_folder(from: &Path, to: &Path) -> Result<(), Failure> {
    let name = to.file_name().unwrap_or_default().to_string_lossy();
    let aside = to.with_file_name(files::write::draft_name(&name));
    let is_there = match fs::rename(to, &aside) {
        Ok(()) => true,
        Err(error) if error.kind() == ErrorKind::NotFound => false,
        Err(error) => return Err(Failure::at(to)(error)),
    };
    if let Err(error) = fs::rename(from, to) {
        if is_there {
            fs::rename(&aside, to).map_err(Failure::at(to))?;
        }
        return Err(Failure::at(to)(error));
    }
    remove(&aside)
}

/// The names in a folder, sorted; none when there is no such folder or something else has its name. Names that are not
/// UTF-8 are left out.
///
/// # Errors
/// The folder cannot be read.
pub fn names(folder: &Path) -> Result<Vec<String>, Failure> {
    let entries = match fs::read_dir(folder) {
        Ok(entries) => entries,
        Err(error) if matches!(error.kind(), ErrorKind::NotFound | ErrorKind::NotADirectory) => return Ok(Vec::new()),
        // a link that leads round in a circle
        Err(_) if folder.is_symlink() && folder.metadata().is_err() => return Ok(Vec::new()),
        Err(error) => return Err(Failure::at(folder)(error)),
    };
    let mut names = Vec::new();
    for entry in entries {
        names.extend(entry.map_err(Failure::at(folder))?.file_name().into_string());
    }
    names.sort();
    Ok(names)
}

/// All files below `folder`, sorted; `enter` selects the folders to search, by name.
///
/// # Errors
/// A folder cannot be read.
pub fn walk(folder: &Path, enter: &dyn Fn(&str) -> bool) -> Result<Vec<PathBuf>, Failure> {
    let mut found = Vec::new();
    for name in names(folder)? {
        let path = folder.join(&name);
        if !path.is_dir() {
            found.push(path);
        } else if enter(&name) {
            found.extend(walk(&path, enter)?);
        }
    }
    Ok(found)
}
