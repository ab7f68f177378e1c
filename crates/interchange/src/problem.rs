//! The reasons for which an export fails, each with its exit code.

use std::fmt;
use std::io;

/// A message for the user and whether the input is to blame.
#[derive(Debug, PartialEq)]
pub enum Problem {
    /// Bad input (exit code 2).
    Input(String),
    /// The work failed: disk full and the like (exit code 4).
    Work(String),
}

impl Problem {
    /// The exit code of the process.
    pub fn code(&self) -> u8 {
        match self {
            Problem::Input(_) => 2,
            Problem::Work(_) => 4,
        }
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Problem::Input(text) | Problem::Work(text) => f.write_str(text),
        }
    }
}

impl std::error::Error for Problem {}

impl From<io::Error> for Problem {
    fn from(error: io::Error) -> Problem {
        // a pipe or a device where a file is to be written
        match error.kind() {
            io::ErrorKind::InvalidInput => Problem::Input(error.to_string()),
            _ => Problem::Work(error.to_string()),
        }
    }
}

impl From<files::reader::SceneError> for Problem {
    fn from(error: files::reader::SceneError) -> Problem {
        Problem::Input(error.to_string())
    }
}
