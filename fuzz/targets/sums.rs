//! Lists of sums: what is accepted is written back as an equal list.

use checkout::sums::{State, Sums};

/// Tries one file.
pub fn read(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    match Sums::parse("SHA256SUMS", &text) {
        Ok(sums) => {
            assert_eq!(Sums::parse("SHA256SUMS", &sums.to_text()).as_ref(), Ok(&sums));
            assert!(sums.judge(&sums.by_name).values().all(|state| *state == State::Same));
            assert!(
                sums.by_name.keys().all(|name| !name.starts_with('/') && !name.split('/').any(|part| part == ".."))
            );
        }
        Err(failure) => assert!(failure.text().starts_with("SHA256SUMS:") && failure.code() == 2, "{failure:?}"),
    }
}
