//! Scenes that once went wrong: `scenes/*.toml`, each with a comment that says how.

use hunt::judge;
use std::path::Path;

#[test]
fn scenes_that_went_wrong_are_right_or_say_why_not() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let mut files: Vec<_> =
        std::fs::read_dir(&folder).expect("a folder").map(|entry| entry.expect("an entry").path()).collect();
    files.sort();
    assert!(files.len() > 5, "{}", folder.display());
    for file in files {
        let text = std::fs::read_to_string(&file).expect("text");
        for verdict in judge::scene(&text) {
            let name = file.display();
            assert!(verdict.findings.is_empty() && verdict.undecided.is_empty(), "{name}: {verdict:#?}");
        }
    }
}
