//! What git knows about the checkout.

use checkout::failure::Failure;
use checkout::paths::Paths;
use std::io::ErrorKind;
use std::process::Command;

/// The commit that an archive is made of.
#[derive(Clone, Debug, PartialEq)]
pub struct Commit {
    /// Its hash.
    pub hash: String,
    /// When it was made, seconds since 1970.
    pub seconds: u64,
    /// The same as a date of the calendar, in UTC.
    pub date: String,
    /// The same with the time of day.
    pub time: String,
}

/// The commit that is checked out.
///
/// # Errors
/// Unsupported: no git, or no repository.
pub fn commit(paths: &Paths) -> Result<Commit, Failure> {
    let mut git = command(paths);
    git.env("TZ", "UTC0").args([
        "show",
        "--no-patch",
        "--date=format-local:%Y-%m-%dT%H:%M:%SZ",
        "--format=%H %ct %cd",
        "HEAD",
    ]);
    let text = output(git)?;
    let mut words = text.split_whitespace();
    let mut word = || words.next().unwrap_or_default().to_owned();
    let (hash, seconds, time) = (word(), word(), word());
    let date = time.split('T').next().unwrap_or_default().to_owned();
    let seconds = seconds.parse().map_err(|_| Failure::Failed(format!("git show: {text:?}")))?;
    Ok(Commit { hash, seconds, date, time })
}

/// Tracked files, and whether each may be executed.
///
/// # Errors
/// Unsupported: no git, or no repository. Failed: a tracked file is a link or a module of its own.
pub fn tracked(paths: &Paths) -> Result<Vec<(String, bool)>, Failure> {
    let mut git = command(paths);
    git.args(["ls-files", "--stage", "-z"]);
    let entry = |entry: &str| {
        let (facts, name) = entry.split_once('\t').unwrap_or_default();
        match facts.get(..6) {
            Some("100644") => Ok((name.to_owned(), false)),
            Some("100755") => Ok((name.to_owned(), true)),
            _ => Err(Failure::Failed(format!("{name}: only plain files can be archived, not mode {facts}"))),
        }
    };
    output(git)?.split_terminator('\0').map(entry).collect()
}

fn command(paths: &Paths) -> Command {
    let mut git = Command::new("git");
    git.arg("-C").arg(&paths.root);
    git
}

fn output(mut git: Command) -> Result<String, Failure> {
    let output = git.output().map_err(|error| match error.kind() {
        ErrorKind::NotFound => Failure::Unsupported("git is missing: the archive names its commit".to_owned()),
        _ => Failure::Failed(format!("git: {error}")),
    })?;
    match output.status.success() {
        true => Ok(String::from_utf8_lossy(&output.stdout).into_owned()),
        false => Err(Failure::Unsupported(format!("git: {}", String::from_utf8_lossy(&output.stderr).trim_end()))),
    }
}
