//! The level of pixels: pictures whose bytes are not as committed.

use crate::pixels::{self, Image, Pixels};
use crate::reference::Reference;
use checkout::disk;
use checkout::failure::Failure;
use checkout::figure::Figure;
use checkout::outputs;
use checkout::paths::Paths;
use checkout::sums::State;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// A picture whose bytes are not as committed.
#[derive(Clone, Debug, PartialEq)]
pub enum Picture {
    /// A PNG: its pixels, and the pictures that show them.
    Pixels(Pixels, Shown),
    /// An SVG: it is text. The first byte that differs, and the two lengths in bytes.
    Text {
        /// Index of the byte.
        first: usize,
        /// Bytes of the committed file.
        committed: usize,
        /// Bytes of the file made now.
        made: usize,
    },
    /// It cannot be compared: why.
    Problem(String),
}

/// Where the pictures of a difference were written.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Shown {
    /// Expected, actual, difference, in this order; empty when no folder was given, or no pixel differs.
    pub files: Vec<PathBuf>,
}

impl Picture {
    /// Whether only the file differs and not the picture.
    pub fn is_other_file(&self) -> bool {
        matches!(self, Picture::Pixels(pixels, _) if pixels.changed == 0)
    }

    /// Why it cannot be compared.
    pub fn problem(&self) -> Option<&str> {
        match self {
            Picture::Problem(problem) => Some(problem),
            _ => None,
        }
    }
}

/// Compares each picture of the figure whose bytes differ. With a `folder`, those of a PNG that shows something else
/// are written there: `fig04-expected.png`, `fig04-actual.png`, `fig04-difference.png`.
///
/// # Errors
/// A file cannot be read or written.
pub fn judge(
    paths: &Paths,
    made: &Paths,
    figure: &Figure,
    reference: &Reference,
    files: &BTreeMap<String, State>,
    folder: Option<&Path>,
) -> Result<BTreeMap<String, Picture>, Failure> {
    let mut judged = BTreeMap::new();
    for name in outputs::pictures(made, figure) {
        if files.get(&name) != Some(&State::Differs) {
            continue;
        }
        let actual = disk::read_bytes(&made.output(&name))?.unwrap_or_default();
        let picture = match reference.bytes(paths, figure, &name)? {
            None => Picture::Problem("the committed picture is missing: git restore it".to_owned()),
            Some(expected) if name.ends_with(".png") => compare(&expected, &actual, &figure.id, folder)?,
            Some(expected) => text(&expected, &actual),
        };
        judged.insert(name, picture);
    }
    Ok(judged)
}

fn text(expected: &[u8], actual: &[u8]) -> Picture {
    let shorter = expected.len().min(actual.len());
    let first = expected.iter().zip(actual).position(|(a, b)| a != b).unwrap_or(shorter);
    Picture::Text { first, committed: expected.len(), made: actual.len() }
}

fn compare(expected: &[u8], actual: &[u8], id: &str, folder: Option<&Path>) -> Result<Picture, Failure> {
    let decode = |bytes: &[u8], which: &str| Image::decode(bytes).map_err(|error| format!("{which}: {error}"));
    let images = decode(expected, "committed").and_then(|one| Ok((one, decode(actual, "made")?)));
    let compared = images.and_then(|(one, other)| Ok((pixels::compare(&one, &other)?, one, other)));
    let (pixels, one, other) = match compared {
        Ok(compared) => compared,
        Err(problem) => return Ok(Picture::Problem(problem)),
    };
    let mut shown = Shown::default();
    if let Some(folder) = folder.filter(|_| pixels.changed > 0) {
        let drawn = pixels::difference(&one, &other).encode().map_err(Failure::Failed)?;
        for (what, bytes) in [("expected", expected), ("actual", actual), ("difference", &drawn)] {
            let file = folder.join(format!("{id}-{what}.png"));
            disk::write(&file, bytes)?;
            shown.files.push(file);
        }
    }
    Ok(Picture::Pixels(pixels, shown))
}
