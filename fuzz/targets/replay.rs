//! Replays every stored input, for plain `cargo test` without a fuzzer.

use std::path::Path;

/// Tries all files of a corpus, in the order of their names.
///
/// # Panics
/// When one is not read as it must be; its name is printed before. When there are none: a corpus that is lost checks
/// nothing.
pub fn replay(name: &str, try_one: fn(&[u8])) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(super::TO_ROOT).join("fuzz/corpus").join(name);
    let entries = std::fs::read_dir(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut files: Vec<_> = entries.map(|entry| entry.expect("a file").path()).collect();
    files.sort();
    assert!(!files.is_empty(), "{}: no file", folder.display());
    for file in &files {
        let bytes = std::fs::read(file).expect("a file");
        if std::panic::catch_unwind(|| try_one(&bytes)).is_err() {
            panic!("{}: see above", file.display());
        }
    }
}
