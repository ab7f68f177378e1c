//! Writing leaves either the old file or the whole new one, and nothing else.

use files::write::{Draft, atomic, atomic_all, draft_name, is_draft_name, make_folder, sha256, sha256_file};
use std::collections::BTreeSet;
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
fn a_folder_is_not_made_in_place_of_a_file() {
    let folder = Folder::new("made");
    let file = folder.0.join("table.csv");
    fs::write(&file, b"old").expect("a file");
    for place in [file.clone(), file.join("inner").join("more")] {
        let error = make_folder(&place).expect_err("a file is in the way");
        assert_eq!(error.kind(), std::io::ErrorKind::InvalidInput);
        assert!(error.to_string().starts_with(&format!("{}: ", file.display())), "{error}");
    }
    assert_eq!(fs::read(&file).expect("the file"), b"old");
    for _ in 0..2 {
        make_folder(&folder.0.join("one").join("two")).expect("nothing is in the way");
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
    // every write to this device fails for want of space
    let folder = Folder::new("full");
    let file = folder.0.join("table.csv");
    fs::write(&file, b"old").expect("the old file");
    let draft = Draft::new(&file).expect("a draft");
    std::os::unix::fs::symlink("/dev/full", draft.path()).expect("a link");
    let error = draft.fill(b"new").expect_err("the disk is full");
    assert_eq!(error.kind(), std::io::ErrorKind::StorageFull, "{error}");
    drop(draft);
    assert_eq!(fs::read(&file).expect("the file"), b"old");
    assert_eq!(folder.names(), ["table.csv"]);
}

#[cfg(unix)]
#[test]
fn a_pipe_is_named_and_stays() {
    let folder = Folder::new("pipe");
    let pipe = folder.0.join("state.csv");
    let made = std::process::Command::new("mkfifo").arg(&pipe).status().expect("mkfifo");
    assert!(made.success());
    let error = atomic(&pipe, b"new").expect_err("a pipe");
    assert!(error.to_string().contains("state.csv: is a pipe"), "{error}");
    let error = atomic(Path::new("/dev/null"), b"new").expect_err("a device");
    assert!(error.to_string().contains("/dev/null: is a device"), "{error}");
    assert_eq!(folder.names(), ["state.csv"]);
}

#[test]
fn threads_that_write_one_path_leave_one_of_the_texts_whole() {
    let folder = Folder::new("threads");
    let file = folder.0.join("table.csv");
    let texts: Vec<Vec<u8>> = (b'a'..=b'd').map(|letter| vec![letter; 100_000]).collect();
    std::thread::scope(|scope| {
        for text in &texts {
            scope.spawn(|| (0..20).for_each(|_| atomic(&file, text).expect("it can be written")));
        }
    });
    assert!(texts.contains(&fs::read(&file).expect("the file")));
    assert_eq!(folder.names(), ["table.csv"]);
}

#[test]
fn all_files_of_a_folder_come_from_one_of_two_writers() {
    let folder = Folder::new("writers");
    let write = |letter: u8| {
        let files: Vec<_> = (0..8).map(|i| (folder.0.join(format!("{i}.csv")), vec![letter])).collect();
        atomic_all(&files).expect("they can be written");
    };
    for _ in 0..10 {
        std::thread::scope(|scope| {
            scope.spawn(|| write(b'a'));
            scope.spawn(|| write(b'b'));
        });
        let contents: BTreeSet<Vec<u8>> =
            folder.names().iter().map(|name| fs::read(folder.0.join(name)).expect("a file")).collect();
        assert_eq!((contents.len(), folder.names().len()), (1, 8));
    }
}

#[test]
fn two_files_of_one_name_are_refused() {
    let folder = Folder::new("twice");
    let file = folder.0.join("std.csv");
    let error = atomic_all(&[(file.clone(), vec![1]), (file, vec![2])]).expect_err("twice");
    assert!(error.to_string().contains("std.csv"), "{error}");
    assert!(folder.names().is_empty());
}

#[test]
fn names_of_drafts_are_known_and_never_the_same() {
    let [one, other] = [0, 1].map(|_| draft_name("fig04.png"));
    assert!(one != other && one.starts_with("fig04.png.tmp-"), "{one} {other}");
    for (name, expected) in
        [(one.as_str(), true), ("a.tmp-12", true), ("a.tmp-12-3", true), ("a.tmp-", false), ("a.tmp-1-", false)]
    {
        assert_eq!(is_draft_name(name), expected, "{name}");
    }
    assert!(!is_draft_name("a.csv") && !is_draft_name("a.tmp-x1"));
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

/// A folder that is locked by one of its names must not be waited for by another.
#[test]
fn files_of_one_folder_are_written_together_whatever_its_names() {
    let folder = Folder::new("names");
    let other = folder.0.join("..").join(folder.0.file_name().expect("a name"));
    let files = [(folder.0.join("one"), b"1".to_vec()), (other.join("two"), b"2".to_vec())];
    let writer = std::thread::spawn(move || atomic_all(&files));
    let begin = std::time::Instant::now();
    while !writer.is_finished() {
        assert!(begin.elapsed().as_secs() < 60, "it waits for itself");
        std::thread::sleep(std::time::Duration::from_millis(1));
    }
    writer.join().expect("no panic").expect("written");
    assert_eq!(folder.names(), ["one", "two"]);
}
