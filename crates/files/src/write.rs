//! Writing so that a reader never meets half a file, and the hash that names contents.

use sha2::{Digest, Sha256};
use std::fs::{self, File};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

/// Writes `bytes` to `path`: into a temporary file beside it, flushed to the disk, then renamed over it.
///
/// # Errors
/// The operating system's error with the path in its text. The temporary file is removed, the old file is untouched.
pub fn atomic(path: &Path, bytes: &[u8]) -> io::Result<()> {
    replace(&[(path, bytes)])
}

/// Writes several files so that all of them appear or none: first each beside its place, then all are renamed.
///
/// # Errors
/// As [`atomic`]; the old files are untouched and no temporary one is left, unless a rename fails half-way.
pub fn atomic_all(files: &[(PathBuf, Vec<u8>)]) -> io::Result<()> {
    let borrowed: Vec<(&Path, &[u8])> = files.iter().map(|(path, bytes)| (path.as_path(), bytes.as_slice())).collect();
    replace(&borrowed)
}

fn replace(files: &[(&Path, &[u8])]) -> io::Result<()> {
    let written: io::Result<()> = files.iter().try_for_each(|&(path, bytes)| {
        let create =
            || File::create(beside(path)).and_then(|mut file| file.write_all(bytes).and_then(|()| file.sync_all()));
        create().map_err(|error| with_path(error, path))
    });
    let renamed = written.and_then(|()| {
        files.iter().try_for_each(|&(path, _)| fs::rename(beside(path), path).map_err(|error| with_path(error, path)))
    });
    if renamed.is_err() {
        for (path, _) in files {
            // a failed clean-up has nothing to add to the error that is already on its way
            let _ = fs::remove_file(beside(path));
        }
    }
    renamed
}

/// The SHA-256 of `bytes`, in 64 lower-case hexadecimal digits.
pub fn sha256(bytes: &[u8]) -> String {
    hexadecimal(Sha256::digest(bytes).as_slice())
}

/// The SHA-256 of a file, read in pieces of 256 KiB.
///
/// # Errors
/// The operating system's error with the path in its text.
pub fn sha256_file(path: &Path) -> io::Result<String> {
    let mut file = File::open(path).map_err(|error| with_path(error, path))?;
    let mut hasher = Sha256::new();
    let mut piece = vec![0; 1 << 18];
    loop {
        match file.read(&mut piece) {
            Ok(0) => return Ok(hexadecimal(hasher.finalize().as_slice())),
            Ok(length) => hasher.update(&piece[..length]),
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Err(error) => return Err(with_path(error, path)),
        }
    }
}

/// The same error, its text preceded by the path it is about.
pub fn with_path(error: io::Error, path: &Path) -> io::Error {
    io::Error::new(error.kind(), format!("{}: {error}", path.display()))
}

/// A name in the same folder, so that the rename stays on one file system; the process number keeps two runs apart.
fn beside(path: &Path) -> PathBuf {
    let mut name = path.file_name().unwrap_or_default().to_os_string();
    name.push(format!(".tmp-{}", std::process::id()));
    path.with_file_name(name)
}

fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}
