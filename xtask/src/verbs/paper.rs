//! `paper`: sets the report as PDF, with its pictures, from figures that verify and from numbers of the tables.

use crate::child;
use crate::cli::PaperArgs;
use crate::disk;
use crate::failure::Failure;
use crate::figure::{self, Figure};
use crate::gate;
use crate::hashing;
use crate::lock::Lock;
use crate::paths::{DOCUMENT, DOCUMENT_PDF, NUMBERS_JSON, NUMBERS_TEX, PAPER_SUMS, PDF_CHECK, PDF_CHECK_PIN};
use crate::paths::{PICTURE_PDFS, PICTURE_SOURCE, Paths};
use crate::print;
use crate::python;
use crate::quantities::Quantities;
use crate::sums::{State, Sums};
use crate::typeset::{self, Typesetter};
use files::write::{Draft, publish};
use std::path::{Path, PathBuf};
use std::process::Command;

/// How to accept what differs.
const REMEDY: &str = "cargo xtask paper --bless accepts it";

/// Runs the verb.
///
/// # Errors
/// Differs: the figures are not the committed ones, the committed numbers are
/// not those of the tables, or the document has another sum. Stale: a figure is. Unsupported: there is no typesetter.
pub fn run(paths: &Paths, arguments: &PaperArgs) -> Result<(), Failure> {
    let all = figure::discover(paths)?;
    let _lock = Lock::take(paths)?;
    gate::figures_verify(paths, &all)?;
    // before the numbers are collected, which takes longer
    let typesetter = typeset::find(paths)?;
    numbers(paths, &all, arguments.bless)?;
    let made = set(paths, &all, &typesetter)?;
    compare(paths, &made, arguments.bless)?;
    if arguments.check {
        check_pdf(paths)?;
    }
    print::out(&format!("{DOCUMENT_PDF}, {} pictures in {PICTURE_PDFS}, {NUMBERS_TEX}\n", made.len() - 1))
}

/// The step of `ci`: the document as committed, and what it claims of itself. Skipped aloud where there is neither a
/// typesetter nor a way to install one, except on a CI machine.
///
/// # Errors
/// As [`run`].
pub fn ci(paths: &Paths) -> Result<(), Failure> {
    if std::env::var_os("CI").is_some() {
        install_python();
    }
    match run(paths, &PaperArgs { check: true, ..PaperArgs::default() }) {
        Err(Failure::Unsupported(why)) if std::env::var_os("CI").is_none() => {
            print::out(&format!("skipped: paper: {why}\n"))
        }
        ended => ended,
    }
}

/// Python with a way to install packages, where this user may install programs.
fn install_python() {
    let can = |program: PathBuf| {
        let program = program.to_string_lossy().into_owned();
        let has = |module: &str| child::first_line(&program, &["-m", module, "--help"]).is_some();
        has("ensurepip") || has("pip")
    };
    if python::find().is_some_and(can) {
        return;
    }
    eprintln!("ci: installing python3, python3-venv");
    for words in
        [&["update", "-qq"][..], &["install", "-y", "-qq", "--no-install-recommends", "python3", "python3-venv"]]
    {
        // whoever may not do this hears from the next step what is missing
        match Command::new("apt-get").args(words).env("DEBIAN_FRONTEND", "noninteractive").status() {
            Ok(status) if status.success() => {}
            Ok(status) => eprintln!("ci: apt-get {}: {status}", words.join(" ")),
            Err(error) => eprintln!("ci: apt-get: {error}"),
        }
    }
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
            None => {
                differing.push(format!("{name}: {} lines in place of {}", old.lines().count(), text.lines().count()))
            }
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
        let name = Paths::picture_pdf(&figure.id);
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

/// What the PDF claims, checked from outside.
fn check_pdf(paths: &Paths) -> Result<(), Failure> {
    let python = python::install(paths, "pdf", PDF_CHECK_PIN)?;
    let mut command = python.command();
    super::test::step(PDF_CHECK, command.arg(PDF_CHECK).arg(DOCUMENT_PDF).current_dir(&paths.root))
}
