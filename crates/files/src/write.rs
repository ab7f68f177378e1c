//! Atomic writing, and the hash that identifies contents.

use sha2::{Digest, Sha256};
use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

/// The separator between a file's name and the number of its draft.
const DRAFT: &str = ".tmp-";

/// A file written under a temporary name and renamed to its final name when it is complete. Dropped before [`publish`],
/// it leaves nothing.
#[derive(Debug)]
pub struct Draft {
    place: PathBuf,
    beside: PathBuf,
}

impl Draft {
    /// A draft for `place`, in the same folder, so that the last step is a rename.
    ///
    /// # Errors
    /// Something that a rename would destroy has this name: a folder, a pipe, a device. A leftover cannot be removed.
    pub fn new(place: &Path) -> io::Result<Draft> {
        if let Some(kind) = fs::metadata(place).ok().and_then(|data| not_a_file(data.file_type())) {
            let problem = format!("{kind}; the name of a file is needed, which is replaced as a whole");
            return Err(with_path(io::Error::new(io::ErrorKind::InvalidInput, problem), place));
        }
        let beside = place.with_file_name(draft_name(&place.file_name().unwrap_or_default().to_string_lossy()));
        // an earlier process of this number may have been killed
        match fs::remove_file(&beside) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(with_path(error, &beside)),
            _ => {}
        }
        Ok(Draft { place: place.to_path_buf(), beside })
    }

    /// Where to write.
    pub fn path(&self) -> &Path {
        &self.beside
    }

    /// Where the file will be.
    pub fn place(&self) -> &Path {
        &self.place
    }

    /// Writes all of the file and flushes it to the disk.
    ///
    /// # Errors
    /// The operating system's error with the path in its text.
    pub fn fill(&self, bytes: &[u8]) -> io::Result<()> {
        let file = File::create(&self.beside).and_then(|mut file| file.write_all(bytes).and_then(|()| file.sync_all()));
        file.map_err(|error| with_path(error, &self.place))
    }

    /// Flushes what was written through [`Draft::path`] to the disk.
    ///
    /// # Errors
    /// The operating system's error with the path in its text.
    pub fn flush(&self) -> io::Result<()> {
        // Windows flushes only what is open for writing
        let file = File::options().append(true).open(&self.beside);
        file.and_then(|file| file.sync_all()).map_err(|error| with_path(error, &self.place))
    }
}

impl Drop for Draft {
    fn drop(&mut self) {
        // gone when it was published; a failed clean-up has nothing to add to the error that is on its way
        let _ = fs::remove_file(&self.beside);
    }
}

/// A folder, a pipe and the like, in words; `None` for a file.
fn not_a_file(kind: fs::FileType) -> Option<&'static str> {
    #[cfg(unix)]
    {
        use std::os::unix::fs::FileTypeExt as _;
        if kind.is_fifo() {
            return Some("is a pipe");
        }
        if kind.is_char_device() || kind.is_block_device() || kind.is_socket() {
            return Some("is a device");
        }
    }
    kind.is_dir().then_some("is a folder")
}

/// Makes a folder and those above it, where they are missing.
///
/// # Errors
/// As [`can_be_folder`]; or the operating system's, with the path in its text.
pub fn make_folder(path: &Path) -> io::Result<()> {
    can_be_folder(path)?;
    fs::create_dir_all(path).map_err(|error| with_path(error, path))
}

/// Whether a folder of this name is there or can be made, asked before a long run rather than after it.
///
/// # Errors
/// Invalid input: the name, or one above it, is that of something else.
pub fn can_be_folder(path: &Path) -> io::Result<()> {
    // with a file above it a name is neither there nor missing
    let Some((at, data)) = path.ancestors().find_map(|at| Some((at, fs::metadata(at).ok()?))) else { return Ok(()) };
    if data.is_dir() {
        return Ok(());
    }
    let problem = "is no folder; the name of a folder is needed, which is made if it is missing";
    Err(with_path(io::Error::new(io::ErrorKind::InvalidInput, problem), at))
}

/// Whether a file of this name can be written, asked before a long run rather than after it: a draft is, and removed.
/// Nothing is asked of a file whose folder is still to be made.
///
/// # Errors
/// Something that a rename would destroy has this name; or the operating system's, with the path in its text.
pub fn can_be_file(path: &Path) -> io::Result<()> {
    let draft = Draft::new(path)?;
    if !folder_of(path).exists() {
        return Ok(());
    }
    File::create(draft.path()).map(drop).map_err(|error| with_path(error, path))
}

/// The one path of a file under any of its names: absolute and without links, also where it or its folder is still to
/// be made.
pub fn resolved(path: &Path) -> PathBuf {
    let path = std::path::absolute(path).unwrap_or_else(|_| path.to_path_buf());
    let from = |at: &Path| Some(fs::canonicalize(at).ok()?.join(path.strip_prefix(at).ok()?));
    path.ancestors().find_map(from).unwrap_or_else(|| path.clone())
}

/// The name of a draft of `name`: no other process has this number, and no other draft of this process that count.
pub fn draft_name(name: &str) -> String {
    static COUNT: AtomicU64 = AtomicU64::new(0);
    format!("{name}{DRAFT}{}-{}", std::process::id(), COUNT.fetch_add(1, Ordering::Relaxed))
}

/// Whether a name is that of a draft, of any process.
pub fn is_draft_name(name: &str) -> bool {
    let numbers = name.rsplit_once(DRAFT).map_or("", |(_, numbers)| numbers);
    let is_number = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    numbers.splitn(2, '-').all(is_number)
}

/// Puts drafts in their places. Two writers of the same files take turns, so that all files come from one of them.
///
/// # Errors
/// A rename fails: what was renamed before it stays, the other old files are untouched.
pub fn publish(drafts: Vec<Draft>) -> io::Result<()> {
    // each once, whatever its names: this process would wait for itself
    let folders: BTreeSet<PathBuf> = drafts.iter().map(|draft| resolved(&folder_of(&draft.place))).collect();
    // in the order of their names, so that two writers never wait for each other
    let opened: Vec<Option<File>> = folders.iter().map(|folder| File::open(folder).ok()).collect();
    for folder in opened.iter().flatten() {
        // where a folder cannot be locked or opened (Windows, some networks), each file by itself is whole all the same
        let _ = folder.lock();
    }
    for draft in &drafts {
        fs::rename(&draft.beside, &draft.place).map_err(|error| with_path(error, &draft.place))?;
    }
    for folder in opened.iter().flatten() {
        // the names are in the folder: without this a power cut could take them back. Not every file system knows how
        let _ = folder.sync_all();
    }
    Ok(())
}

fn folder_of(path: &Path) -> PathBuf {
    let parent = path.parent().filter(|parent| !parent.as_os_str().is_empty());
    parent.unwrap_or(Path::new(".")).to_path_buf()
}

/// Writes `bytes` to `path`: into a draft beside it, flushed to the disk, then renamed over it.
///
/// # Errors
/// The operating system's error with the path in its text. The draft is removed, the old file is untouched.
pub fn atomic(path: &Path, bytes: &[u8]) -> io::Result<()> {
    publish(vec![filled(path, bytes)?])
}

/// Writes several files so that all of them appear or none: first each beside its place, then all are renamed.
///
/// # Errors
/// Two have the same path. Otherwise as [`atomic`]; the old files are untouched unless a rename fails half-way.
pub fn atomic_all(files: &[(PathBuf, Vec<u8>)]) -> io::Result<()> {
    let mut places = BTreeSet::new();
    if let Some((path, _)) = files.iter().find(|(path, _)| !places.insert(path)) {
        let twice = io::Error::new(io::ErrorKind::InvalidInput, "two files of this name would be written");
        return Err(with_path(twice, path));
    }
    publish(files.iter().map(|(path, bytes)| filled(path, bytes)).collect::<io::Result<_>>()?)
}

fn filled(path: &Path, bytes: &[u8]) -> io::Result<Draft> {
    let draft = Draft::new(path)?;
    draft.fill(bytes).map(|()| draft)
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

fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}
