//! `.zenodo.json`: what Zenodo fills its form with.

use super::git::Commit;
use super::paper;
use checkout::failure::Failure;
use serde_json::{Value, json};

/// The file.
///
/// # Errors
/// None at present.
pub fn text(commit: &Commit) -> Result<String, Failure> {
    let value: Value = json!({
        "title": paper::SOFTWARE,
        "upload_type": "software",
        "version": paper::VERSION,
        "publication_date": commit.date,
        "description": paper::DESCRIPTION,
        "notes": format!("Made from commit {}. Code: MIT or Apache-2.0, as you like; data and pictures: CC0.", commit.hash),
        "creators": [{ "name": paper::MAKERS }],
        "keywords": paper::KEYWORDS,
        "license": "MIT",
        "access_right": "open",
        "language": "eng",
        "related_identifiers": [
            { "identifier": paper::DOI, "scheme": "doi", "relation": "isDerivedFrom", "resource_type": "publication-article" }
        ],
    });
    let text = serde_json::to_string_pretty(&value).map_err(Failure::failed)?;
    Ok(format!("{text}\n"))
}
