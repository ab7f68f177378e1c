//! Writing leaves the whole new file or the old one, and nothing else.

use files::write::{atomic, sha256, sha256_file};
use std::fs;
use std::path::{Path, PathBuf};

/// A folder of its own for a test, removed at the end.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Folder {
        let folder = std::env::temp_dir().join(format!("files-it-{}-{name}", std::process::id()));
        fs::create_dir_all(&folder).expect("a temporary folder");
        Folder(folder)
    }

    fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(&self.0).expect("the folder");
        let mut names: Vec<String> =
            entries.map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        // what cannot be removed here is left to the system's own tidying
        let _ = fs::remove_dir_all(&self.0);
    }
}

#[test]
fn writing_makes_one_file_and_replaces_it() {
    let folder = Folder::new("replace");
    let file = folder.0.join("table.csv");
    for contents in [&b"first"[..], b"second, longer", b""] {
        atomic(&file, contents).expect("it can be written");
        assert_eq!(fs::read(&file).expect("the file"), contents);
        assert_eq!(folder.names(), ["table.csv"]);
    }
}

#[test]
fn a_failed_write_keeps_the_old_and_leaves_nothing() {
    let folder = Folder::new("fail");
    // a folder in the place of the file: the rename fails after the temporary file was written
    let place = folder.0.join("table.csv");
    fs::create_dir_all(place.join("inner")).expect("a folder");
    let error = atomic(&place, b"new").expect_err("a folder is in the way");
    assert!(error.to_string().starts_with(&format!("{}: ", place.display())), "{error}");
    assert_eq!(folder.names(), ["table.csv"]);
    assert!(place.join("inner").is_dir());
    // a folder that does not exist
    let nowhere = folder.0.join("missing").join("table.csv");
    let error = atomic(&nowhere, b"new").expect_err("no folder");
    assert_eq!(error.kind(), std::io::ErrorKind::NotFound);
    assert!(error.to_string().contains("missing"), "{error}");
    assert_eq!(folder.names(), ["table.csv"]);
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_keeps_the_old_file() {
    // every write to this device fails for want of space; a link in a folder lets the write start
    let folder = Folder::new("full");
    let file = folder.0.join("table.csv");
    fs::write(&file, b"old").expect("the old file");
    let temporary = folder.0.join(format!("table.csv.tmp-{}", std::process::id()));
    std::os::unix::fs::symlink("/dev/full", &temporary).expect("a link");
    let error = atomic(&file, b"new").expect_err("the disk is full");
    assert_eq!(error.kind(), std::io::ErrorKind::StorageFull, "{error}");
    assert_eq!(fs::read(&file).expect("the file"), b"old");
    assert_eq!(folder.names(), ["table.csv"]);
}

#[test]
fn hashes_are_those_of_the_standard() {
    // FIPS 180-4: the empty message, and "abc"
    assert_eq!(sha256(b""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    assert_eq!(sha256(b"abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

#[test]
fn a_file_hashes_as_its_bytes() {
    let folder = Folder::new("hash");
    let file = folder.0.join("data");
    // below, at and above the piece in which files are read
    for length in [0, 1, (1 << 18) - 1, 1 << 18, (1 << 18) + 1, 700_000] {
        let bytes: Vec<u8> = (0..length).map(|i: u32| (i % 251) as u8).collect();
        fs::write(&file, &bytes).expect("the file");
        assert_eq!(sha256_file(&file).expect("the hash"), sha256(&bytes));
    }
    let error = sha256_file(Path::new("no/such/file")).expect_err("there is none");
    assert!(error.to_string().starts_with("no/such/file: "), "{error}");
}
