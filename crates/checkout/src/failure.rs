//! The reasons for which a verb fails, each with its exit code.

use std::fmt::Display;
use std::path::Path;

/// The reason of an end that is not success; the text goes to stderr, the code to the shell.
#[derive(Clone, Debug, PartialEq)]
pub enum Failure {
    /// Something differs from what is committed (1).
    Differs(String),
    /// Wrong use or bad input (2).
    Usage(String),
    /// Something is older than what it is made from (3).
    Stale(String),
    /// A figure or a tool failed: disk full, a crash, a build error (4).
    Failed(String),
    /// The machine lacks a font, a tool or the toolchain (5).
    Unsupported(String),
    /// A program failed and has already reported why; its exit code is passed on.
    Child(i32),
}

impl Failure {
    /// The exit code of the contract.
    pub fn code(&self) -> i32 {
        match self {
            Failure::Differs(_) => 1,
            Failure::Usage(_) => 2,
            Failure::Stale(_) => 3,
            Failure::Failed(_) => 4,
            Failure::Unsupported(_) => 5,
            Failure::Child(code) => *code,
        }
    }

    /// Says the text on stderr, if there is one left to say; the exit code.
    pub fn tell(&self) -> i32 {
        if !self.text().is_empty() {
            eprintln!("{}", self.text());
        }
        self.code()
    }

    /// The text for stderr; empty when there is nothing left to say.
    pub fn text(&self) -> &str {
        match self {
            Failure::Differs(text)
            | Failure::Usage(text)
            | Failure::Stale(text)
            | Failure::Failed(text)
            | Failure::Unsupported(text) => text,
            Failure::Child(_) => "",
        }
    }

    /// A closure for `map_err`: code 4 with the path and the operating system's message.
    pub fn at<E: Display>(path: &Path) -> impl Fn(E) -> Failure {
        let path = path.display().to_string();
        move |error| Failure::Failed(format!("{path}: {error}"))
    }

    /// Code 4 for an error whose text names its path already.
    pub fn failed<E: Display>(error: E) -> Failure {
        Failure::Failed(error.to_string())
    }
}

/// An error of the operating system whose text names its path; a pipe or a device in the place of a file is bad input.
impl From<std::io::Error> for Failure {
    fn from(error: std::io::Error) -> Failure {
        match error.kind() {
            std::io::ErrorKind::InvalidInput => Failure::Usage(error.to_string()),
            _ => Failure::failed(error),
        }
    }
}

impl From<files::reader::SceneError> for Failure {
    fn from(error: files::reader::SceneError) -> Failure {
        Failure::Usage(error.to_string())
    }
}
