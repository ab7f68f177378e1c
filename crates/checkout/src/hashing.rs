//! SHA-256 of many files at once.

use crate::failure::Failure;
use std::collections::BTreeMap;
use std::fs;
use std::io::ErrorKind;
use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

/// Hashes a file; `None` if it does not exist.
pub type HashOne = dyn Fn(&Path) -> Result<Option<String>, Failure> + Sync;

/// The hashes of files, in the order of `paths`; `None` for what is not there or no file.
///
/// # Errors
/// A file that is there cannot be read.
pub fn hash_all(paths: &[PathBuf]) -> Result<Vec<Option<String>>, Failure> {
    hash_by(paths, &hash)
}

/// As [`hash_all`], by another way to hash one file.
///
/// # Errors
/// Those of `hash`; or a thread panicked, so that some hashes are unknown.
pub fn hash_by(paths: &[PathBuf], hash: &HashOne) -> Result<Vec<Option<String>>, Failure> {
    let next = AtomicUsize::new(0);
    let threads = thread::available_parallelism().map_or(1, NonZero::get).min(paths.len().max(1));
    let work = || {
        let mut mine = Vec::new();
        loop {
            let index = next.fetch_add(1, Ordering::Relaxed);
            match paths.get(index) {
                Some(path) => mine.push((index, hash(path))),
                None => return mine,
            }
        }
    };
    let mut hashes: Vec<Result<Option<String>, Failure>> = vec![Ok(None); paths.len()];
    thread::scope(|scope| {
        let workers: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        for worker in workers {
            let panicked = |_| Failure::Failed("a thread that hashed files panicked".to_owned());
            for (index, hash) in worker.join().map_err(panicked)? {
                hashes[index] = hash;
            }
        }
        Ok::<(), Failure>(())
    })?;
    hashes.into_iter().collect()
}

/// A folder, a device or a link that leads nowhere in the place of a file is no file: it is made again, not read.
fn hash(path: &Path) -> Result<Option<String>, Failure> {
    match fs::metadata(path) {
        Ok(data) if data.is_file() => files::write::sha256_file(path).map(Some).map_err(Failure::failed),
        Ok(_) => Ok(None),
        Err(error) if matches!(error.kind(), ErrorKind::NotFound | ErrorKind::NotADirectory) => Ok(None),
        Err(_) if path.is_symlink() => Ok(None),
        Err(error) => Err(Failure::at(path)(error)),
    }
}

/// One hash for a list of named hashes.
pub fn digest(inputs: &BTreeMap<String, String>) -> String {
    let mut text = String::new();
    for (name, hash) in inputs {
        text.push_str(&format!("{hash}  {name}\n"));
    }
    files::write::sha256(text.as_bytes())
}
