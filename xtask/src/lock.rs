//! The lock: one run at a time in a target folder.

use checkout::disk;
use checkout::failure::Failure;
use checkout::paths::Paths;
use std::fs::{File, TryLockError};
use std::process::Stdio;
use std::sync::{Mutex, PoisonError};

/// The lock of this process, for its programs.
static HELD: Mutex<Option<File>> = Mutex::new(None);

/// Held while the runner writes; freed when dropped, also by a crash. What takes it while this process has it shares
/// it.
#[derive(Debug)]
pub struct Lock {
    /// None for one that shares the lock of another.
    file: Option<File>,
}

impl Lock {
    /// Takes the lock; reports on stderr if it has to wait for another run.
    ///
    /// # Errors
    /// The lock file cannot be written or locked.
    pub fn take(paths: &Paths) -> Result<Lock, Failure> {
        let path = paths.lock();
        // held until the end, so that two threads do not wait for each other's file
        let mut held = HELD.lock().unwrap_or_else(PoisonError::into_inner);
        if held.is_some() {
            return Ok(Lock { file: None });
        }
        disk::own_folder(&paths.xtask())?;
        disk::clear_for_file(&path)?;
        let file = File::create(&path).map_err(Failure::at(&path))?;
        match file.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => {
                eprintln!("waiting for another cargo xtask in this folder");
                file.lock().map_err(Failure::at(&path))?;
            }
            Err(TryLockError::Error(error)) => return Err(Failure::at(&path)(error)),
        }
        *held = Some(file.try_clone().map_err(Failure::at(&path))?);
        Ok(Lock { file: Some(file) })
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        if self.file.is_some() {
            *HELD.lock().unwrap_or_else(PoisonError::into_inner) = None;
        }
    }
}

/// An empty stdin for a program that writes for us: the lock file itself. Where only the runner is killed (not its
/// programs), the lock stays taken until the last of them has ended, and none of them writes beside the next run.
pub fn stdin() -> Stdio {
    let held = HELD.lock().unwrap_or_else(PoisonError::into_inner);
    held.as_ref().and_then(|file| file.try_clone().ok()).map_or_else(Stdio::null, Stdio::from)
}
