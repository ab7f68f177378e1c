//! A file that is written beside its place and put there when it is whole.

use files::write::with_path;
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

/// The place of a file and the name under which it is written. Dropped before [`Draft::publish`], it leaves nothing.
#[derive(Debug)]
pub struct Draft {
    place: PathBuf,
    beside: PathBuf,
}

impl Draft {
    /// A draft for `place`, in the same folder, so that the last step is a rename. What an earlier process of the same
    /// number left there is removed.
    ///
    /// # Errors
    /// A leftover that cannot be removed.
    pub fn new(place: &Path) -> io::Result<Draft> {
        let mut name = place.file_name().unwrap_or_default().to_os_string();
        name.push(format!(".tmp-{}", std::process::id()));
        let draft = Draft { place: place.to_path_buf(), beside: place.with_file_name(name) };
        match fs::remove_file(&draft.beside) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => Err(with_path(error, &draft.beside)),
            _ => Ok(draft),
        }
    }

    /// Where to write.
    pub fn path(&self) -> &Path {
        &self.beside
    }

    /// Where the file will be.
    pub fn place(&self) -> &Path {
        &self.place
    }

    /// Flushes the file to the disk.
    ///
    /// # Errors
    /// The operating system's error with the path in its text.
    pub fn flush(&self) -> io::Result<()> {
        // Windows flushes only what is open for writing
        let file = File::options().append(true).open(&self.beside);
        file.and_then(|file| file.sync_all()).map_err(|error| with_path(error, &self.place))
    }

    /// Puts the file in its place.
    ///
    /// # Errors
    /// The rename fails; the old file is untouched.
    pub fn publish(self) -> io::Result<()> {
        fs::rename(&self.beside, &self.place).map_err(|error| with_path(error, &self.place))
    }
}

impl Drop for Draft {
    fn drop(&mut self) {
        // gone when it was published; a failed clean-up has nothing to add to the error that is on its way
        let _ = fs::remove_file(&self.beside);
    }
}
