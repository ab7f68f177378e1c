//! `codecheck.yml`: which files a CODECHECK should make again, in the form of its specification 1.0.
//!
//! Who checks adds name, report and certificate; identifiers of the authors are left out where they are not known.

use super::paper;
use checkout::failure::Failure;
use checkout::figure::Figure;
use checkout::outputs;
use checkout::paths::Paths;
use std::fmt::Write as _;

/// The specification.
pub const VERSION: &str = "https://codecheck.org.uk/spec/config/1.0/";

/// The file: every table and picture of the paper's figures, with the figure it belongs to.
///
/// # Errors
/// A folder of tables cannot be read.
pub fn text(paths: &Paths, figures: &[Figure]) -> Result<String, Failure> {
    let mut text = format!("---\nversion: {VERSION}\n\npaper:\n  title: {}\n  authors:\n", quoted(paper::TITLE));
    for (family, given) in paper::AUTHORS {
        let _ = writeln!(text, "    - name: {}", quoted(&format!("{given} {family}")));
    }
    let _ = write!(text, "  reference: {}\n\nmanifest:\n", paper::address());
    for figure in figures.iter().filter(|figure| !figure.is_supplement()) {
        let kinds =
            [("table", outputs::tables(paths, figure)?), ("picture", outputs::pictures(paths, figure).to_vec())];
        for (kind, names) in kinds {
            for name in names {
                let comment =
                    format!("{kind} of {} ({}): cargo xtask figures {}", figure.id, figure.label(), figure.id);
                let _ = write!(text, "  - file: {}\n    comment: {}\n", quoted(&name), quoted(&comment));
            }
        }
    }
    Ok(text)
}

/// A text of JSON is one of YAML.
fn quoted(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}
