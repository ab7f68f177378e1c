//! The archive for a repository such as Zenodo: its contents, and how it is written.
//!
//! Its bytes depend on the commit alone: members are sorted, owners, modes and dates are fixed (the date is that of the
//! commit), nothing is compressed.

pub mod descriptions;
pub mod git;
pub mod tarball;

use checkout::disk;
use checkout::failure::Failure;
use checkout::figure::{self, Figure};
use checkout::outputs;
use checkout::paths::{BUNDLE_TOP, DOCUMENT_PDF, PAGE, Paths};
use checkout::print;
use checkout::process;
use git::Commit;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// In the archive, the folder of the crates that the lock file names.
const VENDOR: &str = "vendor";
/// In the archive, what tells cargo of that folder; `.cargo/config.toml` includes it where it exists.
const VENDORED_CONFIG: &str = ".cargo/vendored.toml";
/// Documents that belong into the archive when they have been made.
const DOCUMENTS: [&str; 2] = [DOCUMENT_PDF, PAGE];

/// The list of sums at the top of the archive, by name.
pub const SUMS: &str = "SHA256SUMS";

/// What a member holds.
#[derive(Clone, Debug, PartialEq)]
pub enum Content {
    /// The bytes of a file.
    File(PathBuf),
    /// These bytes.
    Bytes(Vec<u8>),
}

/// One file of the archive.
#[derive(Clone, Debug, PartialEq)]
pub struct Member {
    /// Its bytes.
    pub content: Content,
    /// Whether it may be executed.
    pub is_program: bool,
}

/// Members by their names, with `/`, relative to the top folder.
pub type Members = BTreeMap<String, Member>;

/// Writes the archive of the commit that is checked out.
///
/// # Errors
/// What kept the archive from being written. That no tracked file is modified has been seen before.
pub fn run(paths: &Paths, out: Option<PathBuf>) -> Result<(), Failure> {
    let archive = out.unwrap_or_else(|| paths.archive());
    let commit = git::commit(paths)?;
    let members = gather(paths, &figure::discover(paths)?, &commit)?;
    tarball::write(&archive, BUNDLE_TOP, commit.seconds, &members)?;
    let hash = files::write::sha256_file(&archive).map_err(Failure::failed)?;
    let (count, commit, archive) = (members.len() + 1, commit.hash, archive.display());
    print::out(&format!("{count} files of commit {commit}\n{hash}  {archive}\n"))
}

/// Everything that belongs into the archive, without the list of sums.
///
/// # Errors
/// Git or cargo fails, or a folder cannot be read.
pub fn gather(paths: &Paths, figures: &[Figure], commit: &Commit) -> Result<Members, Failure> {
    let mut members = Members::new();
    for (name, is_program) in git::tracked(paths)? {
        members.insert(name.clone(), Member { content: Content::File(paths.root.join(name)), is_program });
    }
    let mut made: Vec<String> = Vec::new();
    for figure in figures {
        made.extend(outputs::tables(paths, figure)?);
    }
    made.extend(DOCUMENTS.iter().filter(|name| paths.root.join(name).is_file()).map(|name| (*name).to_owned()));
    for name in made {
        let content = Content::File(paths.root.join(&name));
        members.entry(name).or_insert(Member { content, is_program: false });
    }
    members.extend(vendored(paths)?);
    let mut texts = descriptions::texts(paths, figures, commit, &members)?.to_vec();
    texts.push((VENDORED_CONFIG, vendored_config()));
    texts.push(("COMMIT", format!("{}\n{}\n", commit.hash, commit.date)));
    for (name, text) in texts {
        members.insert(name.to_owned(), Member { content: Content::Bytes(text.into_bytes()), is_program: false });
    }
    Ok(members)
}

/// The sources of all crates that the lock file names, so that nothing has to be fetched.
fn vendored(paths: &Paths) -> Result<Members, Failure> {
    let folder = paths.target.join("bundle").join(VENDOR);
    disk::remove(&folder)?;
    let mut cargo = process::cargo();
    cargo.args(["vendor", "--quiet", "--locked", "--versioned-dirs"]).arg(&folder).current_dir(&paths.root);
    // it prints the configuration that we write ourselves
    cargo.stdout(std::process::Stdio::null());
    process::run_shown(&mut cargo).map_err(|failure| match failure {
        Failure::Child(code) => Failure::Failed(format!("cargo vendor ended with {code}")),
        other => other,
    })?;
    let mut members = Members::new();
    for path in disk::walk(&folder, &|_| true)? {
        let relative = path.strip_prefix(&folder).unwrap_or(&path).iter();
        let parts: Vec<_> = relative.map(|part| part.to_string_lossy()).collect();
        let name = format!("{VENDOR}/{}", parts.join("/"));
        members.insert(name, Member { content: Content::File(path), is_program: false });
    }
    Ok(members)
}

/// `.cargo/config.toml` includes this file where it exists: no tracked file of the archive differs from the commit.
fn vendored_config() -> String {
    format!(
        "[source.crates-io]\nreplace-with = \"vendored\"\n\n[source.vendored]\ndirectory = \"{VENDOR}\"\n\n[net]\noffline = true\n"
    )
}
