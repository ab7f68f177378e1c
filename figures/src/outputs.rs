//! Whether results can be written, asked before a long run rather than after it.

use crate::failure::Failure;
use files::write::{can_be_file, can_be_folder, is_same_file};
use std::path::{Path, PathBuf};

/// Whether these files can be written, and the folder be made, if one is named.
///
/// # Errors
/// One of them is the scene, a folder or a device, or one of the others by another name; a folder that takes no files.
pub fn can_write(scene: &Path, folder: Option<&Path>, results: &[PathBuf]) -> Result<(), Failure> {
    folder.map_or(Ok(()), can_be_folder)?;
    for (index, place) in results.iter().enumerate() {
        is_not_scene(place, scene)?;
        if results[..index].iter().any(|other| is_same_file(other, place)) {
            return Err(Failure::input(format!("{}: two files of this name would be written", place.display())));
        }
    }
    // the first of the folders that will be made
    let is_missing = |at: &&Path| !at.as_os_str().is_empty() && !at.exists();
    if let Some(first) = folder.and_then(|folder| folder.ancestors().take_while(is_missing).last()) {
        can_be_file(first)?;
    }
    results.iter().try_for_each(|place| can_write_one(place, folder))
}

/// Whether this file can be written, now or after the folder is made.
///
/// # Errors
/// It is a folder or a device; the folder above it is missing, or takes no files.
pub fn can_write_one(place: &Path, folder: Option<&Path>) -> Result<(), Failure> {
    let above = place.parent().filter(|above| !above.as_os_str().is_empty() && !above.exists());
    if above.is_some() && above != folder {
        return Err(Failure::input(format!("{}: its folder is missing; make it first", place.display())));
    }
    Ok(can_be_file(place)?)
}

/// Whether a file that will be replaced is not the scene.
///
/// # Errors
/// It is.
pub fn is_not_scene(place: &Path, scene: &Path) -> Result<(), Failure> {
    if !is_same_file(place, scene) {
        return Ok(());
    }
    let problem = "is the scene, which would be overwritten; choose another folder or file for the results";
    Err(Failure::input(format!("{}: {problem}", place.display())))
}
