//! One run at a time in one target folder.

use crate::disk;
use crate::failure::Failure;
use crate::paths::Paths;
use std::fs::{File, TryLockError};

/// Held while the runner writes; freed when dropped, also by a crash.
#[derive(Debug)]
pub struct Lock {
    _file: File,
}

impl Lock {
    /// Takes the lock; says so on stderr when it has to wait for another run.
    ///
    /// # Errors
    /// The lock file cannot be written or locked.
    pub fn take(paths: &Paths) -> Result<Lock, Failure> {
        let path = paths.lock();
        disk::create_folder(&paths.xtask())?;
        let file = File::create(&path).map_err(Failure::at(&path))?;
        match file.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => {
                eprintln!("waiting for another cargo xtask that works in this folder");
                file.lock().map_err(Failure::at(&path))?;
            }
            Err(TryLockError::Error(error)) => return Err(Failure::at(&path)(error)),
        }
        Ok(Lock { _file: file })
    }
}
