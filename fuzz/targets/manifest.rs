//! The manifest: what is accepted is written back unchanged; an error says where it is.

use checkout::manifest;

/// Tries one file.
pub fn read(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    match manifest::parse(&text) {
        Ok(entries) => {
            let again = manifest::parse(&manifest::to_text(entries.clone()).expect("numbers and texts"));
            assert_eq!(again.as_ref(), Ok(&entries));
        }
        Err(problem) => assert!(!problem.is_empty()),
    }
}
