//! Sets the article as PDF, with its pictures, from the numbers of the tables.

use crate::quantities::Quantities;
use crate::typeset::{self, Typesetter};
use checkout::disk;
use checkout::failure::Failure;
use checkout::figure::{self, Figure};
use checkout::hashing;
use checkout::paths::{DOCUMENT_PDF, NUMBERS_JSON, NUMBERS_TEX, PAPER_SUMS, PICTURE_PDFS, Paths};
use checkout::print;
use checkout::sums::{State, Sums};
use files::write::{Draft, publish};
use std::path::{Path, PathBuf};

/// The document's main file, by name.
pub const DOCUMENT: &str = "paper/main.typ";
/// The file that sets one picture, by name.
const PICTURE_SOURCE: &str = "paper/picture.typ";

/// How to accept what differs.
const REMEDY: &str = "cargo xtask paper --bless accepts it";

/// Sets the article and its pictures; with `bless` accepts the numbers and sums.
///
/// # Errors
/// Differs: the committed numbers are not those of the tables, or the article has another sum. Unsupported: there is no
/// typesetter.
pub fn run(paths: &Paths, bless: bool) -> Result<(), Failure> {
    let all = figure::discover(paths)?;
    // before the numbers are collected, which takes longer
    let typesetter = typeset::find(paths)?;
    numbers(paths, &all, bless)?;
    let made = set(paths, &all, &typesetter)?;
    compare(paths, &made, bless)?;
    print::out(&format!("{DOCUMENT_PDF}, {} pictures in {PICTURE_PDFS}, {NUMBERS_TEX}\n", made.len() - 1))
}

/// Compares the committed numbers with those of the tables; with `bless` writes them.
fn numbers(paths: &Paths, all: &[Figure], bless: bool) -> Result<(), Failure> {
    let numbers = Quantities::collect(paths, all)?;
    let mut differing = Vec::new();
    for (name, text) in [(NUMBERS_JSON, numbers.to_json()?), (NUMBERS_TEX, numbers.to_tex())] {
        let path = paths.root.join(name);
        if bless {
            disk::write_if_changed(&path, text.as_bytes())?;
            continue;
        }
        let old = disk::read_text(&path)?.unwrap_or_default();
        let first = text.lines().zip(old.lines()).enumerate().find(|(_, (new, old))| new != old);
        match first {
            _ if old == text => {}
            Some((line, (new, _))) => differing.push(format!("{name}:{}: the tables say {}", line + 1, new.trim())),
            None => differing.push(format!(
                "{name}: expected {} lines, found {}",
                text.lines().count(),
                old.lines().count()
            )),
        }
    }
    match differing.is_empty() {
        true => Ok(()),
        false => Err(Failure::Differs(format!("{}\n{REMEDY}", differing.join("\n")))),
    }
}

/// Sets the document and the pictures; their names.
fn set(paths: &Paths, all: &[Figure], typesetter: &Typesetter) -> Result<Vec<String>, Failure> {
    let mut made = vec![DOCUMENT_PDF.to_owned()];
    place(paths, DOCUMENT_PDF, |output| typesetter.set(paths, DOCUMENT, output, &[]))?;
    for figure in all {
        let name = format!("{PICTURE_PDFS}/{}.pdf", figure.id);
        let picture = format!("/{}/{}.svg", paths.pictures(&figure.slug, &figure.id), figure.id);
        let inputs = [("id", figure.id.as_str()), ("picture", &picture), ("title", figure.title())];
        place(paths, &name, |output| typesetter.set(paths, PICTURE_SOURCE, output, &inputs))?;
        made.push(name);
    }
    Ok(made)
}

/// Lets a file be made beside its place, then puts it there.
fn place(paths: &Paths, name: &str, make: impl Fn(&Path) -> Result<(), Failure>) -> Result<(), Failure> {
    let place = paths.root.join(name);
    place.parent().map_or(Ok(()), disk::create_folder)?;
    let draft = Draft::new(&place).map_err(Failure::failed)?;
    make(draft.path())?;
    draft.flush().and_then(|()| publish(vec![draft])).map_err(Failure::failed)
}

fn compare(paths: &Paths, made: &[String], bless: bool) -> Result<(), Failure> {
    let files: Vec<PathBuf> = made.iter().map(|name| paths.root.join(name)).collect();
    let hashes = made.iter().cloned().zip(hashing::hash_all(&files)?);
    let sums = Sums { by_name: hashes.filter_map(|(name, hash)| Some((name, hash?))).collect() };
    let list = paths.root.join(PAPER_SUMS);
    // the page has its line in the same list
    let mut committed = Sums::read(&list, PAPER_SUMS)?.unwrap_or_default();
    let mine = |name: &String| name.ends_with(".pdf");
    if bless {
        committed.by_name.retain(|name, _| !mine(name));
        committed.by_name.extend(sums.by_name);
        return disk::write_if_changed(&list, committed.to_text().as_bytes());
    }
    committed.by_name.retain(|name, _| mine(name));
    let states = committed.judge(&sums.by_name).into_iter().filter(|(_, state)| *state != State::Same);
    let wrong: Vec<String> = states.map(|(name, state)| format!("{}: {name}", state.word())).collect();
    match wrong.is_empty() {
        true => Ok(()),
        false => Err(Failure::Differs(format!("not as in {PAPER_SUMS}:\n{}\n{REMEDY}", wrong.join("\n")))),
    }
}
