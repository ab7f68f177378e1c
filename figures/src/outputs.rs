//! Whether results can be written, asked before a long run rather than after it.

use crate::failure::Failure;
use files::write::{can_be_file, can_be_folder, resolved};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// Whether these files can be written, and the folder be made, if one is named.
///
/// # Errors
/// One of them is the scene, a folder or a device, or one of the others by another name; a folder that takes no files.
pub fn can_write(scene: &Path, folder: Option<&Path>, results: &[PathBuf]) -> Result<(), Failure> {
    folder.map_or(Ok(()), can_be_folder)?;
    let (scene, mut seen) = (resolved(scene), BTreeSet::new());
    for place in results {
        let file = resolved(place);
        is_not(&scene, place, &file)?;
        if !seen.insert(file) {
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
    let above = place.parent().filter(|above| !above.as_os_str().is_empty() && !above.exists()).map(resolved);
    let is_made = |above: PathBuf| folder.is_some_and(|folder| resolved(folder).starts_with(above));
    if above.is_some_and(|above| !is_made(above)) {
        return Err(Failure::input(format!("{}: its folder is missing; make it first", place.display())));
    }
    Ok(can_be_file(place)?)
}

/// Whether a file that will be replaced is not the scene.
///
/// # Errors
/// It is.
pub fn is_not_scene(place: &Path, scene: &Path) -> Result<(), Failure> {
    is_not(&resolved(scene), place, &resolved(place))
}

/// Whether the file at this place is another one than the scene, both resolved.
fn is_not(scene: &Path, place: &Path, file: &Path) -> Result<(), Failure> {
    if file != scene {
        return Ok(());
    }
    let problem = "is the scene, which would be overwritten; choose another folder or file for the results";
    Err(Failure::input(format!("{}: {problem}", place.display())))
}
